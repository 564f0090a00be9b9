//! Something that is offered: what people see of it, what is written.

use serde_json::Value;

use super::site::Site;
use crate::context::Context;
use crate::protocol::{CompletionItem, CompletionList, Markup};

/// Most items of an answer.
pub(super) const ITEMS_MAX: usize = 200;
/// The text has places to fill in.
const SNIPPET: u8 = 2;
const PLAIN: u8 = 1;
/// The client indents the lines of a text as the line that it goes to.
const ADJUST_INDENTATION: u8 = 2;

/// Something that may be written.
#[derive(Clone, Debug, Default)]
pub(super) struct Item {
    label: String,
    kind: u8,
    detail: Option<String>,
    documentation: Option<String>,
    /// What people type for it, if that is not how its label begins.
    known_as: Option<String>,
    /// What else finds it.
    words: Vec<String>,
    text: String,
    is_snippet: bool,
    /// The order among the others: the lower first.
    rank: u32,
    /// What its documentation is made of when somebody looks at it.
    data: Option<Value>,
}

impl Item {
    pub(super) fn new(label: impl Into<String>, kind: u8) -> Self {
        let label = label.into();
        Self { text: label.clone(), label, kind, rank: 100, ..Self::default() }
    }

    pub(super) fn detail(mut self, detail: impl Into<String>) -> Self {
        self.detail = Some(detail.into());
        self
    }

    pub(super) fn documentation(mut self, text: impl Into<String>) -> Self {
        self.documentation = Some(text.into());
        self
    }

    pub(super) fn text(mut self, text: impl Into<String>) -> Self {
        self.text = text.into();
        self
    }

    /// What is written.
    pub(super) fn written(&self) -> &str {
        &self.text
    }

    pub(super) fn snippet(mut self, text: impl Into<String>) -> Self {
        self.is_snippet = true;
        self.text(text)
    }

    pub(super) fn rank(mut self, rank: u32) -> Self {
        self.rank = rank;
        self
    }

    pub(super) fn known_as(mut self, name: impl Into<String>) -> Self {
        self.known_as = Some(name.into());
        self
    }

    pub(super) fn words(mut self, words: impl IntoIterator<Item = impl Into<String>>) -> Self {
        self.words.extend(words.into_iter().map(Into::into));
        self
    }

    pub(super) fn data(mut self, data: Value) -> Self {
        self.data = Some(data);
        self
    }

    /// What a client compares with what is typed.
    fn filter(&self) -> String {
        let all = self.known_as.iter().chain([&self.label]).chain(&self.words);
        all.cloned().collect::<Vec<_>>().join(" ")
    }

    /// Whether what is typed finds it: its letters are in the filter, in this order.
    fn is_found_by(&self, typed: &str) -> bool {
        let filter = self.filter().to_lowercase();
        let mut letters = filter.chars();
        let is_letter = |one: &char| one.is_alphanumeric();
        typed.to_lowercase().chars().filter(is_letter).all(|one| letters.any(|other| other == one))
    }

    /// How well what is typed finds it: 0 if its name begins so.
    fn distance(&self, typed: &str) -> u8 {
        let typed = typed.to_lowercase();
        let begins = |word: &String| word.to_lowercase().starts_with(&typed);
        if begins(&self.label) || self.known_as.as_ref().is_some_and(begins) {
            0
        } else if self.words.iter().any(begins) {
            1
        } else {
            2
        }
    }
}

/// The items as the answer: if there are too many, those that what is typed finds.
pub(super) fn list(
    cx: &Context<'_>,
    site: &Site<'_>,
    offset: usize,
    mut items: Vec<Item>,
) -> CompletionList {
    let typed = cx.text.get(site.word.start..offset).unwrap_or_default();
    items.sort_by_key(|item| item.rank);
    let mut is_incomplete = false;
    if items.len() > ITEMS_MAX {
        items.retain(|item| item.is_found_by(typed));
        items.sort_by_key(|item| item.distance(typed));
        // What was left out may be what a longer word finds, or a shorter one.
        is_incomplete = true;
        items.truncate(ITEMS_MAX);
    }
    let snippets = cx.documents.snippets;
    let items = items.into_iter().zip(0_u32..);
    let items = items.map(|(item, at)| {
        let is_snippet = item.is_snippet && snippets;
        let text = if item.is_snippet && !snippets { plain(&item.text) } else { item.text.clone() };
        let filter = item.filter();
        CompletionItem {
            kind: item.kind,
            detail: item.detail,
            documentation: item.documentation.map(Markup::new),
            sort_text: format!("{at:04}"),
            filter_text: (filter != item.label).then_some(filter),
            label: item.label,
            insert_text_format: if is_snippet { SNIPPET } else { PLAIN },
            insert_text_mode: text.contains('\n').then_some(ADJUST_INDENTATION),
            text_edit: cx.edit(site.word.clone(), text),
            additional_text_edits: Vec::new(),
            data: item.data,
        }
    });
    CompletionList { is_incomplete, items: items.collect() }
}

/// A text for a snippet.
pub(super) fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('$', "\\$").replace('}', "\\}")
}

/// A snippet with what stands in its places, for clients that have none.
fn plain(snippet: &str) -> String {
    let (mut out, mut depth) = (String::new(), 0_u32);
    let mut letters = snippet.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => out.extend(letters.next()),
            '$' => {
                let is_braced = letters.next_if_eq(&'{').is_some();
                while letters.next_if(char::is_ascii_digit).is_some() {}
                if is_braced {
                    letters.next_if_eq(&':');
                    depth += 1;
                }
            }
            '}' if depth > 0 => depth -= 1,
            other => out.push(other),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_snippet_is_plain_for_clients_that_have_none() {
        assert_eq!(plain("baud = $1;"), "baud = ;");
        let block = "sensor ${1:Name} returns ${2:int16[3]} {\n    $0\n}";
        assert_eq!(plain(block), "sensor Name returns int16[3] {\n    \n}");
        assert_eq!(plain(&escaped("a $1 {b} \\c")), "a $1 {b} \\c");
    }
}
