//! What unused pins can be: texts beside the contacts of a board without a form, which has the room.

use super::area::Side;
use super::shape::{Carries, Contact, Shape};
use super::text::{Anchor, Text, cut};

const SIZE: f64 = 9.0;
/// From the names and labels, and up to the middle of the board.
const GAP: f64 = 10.0;

/// The texts; none for a board that is drawn to scale.
pub(super) fn texts(
    shape: &Shape<'_>,
    labels: &[Text],
    is_used: &dyn Fn(&Contact<'_>) -> bool,
) -> Vec<Text> {
    if shape.is_to_scale {
        return Vec::new();
    }
    let widths = labels.iter().map(|label| label.area().right - label.area().left);
    let inset = widths.fold(0.0, f64::max) + 2.0 * GAP;
    let free = shape.contacts.iter().filter(|contact| !is_used(contact));
    free.filter_map(|contact| text(shape, contact, inset)).collect()
}

fn text(shape: &Shape<'_>, contact: &Contact<'_>, inset: f64) -> Option<Text> {
    let Carries::Pin(pin) = contact.carries else { return None };
    let part = pin.onboard.iter().map(|part| format!("[{}]", part.part));
    let usages = pin.usages.iter().map(|usage| usage.spelled.clone());
    let words: Vec<String> = part.chain(usages).collect();
    let side = shape.side(contact.at);
    let start = contact.at.0 - side.outward() * inset;
    let room = (shape.width / 2.0 - start).abs() - GAP;
    let anchor = match side {
        Side::Left => Anchor::Start,
        Side::Right => Anchor::End,
    };
    let content = cut(&words.join(" "), SIZE, room);
    let at = (start, contact.at.1);
    (!content.is_empty()).then(|| Text::new(at, SIZE, "sd-soft", &content).anchored(anchor))
}
