//! The shapes of boards: outline, where the contacts of each connector are, buttons and LEDs.
//!
//! Many boards share a form: all Nucleo-64 have their connectors at the same places. The forms are
//! the files of `forms/`, embedded by the generated module `registry`. Seen from the side of the
//! parts, in millimetres from the upper left corner of the outline, y downwards.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use sensedsl_diagnostics::nearest;
use serde::Deserialize;

use crate::landmark::Landmark;
use crate::registry::{FILES, FORMS};

/// The shape of a board.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Form {
    /// The name, as in a table's line `# form = nucleo64`.
    pub name: String,
    /// The width of the outline.
    pub width_mm: f64,
    /// The height of the outline.
    pub height_mm: f64,
    /// Where the plug of the USB cable for power and programs is, if known: x and y.
    pub usb_mm: Option<[f64; 2]>,
    /// The source of the figures.
    pub source: String,
    /// The connectors.
    pub connector: Vec<Connector>,
    /// The buttons and LEDs that are at the same place on all boards of this form.
    #[serde(default)]
    pub landmark: Vec<Landmark>,
}

/// A connector of a form.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Connector {
    /// The name, as printed or as the maker's manual has it.
    pub name: String,
    /// Its contacts, in straight rows.
    pub row: Vec<Row>,
}

/// A straight row of contacts with equal distances.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The number of the first contact.
    pub first: u32,
    /// The difference between the numbers of neighbours.
    pub step: u32,
    /// The number of contacts.
    pub count: u32,
    /// Where the first contact is: x and y.
    pub at_mm: [f64; 2],
    /// From one contact to the next: x and y.
    pub to_next_mm: [f64; 2],
}

/// Where a contact is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At {
    /// From the left edge.
    pub x_mm: f64,
    /// From the upper edge.
    pub y_mm: f64,
    /// Whether the row that it is in runs up and down the board.
    pub is_vertical: bool,
}

impl Form {
    /// The connector of a name; letters of any case.
    #[must_use]
    pub fn connector(&self, name: &str) -> Option<&Connector> {
        self.connector.iter().find(|one| one.name.eq_ignore_ascii_case(name))
    }

    /// The edge of the board that a row is nearest to.
    #[must_use]
    pub fn side(&self, at: &At) -> &'static str {
        if at.is_vertical {
            if at.x_mm * 2.0 < self.width_mm { "left" } else { "right" }
        } else if at.y_mm * 2.0 < self.height_mm {
            "top"
        } else {
            "bottom"
        }
    }
}

impl Connector {
    /// Where a contact is; none if the connector has no such contact.
    #[must_use]
    pub fn contact(&self, number: u32) -> Option<At> {
        self.row.iter().find_map(|row| row.contact(number))
    }

    /// How far along the connector a contact is, counted in contacts: those of two rows that are
    /// beside each other are equally far. None if the connector has no such contact.
    #[must_use]
    pub fn along(&self, number: u32) -> Option<u32> {
        let at = self.contact(number)?;
        let first = self.row.first()?;
        let [dx, dy] = first.to_next_mm;
        let pitch_mm = dx.abs().max(dy.abs());
        let along_mm = |at: &At| if at.is_vertical { at.y_mm } else { at.x_mm };
        let beside = self.numbers().filter_map(|number| self.contact(number));
        let beside = beside.filter(|other| other.is_vertical == at.is_vertical);
        let nearest_mm = beside.map(|other| along_mm(&other)).fold(f64::INFINITY, f64::min);
        let contacts = ((along_mm(&at) - nearest_mm) / pitch_mm).round();
        // A form that a person wrote may have no distance between contacts.
        (0..=i32::MAX).contains(&(contacts as i32)).then_some(contacts as u32)
    }

    /// The numbers of all its contacts, row by row.
    pub fn numbers(&self) -> impl Iterator<Item = u32> {
        self.row.iter().flat_map(|row| (0..row.count).map(|index| row.first + index * row.step))
    }
}

impl Row {
    fn contact(&self, number: u32) -> Option<At> {
        let beyond = number.checked_sub(self.first)?;
        let index = beyond / self.step.max(1);
        (beyond.is_multiple_of(self.step.max(1)) && index < self.count).then(|| {
            let [[x, y], [dx, dy]] = [self.at_mm, self.to_next_mm];
            let along = f64::from(index);
            let is_vertical = dy.abs() > dx.abs();
            At { x_mm: x + along * dx, y_mm: y + along * dy, is_vertical }
        })
    }
}

/// The form of a name.
#[must_use]
pub fn find(name: &str) -> Option<&'static Form> {
    all().get(name)
}

/// The names of all forms, in order.
pub fn names() -> impl Iterator<Item = &'static str> {
    FORMS.iter().copied()
}

/// The name closest to a misspelt one.
#[must_use]
pub fn nearest_name(name: &str) -> Option<&'static str> {
    nearest(name, names())
}

/// All forms by name. A damaged file is left out; tests rule that out.
fn all() -> &'static BTreeMap<&'static str, Form> {
    static ALL: OnceLock<BTreeMap<&'static str, Form>> = OnceLock::new();
    ALL.get_or_init(|| {
        let text = |name: &str| FILES.text(&format!("forms/{name}.toml"));
        let read = |name: &&'static str| Some((*name, toml::from_str(text(name)).ok()?));
        FORMS.iter().filter_map(read).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::find;

    #[test]
    fn contacts_beside_each_other_are_equally_far_along() {
        let along = |form: &str, connector: &str, number: u32| {
            find(form).and_then(|form| form.connector(connector)?.along(number))
        };
        for (number, far) in [(1, 0), (2, 0), (27, 13), (28, 13), (38, 18)] {
            assert_eq!(along("nucleo64", "CN7", number), Some(far), "{number}");
        }
        for (number, far) in [(1, 0), (40, 0), (20, 19), (21, 19), (30, 10)] {
            assert_eq!(along("pico", "Pico", number), Some(far), "{number}");
        }
        assert_eq!(along("pico", "Pico", 41), None);
    }
}
