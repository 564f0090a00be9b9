//! Where a person finds a pin on the board: contacts of connectors, written `CN7.28?=A0`.

use crate::form::Form;

/// A contact of a connector, or a position on the package.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The connector; `None` for a position on the package.
    pub header: Option<String>,
    /// The contact on the connector, or the position on the package.
    pub position: Option<String>,
    /// The edge of the board that it is at.
    pub side: Option<String>,
    /// The text printed beside this contact, if it differs from the pin's label.
    pub label: Option<String>,
    /// True if no source confirms the place.
    pub is_inferred: bool,
}

impl Place {
    /// Reads a word of the column `Places`: a connector, a dot and a contact; `?` behind it marks a
    /// place that no source confirms, `=` what is printed there. `None` if it is no such word.
    #[must_use]
    pub fn parse(word: &str) -> Option<Self> {
        let (place, label) = match word.split_once('=') {
            Some((_, "")) => return None,
            Some((place, label)) => (place, Some(label.to_owned())),
            None => (word, None),
        };
        let sure = place.strip_suffix('?');
        let (header, position) = sure.unwrap_or(place).rsplit_once('.')?;
        (!header.is_empty() && !position.is_empty()).then(|| Self {
            header: Some(header.to_owned()),
            position: Some(position.to_owned()),
            side: None,
            label,
            is_inferred: sure.is_some(),
        })
    }

    /// The word that [`Self::parse`] reads, without the edge of the board; none for a place that is
    /// not a contact of a connector.
    #[must_use]
    pub fn word(&self) -> Option<String> {
        let contact = self.contact()?;
        let mark = if self.is_inferred { "?" } else { "" };
        let label = self.label.as_ref().map_or(String::new(), |label| format!("={label}"));
        Some(format!("{contact}{mark}{label}"))
    }

    /// Connector and contact: `CN7.28`.
    #[must_use]
    pub fn contact(&self) -> Option<String> {
        Some(format!("{}.{}", self.header.as_ref()?, self.position.as_ref()?))
    }

    /// Whether it is at this connector; letters of any case.
    #[must_use]
    pub fn is_at_header(&self, name: &str) -> bool {
        self.header.as_deref().is_some_and(|own| own.eq_ignore_ascii_case(name))
    }

    /// Whether it is at this edge of the board; letters of any case.
    #[must_use]
    pub fn is_at_side(&self, name: &str) -> bool {
        self.side.as_deref().is_some_and(|own| own.eq_ignore_ascii_case(name))
    }

    /// Takes over the edge of the board from the board's form. False if the form has the connector
    /// but not the contact.
    pub(crate) fn look_up(&mut self, form: &Form) -> bool {
        let (Some(header), Some(position)) = (&self.header, &self.position) else { return true };
        let Some(connector) = form.connector(header) else { return true };
        let number = position.parse().ok();
        let Some(at) = number.and_then(|number| connector.contact(number)) else { return false };
        self.side.get_or_insert_with(|| form.side(&at).to_owned());
        true
    }
}

/// A contact of a connector that carries no pin: supply, ground, reset, or nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contact {
    /// What it carries: `GND`, `3V3`, `NRST`, `NC`.
    pub signal: String,
    /// Where it is.
    pub place: Place,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_back() {
        for word in ["CN7.28", "CN8.1=A0", "Pico.36=3V3(OUT)", "CN11.4?", "CN11.4?=D1", "J1.A7"] {
            assert_eq!(Place::parse(word).and_then(|place| place.word()).as_deref(), Some(word));
        }
        for word in ["CN7", "CN7.", ".3", "CN7.3=", "", "="] {
            assert_eq!(Place::parse(word), None, "{word}");
        }
    }
}
