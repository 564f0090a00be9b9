//! From text to tokens. Every character of the text belongs to exactly one token, in order, so that
//! the tokens spell the whole text; characters that begin no token become `Unknown` tokens.
//!
//! Mistakes within a token (an unknown escape, a digit that the base does not have) are found here;
//! the parser checks whether a token is in the right place.

mod number;

use crate::error::{Errors, SyntaxErrorKind};
use crate::kind::SyntaxKind;
use crate::literal;
use crate::unit::Unit;
use rowan::{TextRange, TextSize};

/// A piece of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Token {
    /// The kind of the token.
    pub(crate) kind: SyntaxKind,
    /// The range of the token.
    pub(crate) range: TextRange,
}

/// All tokens of a text, and the mistakes within them.
#[derive(Debug)]
pub(crate) struct Lexed {
    pub(crate) tokens: Vec<Token>,
    pub(crate) errors: Errors,
    /// Where lexing stopped because the text has more tokens than are read.
    pub(crate) cut: Option<TextSize>,
}

/// Splits `text` into at most `most` tokens.
pub(crate) fn lex(text: &str, most: usize) -> Lexed {
    let (tokens, errors) = (Vec::new(), Errors::default());
    let mut lexer = Lexer { text, position: 0, tokens, errors };
    while lexer.position < text.len() && lexer.tokens.len() < most {
        let start = lexer.position;
        let kind = lexer.token();
        debug_assert!(lexer.position > start, "a token is never empty");
        let range = TextRange::new(size(start), size(lexer.position));
        lexer.tokens.push(Token { kind, range });
    }
    let cut = (lexer.position < text.len()).then(|| size(lexer.position));
    Lexed { tokens: lexer.tokens, errors: lexer.errors, cut }
}

/// An offset in the tree's type. Texts are far below 4 GiB: the binary refuses larger files.
fn size(offset: usize) -> TextSize {
    TextSize::new(u32::try_from(offset).unwrap_or(u32::MAX))
}

struct Lexer<'a> {
    text: &'a str,
    position: usize,
    tokens: Vec<Token>,
    errors: Errors,
}

/// Words that go on with a step of a test, so that they are neither an operand nor the unit of a number before them.
pub(crate) const JOINTS: &[&str] =
    &["and", "or", "in", "then", "within", "from", "to", "for", "at", "of", "set"];

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.position..).unwrap_or_default()
    }

    fn since(&self, start: usize) -> &'a str {
        self.text.get(start..self.position).unwrap_or_default()
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn peek_second(&self) -> Option<char> {
        self.rest().chars().nth(1)
    }

    fn bump(&mut self) -> Option<char> {
        let character = self.peek()?;
        self.position += character.len_utf8();
        Some(character)
    }

    fn bump_while(&mut self, accept: impl Fn(char) -> bool) {
        while self.peek().is_some_and(&accept) {
            self.bump();
        }
    }

    fn error(&mut self, kind: SyntaxErrorKind, start: usize, end: usize) {
        let range = TextRange::new(size(start), size(end));
        self.errors.push(kind, range);
    }

    /// Consumes one token.
    fn token(&mut self) -> SyntaxKind {
        let start = self.position;
        let rest = self.rest();
        let Some(first) = self.bump() else { return SyntaxKind::Unknown };
        match first {
            '\u{feff}' if start == 0 => SyntaxKind::Bom,
            _ if is_space(first) => {
                self.bump_while(is_space);
                SyntaxKind::Whitespace
            }
            '/' if rest.starts_with("//") => {
                self.bump_while(|character| !is_line_end(character));
                SyntaxKind::LineComment
            }
            '/' if rest.starts_with("/*") => self.block_comment(start),
            '"' => self.string(start),
            '.' if self.peek() == Some('.') => self.dots(),
            '.' if self.peek().is_some_and(|next| next.is_ascii_digit()) => {
                self.fraction_without_integer(start)
            }
            '0'..='9' => self.number(start),
            _ if is_name_start(first) => {
                self.bump_while(is_name_continue);
                // `deg/s` is one word after a number, and a division elsewhere.
                let before = self.text.get(..start).unwrap_or_default().trim_end_matches(' ');
                let is_unit = before.ends_with(|last: char| last.is_ascii_digit());
                let length = Unit::with_slash(rest).filter(|_| is_unit);
                self.position = self.position.max(start + length.unwrap_or(0));
                self.number_of_pin(start);
                SyntaxKind::Ident
            }
            '<' | '>' | '!' | '=' if self.peek() == Some('=') => {
                self.bump();
                match first {
                    '<' => SyntaxKind::LtEq,
                    '>' => SyntaxKind::GtEq,
                    '!' => SyntaxKind::NotEq,
                    _ => SyntaxKind::EqEq,
                }
            }
            '.' if self.is_between_names(start) => SyntaxKind::Dot,
            '%' if self.is_behind_a_number(start) => SyntaxKind::Ident,
            ':' if self.is_between_numbers(start) => {
                self.error(SyntaxErrorKind::RangeWithColon, start, self.position);
                SyntaxKind::DotDot
            }
            _ => punctuation(first).unwrap_or_else(|| self.unknown(start, first)),
        }
    }

    /// Takes the number of a pin of nRF, so that `P0.13` is one word where a pin can be named.
    fn number_of_pin(&mut self, start: usize) {
        let word = self.since(start).as_bytes();
        let is_port = matches!(word, [b'P' | b'p', b'0'..=b'9']);
        let has_number = self.peek() == Some('.')
            && self.peek_second().is_some_and(|next| next.is_ascii_digit());
        let before = self.text.get(..start).unwrap_or_default().trim_end();
        let is_named = before.ends_with(['=', '[', ','])
            || ["reserve", "release"].iter().any(|rule| before.ends_with(rule));
        if is_port && has_number && is_named {
            self.bump();
            self.bump_while(|next| next.is_ascii_digit());
        }
    }

    /// Whether the dot there joins two names.
    fn is_between_names(&self, start: usize) -> bool {
        let before = self.text.get(..start).unwrap_or_default();
        before.ends_with(is_name_continue) && self.peek().is_some_and(is_name_start)
    }

    /// Whether what begins there can be the unit of a number: `50 %`.
    fn is_behind_a_number(&self, start: usize) -> bool {
        let before = self.text.get(..start).unwrap_or_default().trim_end_matches(' ');
        // Before an operand it was meant as an operator that does not exist.
        let behind = self.rest().trim_start_matches(' ');
        let word = behind.split(|next: char| !is_name_continue(next)).next().unwrap_or_default();
        let is_operator = behind.starts_with(|next: char| next.is_alphanumeric() || next == '(')
            && !JOINTS.contains(&word);
        before.ends_with(|last: char| last.is_ascii_digit()) && !is_operator
    }

    fn block_comment(&mut self, start: usize) -> SyntaxKind {
        let body = self.text.get(start + 2..).unwrap_or_default();
        if let Some(length) = body.find("*/") {
            self.position = start + 2 + length + 2;
        } else {
            // The place of the mistake is the beginning of the comment, not the rest of the file.
            self.position = self.text.len();
            self.error(SyntaxErrorKind::UnterminatedComment, start, start + 2);
        }
        SyntaxKind::BlockComment
    }

    fn string(&mut self, start: usize) -> SyntaxKind {
        loop {
            match self.peek() {
                Some('"') => {
                    self.bump();
                    return SyntaxKind::Str;
                }
                Some('\\') => {
                    let (escape, meaning) = literal::escape(self.rest());
                    let at = self.position;
                    self.position += escape.len();
                    // A `\` at the end of the line is reported as an unterminated string.
                    if meaning.is_none() && escape.len() > 1 {
                        let kind = SyntaxErrorKind::UnknownEscape { escape: escape.to_owned() };
                        self.error(kind, at, self.position);
                    }
                }
                Some(character) if !is_line_end(character) => {
                    self.bump();
                }
                Some(_) | None => {
                    self.error(SyntaxErrorKind::UnterminatedString, start, self.position);
                    return SyntaxKind::Str;
                }
            }
        }
    }

    /// `..`, after its first dot. A third dot is a separate mistake: ranges have two dots here,
    /// unlike in some other languages.
    fn dots(&mut self) -> SyntaxKind {
        self.bump();
        let start = self.position;
        self.bump_while(|character| character == '.');
        if self.position > start {
            let kind = SyntaxErrorKind::UnexpectedCharacter { character: '.' };
            self.error(kind, start, self.position);
        }
        SyntaxKind::DotDot
    }

    /// Whether the character at `start`, which was just consumed, has a digit on both sides: `31:18`.
    fn is_between_numbers(&self, start: usize) -> bool {
        let before = self.text.get(..start).unwrap_or_default();
        let is_digit = |one: char| one.is_ascii_digit();
        before.ends_with(is_digit) && self.rest().starts_with(is_digit)
    }

    /// A run of characters that begin no token, reported once. A `#` includes the rest of its line,
    /// because it is meant to begin a comment.
    fn unknown(&mut self, start: usize, first: char) -> SyntaxKind {
        if first == '#' {
            self.bump_while(|character| !is_line_end(character));
        }
        if is_other_quote(first) {
            // A text between such quotes is a single mistake.
            let ends = |character| is_other_quote(character) || is_line_end(character);
            let length = self.rest().find(ends).unwrap_or_default();
            if self.rest().get(length..).is_some_and(|rest| rest.starts_with(is_other_quote)) {
                self.position += length;
                self.bump();
                let kind = SyntaxErrorKind::UnexpectedCharacter { character: first };
                self.error(kind, start, self.position);
                return SyntaxKind::Unknown;
            }
        }
        while self.peek().is_some_and(is_unknown) && !starts_token(self.rest()) {
            self.bump();
        }
        let kind = SyntaxErrorKind::UnexpectedCharacter { character: first };
        self.error(kind, start, self.position);
        SyntaxKind::Unknown
    }
}

fn punctuation(character: char) -> Option<SyntaxKind> {
    Some(match character {
        '{' => SyntaxKind::LBrace,
        '}' => SyntaxKind::RBrace,
        '[' => SyntaxKind::LBracket,
        ']' => SyntaxKind::RBracket,
        '(' => SyntaxKind::LParen,
        ')' => SyntaxKind::RParen,
        '=' => SyntaxKind::Eq,
        ';' => SyntaxKind::Semicolon,
        ',' => SyntaxKind::Comma,
        '+' => SyntaxKind::Plus,
        '-' => SyntaxKind::Minus,
        '*' => SyntaxKind::Star,
        '/' => SyntaxKind::Slash,
        '<' => SyntaxKind::Lt,
        '>' => SyntaxKind::Gt,
        _ => return None,
    })
}

/// Only ASCII white space counts; a no-break space from a web page deserves a report.
fn is_space(character: char) -> bool {
    matches!(character, ' ' | '\t' | '\n' | '\r' | '\u{b}' | '\u{c}')
}

fn is_line_end(character: char) -> bool {
    matches!(character, '\n' | '\r')
}

fn is_digit(character: char) -> bool {
    character.is_ascii_digit() || character == '_'
}

/// Non-ASCII letters belong to a name, which the parser then reports as a whole.
fn is_name_start(character: char) -> bool {
    character.is_alphabetic() || character == '_'
}

fn is_name_continue(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

/// Quotes other than `"`, from other languages and from word processors.
fn is_other_quote(character: char) -> bool {
    matches!(character, '\'' | '`' | '\u{2018}'..='\u{201f}' | '«' | '»' | '‹' | '›')
}

fn is_unknown(character: char) -> bool {
    !is_space(character)
        && !is_name_start(character)
        && !character.is_ascii_digit()
        && character != '"'
        && punctuation(character).is_none()
}

/// Whether a character that is otherwise unknown begins a range or a number here.
fn starts_token(rest: &str) -> bool {
    let mut characters = rest.chars();
    characters.next() == Some('.')
        && characters.next().is_some_and(|next| next == '.' || next.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &[(SyntaxKind, &str)]) {
        let lexed = lex(text, usize::MAX);
        let tokens: Vec<_> =
            lexed.tokens.iter().map(|token| (token.kind, &text[token.range])).collect();
        assert_eq!(tokens, expected, "{text:?}");
        assert_eq!(lexed.errors.list, [], "{text:?}");
    }

    fn check_error(text: &str, expected: &str, at: &str) {
        let lexed = lex(text, usize::MAX);
        let spelled: String = lexed.tokens.iter().map(|token| &text[token.range]).collect();
        assert_eq!(spelled, text);
        let [error] = &lexed.errors.list[..] else { panic!("{text:?}: {:?}", lexed.errors) };
        assert_eq!(format!("{:?}", error.kind), expected, "{text:?}");
        assert_eq!(&text[error.range], at, "{text:?}");
    }

    #[test]
    fn numbers_and_units() {
        use SyntaxKind::{Float, Ident, Int, Whitespace};
        check("60ms", &[(Int, "60"), (Ident, "ms")]);
        check("60 ms", &[(Int, "60"), (Whitespace, " "), (Ident, "ms")]);
        check("0xE6", &[(Int, "0xE6")]);
        check("0x10us", &[(Int, "0x10"), (Ident, "us")]);
        check("0b1010_0000", &[(Int, "0b1010_0000")]);
        check("1_000_000Hz", &[(Int, "1_000_000"), (Ident, "Hz")]);
        check("1.051e-3", &[(Float, "1.051e-3")]);
        check("1e3kHz", &[(Float, "1e3"), (Ident, "kHz")]);
        check("1e", &[(Int, "1"), (Ident, "e")]);
        check("0.1", &[(Float, "0.1")]);
        check("8N1;", &[(Ident, "8N1"), (SyntaxKind::Semicolon, ";")]);
        check("1E3", &[(Float, "1E3")]);
        check("0XF0", &[(Int, "0XF0")]);
        check(
            "20 deg/s;",
            &[(Int, "20"), (Whitespace, " "), (Ident, "deg/s"), (SyntaxKind::Semicolon, ";")],
        );
        check("9.8m/s^2", &[(Float, "9.8"), (Ident, "m/s^2")]);
        check(
            "2 m/sec",
            &[
                (Int, "2"),
                (Whitespace, " "),
                (Ident, "m"),
                (SyntaxKind::Slash, "/"),
                (Ident, "sec"),
            ],
        );
        check(
            "A m/s",
            &[
                (Ident, "A"),
                (Whitespace, " "),
                (Ident, "m"),
                (SyntaxKind::Slash, "/"),
                (Ident, "s"),
            ],
        );
        check("8N1_", &[(Int, "8"), (Ident, "N1_")]);
        check("18446744073709551615", &[(Int, "18446744073709551615")]);
    }

    #[test]
    fn ranges_and_operators() {
        use SyntaxKind::{DotDot, Float, Ident, Int, LParen, Minus, RParen, Slash, Star};
        check("1..5", &[(Int, "1"), (DotDot, ".."), (Int, "5")]);
        check("1.5..2.5", &[(Float, "1.5"), (DotDot, ".."), (Float, "2.5")]);
        check("0x0..0xF", &[(Int, "0x0"), (DotDot, ".."), (Int, "0xF")]);
        check("1e3..2", &[(Float, "1e3"), (DotDot, ".."), (Int, "2")]);
        check("3V..5", &[(Int, "3"), (Ident, "V"), (DotDot, ".."), (Int, "5")]);
        check("A..-1", &[(Ident, "A"), (DotDot, ".."), (Minus, "-"), (Int, "1")]);
        check("(2*3)", &[(LParen, "("), (Int, "2"), (Star, "*"), (Int, "3"), (RParen, ")")]);
        check("1/2//3", &[(Int, "1"), (Slash, "/"), (Int, "2"), (SyntaxKind::LineComment, "//3")]);
    }

    #[test]
    fn trivia_and_strings() {
        use SyntaxKind::{BlockComment, Bom, Ident, LineComment, Semicolon, Str, Whitespace};
        check("\u{feff}a", &[(Bom, "\u{feff}"), (Ident, "a")]);
        check("// a\r\nb", &[(LineComment, "// a"), (Whitespace, "\r\n"), (Ident, "b")]);
        check("/*/ a */b", &[(BlockComment, "/*/ a */"), (Ident, "b")]);
        check(r#""a\"b";"#, &[(Str, r#""a\"b""#), (Semicolon, ";")]);
        check(r#""\u{b0}C\\""#, &[(Str, r#""\u{b0}C\\""#)]);
        check("\"// µ\"", &[(Str, "\"// µ\"")]);
    }

    #[test]
    fn unknown_characters_end_before_a_comment_and_a_number() {
        let kinds =
            |text| lex(text, usize::MAX).tokens.iter().map(|token| token.kind).collect::<Vec<_>>();
        use SyntaxKind::{BlockComment, Float, LineComment, Unknown};
        assert_eq!(kinds("@// a"), [Unknown, LineComment]);
        assert_eq!(kinds("@/* a */"), [Unknown, BlockComment]);
        assert_eq!(kinds("@.5"), [Unknown, Float]);
        assert_eq!(kinds("@:."), [Unknown]);
        assert_eq!(kinds("@.."), [Unknown, SyntaxKind::DotDot]);
        assert_eq!(kinds("@*"), [Unknown, SyntaxKind::Star]);
    }

    #[test]
    fn mistakes_within_tokens() {
        check_error("a /* b", "UnterminatedComment", "/*");
        check_error("\"abc\nd", "UnterminatedString", "\"abc");
        check_error("\"abc\\\nd", "UnterminatedString", "\"abc\\");
        check_error(r#""a\qb""#, r#"UnknownEscape { escape: "\\q" }"#, r"\q");
        check_error(r#""\u{d800}""#, r#"UnknownEscape { escape: "\\u{d800}" }"#, r"\u{d800}");
        check_error(r#""\u{b0""#, r#"UnknownEscape { escape: "\\u" }"#, r"\u");
        check_error("0b102", "InvalidDigit { digit: '2', base: 2 }", "2");
        check_error("0x", r#"MissingDigits { number: "0x" }"#, "0x");
        check_error("0x_", r#"MissingDigits { number: "0x_" }"#, "0x_");
        check_error("1.;", r#"MissingDigits { number: "1." }"#, "1.");
        check_error("1...5", "UnexpectedCharacter { character: '.' }", ".");
        check_error("a . b", "UnexpectedCharacter { character: '.' }", ".");
        check_error("31:18", "RangeWithColon", ":");
        check_error("a : b", "UnexpectedCharacter { character: ':' }", ":");
        check_error(".5", r#"MissingDigits { number: ".5" }"#, ".5");
        let large = "18446744073709551616";
        check_error(large, &format!("NumberTooLarge {{ number: {large:?} }}"), large);
        check_error("1e999", r#"NumberTooLarge { number: "1e999" }"#, "1e999");
        check_error("a @?@ b", "UnexpectedCharacter { character: '@' }", "@?@");
        check_error("a # b\nc", "UnexpectedCharacter { character: '#' }", "# b");
        check_error("a\u{a0}b", "UnexpectedCharacter { character: '\\u{a0}' }", "\u{a0}");
        check_error("a\u{feff}", "UnexpectedCharacter { character: '\\u{feff}' }", "\u{feff}");
    }
}
