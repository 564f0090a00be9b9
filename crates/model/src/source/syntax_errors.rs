//! Syntax errors in, diagnostics out: the parser says what it found, and people are told what to write.

use std::collections::BTreeSet;

use sensedsl_diagnostics::codes::{
    e0101_unexpected_token, e0102_unknown_character, e0103_unterminated, e0104_missing_semicolon,
    e0105_missing_closing, e0106_bad_number, e0107_misspelled_keyword, e0108_nested_too_deep,
    e0109_bad_string, e0110_misplaced_item, e0116_too_many_tokens, e0117_more_mistakes,
    e0208_unknown_type, e0209_wrong_value, e0210_wrong_unit, e0211_out_of_range,
    e0212_unknown_word, e0220_impossible_type, e0221_identifier_reserved,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span};
use sensedsl_limits::TOKENS_MAX;
use sensedsl_syntax::{Block, Item, Parse, SyntaxError, SyntaxErrorKind, SyntaxKind, TextRange};

use crate::spanned::span;
use crate::value::other_types;

/// The diagnostic for a syntax error in `file`.
pub fn diagnostic(error: &SyntaxError, file: FileId) -> Diagnostic {
    use SyntaxErrorKind as Kind;
    let at = span(file, error.range);
    let expected =
        |what: &str, found: &str| e0101_unexpected_token::unexpected_token(at, what, found);
    match &error.kind {
        Kind::UnexpectedCharacter { character } => unexpected_character(at, *character),
        Kind::RangeWithColon => e0102_unknown_character::range_with_colon(at),
        Kind::UnterminatedComment => e0103_unterminated::unterminated(at, "comment", "*/"),
        Kind::UnterminatedString => e0103_unterminated::unterminated(at, "string", "\""),
        Kind::UnknownEscape { escape } => e0109_bad_string::bad_string(at, escape),
        Kind::InvalidDigit { digit, base } => {
            let why = format!("base {base} has no such digit");
            e0106_bad_number::bad_number(at, &digit.to_string(), &why)
        }
        Kind::MissingDigits { number } => {
            e0106_bad_number::bad_number(at, number, "digits are missing")
        }
        Kind::NumberTooLarge { number } => {
            e0106_bad_number::bad_number(at, number, "it is too large")
        }
        Kind::UnknownUnit { found, suggestion } => unknown_unit(at, found, *suggestion),
        Kind::NonAsciiName { name } => e0221_identifier_reserved::identifier_reserved(
            at,
            name,
            "it has letters that generated code cannot spell",
        ),
        Kind::HyphenInName { name, suggestion, in_value } => {
            hyphen(at, name, suggestion, *in_value)
        }
        Kind::UnknownItem { found, suggestion: Some(meant), .. } => {
            e0107_misspelled_keyword::misspelled_keyword(at, found, meant)
        }
        Kind::UnknownItem { found, suggestion: None, block } => {
            expected(inside(*block), &format!("`{found}`"))
        }
        Kind::NotAllowedHere { item, block } => e0110_misplaced_item::misplaced_item(
            at,
            &format!("{} in {}", item.with_article(), block.with_article()),
            belongs(*item, *block),
        ),
        Kind::Expected { expected: what, found } => expected(&what.to_string(), &found.to_string()),
        Kind::StrayToken { found, block } => expected(inside(*block), &found.to_string()),
        Kind::PinInHead { head, pin } => {
            let kind = if head.ends_with("bool") { "digital" } else { "analog" };
            e0101_unexpected_token::pin_in_head(at, head, kind, pin)
        }
        Kind::StrayCloseBrace => expected("nothing to close", "`}`"),
        Kind::MissingSemicolon => e0104_missing_semicolon::missing_semicolon(at),
        Kind::MissingEquals { property } => expected(&format!("`=` after `{property}`"), "a value"),
        Kind::SingleEquals => e0101_unexpected_token::single_equals(at),
        Kind::DoubledEquals => e0101_unexpected_token::doubled_equals(at),
        Kind::MissingValue { property } => expected(&format!("a value for `{property}`"), "none"),
        Kind::MissingCloseBrace { open, .. } => {
            e0105_missing_closing::missing_closing(at, "}", Some(span(file, *open)))
        }
        Kind::MissingCloseParen { open } => {
            e0105_missing_closing::missing_closing(at, ")", Some(span(file, *open)))
        }
        Kind::ParenthesesAroundList => e0101_unexpected_token::parentheses_around_list(at),
        Kind::TypeOfWords { name } => {
            e0208_unknown_type::unknown_type(at, name, other_types::meant(name))
        }
        Kind::UnitAlone { unit } => e0106_bad_number::unit_alone(at, unit),
        Kind::MissingCloseBracket { open } => {
            e0105_missing_closing::missing_closing(at, "]", Some(span(file, *open)))
        }
        Kind::MissingComma => expected("`,`", "the next value"),
        Kind::TrailingComma => expected("another value after `,`", "none"),
        Kind::NestingTooDeep { limit } => e0108_nested_too_deep::nested_too_deep(at, *limit),
        Kind::TooManyTokens { limit: _ } => e0116_too_many_tokens::too_many_tokens(at, TOKENS_MAX),
        Kind::More { listed, more } => e0117_more_mistakes::more_mistakes(at, *listed, *more),
    }
}

/// Some unknown characters are habits from other languages and word processors.
fn unexpected_character(at: Span, character: char) -> Diagnostic {
    match character {
        '#' => e0102_unknown_character::comment_with_hash(at),
        ':' => e0102_unknown_character::colon(at),
        '…' => e0102_unknown_character::ellipsis(at),
        '\'' | '`' | '\u{2018}'..='\u{201f}' | '«' | '»' | '‹' | '›' => {
            e0102_unknown_character::other_quotes(at)
        }
        '°' | 'º' => e0102_unknown_character::of_unit(at, character, "deg"),
        '\u{b5}' | '\u{3bc}' => e0102_unknown_character::of_unit(at, character, "u"),
        '\u{3a9}' | '\u{2126}' => e0102_unknown_character::of_unit(at, character, "Ohm"),
        '²' => e0102_unknown_character::of_unit(at, character, "^2"),
        '³' => e0102_unknown_character::of_unit(at, character, "3"),
        _ => e0102_unknown_character::unknown_character(at, &character.to_string()),
    }
}

fn hyphen(at: Span, name: &str, suggestion: &str, in_value: bool) -> Diagnostic {
    let diagnostic = e0221_identifier_reserved::identifier_reserved(at, name, "it has a hyphen")
        .here(format!("write `{suggestion}`"))
        .replace(format!("change to `{suggestion}`"), at, suggestion);
    if !in_value {
        return diagnostic;
    }
    let apart = name.replace('-', " - ");
    let help =
        format!("write `{suggestion}` for a name, or `{apart}`, with spaces, for a subtraction");
    diagnostic.help(help).one_of([apart.as_str()])
}

fn unknown_unit(at: Span, found: &str, suggestion: Option<&str>) -> Diagnostic {
    let diagnostic = e0106_bad_number::bad_number(at, found, "there is no such unit");
    match suggestion {
        Some(meant) => diagnostic.here(format!("did you mean `{meant}`?")).replace(
            format!("change to `{meant}`"),
            at,
            meant,
        ),
        None => diagnostic,
    }
}

/// Drops diagnostics about values in statements that have syntax errors: those values are not what
/// was meant.
pub(crate) fn drop_consequences(trees: &[(FileId, Parse)], diagnostics: &mut Vec<Diagnostic>) {
    let mut broken: Vec<Span> = Vec::new();
    for (file, parsed) in trees {
        let errors = parsed.errors().iter().filter(|error| spoils_value(&error.kind));
        // A missing token is reported right after the token before it.
        let place = |range: TextRange| (range.start(), !range.is_empty());
        let places: BTreeSet<_> = errors.map(|error| place(error.range)).collect();
        if places.is_empty() {
            continue;
        }
        let statements = parsed.syntax().descendants().filter(|node| {
            matches!(node.kind(), SyntaxKind::Property | SyntaxKind::Const | SyntaxKind::Type)
        });
        let ranges = statements.map(|node| node.text_range());
        let is_broken = |range: &TextRange| {
            places.range((range.start(), true)..(range.end(), true)).next().is_some()
        };
        broken.extend(ranges.filter(is_broken).map(|range| span(*file, range)));
    }
    broken.sort_unstable();
    let is_value = |one: &Diagnostic| {
        let codes = [
            e0209_wrong_value::CODE,
            e0210_wrong_unit::CODE,
            e0211_out_of_range::CODE,
            e0212_unknown_word::CODE,
            e0220_impossible_type::CODE,
        ];
        codes.contains(&one.code)
    };
    let is_reported = |error: &Diagnostic| {
        let at = error.primary.span;
        // Statements are not nested, except for a type, and the device around a type is not a
        // statement.
        let behind = broken.partition_point(|one| (one.file, one.start) <= (at.file, at.start));
        let before = behind.checked_sub(1).and_then(|number| broken.get(number));
        before.is_some_and(|one| one.file == at.file && at.end <= one.end)
    };
    diagnostics.retain(|one| !is_value(one) || !is_reported(one));
}

/// Whether a mistake leaves the value of its statement in doubt.
fn spoils_value(kind: &SyntaxErrorKind) -> bool {
    use SyntaxErrorKind as Kind;
    !matches!(kind, Kind::MissingSemicolon | Kind::MissingEquals { .. })
}

/// The contents of a block, in words.
fn inside(block: Block) -> &'static str {
    match block {
        Block::File => "`board`, `sensor`, `actuator`, `chip`, `driver`, `test`, `const` or `use`",
        Block::Board => "a sensor, an actuator, a chip, a controller, a rule, a link or a property",
        Block::Chip => "a sensor, an actuator, a connection, a rule or a property",
        Block::Sensor | Block::Actuator => "a property or a rule",
        Block::Driver => "a property, a connection, a reading or a command",
        Block::Connection | Block::Reading | Block::Command | Block::Link => "a property",
        Block::Controller => "a property, such as `reads = [Line];`, or `allow`",
        Block::Test => {
            "a property, a step (`at`, `fault`) or a rule (`always`, `never`, `eventually`, `when`)"
        }
    }
}

/// Where an item belongs.
fn belongs(item: Item, block: Block) -> &'static str {
    match item {
        Item::Use | Item::Const | Item::Board | Item::Driver | Item::Test => "at the top of a file",
        Item::Chip => "in a board or at the top of a file",
        Item::Sensor | Item::Actuator => "in a board, in a chip or at the top of a file",
        Item::Connection => "in a chip or in a driver",
        Item::Reading | Item::Command => "in a driver",
        Item::Link | Item::Controller => "in a board",
        Item::Step => "in a test",
        Item::Rule => "in a board or, for `prefer`, `avoid` and `allow`, in a device or a chip",
        Item::Property if block == Block::File => "in a block; a constant begins with `const`",
        Item::Property => "in a board, a device, a chip, a driver or a link",
    }
}
