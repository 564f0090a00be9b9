//! Semantic tokens: what each word means, for colours that a grammar alone cannot know.
#![expect(clippy::wildcard_enum_match_arm, reason = "most kinds mean nothing here")]

use std::collections::BTreeSet;
use std::ops::Range as Bytes;

use sensedsl_model::kind::KindName;
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_syntax::{SyntaxElement, SyntaxKind, SyntaxToken};
use serde_json::{Value, json};

use crate::context::{Context, bytes};

/// The types that are used, in the order of their numbers.
const TYPES: &[&str] = &[
    "keyword",
    "comment",
    "string",
    "number",
    "operator",
    "type",
    "class",
    "interface",
    "variable",
    "property",
    "enumMember",
    "modifier",
    "function",
];
/// The modifiers that are used, in the order of their bits.
const MODIFIERS: &[&str] = &["declaration", "readonly"];

const DECLARATION: u32 = 1;
const READONLY: u32 = 2;

/// What the numbers mean, for `initialize`.
pub(crate) fn legend() -> Value {
    json!({ "tokenTypes": TYPES, "tokenModifiers": MODIFIERS })
}

/// The tokens of a file, or those that touch a range.
pub(crate) fn all(cx: &Context<'_>, within: Option<&Bytes<usize>>) -> Value {
    let trees = cx.analysis.snapshot.trees().iter();
    let constants = trees.flat_map(|(_, tree)| tree.ast().constants().collect::<Vec<_>>());
    let constants = constants.filter_map(|one| one.name().map(|name| name.text().to_owned()));
    let constants: BTreeSet<String> = constants.collect();
    let mut data: Vec<u32> = Vec::new();
    let mut before = (0, 0);
    let tokens = cx.root().descendants_with_tokens().filter_map(SyntaxElement::into_token);
    for token in tokens {
        let range = bytes(token.text_range());
        let touches = within.is_none_or(|part| range.start < part.end && range.end > part.start);
        let Some((word, modifiers)) = meaning(&token, &constants).filter(|_| touches) else {
            continue;
        };
        let Some(number) = TYPES.iter().position(|one| *one == word) else { continue };
        for line in lines(&token) {
            let place = cx.range(line);
            let (at, end) = (place.start, place.end);
            let column = if at.line == before.0 { at.character - before.1 } else { at.character };
            let number = u32::try_from(number).unwrap_or_default();
            data.extend([
                at.line - before.0,
                column,
                end.character - at.character,
                number,
                modifiers,
            ]);
            before = (at.line, at.character);
        }
    }
    json!({ "data": data })
}

/// The bytes of a token in each of its lines: clients do not take one of several.
fn lines(token: &SyntaxToken) -> Vec<Bytes<usize>> {
    let mut start = usize::from(token.text_range().start());
    let lines = token.text().split_inclusive('\n').map(|line| {
        let range = start..start + line.trim_end_matches(['\r', '\n']).len();
        start += line.len();
        range
    });
    lines.filter(|range| !range.is_empty()).collect()
}

fn meaning(token: &SyntaxToken, constants: &BTreeSet<String>) -> Option<(&'static str, u32)> {
    let kind = token.kind();
    match kind {
        kind if kind.is_comment() => Some(("comment", 0)),
        SyntaxKind::Str => Some(("string", 0)),
        SyntaxKind::Int | SyntaxKind::Float => Some(("number", 0)),
        SyntaxKind::Unit => Some(("modifier", 0)),
        SyntaxKind::Plus
        | SyntaxKind::Minus
        | SyntaxKind::Star
        | SyntaxKind::Slash
        | SyntaxKind::DotDot
        | SyntaxKind::EqEq
        | SyntaxKind::NotEq
        | SyntaxKind::Lt
        | SyntaxKind::LtEq
        | SyntaxKind::Gt
        | SyntaxKind::GtEq => Some(("operator", 0)),
        kind if kind.word().is_some() => Some(("keyword", 0)),
        SyntaxKind::Ident => of_name(token, constants),
        _ => None,
    }
}

fn of_name(token: &SyntaxToken, constants: &BTreeSet<String>) -> Option<(&'static str, u32)> {
    let parent = token.parent()?;
    let is_constant = constants.contains(token.text());
    Some(match parent.kind() {
        SyntaxKind::Const => ("variable", DECLARATION | READONLY),
        SyntaxKind::Board => ("class", DECLARATION),
        SyntaxKind::OnClause => ("class", 0),
        SyntaxKind::Type if is_constant => ("variable", READONLY),
        SyntaxKind::Type | SyntaxKind::Kind => ("type", 0),
        SyntaxKind::Device | SyntaxKind::Chip | SyntaxKind::Controller => ("variable", DECLARATION),
        SyntaxKind::Test => ("class", DECLARATION),
        SyntaxKind::Call => ("function", 0),
        SyntaxKind::SetStep | SyntaxKind::Index => ("variable", 0),
        SyntaxKind::Member
            if token.prev_token().is_some_and(|dot| dot.kind() == SyntaxKind::Dot) =>
        {
            ("property", 0)
        }
        SyntaxKind::Member => ("variable", 0),
        SyntaxKind::Driver => ("interface", DECLARATION),
        SyntaxKind::Reading | SyntaxKind::Command => ("function", DECLARATION),
        SyntaxKind::Connection | SyntaxKind::Property => ("property", 0),
        SyntaxKind::NameValue if is_constant => ("variable", READONLY),
        SyntaxKind::NameValue => {
            // In a step of a test it is a device, or what breaks.
            let Some(property) = parent.ancestors().find_map(ast::Property::cast) else {
                return Some(("variable", 0));
            };
            let of = property.name()?;
            match of.text() {
                "driver" => ("interface", 0),
                "type" if KindName::from_name(token.text()).is_some() => ("type", 0),
                "reading" => ("function", 0),
                _ => ("enumMember", 0),
            }
        }
        SyntaxKind::Reserve | SyntaxKind::Release | SyntaxKind::Allow => ("enumMember", 0),
        _ => return None,
    })
}
