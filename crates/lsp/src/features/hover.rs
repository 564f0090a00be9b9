//! What is said of a word under the pointer: a device, a chip, a pin, a part of the library, a kind, a board, a number.

mod boards;
mod numbers;
mod parts;
mod pins;

use sensedsl_syntax::{SyntaxKind, SyntaxToken};

use super::completion::described::{described, meaning};
use crate::context::{Context, bytes};
use crate::names::{Names, Thing};
use crate::protocol::{Hover, Markup};

pub(crate) use parts::{explained, page};

/// What there is to say of an offset.
pub(crate) fn hover(cx: &Context<'_>, offset: usize) -> Option<Hover> {
    let token = cx.token(offset)?;
    let names = Names::new(&cx.analysis.snapshot);
    let text = match names.at(cx.file, offset).map(|one| &one.thing) {
        Some(Thing::Constant(name)) => constant(cx, name),
        Some(Thing::Driver(name)) => parts::driver(cx, name),
        Some(Thing::Part(name)) => parts::part(cx, name),
        Some(Thing::Board(name)) => boards::board(cx, name),
        Some(Thing::DriverValue(driver, name)) => parts::value(driver, name),
        Some(Thing::Connection(..) | Thing::Group(_)) | None => None,
    };
    let text = text.or_else(|| of_token(cx, &token))?;
    let range = cx.range(bytes(token.text_range()));
    Some(Hover { contents: Markup::new(text), range })
}

/// What a property means.
fn property(cx: &Context<'_>, token: &SyntaxToken) -> Option<String> {
    let meaning = meaning(cx, bytes(token.text_range()).end)?;
    Some(described(meaning))
}

/// What a built-in board is, by its name.
pub(crate) fn board(name: &str) -> Option<String> {
    boards::source(name)
}

fn of_token(cx: &Context<'_>, token: &SyntaxToken) -> Option<String> {
    let parent = token.parent()?;
    match (token.kind(), parent.kind()) {
        (SyntaxKind::Int | SyntaxKind::Float | SyntaxKind::Unit, _) => numbers::number(cx, &parent),
        (SyntaxKind::Ident, SyntaxKind::Property) => property(cx, token),
        (SyntaxKind::Ident, SyntaxKind::OnClause) => boards::source(token.text()),
        (SyntaxKind::Ident | SyntaxKind::Str, SyntaxKind::NameValue | SyntaxKind::StringValue) => {
            pins::pin(cx, token).or_else(|| parts::kind(&parent, token.text()))
        }
        _ => None,
    }
}

/// A constant: how it is written, and what that comes to.
fn constant(cx: &Context<'_>, name: &str) -> Option<String> {
    let snapshot = &cx.analysis.snapshot;
    for (file, tree) in snapshot.trees() {
        let mut all = tree.ast().constants();
        let found = all.find(|one| one.name().is_some_and(|own| own.text() == name));
        let Some(value) = found.and_then(|one| one.value()) else { continue };
        let written = sensedsl_syntax::ast::AstNode::syntax(&value).text().to_string();
        let computed = snapshot.constants().computed(*file, &value);
        let computed = computed.filter(|one| *one != written.trim());
        let computed = computed.map_or(String::new(), |one| format!("\n\n= {one}"));
        return Some(format!("```sensedsl\nconst {name} = {};\n```{computed}", written.trim()));
    }
    None
}
