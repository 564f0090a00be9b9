//! Where the cursor is: an open text in, the blocks around it, the statement before it and its word out.
//!
//! This reads tokens and not the tree, as a text that is being typed has no tree worth the name: `sensor X returns
//! uint16 { ty` is the beginning of a property in a device.

use std::ops::Range;

use sensedsl_syntax::{SyntaxElement, SyntaxKind};

use crate::context::{Context, bytes};

/// A token other than white space and comments.
#[derive(Clone, Debug)]
pub(crate) struct Token<'a> {
    pub(crate) kind: SyntaxKind,
    pub(crate) text: &'a str,
    range: Range<usize>,
    begins_line: bool,
}

/// A block: the words before its brace, its statements and the blocks in it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Block<'a> {
    pub(crate) head: Vec<Token<'a>>,
    pub(crate) statements: Vec<Vec<Token<'a>>>,
    pub(crate) blocks: Vec<Block<'a>>,
}

/// The place of the cursor.
#[derive(Debug)]
pub(crate) struct Site<'a> {
    /// The blocks around it, from the inside; the last is the file.
    pub(crate) blocks: Vec<Block<'a>>,
    /// The statement up to the word.
    pub(crate) before: Vec<Token<'a>>,
    /// The word at the cursor, in bytes; empty if there is none.
    pub(crate) word: Range<usize>,
    /// Whether the word is within quotes.
    pub(crate) in_text: bool,
    /// Whether it is a number.
    pub(crate) in_number: bool,
    /// The token after the word, on the same line.
    pub(crate) next: Option<Token<'a>>,
}

/// The words that begin a block.
const KEYWORDS: [&str; 12] = [
    "spare",
    "board",
    "chip",
    "sensor",
    "actuator",
    "driver",
    "connection",
    "reading",
    "command",
    "link",
    "controller",
    "test",
];

impl<'a> Block<'a> {
    /// The word that its head begins with, without `spare`.
    pub(crate) fn keyword(&self) -> &'a str {
        let words = self.head.iter().map(|token| token.text);
        words.into_iter().find(|word| *word != "spare").unwrap_or_default()
    }

    /// The word after a word of its head.
    pub(crate) fn after(&self, word: &str) -> Option<&'a str> {
        let at = self.head.iter().position(|token| token.text == word)?;
        self.head.get(at + 1).map(|token| token.text)
    }

    /// Its name.
    pub(crate) fn name(&self) -> Option<&'a str> {
        self.after(self.keyword())
    }

    /// The names of its properties.
    pub(crate) fn properties(&self) -> impl Iterator<Item = &'a str> {
        self.statements.iter().filter_map(|statement| match statement.as_slice() {
            [name, equals, ..] if equals.kind == SyntaxKind::Eq => Some(name.text),
            _ => None,
        })
    }

    /// The value of a property that is a name or a text.
    pub(crate) fn value(&self, name: &str) -> Option<&'a str> {
        let found = self.statements.iter().find_map(|statement| match statement.as_slice() {
            [own, equals, value, ..] if own.text == name && equals.kind == SyntaxKind::Eq => {
                Some(value.text.trim_matches('"'))
            }
            _ => None,
        });
        found.filter(|value| !value.is_empty())
    }
}

impl<'a> Site<'a> {
    /// The place of an offset; none in a comment.
    pub(crate) fn of(cx: &Context<'a>, offset: usize) -> Option<Self> {
        let tokens = tokens(cx, offset)?;
        let text = tokens.iter().find(|token| is_in_text(token, offset));
        let (mut word, in_text) = match text {
            Some(token) => (within_quotes(token), true),
            None => (compound(&tokens, offset).unwrap_or_else(|| word(cx.text, offset)), false),
        };
        let run = cx.text.get(word.clone()).unwrap_or_default();
        let in_number = !in_text && run.starts_with(|one: char| one.is_ascii_digit());
        let mut reader = Reader::default();
        let mut around = None;
        for token in &tokens {
            if around.is_none() && (token.range.start >= word.start || token.range.end > offset) {
                around = Some(reader.around(begins_line(cx.text, word.start)));
            }
            reader.take(token, around.as_mut());
        }
        let mut around = around.unwrap_or_else(|| reader.around(begins_line(cx.text, word.start)));
        reader.end(&mut around);
        // Before a statement another one begins.
        if around.before.is_empty() && word.start == offset && !in_text {
            word.end = offset;
        }
        let next = tokens.into_iter().find(|token| token.range.start >= word.end.max(offset));
        let next = next.filter(|next| !next.begins_line);
        let Around { blocks, before, .. } = around;
        Some(Self { blocks, before, word, in_text, in_number, next })
    }

    /// The block that the cursor is in.
    pub(crate) fn block(&self) -> &Block<'a> {
        static FILE: Block<'static> =
            Block { head: Vec::new(), statements: Vec::new(), blocks: Vec::new() };
        self.blocks.first().unwrap_or(&FILE)
    }

    /// The texts of the statement up to the word.
    pub(crate) fn words(&self) -> Vec<&'a str> {
        self.before.iter().map(|token| token.text).collect()
    }

    /// The property in whose value the cursor is, and the tokens of the value before it.
    pub(crate) fn property(&self) -> Option<(&'a str, &[Token<'a>])> {
        let at = self.before.iter().position(|token| token.kind == SyntaxKind::Eq)?;
        let name = self.before.get(at.checked_sub(1)?)?;
        Some((name.text, self.before.get(at + 1..).unwrap_or_default()))
    }
}

/// The tokens of a text that say something; none if the offset is in a comment.
fn tokens<'a>(cx: &Context<'a>, offset: usize) -> Option<Vec<Token<'a>>> {
    let (mut tokens, mut begins_line) = (Vec::new(), true);
    for token in cx.root().descendants_with_tokens().filter_map(SyntaxElement::into_token) {
        let (kind, range) = (token.kind(), bytes(token.text_range()));
        let text = cx.text.get(range.clone()).unwrap_or_default();
        if kind.is_trivia() {
            let is_open = kind == SyntaxKind::LineComment || !text.ends_with("*/");
            let is_within = range.start < offset && offset < range.end + usize::from(is_open);
            if kind.is_comment() && is_within {
                return None;
            }
            begins_line |= text.contains('\n');
            continue;
        }
        tokens.push(Token { kind, text, range, begins_line });
        begins_line = false;
    }
    Some(tokens)
}

/// The unit of several parts at an offset, such as `m/s^2`.
fn compound(tokens: &[Token<'_>], offset: usize) -> Option<Range<usize>> {
    let is_here = |token: &&Token<'_>| {
        token.kind == SyntaxKind::Unit
            && token.text.contains('/')
            && (token.range.start..=token.range.end).contains(&offset)
    };
    tokens.iter().find(is_here).map(|token| token.range.clone())
}

/// Whether an offset is between the quotes of a token.
fn is_in_text(token: &Token<'_>, offset: usize) -> bool {
    let is_text = token.kind == SyntaxKind::Str && token.range.start < offset;
    is_text && (offset < token.range.end || offset == token.range.end && !is_closed(token))
}

fn is_closed(token: &Token<'_>) -> bool {
    token.text.len() > 1 && token.text.ends_with('"')
}

/// What is between the quotes.
fn within_quotes(token: &Token<'_>) -> Range<usize> {
    let end = token.range.end - usize::from(is_closed(token));
    token.range.start + 1..end
}

/// The word at an offset, with the hyphens and dots that names of boards and pins have; or the number.
fn word(text: &str, offset: usize) -> Range<usize> {
    let (before, after) = text.split_at_checked(offset).unwrap_or((text, ""));
    let is_name = |one: char| one.is_alphanumeric() || one == '_';
    let run = before.trim_end_matches(|one: char| is_name(one) || one == '-' || one == '.');
    let mut start = run.len();
    let mut own = before.get(start..).unwrap_or_default();
    if let Some(range) = own.rfind("..") {
        start += range + 2;
        own = own.get(range + 2..).unwrap_or_default();
    }
    let is_sign = |one: char| one == '-' || one == '.';
    let digits = |one: char| one.is_ascii_digit() || is_sign(one) || one == '_';
    let unsigned = own.trim_start_matches(is_sign);
    let end = offset + rest_of_name(after);
    let rest = own.trim_start_matches(digits);
    let is_number = unsigned.starts_with(|one: char| one.is_ascii_digit());
    // `10m` is a number and the beginning of its unit.
    let skipped = if is_number && !rest.is_empty() && !unsigned.starts_with("0x") {
        own.len() - rest.len()
    } else {
        own.len() - unsigned.len()
    };
    start + skipped..end
}

/// How far the name at the beginning of a text goes on: `P0.13` and `NUCLEO-F446RE` are one.
fn rest_of_name(text: &str) -> usize {
    let mut letters = text.char_indices().peekable();
    while let Some((at, letter)) = letters.next() {
        let is_inner =
            |next: Option<&(usize, char)>| next.is_some_and(|next| next.1.is_alphanumeric());
        let goes_on = letter.is_alphanumeric()
            || letter == '_'
            || (letter == '.' || letter == '-') && is_inner(letters.peek());
        if !goes_on {
            return at;
        }
    }
    text.len()
}

/// Whether there is nothing before an offset on its line.
fn begins_line(text: &str, offset: usize) -> bool {
    let before = text.get(..offset).unwrap_or_default();
    before.rsplit('\n').next().unwrap_or_default().trim().is_empty()
}

/// What is around the cursor.
struct Around<'a> {
    /// Those that have ended, from the inside.
    blocks: Vec<Block<'a>>,
    before: Vec<Token<'a>>,
    /// How many blocks around it have not ended.
    open: usize,
}

/// Reads tokens into blocks.
#[derive(Default)]
struct Reader<'a> {
    /// The blocks around the current one, with what is in each so far.
    outer: Vec<Block<'a>>,
    current: Block<'a>,
    /// The tokens since the last statement or block.
    pending: Vec<Token<'a>>,
}

impl<'a> Reader<'a> {
    /// What is around a cursor after the tokens that were read.
    fn around(&self, begins_line: bool) -> Around<'a> {
        let mut statements = split(&self.pending);
        let last = statements.pop().unwrap_or_default();
        let is_new =
            begins_line && last.last().is_none_or(|token| !goes_on(token)) && !is_open(&last);
        let before = if is_new { Vec::new() } else { last };
        Around { blocks: Vec::new(), before, open: self.outer.len() + 1 }
    }

    fn take(&mut self, token: &Token<'a>, around: Option<&mut Around<'a>>) {
        if token.kind == SyntaxKind::Semicolon {
            self.finish();
        } else if token.kind == SyntaxKind::LBrace {
            self.open();
        } else if token.kind == SyntaxKind::RBrace {
            self.finish();
            if let Some(outer) = self.outer.pop() {
                self.close(outer, around);
            }
        } else {
            self.pending.push(token.clone());
        }
    }

    /// Begins a block, whose head are the last words that begin as one.
    fn open(&mut self) {
        let starts = |(at, one): (usize, &Token<'a>)| {
            (KEYWORDS.contains(&one.text) && (at == 0 || one.begins_line)).then_some(at)
        };
        let at = self.pending.iter().enumerate().rev().find_map(starts).unwrap_or(0);
        let head = self.pending.split_off(at);
        self.finish();
        let block = Block { head, ..Block::default() };
        self.outer.push(std::mem::replace(&mut self.current, block));
    }

    fn finish(&mut self) {
        self.current.statements.append(&mut split(&self.pending));
        self.pending.clear();
    }

    /// Ends the current block, which is in another one.
    fn close(&mut self, outer: Block<'a>, around: Option<&mut Around<'a>>) {
        let ended = std::mem::replace(&mut self.current, outer);
        if let Some(around) = around.filter(|around| around.open == self.outer.len() + 2) {
            around.open -= 1;
            around.blocks.push(ended.clone());
        }
        self.current.blocks.push(ended);
    }

    /// Ends all blocks at the end of the text.
    fn end(mut self, around: &mut Around<'a>) {
        self.finish();
        while let Some(outer) = self.outer.pop() {
            self.close(outer, Some(around));
        }
        around.blocks.push(self.current);
    }
}

/// The statements in tokens without a `;`: what begins a line begins one, unless the line before goes on.
fn split<'a>(tokens: &[Token<'a>]) -> Vec<Vec<Token<'a>>> {
    let mut statements: Vec<Vec<Token<'a>>> = Vec::new();
    for token in tokens {
        match statements.last_mut() {
            Some(last)
                if !token.begins_line || is_open(last) || last.last().is_some_and(goes_on) =>
            {
                last.push(token.clone());
            }
            Some(_) | None => statements.push(vec![token.clone()]),
        }
    }
    statements
}

/// Whether a list or a parenthesis has not ended.
fn is_open(tokens: &[Token<'_>]) -> bool {
    let count =
        |kinds: [SyntaxKind; 2]| tokens.iter().filter(|one| kinds.contains(&one.kind)).count();
    count([SyntaxKind::LBracket, SyntaxKind::LParen])
        > count([SyntaxKind::RBracket, SyntaxKind::RParen])
}

/// Whether a sign needs a value behind it.
pub(crate) fn joins(sign: SyntaxKind) -> bool {
    matches!(
        sign,
        SyntaxKind::Eq
            | SyntaxKind::Comma
            | SyntaxKind::Plus
            | SyntaxKind::Minus
            | SyntaxKind::Star
            | SyntaxKind::Slash
            | SyntaxKind::DotDot
    )
}

/// Whether a statement cannot end with a token.
fn goes_on(token: &Token<'_>) -> bool {
    joins(token.kind) || ["on", "returns", "accepts", "for", "every"].contains(&token.text)
}
