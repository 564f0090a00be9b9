//! What each word of a text is, by the compiler's tree: what an editor's colours have to tell apart.

use sensedsl_syntax::{SyntaxKind, SyntaxToken};

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Class {
    Comment,
    /// The name of a constant or a pin, a word as a value, a code, a board that another is on.
    Constant,
    /// The name of a device, a reading, a command or a controller.
    Device,
    /// What a condition computes: `rising`.
    Function,
    Keyword,
    Number,
    /// The name of a property, or of what is asked of a device: `Follow.overruns`.
    Property,
    Text,
    /// The name of a board, a chip, a driver, a connection or a test.
    Thing,
    /// A kind, or the type of a value.
    Type,
    Unit,
}

/// The words of a text in its order: bytes from and to, and what each is.
pub(super) fn classes(text: &str) -> Vec<(usize, usize, Class)> {
    let tree = sensedsl_syntax::parse(text).syntax();
    let tokens = tree.descendants_with_tokens().filter_map(|element| element.into_token());
    let words = tokens.filter_map(|token| {
        let range = token.text_range();
        Some((range.start().into(), range.end().into(), class(&token)?))
    });
    words.collect()
}

/// `None` for spaces and marks.
fn class(token: &SyntaxToken) -> Option<Class> {
    use SyntaxKind as Kind;
    Some(match token.kind() {
        kind if kind.is_comment() => Class::Comment,
        kind if kind.word().is_some() => Class::Keyword,
        Kind::Str => Class::Text,
        Kind::Int | Kind::Float => Class::Number,
        Kind::Unit => Class::Unit,
        Kind::Ident => match token.parent()?.kind() {
            Kind::Board | Kind::Chip | Kind::Driver | Kind::Connection | Kind::Test => Class::Thing,
            Kind::Device | Kind::Reading | Kind::Command | Kind::Controller => Class::Device,
            Kind::Call => Class::Function,
            Kind::Property => Class::Property,
            Kind::Member if !is_first(token) => Class::Property,
            Kind::Kind => Class::Type,
            Kind::Type if is_first(token) => Class::Type,
            _ => Class::Constant,
        },
        _ => return None,
    })
}

fn is_first(token: &SyntaxToken) -> bool {
    token.parent().is_some_and(|parent| parent.first_token().as_ref() == Some(token))
}
