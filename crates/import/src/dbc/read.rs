//! The lines of a DBC file: nodes, messages, signals, types, value tables and the cycle times of
//! messages.

use std::collections::BTreeMap;

use sensedsl_diagnostics::codes::e0810_dbc_line;
use sensedsl_diagnostics::{FileId, Span};
use sensedsl_limits::DBC_PARTS_MAX;

use crate::log::Log;

/// The bit of an identifier that marks it as having 29 bits.
const EXTENDED: u32 = 1 << 31;

/// The contents of a file.
#[derive(Debug, Default)]
pub(super) struct Network {
    pub(super) nodes: Vec<String>,
    pub(super) messages: Vec<Message>,
    /// Bits per second, if the file states them.
    pub(super) bitrate_hz: Option<u32>,
}

#[derive(Debug)]
pub(super) struct Message {
    pub(super) span: Span,
    pub(super) id: u32,
    pub(super) is_extended: bool,
    pub(super) name: String,
    pub(super) bytes: u32,
    pub(super) sender: String,
    pub(super) cycle_ms: Option<u32>,
    pub(super) signals: Vec<Signal>,
}

#[derive(Clone, Debug)]
pub(super) struct Signal {
    pub(super) span: Span,
    pub(super) name: String,
    pub(super) mux: Mux,
    pub(super) bit: u32,
    pub(super) bits: u32,
    pub(super) is_little: bool,
    pub(super) kind: Number,
    pub(super) factor: f64,
    pub(super) offset: f64,
    pub(super) least: f64,
    pub(super) most: f64,
    pub(super) unit: String,
    pub(super) receivers: Vec<String>,
    /// The meanings of its values.
    pub(super) words: Vec<(i64, String)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    Unsigned,
    Signed,
    Float,
    Double,
}

/// Which contents of its message a signal is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mux {
    Always,
    /// The signal selects the contents.
    Selector,
    Only(u64),
    /// The signal is selected, and selects further signals.
    Nested,
    /// The signal is selected by an unstated value.
    Open,
}

struct Reader<'l> {
    network: Network,
    /// The index of each message.
    places: BTreeMap<u32, usize>,
    /// The index of each signal in its message, by the message's identifier.
    signals: BTreeMap<(u32, String), usize>,
    current: Option<u32>,
    /// The number of parts so far, out of [`DBC_PARTS_MAX`].
    parts: usize,
    log: &'l mut Log,
}

/// Reads a file. Each wrong line is reported, until no more errors are listed.
pub(super) fn read(file: FileId, name: &str, text: &str, log: &mut Log) -> Network {
    let (network, places, signals) = (Network::default(), BTreeMap::new(), BTreeMap::new());
    let mut reader = Reader { network, places, signals, current: None, parts: 0, log };
    let mut begin = 0;
    let mut open = false;
    for line in text.split_inclusive('\n') {
        let (from, to) = (begin, begin + line.trim_end().len());
        begin += line.len();
        // A text continues on the next line until its quote ends; its first line states what it
        // belongs to.
        let is_inside = open;
        open ^= line.matches('"').count() % 2 == 1;
        if is_inside {
            continue;
        }
        let span = Span::new(file, from..to);
        if let Err(why) = reader.line(span, line.trim()) {
            reader.log.say(e0810_dbc_line::dbc_line(span, &why));
            if reader.log.is_full() {
                break;
            }
        }
        if reader.parts > DBC_PARTS_MAX {
            let what = "nodes, messages, signals, receivers and words for values";
            reader.log.too_large(span, name, what, DBC_PARTS_MAX);
            break;
        }
    }
    reader.network
}

impl Reader<'_> {
    fn line(&mut self, span: Span, line: &str) -> Result<(), String> {
        let Some(word) = line.split([' ', '\t', ':']).next() else { return Ok(()) };
        let rest = line.get(word.len()..).unwrap_or_default().trim();
        match word {
            "BU_" => {
                let names = rest.trim_start_matches(':').split_whitespace();
                let before = self.network.nodes.len();
                self.network.nodes.extend(names.take(DBC_PARTS_MAX + 1).map(str::to_owned));
                self.parts += self.network.nodes.len() - before;
                Ok(())
            }
            "BO_" => self.message(span, rest),
            "SG_" => self.signal(span, rest),
            "VAL_" => self.words(rest),
            "SIG_VALTYPE_" => self.real(rest),
            "BA_" => self.attribute(rest),
            "SG_MUL_VAL_" => {
                if !self.says_the_same(rest) {
                    let what = "a range of selecting values (`SG_MUL_VAL_`) is left out";
                    self.log.dropped(span, "", what);
                }
                Ok(())
            }
            // Comments, definitions of attributes, environment variables.
            _ => Ok(()),
        }
    }

    fn message(&mut self, span: Span, rest: &str) -> Result<(), String> {
        self.current = None;
        let words: Vec<&str> =
            rest.split([' ', '\t', ':']).filter(|word| !word.is_empty()).collect();
        let [id, name, bytes, others @ ..] = words.as_slice() else {
            return Err("a message is `BO_ IDENTIFIER NAME: BYTES SENDER`".to_owned());
        };
        let raw: u32 = whole(id, "an identifier")?;
        let own = raw & !EXTENDED;
        if own > 0x1FFF_FFFF {
            // Tools store items that are on no bus under such numbers: VECTOR__INDEPENDENT_SIG_MSG
            // holds signals without a message.
            let what = format!("{name} is left out: {raw} is not an identifier of 11 or 29 bits");
            self.log.dropped(span, "", &what);
            return Ok(());
        }
        let is_extended = raw & EXTENDED != 0 || own > 0x7FF;
        if raw == own && is_extended {
            let what = format!(
                "{name} is read with an identifier of 29 bits: {own} is more than 0x7FF, and bit 31 is not set"
            );
            self.log.doubtful(span, "", &what);
        }
        if self.places.contains_key(&raw) {
            return Err(format!("there are two messages of identifier {raw}"));
        }
        self.places.insert(raw, self.network.messages.len());
        self.current = Some(raw);
        self.parts += 1;
        self.network.messages.push(Message {
            span,
            id: own,
            is_extended,
            name: (*name).to_owned(),
            bytes: whole(bytes, "a length")?,
            sender: others.first().copied().unwrap_or_default().to_owned(),
            cycle_ms: None,
            signals: Vec::new(),
        });
        Ok(())
    }

    /// `NAME [M|mN]: BIT|BITS@ORDER SIGN (FACTOR,OFFSET) [LEAST|MOST] "UNIT" RECEIVERS`
    fn signal(&mut self, span: Span, rest: &str) -> Result<(), String> {
        let Some(id) = self.current else { return Ok(()) };
        let place = self.places.get(&id).copied();
        let Some(message) = place.and_then(|at| self.network.messages.get_mut(at)) else {
            return Ok(());
        };
        let form = "a signal is `SG_ NAME : BIT|BITS@ORDER± (FACTOR,OFFSET) [LEAST|MOST] \"UNIT\" RECEIVERS`";
        let parts = || {
            let (head, rest) = rest.split_once(':')?;
            let (place, rest) = rest.split_once('(')?;
            let (scale, rest) = rest.split_once(')')?;
            let (_, rest) = rest.split_once('[')?;
            let (bounds, rest) = rest.split_once(']')?;
            let (_, rest) = rest.split_once('"')?;
            let (unit, receivers) = rest.split_once('"')?;
            Some((head, place, scale.split_once(',')?, bounds.split_once('|')?, unit, receivers))
        };
        let (head, place, scale, bounds, unit, receivers) = parts().ok_or(form)?;
        let (bit, place) = place.trim().split_once('|').ok_or(form)?;
        let (bits, order) = place.split_once('@').ok_or(form)?;
        let mut head = head.split_whitespace();
        let name = head.next().ok_or(form)?.to_owned();
        let receivers = receivers.split([' ', ',', '\t', '\r']).filter(|name| !name.is_empty());
        let receivers: Vec<String> = receivers.take(DBC_PARTS_MAX + 1).map(str::to_owned).collect();
        self.parts += 1 + receivers.len();
        self.signals.entry((id, name.clone())).or_insert(message.signals.len());
        message.signals.push(Signal {
            span,
            name,
            mux: selection(head.next())?,
            bit: whole(bit, "a bit")?,
            bits: whole(bits, "a number of bits")?,
            is_little: match order.trim().chars().next() {
                Some('1') => true,
                Some('0') => false,
                _ => return Err("the order behind `@` is 1 (little) or 0 (big)".to_owned()),
            },
            kind: match order.trim().chars().last() {
                Some('+') => Number::Unsigned,
                Some('-') => Number::Signed,
                _ => return Err("the sign behind the order is + or -".to_owned()),
            },
            factor: real(scale.0)?,
            offset: real(scale.1)?,
            least: real(bounds.0)?,
            most: real(bounds.1)?,
            unit: unit.to_owned(),
            receivers,
            words: Vec::new(),
        });
        Ok(())
    }

    /// `ID SIGNAL SELECTOR FROM-TO;`, which may only repeat the signal's `m3`. In the list of words
    /// at the start of a file it means nothing.
    fn says_the_same(&mut self, rest: &str) -> bool {
        let mut words = rest.trim_end_matches(';').split_whitespace();
        let (Some(id), Some(name), Some(_)) = (words.next(), words.next(), words.next()) else {
            return rest.is_empty();
        };
        let range = words.next().and_then(|range| range.split_once('-'));
        let signal = self.find(id, name).ok().flatten();
        let only = range.filter(|(from, to)| from == to && words.next().is_none());
        only.zip(signal).is_some_and(|((number, _), signal)| {
            number.parse().is_ok_and(|number| signal.mux == Mux::Only(number))
        })
    }

    fn find(&mut self, id: &str, name: &str) -> Result<Option<&mut Signal>, String> {
        let id: u32 = whole(id, "an identifier")?;
        let message = self.places.get(&id).and_then(|at| self.network.messages.get_mut(*at));
        let place = self.signals.get(&(id, name.to_owned()));
        Ok(message.zip(place).and_then(|(message, at)| message.signals.get_mut(*at)))
    }

    /// `ID SIGNAL NUMBER "WORDS" … ;`; tables of environment variables have no identifier.
    fn words(&mut self, rest: &str) -> Result<(), String> {
        let mut head = rest.splitn(3, char::is_whitespace);
        let (Some(id), Some(name), Some(list)) = (head.next(), head.next(), head.next()) else {
            return Ok(());
        };
        if !id.starts_with(|c: char| c.is_ascii_digit()) {
            return Ok(());
        }
        let mut words = Vec::new();
        let mut pieces = list.trim_end_matches(';').split('"');
        while let (Some(number), Some(word)) = (pieces.next(), pieces.next()) {
            words.push((whole(number.trim(), "a value")?, word.to_owned()));
            self.parts += 1;
            if self.parts > DBC_PARTS_MAX {
                break;
            }
        }
        if let Some(signal) = self.find(id, name)? {
            signal.words = words;
        }
        Ok(())
    }

    /// `ID SIGNAL : 1;` for 32 bits, and 2 for 64 bits.
    fn real(&mut self, rest: &str) -> Result<(), String> {
        let words: Vec<&str> =
            rest.split([' ', ':', ';', '\t']).filter(|one| !one.is_empty()).collect();
        let [id, name, kind] = words.as_slice() else { return Ok(()) };
        let kind = match *kind {
            "1" => Number::Float,
            "2" => Number::Double,
            _ => return Ok(()),
        };
        if let Some(signal) = self.find(id, name)? {
            signal.kind = kind;
        }
        Ok(())
    }

    /// The cycle times of messages, and the bit rate.
    fn attribute(&mut self, rest: &str) -> Result<(), String> {
        let words: Vec<&str> = rest.trim_end_matches(';').split_whitespace().collect();
        match words.as_slice() {
            ["\"GenMsgCycleTime\"", "BO_", id, ms] => {
                let id: u32 = whole(id, "an identifier")?;
                let ms = real(ms)?;
                let place = self.places.get(&id).copied();
                let message = place.and_then(|place| self.network.messages.get_mut(place));
                if let Some(message) = message.filter(|_| (1.0..=60_000.0).contains(&ms)) {
                    message.cycle_ms = whole(&format!("{ms:.0}"), "a time").ok();
                }
            }
            ["\"Baudrate\"", rate] => {
                let rate: Option<u32> = rate.parse().ok();
                self.network.bitrate_hz = rate.filter(|rate| (10_000..=1_000_000).contains(rate));
            }
            _ => {}
        }
        Ok(())
    }
}

fn selection(word: Option<&str>) -> Result<Mux, String> {
    let wrong = || "what is between the name and `:` is `M` or `m` with a number".to_owned();
    match word {
        None => Ok(Mux::Always),
        Some("M") => Ok(Mux::Selector),
        Some(word) => {
            let number = word.strip_prefix('m').ok_or_else(wrong)?;
            match number.strip_suffix('M') {
                None if number.is_empty() => Ok(Mux::Open),
                Some(_) => Ok(Mux::Nested),
                None => number.parse().map(Mux::Only).map_err(|_| wrong()),
            }
        }
    }
}

fn whole<T: std::str::FromStr>(text: &str, what: &str) -> Result<T, String> {
    text.trim().parse().map_err(|_| format!("`{}` is not {what}", text.trim()))
}

fn real(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.trim().parse().ok();
    number
        .filter(|number| number.is_finite())
        .ok_or_else(|| format!("`{}` is not a number", text.trim()))
}
