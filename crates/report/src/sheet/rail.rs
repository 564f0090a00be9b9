//! The board's contacts of supply and ground, given out one by one.

use sensedsl_board::pin::natural;
use sensedsl_board::place::Place;
use sensedsl_model::design::Board;
use sensedsl_model::written::shown_mv;

use super::{End, Line};

/// The contacts of a board that carry a supply or ground, and how often each has been given out.
pub(super) struct Rails<'a> {
    contacts: Vec<Rail<'a>>,
    /// Whether a contact was given out more than once.
    is_shared: bool,
}

struct Rail<'a> {
    signal: &'a str,
    /// Millivolts; 0 for ground.
    mv: u32,
    place: &'a Place,
    taken: usize,
}

/// The voltage that a contact carries, from what is printed; none if it is no supply for parts.
fn voltage_mv(signal: &str) -> Option<u32> {
    match signal.to_ascii_uppercase().as_str() {
        "GND" => Some(0),
        "3V3" | "3V" | "3.3V" => Some(3_300),
        "5V" | "VBUS" | "VUSB" => Some(5_000),
        _ => None,
    }
}

impl<'a> Rails<'a> {
    pub(super) fn of(board: &'a Board) -> Self {
        let rail = |contact: &'a sensedsl_board::place::Contact| {
            let (signal, place) = (contact.signal.as_str(), &contact.place);
            Some(Rail { signal, mv: voltage_mv(signal)?, place, taken: 0 })
        };
        let mut contacts: Vec<Rail<'_>> = board.table.contacts.iter().filter_map(rail).collect();
        contacts.sort_by(|a, b| {
            let text = |rail: &Rail<'_>| rail.place.contact().unwrap_or_default();
            natural(&text(a), &text(b))
        });
        Self { contacts, is_shared: false }
    }

    /// The wire to ground, at one of the `headers` if that is free.
    pub(super) fn ground(&mut self, at_part: &str, headers: &[String]) -> Line {
        self.line(at_part, (0, "ground".to_owned()), headers)
    }

    /// The wire to the supply of a part that takes `least` to `most` millivolts.
    pub(super) fn supply(
        &mut self,
        at_part: &str,
        (least, most): (u32, u32),
        headers: &[String],
    ) -> Line {
        let fits = |mv: u32| (least..=most).contains(&mv);
        let mv = [3_300, 5_000].into_iter().find(|mv| fits(*mv));
        let range = if least == most {
            shown_mv(least)
        } else {
            format!("{} to {}", shown_mv(least), shown_mv(most))
        };
        if let Some(mv) = mv {
            return self.line(at_part, (mv, format!("supply, {range}")), headers);
        }
        let (at_part, purpose) = (at_part.to_owned(), "supply".to_owned());
        Line { at_part, to: format!("a supply of its own, {range}"), purpose, ..Line::default() }
    }

    /// A wire to a contact of that voltage.
    fn line(&mut self, at_part: &str, (mv, purpose): (u32, String), headers: &[String]) -> Line {
        let net = match mv {
            0 => "GND",
            3_300 => "3V3",
            _ => "5V",
        };
        let end = |contact| Some(End { net: net.to_owned(), contact });
        let at_part = at_part.to_owned();
        match self.take(mv, headers) {
            Some((contact, to)) => {
                Line { at_part, to, purpose, end: end(Some(contact)), ..Line::default() }
            }
            None => {
                let to = if mv == 0 { "GND".to_owned() } else { shown_mv(mv) };
                let to = format!("{to} of the board");
                Line { at_part, to, purpose, end: end(None), ..Line::default() }
            }
        }
    }

    /// A contact of that voltage, by itself and in words: the one given out least, at one of the headers if there is.
    fn take(&mut self, mv: u32, headers: &[String]) -> Option<(String, String)> {
        let is_near =
            |rail: &Rail<'_>| headers.iter().any(|header| rail.place.is_at_header(header));
        let candidates = self.contacts.iter_mut().filter(|rail| rail.mv == mv);
        let rail = candidates.min_by_key(|rail| (rail.taken, !is_near(rail)))?;
        rail.taken += 1;
        self.is_shared |= rail.taken > 1;
        let printed = rail.place.label.as_deref().unwrap_or(rail.signal);
        let side = rail.place.side.as_ref().map_or(String::new(), |side| format!("{side} "));
        let contact = rail.place.contact()?;
        let words = format!("{side}{contact} \"{printed}\"");
        Some((contact, words))
    }

    /// What the builder needs because contacts are shared.
    pub(super) fn needs(&self) -> Option<String> {
        self.is_shared.then(|| {
            "a breadboard or terminal strip: several wires of supply or ground share a contact"
                .to_owned()
        })
    }
}
