//! The part of the Language Server Protocol 3.17 that is spoken here, as types for serde.
//!
//! The names are those of the specification. Only fields that are read or written are there: an editor may send more.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Data in camel case, as the protocol has it.
macro_rules! data {
    ($($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $type:ty,)* })+) => { $(
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
        #[serde(rename_all = "camelCase")]
        pub(crate) struct $name { $($(#[$field_doc])* pub(crate) $field: $type,)* }
    )+ };
}

/// A line and a column, both from 0; columns count units of the negotiated encoding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
pub(crate) struct Position {
    pub(crate) line: u32,
    pub(crate) character: u32,
}

/// From one position up to another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
pub(crate) struct Range {
    pub(crate) start: Position,
    pub(crate) end: Position,
}

data! {
    /// A range in a file.
    Location { uri: String, range: Range, }
    /// The file that a request is about.
    Identifier { uri: String, }
    /// That file and its version.
    Versioned { uri: String, version: i32, }
    /// A file that was opened.
    Item { uri: String, version: i32, text: String, }
    /// Parameters of a request about a file.
    DocumentParams { text_document: Identifier, }
    /// Parameters of a request about a place.
    PlaceParams { text_document: Identifier, position: Position, }
    /// Parameters of a request about a range.
    RangeParams { text_document: Identifier, range: Range, }
    /// Parameters of a request about several places.
    PlacesParams { text_document: Identifier, positions: Vec<Position>, }
    /// Parameters of `textDocument/references`.
    ReferenceParams { text_document: Identifier, position: Position, context: ReferenceContext, }
    /// What of references is wanted.
    ReferenceContext { include_declaration: bool, }
    /// Parameters of `sensedsl/pin`: a device or a chip, its wire as `explain wiring` names it, and the pin it gets.
    PinParams { text_document: Identifier, name: String, wire: String, pin: String, }
    /// Parameters of `textDocument/rename`.
    RenameParams { text_document: Identifier, position: Position, new_name: String, }
    /// Parameters of `textDocument/onTypeFormatting`.
    OnTypeParams { text_document: Identifier, position: Position, ch: String, }
    /// Parameters of `textDocument/didOpen`.
    OpenParams { text_document: Item, }
    /// Parameters of `textDocument/didChange`.
    ChangeParams { text_document: Versioned, content_changes: Vec<Change>, }
    /// Parameters of `workspace/executeCommand`.
    CommandParams { command: String, #[serde(default)] arguments: Vec<Value>, }
    /// Parameters of `workspace/symbol`.
    QueryParams { query: String, }
    /// Text that replaces a range.
    TextEdit { range: Range, new_text: String, }
    /// Changes of several files, by URI.
    WorkspaceEdit { changes: BTreeMap<String, Vec<TextEdit>>, }
    /// Text in Markdown.
    Markup { kind: Kind, value: String, }
    /// A command of the server, or of the client.
    Command { title: String, command: String, #[serde(default)] arguments: Vec<Value>, }
    /// A device, chip, board or constant of a file, with what is in it.
    DocumentSymbol {
        name: String,
        #[serde(skip_serializing_if = "String::is_empty", default)] detail: String,
        kind: u8,
        range: Range,
        selection_range: Range,
        children: Vec<DocumentSymbol>,
    }
    /// A symbol of any file.
    SymbolInformation { name: String, kind: u8, location: Location, container_name: String, }
    /// Lines that can be hidden.
    FoldingRange {
        start_line: u32,
        end_line: u32,
        #[serde(skip_serializing_if = "Option::is_none")] kind: Option<String>,
    }
    /// A text beside the code that is not part of it.
    InlayHint {
        position: Position,
        label: String,
        padding_left: bool,
        #[serde(skip_serializing_if = "Option::is_none")] tooltip: Option<Markup>,
    }
    /// A line above the code.
    CodeLens { range: Range, command: Command, }
    /// What is said of a place.
    Hover { contents: Markup, range: Range, }
    /// A change that is offered.
    CodeAction {
        title: String,
        kind: String,
        #[serde(skip_serializing_if = "Vec::is_empty", default)] diagnostics: Vec<Diagnostic>,
        #[serde(skip_serializing_if = "is_not", default)] is_preferred: bool,
        #[serde(skip_serializing_if = "Option::is_none")] edit: Option<WorkspaceEdit>,
        #[serde(skip_serializing_if = "Option::is_none")] command: Option<Command>,
    }
    /// Something that may be written at a place.
    CompletionItem {
        label: String,
        kind: u8,
        #[serde(skip_serializing_if = "Option::is_none")] detail: Option<String>,
        #[serde(skip_serializing_if = "Option::is_none")] documentation: Option<Markup>,
        sort_text: String,
        #[serde(skip_serializing_if = "Option::is_none")] filter_text: Option<String>,
        insert_text_format: u8,
        #[serde(skip_serializing_if = "Option::is_none")] insert_text_mode: Option<u8>,
        text_edit: TextEdit,
        #[serde(skip_serializing_if = "Vec::is_empty", default)] additional_text_edits: Vec<TextEdit>,
        /// What its documentation is made of, for `completionItem/resolve`.
        #[serde(skip_serializing_if = "Option::is_none")] data: Option<Value>,
    }
    /// Everything that may be written at a place.
    CompletionList { is_incomplete: bool, items: Vec<CompletionItem>, }
    /// What is wrong at a place.
    Diagnostic {
        range: Range,
        severity: u8,
        code: String,
        source: String,
        message: String,
        #[serde(skip_serializing_if = "Vec::is_empty", default)] related_information: Vec<Related>,
        #[serde(skip_serializing_if = "Vec::is_empty", default)] tags: Vec<u8>,
    }
    /// A further place of a diagnostic.
    Related { location: Location, message: String, }
    /// All diagnostics of a file.
    PublishParams {
        uri: String,
        #[serde(skip_serializing_if = "Option::is_none")] version: Option<i32>,
        diagnostics: Vec<Diagnostic>,
    }
    /// A part of a signature, as it stands in its label.
    ParameterInformation { label: String, }
    /// How a property is written.
    SignatureInformation {
        label: String,
        documentation: Markup,
        parameters: Vec<ParameterInformation>,
    }
    /// The property at a place.
    SignatureHelp {
        signatures: Vec<SignatureInformation>,
        active_signature: u32,
        active_parameter: u32,
    }
}

fn is_not(flag: &bool) -> bool {
    !*flag
}

/// An edit of a text: of a range, or without one of everything.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub(crate) struct Change {
    pub(crate) range: Option<Range>,
    pub(crate) text: String,
}

/// Parameters of `textDocument/completion`.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct CompletionParams {
    pub(crate) position: Position,
    pub(crate) context: Option<CompletionContext>,
}

/// Why a completion is asked for.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct CompletionContext {
    /// The character that was typed, if it is one that asks.
    pub(crate) trigger_character: Option<String>,
}

/// Parameters of `textDocument/codeAction`.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct CodeActionParams {
    pub(crate) range: Range,
    #[serde(default)]
    pub(crate) context: CodeActionContext,
}

/// What a client wants of code actions.
#[derive(Clone, Debug, Default, Deserialize)]
pub(crate) struct CodeActionContext {
    /// Only actions of these kinds, or of kinds below them.
    pub(crate) only: Option<Vec<String>>,
}

/// A selection, and what it grows to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct SelectionRange {
    pub(crate) range: Range,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) parent: Option<Box<SelectionRange>>,
}

/// The only kind of text for people.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize)]
pub(crate) enum Kind {
    #[serde(rename = "markdown")]
    Markdown,
}

impl Markup {
    pub(crate) fn new(value: impl Into<String>) -> Self {
        Self { kind: Kind::Markdown, value: value.into() }
    }
}

/// Kinds of symbols.
pub(crate) mod symbol {
    pub(crate) const CLASS: u8 = 5;
    pub(crate) const PROPERTY: u8 = 7;
    pub(crate) const FIELD: u8 = 8;
    pub(crate) const INTERFACE: u8 = 11;
    pub(crate) const METHOD: u8 = 6;
    pub(crate) const FUNCTION: u8 = 12;
    pub(crate) const CONSTANT: u8 = 14;
    pub(crate) const OBJECT: u8 = 19;
}

/// Kinds of completions.
pub(crate) mod completion {
    pub(crate) const FUNCTION: u8 = 3;
    pub(crate) const FIELD: u8 = 5;
    pub(crate) const CLASS: u8 = 7;
    pub(crate) const MODULE: u8 = 9;
    pub(crate) const PROPERTY: u8 = 10;
    pub(crate) const UNIT: u8 = 11;
    pub(crate) const VALUE: u8 = 12;
    pub(crate) const ENUM_MEMBER: u8 = 20;
    pub(crate) const KEYWORD: u8 = 14;
    pub(crate) const SNIPPET: u8 = 15;
    pub(crate) const FILE: u8 = 17;
    pub(crate) const CONSTANT: u8 = 21;
    pub(crate) const TYPE: u8 = 25;
}
