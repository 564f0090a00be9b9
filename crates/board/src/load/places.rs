//! Places in a board table: the column `Places`, and rows of contacts that carry no pin.

use crate::cells::Cell;
use crate::finding::FindingKind;
use crate::place::{Contact, Place};
use crate::table::{Column, Role};

use super::{Loader, Slot};

impl Loader<'_> {
    /// The contacts of a row that names no pin: what `Label` says, at the places of `Places`. `None`
    /// for any other row.
    pub(super) fn contacts(&mut self, row: &[Cell], slots: &[Slot]) -> Option<Vec<Contact>> {
        let cell = |role: Role| {
            let is_it = |slot: &Slot| slot.as_ref().is_some_and(|column| column.role == role);
            let at = slots.iter().position(is_it)?;
            Some((row.get(at)?, slots.get(at)?.as_ref()?))
        };
        let (name, _) = cell(Role::Pin)?;
        if self.value(name).is_some() {
            return None;
        }
        let signal = self.text(cell(Role::Label)?.0)?;
        let (places, column) = cell(Role::Places)?;
        let places = self.places(places, column, (&signal, false));
        let contact = |mut place: Place| {
            if let Some(form) = self.form {
                place.look_up(form);
            }
            Contact { signal: signal.clone(), place }
        };
        (!places.is_empty()).then(|| places.into_iter().map(contact).collect())
    }

    /// Reads a cell of the column `Places` in the row of a pin or of another signal.
    pub(super) fn places(
        &mut self,
        cell: &Cell,
        column: &Column,
        (carries, is_pin): (&str, bool),
    ) -> Vec<Place> {
        let mut places = Vec::new();
        for word in self.words(cell) {
            let at = Some(column.header.as_str());
            let Some(mut place) = Place::parse(&word.text) else {
                self.report(FindingKind::BadPlace { spelled: word.text }, &word.range, at);
                continue;
            };
            let contact = place.contact().unwrap_or_default();
            if let Some(form) = self.form.filter(|form| !place.look_up(form)) {
                let form = form.name.clone();
                self.report(
                    FindingKind::NoContact { contact: contact.clone(), form },
                    &word.range,
                    at,
                );
            }
            let carried = (carries.to_owned(), is_pin);
            match self.carried.insert(contact.to_ascii_uppercase(), carried) {
                // Pins that share a contact exclude each other.
                Some((first, other)) if first != carries && !(is_pin && other) => {
                    let kind = FindingKind::ContactTwice { contact, first };
                    self.report(kind, &word.range, at);
                }
                _ => {}
            }
            places.push(place);
        }
        places
    }
}
