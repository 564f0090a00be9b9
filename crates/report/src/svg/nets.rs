//! Which wire begins at which contact and goes to which box: parts and a shape in, nets out.
//!
//! A part is on the side of the board where most of its contacts are. A pin at several contacts is
//! wired at the one that is nearest to that side; wires of one pin to one side share their way.

use super::area::Side;
use super::parts::Part;
use super::shape::Shape;

/// The wires from one contact to one side.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Net<'p> {
    pub(super) contact: usize,
    pub(super) side: Side,
    pub(super) kind: &'p str,
    /// Part and wire of each end.
    pub(super) ends: Vec<(usize, usize)>,
}

/// The side of each part. One that could be on either goes where other parts on its bus are, or
/// where fewer wires are.
pub(super) fn sides(parts: &[Part], shape: &Shape<'_>) -> Vec<Side> {
    let mut placed: Vec<(&str, Side)> = Vec::new();
    let mut sides = Vec::new();
    for part in parts {
        let balance: i32 = part.wires.iter().map(|wire| weight(shape, &wire.pin)).sum();
        let count = |wanted| placed.iter().filter(|(_, side)| *side == wanted).count();
        let joins = |pin: &str| placed.iter().find(|(other, _)| *other == pin);
        let joined = part.wires.iter().find_map(|wire| joins(&wire.pin));
        let side = match (balance, joined) {
            (..=-1, _) => Side::Left,
            (1.., _) => Side::Right,
            (0, Some((_, side))) => *side,
            (0, None) if count(Side::Left) <= count(Side::Right) => Side::Left,
            (0, None) => Side::Right,
        };
        placed.extend(part.wires.iter().map(|wire| (wire.pin.as_str(), side)));
        sides.push(side);
    }
    sides
}

/// Where the contacts of a pin are: -1 if all are on the left, 1 if all are on the right.
fn weight(shape: &Shape<'_>, pin: &str) -> i32 {
    let mut sides = contacts(shape, pin).map(|(_, side)| side);
    let Some(first) = sides.next() else { return 0 };
    if sides.any(|side| side != first) {
        return 0;
    }
    match first {
        Side::Left => -1,
        Side::Right => 1,
    }
}

fn contacts(shape: &Shape<'_>, pin: &str) -> impl Iterator<Item = (usize, Side)> {
    let mine = move |contact: &super::shape::Contact<'_>| {
        contact.pin().is_some_and(|one| one.name.as_str() == pin)
    };
    let all = shape.contacts.iter().enumerate();
    let found: Vec<(usize, Side)> = all
        .filter(|(_, contact)| mine(contact))
        .map(|(index, contact)| (index, shape.side(contact.at)))
        .collect();
    found.into_iter()
}

/// Names the label of the contact that each wire is drawn to, where a pin has several contacts.
pub(super) fn label(parts: &mut [Part], shape: &Shape<'_>) {
    let sides = sides(parts, shape);
    for (part, side) in parts.iter_mut().zip(sides) {
        for wire in &mut part.wires {
            let contact = nearest(shape, &wire.pin, side).and_then(|at| shape.contacts.get(at));
            let label = contact.and_then(|contact| contact.label);
            if let Some(label) = label.filter(|label| !label.eq_ignore_ascii_case(&wire.pin)) {
                wire.label = Some(label.to_owned());
            }
        }
    }
}

/// The nets of all parts, in the order of the parts.
pub(super) fn nets<'p>(parts: &'p [Part], sides: &[Side], shape: &Shape<'_>) -> Vec<Net<'p>> {
    let mut nets: Vec<Net<'p>> = Vec::new();
    for (at, (part, side)) in parts.iter().zip(sides).enumerate() {
        for (index, wire) in part.wires.iter().enumerate() {
            let Some(contact) = nearest(shape, &wire.pin, *side) else { continue };
            let same = |net: &&mut Net<'_>| net.contact == contact && net.side == *side;
            match nets.iter_mut().find(same) {
                Some(net) => net.ends.push((at, index)),
                None => nets.push(Net {
                    contact,
                    side: *side,
                    kind: &wire.kind,
                    ends: vec![(at, index)],
                }),
            }
        }
    }
    nets
}

/// The contact of a pin that is nearest to a side.
fn nearest(shape: &Shape<'_>, pin: &str, side: Side) -> Option<usize> {
    let outward = |index: &usize| {
        shape.contacts.get(*index).map_or(0.0, |contact| contact.at.0 * side.outward())
    };
    let all = contacts(shape, pin).map(|(index, _)| index);
    all.max_by(|a, b| outward(a).total_cmp(&outward(b)).then(b.cmp(a)))
}
