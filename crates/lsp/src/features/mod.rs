//! What an editor can ask for: one file each. This is the registry, with what the client is told of it.

use serde_json::{Value, json};

use crate::answer::{Answer, Refusal, parameters, told};
use crate::context::Context;
use crate::place::Encoding;
use crate::protocol::{
    CodeActionParams, CompletionParams, OnTypeParams, PinParams, PlaceParams, PlacesParams,
    RangeParams, ReferenceParams, RenameParams,
};

mod actions;
mod completion;
pub(crate) mod diagnostics;
mod folding;
mod formatting;
mod hints;
mod hover;
mod lenses;
mod preview;
mod references;
mod rename;
mod selection;
mod signature;
mod symbols;
mod tokens;

/// What the server can do, for `initialize`.
pub(crate) fn capabilities(encoding: Encoding) -> Value {
    json!({
        "positionEncoding": encoding.name(),
        "textDocumentSync": { "openClose": true, "change": 2, "save": true },
        "codeActionProvider": { "codeActionKinds": actions::KINDS },
        "documentFormattingProvider": true,
        "documentRangeFormattingProvider": true,
        "documentOnTypeFormattingProvider": { "firstTriggerCharacter": "}", "moreTriggerCharacter": [";"] },
        "codeLensProvider": {},
        "completionProvider": { "resolveProvider": true, "triggerCharacters": [" ", "=", "\"", "."] },
        "documentHighlightProvider": true,
        "executeCommandProvider": { "commands": [lenses::EXPLAIN, lenses::CAPACITY] },
        "hoverProvider": true,
        "inlayHintProvider": true,
        "documentSymbolProvider": true,
        "definitionProvider": true,
        "referencesProvider": true,
        "renameProvider": { "prepareProvider": true },
        "workspaceSymbolProvider": true,
        "foldingRangeProvider": true,
        "selectionRangeProvider": true,
        "signatureHelpProvider": { "triggerCharacters": ["=", " ", "["] },
        "semanticTokensProvider": {
            "legend": tokens::legend(),
            "full": true,
            "range": true,
        },
    })
}

/// The answer to a request about an open file; none if there is no such request.
pub(crate) fn of_document(method: &str) -> Option<fn(&Context<'_>, Value) -> Answer> {
    Some(match method {
        "textDocument/codeAction" => |cx, params| {
            let CodeActionParams { range, context, .. } = parameters(params)?;
            told(actions::offered(cx, &cx.bytes(range), &context))
        },
        "textDocument/codeLens" => |cx, _| told(lenses::of_file(cx)),
        "textDocument/completion" => |cx, params| {
            let params: CompletionParams = parameters(params)?;
            told(completion::at(cx, &params))
        },
        "textDocument/definition" => |cx, params| {
            let PlaceParams { position, .. } = parameters(params)?;
            told(references::definition(cx, cx.offset(position)))
        },
        "textDocument/documentHighlight" => |cx, params| {
            let PlaceParams { position, .. } = parameters(params)?;
            told(references::highlights(cx, cx.offset(position)))
        },
        "textDocument/documentSymbol" => |cx, _| told(symbols::of_file(cx)),
        "textDocument/foldingRange" => |cx, _| told(folding::ranges(cx)),
        "textDocument/formatting" => |cx, _| told(formatting::whole(cx)),
        "textDocument/hover" => |cx, params| {
            let PlaceParams { position, .. } = parameters(params)?;
            told(hover::hover(cx, cx.offset(position)))
        },
        "textDocument/inlayHint" => |cx, params| {
            let RangeParams { range, .. } = parameters(params)?;
            told(hints::within(cx, cx.bytes(range)))
        },
        "textDocument/onTypeFormatting" => |cx, params| {
            let OnTypeParams { position, ch, .. } = parameters(params)?;
            told(formatting::typed(cx, cx.offset(position), &ch))
        },
        "textDocument/rangeFormatting" => |cx, params| {
            let RangeParams { range, .. } = parameters(params)?;
            told(formatting::part(cx, cx.bytes(range)))
        },
        "textDocument/prepareRename" => |cx, params| {
            let PlaceParams { position, .. } = parameters(params)?;
            told(rename::prepared(cx, cx.offset(position))?)
        },
        "textDocument/references" => |cx, params| {
            let ReferenceParams { position, context, .. } = parameters(params)?;
            told(references::references(cx, cx.offset(position), context.include_declaration))
        },
        "textDocument/rename" => |cx, params| {
            let RenameParams { position, new_name, .. } = parameters(params)?;
            told(rename::renamed(cx, cx.offset(position), &new_name)?)
        },
        "textDocument/selectionRange" => |cx, params| {
            let PlacesParams { positions, .. } = parameters(params)?;
            let at = positions.into_iter().map(|at| selection::growing(cx, cx.offset(at)));
            told(at.collect::<Vec<_>>())
        },
        "textDocument/semanticTokens/full" => |cx, _| told(tokens::all(cx, None)),
        "textDocument/semanticTokens/range" => |cx, params| {
            let RangeParams { range, .. } = parameters(params)?;
            told(tokens::all(cx, Some(&cx.bytes(range))))
        },
        "textDocument/signatureHelp" => |cx, params| {
            let PlaceParams { position, .. } = parameters(params)?;
            told(signature::help(cx, cx.offset(position)))
        },
        "sensedsl/pin" => |cx, params| {
            let params: PinParams = parameters(params)?;
            told(actions::placed(cx, &params)?)
        },
        "sensedsl/wiring" => |cx, _| told(preview::wiring(cx)),
        _ => return None,
    })
}

/// An answer that needs no file; none if there is no such request.
pub(crate) fn of_nothing(method: &str) -> Option<fn(Value) -> Answer> {
    Some(match method {
        "completionItem/resolve" => |item| Ok(completion::resolved(item)),
        _ => return None,
    })
}

/// The answer to a command about something in a file, whose URI and name are its arguments.
pub(crate) fn executed(cx: &Context<'_>, command: &str, name: &str) -> Answer {
    lenses::executed(cx, command, name)
}

/// A request about all open files, each of which adds to the answer.
pub(crate) type OfAll = fn(&Context<'_>, &Value) -> Result<Vec<Value>, Refusal>;

/// The answer to a request about all open files; none if there is no such request.
pub(crate) fn of_all(method: &str) -> Option<OfAll> {
    Some(match method {
        "workspace/symbol" => symbols::found,
        _ => return None,
    })
}
