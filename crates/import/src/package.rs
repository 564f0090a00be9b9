//! Counts the contents of a workbook before anything parses it: its files, the bytes after
//! decompression, and the elements, attributes, levels and namespaces of its XML.
//!
//! A compressed file can hold a megabyte of zeros in a thousand bytes, so nothing that the archive
//! states about itself is trusted: each file is decompressed in small pieces, which are examined
//! and discarded.

use std::io::{Cursor, Read};

use sensedsl_limits::{
    INFLATED_BYTES_MAX, MEMBERS_MAX, XML_ATTRIBUTES_MAX, XML_DEPTH_MAX, XML_ELEMENTS_MAX,
    XML_NAMESPACES_MAX,
};
use zip::ZipArchive;

/// The reason why a source is not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Refused {
    /// There is more of something than is read.
    TooMuch(&'static str, usize),
    /// It is damaged, or in another format than assumed.
    Why(String),
}

impl Refused {
    pub(crate) fn why(error: &dyn std::fmt::Display) -> Self {
        Self::Why(error.to_string())
    }
}

/// Bytes that are inflated at a time.
const PIECE_BYTES: usize = 32 << 10;

/// The contents of a workbook's package.
pub(crate) struct Contents {
    /// The number of its files, of all types.
    pub(crate) files: usize,
    /// Bytes of the largest XML file, which any sheet may name.
    pub(crate) largest: usize,
}

/// Counts the contents of a workbook's XML files.
pub(crate) fn check(bytes: &[u8]) -> Result<Contents, Refused> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| Refused::why(&error))?;
    if archive.len() > MEMBERS_MAX {
        return Err(Refused::TooMuch("files", MEMBERS_MAX));
    }
    let mut left = INFLATED_BYTES_MAX;
    let (mut elements, mut largest) = (0, 0);
    for at in 0..archive.len() {
        let member = archive.by_index(at).map_err(|error| Refused::why(&error))?;
        let name = member.name().map_err(|error| Refused::why(&error))?.to_ascii_lowercase();
        if !name.ends_with(".xml") && !name.ends_with(".rels") {
            continue;
        }
        let mut scan = Scan { elements, ..Scan::new(XML_ELEMENTS_MAX) };
        let before = left;
        pieces(member, &mut left, &mut scan)?;
        elements = scan.elements;
        largest = largest.max(before - left);
    }
    Ok(Contents { files: archive.len(), largest })
}

fn pieces(mut member: impl Read, left: &mut usize, scan: &mut Scan) -> Result<(), Refused> {
    let mut piece = vec![0; PIECE_BYTES];
    loop {
        let count = member.read(&mut piece).map_err(|error| Refused::why(&error))?;
        if count == 0 {
            return Ok(());
        }
        let too_much = Refused::TooMuch("bytes after decompression", INFLATED_BYTES_MAX);
        *left = left.checked_sub(count).ok_or(too_much)?;
        scan.feed(piece.get(..count).unwrap_or_default())?;
    }
}

/// Counts the contents of an XML text that is to become a tree, with at most `most` elements.
pub(crate) fn check_xml(text: &str, most: usize) -> Result<(), Refused> {
    Scan::new(most).feed(text.as_bytes())
}

/// Where the scan is in an XML text.
#[derive(Clone, Copy, Debug, Default)]
enum State {
    #[default]
    Text,
    /// After `<`.
    Open,
    /// After `<!`, with this many hyphens.
    Bang(u8),
    /// In a comment, after this many hyphens.
    Comment(u8),
    /// In a CDATA section, after this many brackets.
    Characters(u8),
    /// In `<?`; true after a question mark.
    Instruction(bool),
    /// In a tag, perhaps in quotes.
    Tag(Option<u8>),
}

/// Reads XML byte by byte, in just enough detail to count.
#[derive(Debug, Default)]
struct Scan {
    state: State,
    most: usize,
    elements: usize,
    depth: usize,
    attributes: usize,
    namespaces: usize,
    /// True if the tag closes an element.
    closing: bool,
    /// Whether the tag may contain places of cells.
    places: Places,
    last: u8,
    /// The first bytes of the current word in a tag, as many as matter, and its whole length.
    word: [u8; WORD_BYTES],
    length: usize,
    /// The value in quotes, if its length matters.
    value: Option<Value>,
}

/// A value that a workbook reader converts to a number.
#[derive(Clone, Copy, Debug)]
enum Value {
    /// A count that makes a reader reserve memory, and the number of its digits so far.
    Strings(usize),
    /// The place of a cell (`AB12`) or a range of them (`A1:B2`).
    Cells(Cells),
}

/// The places of cells, as far as they have been read.
#[derive(Clone, Copy, Debug, Default)]
struct Cells {
    /// Column and row of the place before the colon, then those of the current place.
    first: Option<(u32, u32)>,
    column: u32,
    row: u32,
    /// The number of letters and digits in the place.
    letters: usize,
    digits: usize,
}

impl Cells {
    fn and(mut self, byte: u8) -> Result<Self, Refused> {
        let what = "letters or digits in the place of a cell";
        match byte {
            b':' => return Ok(Self { first: Some((self.column, self.row)), ..Self::default() }),
            b'0'..=b'9' => {
                self.digits += 1;
                at_most(self.digits, ROW_DIGITS_MAX, what)?;
                self.row = self.row * 10 + u32::from(byte - b'0');
            }
            b'A'..=b'Z' | b'a'..=b'z' => {
                self.letters += 1;
                at_most(self.letters, COLUMN_LETTERS_MAX, what)?;
                self.column = self.column * 26 + u32::from(byte.to_ascii_uppercase() - b'A') + 1;
            }
            _ => {}
        }
        Ok(self)
    }

    /// Whether this is a single place, or a range that does not end before its beginning.
    fn is_forward(self) -> bool {
        self.first.is_none_or(|(column, row)| column <= self.column && row <= self.row)
    }
}

impl Value {
    /// The value of an attribute with that name, if it matters.
    fn of(name: &[u8], places: Places) -> Option<Self> {
        match (name, places) {
            (b"uniqueCount", _) => Some(Self::Strings(0)),
            (b"r" | b"ref", Places::Yes) => Some(Self::Cells(Cells::default())),
            _ => None,
        }
    }

    /// The value with one more byte.
    fn and(self, byte: u8) -> Result<Self, Refused> {
        match self {
            Self::Strings(count) => {
                at_most(count, DIGITS_MAX, "digits in the number of its strings")?;
                Ok(Self::Strings(count + 1))
            }
            Self::Cells(cells) => cells.and(byte).map(Self::Cells),
        }
    }

    /// Checks the value at its closing quote.
    fn end(self) -> Result<(), Refused> {
        match self {
            Self::Cells(cells) if !cells.is_forward() => {
                Err(Refused::Why("it has a range of cells that ends before it begins".to_owned()))
            }
            Self::Cells(_) | Self::Strings(_) => Ok(()),
        }
    }
}

/// Whether an element's attributes `r` and `ref` are places of cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Places {
    /// The element's name is still being read.
    Unknown,
    Yes,
    #[default]
    No,
}

impl Places {
    /// Decides this for an element, from the beginning and the length of its name. The workbook
    /// reader ignores the prefix of a name, and takes any file for a sheet that is declared as one.
    fn of(name: &[u8], length: usize) -> Self {
        let local = name.rsplit(|byte| *byte == b':').next().unwrap_or_default();
        match local {
            b"c" | b"row" | b"f" | b"dimension" | b"mergeCell" => Self::Yes,
            // A long prefix leaves no room for the local name.
            _ if length > name.len() => Self::Yes,
            _ => Self::No,
        }
    }
}

/// Bytes of the longest name that matters.
const WORD_BYTES: usize = b"uniqueCount".len();
/// Most digits of a string count that is accepted.
const DIGITS_MAX: usize = 6;
/// More than any sheet has, but still within a 32-bit number.
const COLUMN_LETTERS_MAX: usize = 6;
const ROW_DIGITS_MAX: usize = 9;

impl Scan {
    fn new(most: usize) -> Self {
        Self { most, ..Self::default() }
    }

    fn feed(&mut self, bytes: &[u8]) -> Result<(), Refused> {
        bytes.iter().try_for_each(|byte| self.byte(*byte))
    }

    fn byte(&mut self, byte: u8) -> Result<(), Refused> {
        let more = |count: u8, of: u8| if byte == of { (count + 1).min(2) } else { 0 };
        self.state = match self.state {
            State::Text if byte == b'<' => State::Open,
            State::Text => State::Text,
            State::Open => return self.open(byte),
            State::Bang(0) if byte == b'-' => State::Bang(1),
            State::Bang(1) if byte == b'-' => State::Comment(0),
            State::Bang(0) if byte == b'[' => State::Characters(0),
            State::Bang(_) => {
                let why = "it has a document type, which no such file needs";
                return Err(Refused::Why(why.to_owned()));
            }
            State::Comment(2) | State::Characters(2) if byte == b'>' => State::Text,
            State::Comment(hyphens) => State::Comment(more(hyphens, b'-')),
            State::Characters(brackets) => State::Characters(more(brackets, b']')),
            State::Instruction(true) if byte == b'>' => State::Text,
            State::Instruction(_) => State::Instruction(byte == b'?'),
            State::Tag(quote) => return self.tag(quote, byte),
        };
        Ok(())
    }

    /// Handles the byte after `<`.
    fn open(&mut self, byte: u8) -> Result<(), Refused> {
        self.state = match byte {
            b'!' => State::Bang(0),
            b'?' => State::Instruction(false),
            _ => State::Tag(None),
        };
        if !matches!(self.state, State::Tag(_)) {
            return Ok(());
        }
        self.closing = byte == b'/';
        (self.attributes, self.length, self.last) = (0, 0, byte);
        self.places = Places::Unknown;
        self.put(byte);
        if self.closing {
            self.depth = self.depth.saturating_sub(1);
            return Ok(());
        }
        self.elements += 1;
        self.depth += 1;
        at_most(self.elements, self.most, "elements of XML")?;
        at_most(self.depth, XML_DEPTH_MAX, "elements of XML inside each other")
    }

    /// Handles a byte of a tag.
    fn tag(&mut self, quote: Option<u8>, byte: u8) -> Result<(), Refused> {
        if let Some(quote) = quote {
            let ends = byte == quote;
            self.value = match self.value {
                Some(value) if ends => value.end().map(|()| None)?,
                Some(value) => Some(value.and(byte)?),
                None => None,
            };
            self.state = State::Tag((!ends).then_some(quote));
            return Ok(());
        }
        match byte {
            b'"' | b'\'' => self.state = State::Tag(Some(byte)),
            b'=' => self.attribute()?,
            b'>' => {
                if self.last == b'/' && !self.closing {
                    self.depth = self.depth.saturating_sub(1);
                }
                self.state = State::Text;
            }
            byte if byte.is_ascii_whitespace() => {
                if self.places == Places::Unknown {
                    self.places = Places::of(self.read_word(), self.length);
                }
            }
            byte => {
                if self.last.is_ascii_whitespace() || matches!(self.last, b'"' | b'\'') {
                    self.length = 0;
                }
                self.put(byte);
            }
        }
        self.last = byte;
        Ok(())
    }

    /// Adds a byte to the word.
    fn put(&mut self, byte: u8) {
        if let Some(place) = self.word.get_mut(self.length) {
            *place = byte;
        }
        self.length += 1;
    }

    /// The word so far, or as much of it as is kept.
    fn read_word(&self) -> &[u8] {
        self.word.get(..self.length.min(WORD_BYTES)).unwrap_or_default()
    }

    /// Handles the `=` of an attribute.
    fn attribute(&mut self) -> Result<(), Refused> {
        self.attributes += 1;
        at_most(self.attributes, XML_ATTRIBUTES_MAX, "attributes of one element")?;
        let word = self.read_word();
        let is_namespace = word.starts_with(b"xmlns");
        self.value = Value::of(word, self.places);
        self.namespaces += usize::from(is_namespace);
        at_most(self.namespaces, XML_NAMESPACES_MAX, "namespaces")
    }
}

fn at_most(count: usize, most: usize, what: &'static str) -> Result<(), Refused> {
    if count > most { Err(Refused::TooMuch(what, most)) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scanned(text: &str) -> Result<(usize, usize), Refused> {
        let mut scan = Scan::new(1_000);
        scan.feed(text.as_bytes())?;
        Ok((scan.elements, scan.depth))
    }

    #[test]
    fn elements_are_counted_and_nothing_else() {
        let text = "<?xml version='1.0'?><!-- > <x ' --><a b='>' c=\"/\"><d/><![CDATA[<e>]]]></a>";
        assert_eq!(scanned(text), Ok((2, 0)));
        assert_eq!(scanned("<a><b><c x='1'/>"), Ok((3, 2)));
        assert_eq!(scanned("<c r='XFD1048576'/><f ref='A1:XFD1048576'/>"), Ok((2, 0)));
        // Not a worksheet, so its attributes do not name cells.
        assert_eq!(
            scanned("<a ref='B1:A1'/><author r='Somebody'/><cr r='A12345678901'/>"),
            Ok((3, 0))
        );
    }

    #[test]
    fn each_limit_is_kept() {
        let many = |piece: &str, count: usize| piece.repeat(count);
        for (text, what) in [
            (many("<a/>", 1_001), "elements"),
            (many("<a>", XML_DEPTH_MAX + 1), "inside each other"),
            (format!("<a {}>", many("b='' ", XML_ATTRIBUTES_MAX + 1)), "attributes"),
            (many("<a xmlns:b='' xmlns='' />", XML_NAMESPACES_MAX / 2 + 1), "namespaces"),
            ("<sst count='1' uniqueCount='99999999'/>".to_owned(), "digits"),
            ("<c r='AAAAAAA1'/>".to_owned(), "letters"),
            ("<mergeCell ref='A1:B1234567890'/>".to_owned(), "letters"),
        ] {
            match scanned(&text) {
                Err(Refused::TooMuch(reported, _)) => {
                    assert!(reported.contains(what), "{reported}");
                }
                other => panic!("{what}: {other:?}"),
            }
        }
        for text in [
            "<!DOCTYPE a [<!ENTITY b 'c'>]>",
            "<f ref='B1:A2'/>",
            "<dimension\nref='A2:B1'/>",
            "<x:row spans='1:2' r = 'A2:B1'>",
            "<averylongprefix:mergeCell ref='A2:B1'/>",
        ] {
            assert!(matches!(scanned(text), Err(Refused::Why(_))), "{text}");
        }
    }
}
