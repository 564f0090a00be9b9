//! Pin names: the file's spelling in, the pin of each board out.
//!
//! A pin is named as the MCU names it (`PA5`), as it is labelled on the board (`D13`, `"CN7.3"`),
//! or after the on-board part on it (`LED`). Each board's table decides which pin that is.

use std::collections::BTreeMap;

use sensedsl_board::pin::{PinName, natural};
use sensedsl_board::place::Place;
use sensedsl_board::table::{Pin, Table};

use sensedsl_diagnostics::codes::{e0310_unknown_pin, e0318_several_pins, h0704_printed_elsewhere};
use sensedsl_diagnostics::{Diagnostic, Span, nearest};

use crate::design::{Board, BoardIndex, Design, PinRef, Preference, PreferenceSubject};
use crate::spanned::Spanned;

/// Binds the names of pins to the pins of the boards, and reports names that stand for none or for
/// several.
pub(crate) fn bind(design: &mut Design, diagnostics: &mut Vec<Diagnostic>) {
    let Design { boards, connections, .. } = design;
    for wires in connections {
        let range = wires.board.map_or(0..boards.len(), |board| board.0..board.0 + 1);
        let mut binder = Binder { boards, range, diagnostics };
        let kind = wires.kind.name();
        for (role, Spanned { value, span }) in &mut wires.placement.pins {
            binder.pin(value, *span, true, |pin| kind.serves(*role, pin));
        }
        binder.wishes(&mut wires.wishes);
    }
    for index in 0..boards.len() {
        let Some(board) = boards.get_mut(index) else { continue };
        let mut wishes = std::mem::take(&mut board.wishes);
        let labels = Labels::of(&board.table);
        for rule in board.reserved.iter_mut().chain(&mut board.released) {
            labels.rename(&board.table, rule);
        }
        Binder { boards, range: index..index + 1, diagnostics }.wishes(&mut wishes);
        if let Some(board) = boards.get_mut(index) {
            board.wishes = wishes;
        }
    }
}

/// The pins of a table by their labels, in lower case: rules and pins can both be many.
struct Labels(BTreeMap<String, Vec<PinName>>);

impl Labels {
    fn of(table: &Table) -> Self {
        let mut pins: BTreeMap<String, Vec<PinName>> = BTreeMap::new();
        for pin in &table.pins {
            for label in pin.labels() {
                pins.entry(label.to_ascii_lowercase()).or_default().push(pin.name.clone());
            }
        }
        Self(pins)
    }

    /// Replaces a pin's label in a rule with the MCU's name.
    fn rename(&self, table: &Table, rule: &mut Spanned<String>) {
        let labelled = self.0.get(&rule.value.to_ascii_lowercase()).map(Vec::as_slice);
        if let Some([pin]) = labelled
            && PinName::parse(&rule.value).is_none_or(|name| table.pin(&name).is_none())
        {
            rule.value = pin.to_string();
        }
    }
}

/// Looks names up in the tables of some boards.
struct Binder<'a> {
    boards: &'a [Board],
    range: std::ops::Range<usize>,
    diagnostics: &'a mut Vec<Diagnostic>,
}

impl Binder<'_> {
    fn wishes(&mut self, wishes: &mut [Preference]) {
        for wish in wishes {
            if let PreferenceSubject::Pin(_, pin) = &mut wish.what {
                // A wish may name a pin of the MCU that is not brought out on the board.
                let must = PinName::parse(&pin.spelled).is_none();
                self.pin(pin, wish.span, must, |_| true);
            }
        }
    }

    /// Binds a name. For an unknown name, proposes only pins that `suits` accepts.
    fn pin(&mut self, pin: &mut PinRef, span: Span, must: bool, suits: impl Fn(&Pin) -> bool) {
        let name = pin.spelled.as_str();
        let mut report = None;
        let range = self.range.clone();
        for (index, board) in range.clone().zip(self.boards.get(range).unwrap_or_default()) {
            let on = board.name.value.as_str();
            match find(&board.table, name) {
                FoundName::Pin { name: found, printed } => {
                    if let Some(other) = printed {
                        let other = other.as_str();
                        let hint = h0704_printed_elsewhere::printed_elsewhere;
                        self.diagnostics.push(hint(span, found.as_str(), on, other));
                    }
                    pin.on.push((BoardIndex(index), found));
                }
                FoundName::Several(pins) => {
                    let pins: Vec<&str> = pins.iter().map(PinName::as_str).collect();
                    report = Some(e0318_several_pins::several_pins(span, name, on, &pins));
                }
                FoundName::None if report.is_none() && must => {
                    let suited = board.table.pins.iter().filter(|pin| suits(pin));
                    let pins = suited.clone().map(|pin| pin.name.as_str());
                    let meant = nearest(name, pins.chain(printed(suited)));
                    let shown = PinName::parse(name);
                    let shown = shown.as_ref().map_or(name, PinName::as_str);
                    report = Some(e0310_unknown_pin::unknown_pin(span, shown, on, meant));
                }
                FoundName::None => {}
            }
        }
        self.diagnostics.extend(report.filter(|_| pin.on.is_empty()));
    }
}

fn has_label(pin: &Pin, name: &str) -> bool {
    pin.labels().iter().any(|label| is(label, name))
}

/// What a name stands for in a table.
#[derive(Clone, Debug, PartialEq, Eq)]
enum FoundName {
    /// One pin; `printed` is a different pin that the board has labelled with that name.
    Pin { name: PinName, printed: Option<PinName> },
    /// Pins with the same label, or connected to parts with that name.
    Several(Vec<PinName>),
    /// No pin.
    None,
}

/// What a name stands for: the MCU's names come first, then labels, then on-board parts.
fn find(table: &Table, spelled: &str) -> FoundName {
    let labelled = |pin: &&Pin| has_label(pin, spelled);
    if let Some(pin) = PinName::parse(spelled).and_then(|name| table.pin(&name)) {
        let mut others = table.pins.iter().filter(labelled).filter(|other| other.name != pin.name);
        let printed = others.next().map(|pin| pin.name.clone());
        return FoundName::Pin { name: pin.name.clone(), printed };
    }
    let at_place = |pin: &&Pin| {
        let mut contacts = pin.places.iter().filter_map(Place::contact);
        contacts.any(|contact| is(&contact, spelled))
    };
    let part = |pin: &&Pin| {
        let part = pin.onboard.as_ref().map(|onboard| onboard.part.as_str()).unwrap_or_default();
        is(part, spelled) || part.split_whitespace().any(|word| is(word, spelled))
    };
    let all = |pins: Vec<&Pin>| pins.into_iter().map(|pin| pin.name.clone()).collect::<Vec<_>>();
    let by_label = all(table.pins.iter().filter(labelled).collect());
    let by_place = || all(table.pins.iter().filter(at_place).collect());
    let by_part = || all(table.pins.iter().filter(part).collect());
    let first = |one: Vec<PinName>, next: &dyn Fn() -> Vec<PinName>| {
        if one.is_empty() { next() } else { one }
    };
    let mut found = first(first(by_label, &by_place), &by_part);
    match found.len() {
        0 => FoundName::None,
        1 => found.pop().map_or(FoundName::None, |name| FoundName::Pin { name, printed: None }),
        _ => FoundName::Several(found),
    }
}

/// The other names of these pins, besides the MCU's.
fn printed<'a>(pins: impl Iterator<Item = &'a Pin>) -> Vec<&'a str> {
    let mut labels: Vec<&str> = pins.flat_map(Pin::labels).collect();
    labels.sort_by(|a, b| natural(a, b));
    labels.dedup();
    labels
}

fn is(one: &str, other: &str) -> bool {
    one.eq_ignore_ascii_case(other)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "Pin,Label,Header,Position,Onboard\nPA4,A2,CN7,32,\nPA2,D1,CN10,35,\n\
        PA5,D13,CN10,11,LED LD2:care\nPB1,PA4,CN10,24,LED LD3:care\nPC8,LCD,,,\nPC9,LCD,,,\n";

    fn meant(spelled: &str) -> String {
        match find(&sensedsl_board::table::load(TABLE).board, spelled) {
            FoundName::Pin { name, printed: None } => name.to_string(),
            FoundName::Pin { name, printed: Some(other) } => format!("{name}, not {other}"),
            FoundName::Several(pins) => format!("{pins:?}").replace("PinName", ""),
            FoundName::None => "none".into(),
        }
    }

    #[test]
    fn the_name_of_the_mcu_comes_first() {
        assert_eq!(meant("PA2"), "PA2");
        assert_eq!(meant("pa02"), "PA2");
        assert_eq!(meant("PA4"), "PA4, not PB1");
    }

    #[test]
    fn what_is_printed_is_a_name() {
        assert_eq!(meant("A2"), "PA4");
        assert_eq!(meant("d13"), "PA5");
        assert_eq!(meant("CN7.32"), "PA4");
        assert_eq!(meant("LD2"), "PA5");
        assert_eq!(meant("LED LD3"), "PB1");
    }

    #[test]
    fn names_of_several_pins_are_told() {
        assert_eq!(meant("LED"), "[(\"PA5\"), (\"PB1\")]");
        assert_eq!(meant("LCD"), "[(\"PC8\"), (\"PC9\")]");
        assert_eq!(meant("D14"), "none");
    }
}
