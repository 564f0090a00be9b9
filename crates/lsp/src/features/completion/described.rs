//! What the table of properties says of one, for people.

use sensedsl_model::meaning::{self, Meaning};

use super::site::Site;
use super::subject::Subject;
use crate::context::Context;

/// What the property means whose name ends at an offset.
pub(crate) fn meaning(cx: &Context<'_>, offset: usize) -> Option<&'static Meaning> {
    let site = Site::of(cx, offset)?;
    let name = cx.text.get(site.word.clone())?;
    let subject = Subject::of(cx, &site);
    match site.words().as_slice() {
        [] => subject.block()?.property(name),
        ["prefer" | "avoid"] => meaning::Block::Wish.property(name),
        _ => None,
    }
}

/// What a property means, in Markdown.
pub(crate) fn described(meaning: &Meaning) -> String {
    let default = match meaning.default {
        "none" => String::new(),
        "required" => "\n\nRequired.".to_owned(),
        default => format!("\n\nDefault: {default}."),
    };
    format!(
        "{}\n\nTakes {}.{default}\n\n```sensedsl\n{}\n```",
        meaning.text, meaning.takes, meaning.example
    )
}
