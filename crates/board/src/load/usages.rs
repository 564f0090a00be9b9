//! What a pin can be: cells with usages, alternate functions, and on-board parts.

use sensedsl_diagnostics::nearest;
use sensedsl_limits::{DIAGNOSTICS_MAX, PIN_USAGES_MAX, USAGES_MAX};

use super::{Known, Loader, Word};
use crate::cells::Cell;
use crate::finding::FindingKind;
use crate::remap::Blocks;
use crate::signal::{Function, Signal};
use crate::table::{Column, Occupation, Onboard, Pin, ROUTED, Usage};

impl Loader<'_> {
    /// Reads a cell of usages.
    pub(super) fn usages(
        &mut self,
        cell: &Cell,
        column: &Column,
        pin: &mut Pin,
        known: &mut Known,
    ) {
        for Word { text, range } in self.words(cell).into_iter().flat_map(separated) {
            if pin.usages.len() == PIN_USAGES_MAX {
                return self.too_large("usages of one pin", PIN_USAGES_MAX, &range);
            }
            if self.usages_left == 0 {
                return self.too_large("usages", USAGES_MAX, &range);
            }
            let own = text.strip_prefix(ROUTED);
            let (is_routed, text) = (own.is_some(), own.unwrap_or(&text).to_owned());
            let (spelled, alternate) = match text.split_once('@') {
                Some((spelled, number)) => (spelled.to_owned(), Some(number)),
                None => (text.clone(), None),
            };
            let (spelled, remap) = match spelled.split_once('#') {
                Some((spelled, remap)) => (spelled.to_owned(), Some(remap.to_owned())),
                None => (spelled, None),
            };
            let number = alternate.and_then(alternate_number);
            let blocks = remap.as_deref().and_then(Blocks::parse);
            let unnamed = matches!(spelled.as_str(), "" | "-");
            let unread =
                alternate.is_some() && number.is_none() || remap.is_some() && blocks.is_none();
            if unnamed || unread {
                let kind = FindingKind::BadAlternate { spelled: text.clone() };
                self.report(kind, &range, Some(&column.header));
            }
            if unnamed {
                continue;
            }
            let (signal, malformed) = Signal::parse(&spelled);
            if let Some(malformed) = malformed {
                let kind = FindingKind::MalformedSignal {
                    spelled: spelled.clone(),
                    nearest: malformed.nearest,
                };
                self.report(kind, &range, Some(&column.header));
            }
            if let Some((_, first)) = known.get(signal.name()).cloned() {
                let kind = FindingKind::DuplicateUsage { spelled, first };
                self.report(kind, &range, Some(&column.header));
                continue;
            }
            let column = column.header.clone();
            known.insert(signal.name().to_owned(), (pin.usages.len(), range.clone()));
            self.usages_left -= 1;
            pin.usages.push(Usage {
                spelled,
                signal,
                alternate: number,
                blocks,
                is_routed,
                column,
                range,
            });
        }
    }

    /// Reads an `Onboard` cell: `PART` or `PART:HOW`.
    pub(super) fn onboard(&mut self, cell: &Cell, column: &Column) -> Option<Onboard> {
        let Word { text, range } = self.value(cell)?;
        let Some((part, word)) = text.rsplit_once(':') else {
            return Some(Onboard { part: text, how: Occupation::Taken });
        };
        let (part, word) = (part.trim().to_owned(), word.trim());
        let known = Occupation::WORDS.iter().find(|(name, _)| name.eq_ignore_ascii_case(word));
        if let Some((_, how)) = known {
            return Some(Onboard { part, how: *how });
        }
        let words = Occupation::WORDS.iter().map(|(name, _)| *name);
        let nearest = nearest(word, words).map(str::to_owned);
        let kind = FindingKind::BadOccupation { spelled: word.to_owned(), nearest };
        self.report(kind, &range, Some(&column.header));
        // To be safe, a part that is not understood takes its pin.
        Some(Onboard { part, how: Occupation::Taken })
    }

    /// Reads an `AF` cell: `SIGNAL=n` for each signal, or one number for each usage that has one.
    pub(super) fn alternates(
        &mut self,
        cell: &Cell,
        column: &Column,
        pin: &mut Pin,
        known: &Known,
    ) {
        let words = self.words(cell);
        let (named, bare): (Vec<&Word>, Vec<&Word>) =
            words.iter().partition(|word| word.text.contains('='));
        for word in named {
            self.named_alternate(word, column, pin, known);
        }
        if bare.is_empty() {
            return;
        }
        let digital = |usage: &&mut Usage| !usage.signal.function().is_analog();
        let expected = pin.usages.iter_mut().filter(digital).count();
        if bare.len() != expected {
            let kind = FindingKind::AlternateCount { expected, found: bare.len() };
            let range = self.content(cell).range;
            self.report(kind, &range, Some(&column.header));
            return;
        }
        for (word, usage) in bare.into_iter().zip(pin.usages.iter_mut().filter(digital)) {
            self.set_alternate(&word.text, word, column, usage);
        }
    }

    fn named_alternate(&mut self, word: &Word, column: &Column, pin: &mut Pin, known: &Known) {
        let Some((spelled, number)) = word.text.split_once('=') else { return };
        let (signal, _) = Signal::parse(spelled);
        let known = known.get(signal.name()).and_then(|(at, _)| pin.usages.get_mut(*at));
        if let Some(usage) = known {
            return self.set_alternate(number, word, column, usage);
        }
        let usages = pin.usages.iter().map(|usage| usage.spelled.as_str());
        // A finding that is not listed needs no suggestion.
        let listed = self.findings.len() < DIAGNOSTICS_MAX;
        let nearest = if listed { nearest(spelled, usages) } else { None }.map(str::to_owned);
        let kind = FindingKind::UnknownAlternate { signal: spelled.to_owned(), nearest };
        self.report(kind, &word.range, Some(&column.header));
    }

    fn set_alternate(&mut self, number: &str, word: &Word, column: &Column, usage: &mut Usage) {
        let spelled = word.text.clone();
        let kind = match (alternate_number(number), usage.alternate) {
            (None, _) => FindingKind::BadAlternate { spelled },
            (Some(cell), Some(usage)) if cell != usage => {
                FindingKind::AlternateConflict { spelled, usage, cell }
            }
            (Some(cell), _) => {
                usage.alternate = Some(cell);
                return;
            }
        };
        self.report(kind, &word.range, Some(&column.header));
    }
}

/// The usages of a word with commas or slashes between them: `ADC1_IN0,TIM2_CH1`. A word that may
/// mean something else, such as `USART1_RTS/DE`, stays whole.
fn separated(word: Word) -> Vec<Word> {
    const SEPARATORS: [char; 3] = [',', '/', ';'];
    if !word.text.contains(SEPARATORS) {
        return vec![word];
    }
    // A word with characters that do not show is pointed at as a whole.
    let is_exact = word.text.len() == word.range.len();
    let mut at = word.range.start;
    let mut pieces = Vec::new();
    // No pin has more usages, so those behind them need not be looked at.
    for text in word.text.split(SEPARATORS).take(PIN_USAGES_MAX + 2) {
        let range = if is_exact { at..at + text.len() } else { word.range.clone() };
        at += text.len() + 1;
        if !text.is_empty() {
            pieces.push(Word { text: text.to_owned(), range });
        }
    }
    let name = |piece: &Word| {
        let name = piece.text.split(['@', '#']).next().unwrap_or_default();
        name.trim_start_matches(ROUTED).to_owned()
    };
    let is_named = |piece: &Word| name(piece).contains(['_', '-']);
    let is_known = |piece: &Word| {
        let (signal, malformed) = Signal::parse(&name(piece));
        malformed.is_none() && *signal.function() != Function::Other
    };
    let is_plain = pieces.iter().all(is_named) && pieces.iter().any(is_known);
    if is_plain { pieces } else { vec![word] }
}

/// Known multiplexers number their alternate functions from 0 to 15, with or without `AF`.
fn alternate_number(text: &str) -> Option<u8> {
    let digits = text.strip_prefix("AF").unwrap_or(text);
    let plain = digits.bytes().all(|b| b.is_ascii_digit());
    digits.parse().ok().filter(|number| plain && *number < 16)
}
