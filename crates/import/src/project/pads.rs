//! What the sources of projects have in common: the pins as they spell them, the first use of each,
//! and the `#define` lines of headers.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::{FileId, Span};

use super::Wire;
use crate::log::Log;

/// A pin of a port or of an RP chip: `PA9`, `A09`, `PA_9`, `pin_A9`; `GPIO25`, `GP25`.
pub(crate) fn pad(spelled: &str) -> Option<PinName> {
    let spelled = spelled.trim().trim_matches(['(', ')']);
    let upper = spelled.strip_prefix("pin_").unwrap_or(spelled).to_ascii_uppercase();
    let number = |digits: &str| {
        let is_number = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
        digits.parse::<u8>().ok().filter(|_| is_number)
    };
    if let Some(digits) = upper.strip_prefix("GPIO").or_else(|| upper.strip_prefix("GP")) {
        return PinName::parse(&format!("GP{}", number(digits)?));
    }
    let mut letters = upper.chars();
    let mut port = letters.next()?;
    if port == 'P' && letters.clone().next().is_some_and(|c| c.is_ascii_alphabetic()) {
        port = letters.next()?;
    }
    let digits = letters.as_str();
    let digits = digits.strip_prefix('_').unwrap_or(digits);
    let (digits, side) = digits.strip_suffix("_C").map_or((digits, ""), |digits| (digits, "_C"));
    let is_port = matches!(port, 'A'..='K' | 'Z');
    PinName::parse(&format!("P{port}{}{side}", number(digits).filter(|_| is_port)?))
}

/// The uses of pins, one of each.
#[derive(Debug, Default)]
pub(crate) struct Wires(BTreeMap<PinName, Wire>);

impl Wires {
    /// Adds the use of a pin; the first counts.
    pub(crate) fn add(&mut self, wire: Wire, log: &mut Log) {
        match self.0.entry(wire.pin.clone()) {
            Entry::Vacant(free) => {
                free.insert(wire);
            }
            Entry::Occupied(first) => {
                let what = format!("{} is used twice; the first use counts", first.key());
                log.doubtful(wire.span, "", &what);
            }
        }
    }

    /// Whether the pin has a use.
    pub(crate) fn has(&self, pin: &PinName) -> bool {
        self.0.contains_key(pin)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The uses in natural order.
    pub(crate) fn into_vec(self) -> Vec<Wire> {
        self.0.into_values().collect()
    }
}

/// A line `#define NAME value`, without comment and parentheses.
#[derive(Clone, Debug)]
pub(crate) struct Define {
    pub(crate) name: String,
    pub(crate) value: String,
    pub(crate) span: Span,
}

/// The `#define` lines of a header, in order. Conditions are not evaluated: a board's header has
/// them around values that are usual.
pub(crate) fn defines(file: FileId, text: &str) -> Vec<Define> {
    let mut defines = Vec::new();
    for (line, start) in lines(text) {
        let Some(rest) = line.trim_start().strip_prefix('#') else { continue };
        let Some(rest) = rest.trim_start().strip_prefix("define") else { continue };
        let rest = rest.split("//").next().unwrap_or_default();
        let rest = rest.split("/*").next().unwrap_or_default().trim();
        let (name, value) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
        let value = value.trim().trim_matches(['(', ')']).trim().to_owned();
        let span = Span::new(file, start..start + line.len());
        defines.push(Define { name: name.to_owned(), value, span });
    }
    defines
}

/// The lines of a text without their ends, each with the place of its start.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = (&str, usize)> {
    let mut start = 0;
    text.split_inclusive('\n').map(move |line| {
        let at = start;
        start += line.len();
        (line.trim_end_matches(['\n', '\r']), at)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pins_are_read_in_any_spelling() {
        let read = |spelled| pad(spelled).map(|pin| pin.to_string());
        for (spelled, pin) in [
            ("PA9", "PA9"),
            ("A09", "PA9"),
            ("PB_12", "PB12"),
            ("(pin_C5)", "PC5"),
            ("GPIO25", "GP25"),
            ("gp0", "GP0"),
            ("PC2_C", "PC2_C"),
        ] {
            assert_eq!(read(spelled).as_deref(), Some(pin), "{spelled}");
        }
        for spelled in ["", "P", "PA", "NONE", "EXT_GPIO0", "PA9x", "A1000", "5", "é9", "x9"] {
            assert_eq!(read(spelled), None, "{spelled}");
        }
    }

    #[test]
    fn headers_have_values_without_comment() {
        let file = Log::default().sources.add("b.h", "");
        let read = defines(file, "#pragma once\n  # define LED  (PA5) // green\n#define USE_X\n");
        let read: Vec<_> = read.iter().map(|one| (one.name.as_str(), one.value.as_str())).collect();
        assert_eq!(read, [("LED", "PA5"), ("USE_X", "")]);
    }
}
