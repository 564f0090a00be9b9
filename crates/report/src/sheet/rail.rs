//! The board's contacts of supply and ground, given out one by one.

use sensedsl_board::pin::natural;
use sensedsl_board::place::Place;
use sensedsl_model::design::Board;
use sensedsl_model::written::shown_mv;

use super::Line;

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
        let to = self.take(0, headers).unwrap_or_else(|| "GND of the board".to_owned());
        Line { at_part: at_part.to_owned(), to, pin: String::new(), purpose: "ground".to_owned() }
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
        let (to, purpose) = match mv {
            Some(mv) => (
                self.take(mv, headers).unwrap_or_else(|| format!("{} of the board", shown_mv(mv))),
                format!("supply, {range}"),
            ),
            None => (format!("a supply of its own, {range}"), "supply".to_owned()),
        };
        Line { at_part: at_part.to_owned(), to, pin: String::new(), purpose }
    }

    /// A contact of that voltage: the one given out least, at one of the headers if there is.
    fn take(&mut self, mv: u32, headers: &[String]) -> Option<String> {
        let is_near =
            |rail: &Rail<'_>| headers.iter().any(|header| rail.place.is_at_header(header));
        let candidates = self.contacts.iter_mut().filter(|rail| rail.mv == mv);
        let rail = candidates.min_by_key(|rail| (rail.taken, !is_near(rail)))?;
        rail.taken += 1;
        self.is_shared |= rail.taken > 1;
        let printed = rail.place.label.as_deref().unwrap_or(rail.signal);
        let side = rail.place.side.as_ref().map_or(String::new(), |side| format!("{side} "));
        Some(format!("{side}{} \"{printed}\"", rail.place.contact()?))
    }

    /// What the builder needs because contacts are shared.
    pub(super) fn needs(&self) -> Option<String> {
        self.is_shared.then(|| {
            "a breadboard or terminal strip: several wires of supply or ground share a contact"
                .to_owned()
        })
    }
}
