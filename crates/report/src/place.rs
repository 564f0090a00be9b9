//! Where a pin is found on the board, in words.

use sensedsl_board::place::Place;
use sensedsl_board::table::Pin;

/// All places of a pin with what is printed there: `right CN10.21, CN5.1 "D8"`. The one that is
/// nearest to the part's other wires comes first, if it is known. The side is named where it
/// changes; a label that repeats the pin's name is left out.
pub(crate) fn text(pin: &Pin, nearest: Option<usize>) -> String {
    let (mut texts, mut side) = (Vec::new(), None);
    let first = nearest.and_then(|number| pin.places.get(number));
    let others = pin.places.iter().enumerate().filter(|(number, _)| Some(*number) != nearest);
    for place in first.into_iter().chain(others.map(|(_, place)| place)) {
        let mut words = Vec::new();
        if place.side.is_some() && place.side != side {
            words.extend(place.side.clone());
            side.clone_from(&place.side);
        }
        words.extend(contact(place));
        words.extend(place.label.as_ref().map(|label| format!("\"{label}\"")));
        texts.extend((!words.is_empty()).then(|| words.join(" ")));
    }
    let label = pin.label.as_ref().filter(|label| !label.eq_ignore_ascii_case(pin.name.as_str()));
    let label = label.map(|label| format!("\"{label}\""));
    [texts.join(", ")]
        .into_iter()
        .filter(|text| !text.is_empty())
        .chain(label)
        .collect::<Vec<_>>()
        .join(" ")
}

fn contact(place: &Place) -> Option<String> {
    match (&place.header, &place.position) {
        (Some(_), Some(_)) => place.contact(),
        (Some(header), None) => Some(header.clone()),
        (None, Some(position)) => Some(format!("pin {position}")),
        (None, None) => None,
    }
}
