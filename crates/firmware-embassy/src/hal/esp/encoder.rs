//! Encoders, whose steps a unit of the pulse counter counts. ESP32-C3 has none.

use sensedsl_job::JobConnection;
use sensedsl_model::kind::Role;

use super::settings::Settings;
use crate::context::Context;
use crate::hal::contract::inputs::{Counter, Encoder};
use crate::missing::{self, Printed};
use crate::section::{Constructor, Section};

impl Encoder for Settings {
    fn counter(
        &self,
        _context: &Context<'_>,
        wire: &JobConnection<'_>,
        section: &mut Section,
    ) -> Printed<Counter> {
        let unit = missing::unit(wire)?;
        let (a, b) = (missing::pad(wire, Role::A)?, missing::pad(wire, Role::B)?);
        section.features.insert("pcnt");
        let number = unit.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        let type_ = "rt::pcnt::Counter";
        let make = format!(
            "crate::{type_}::new({number}, p.{}.into(), p.{}.into())",
            a.pin.name, b.pin.name
        );
        Ok(Counter {
            made: Constructor { type_: format!("crate::{type_}"), make },
            suffix: "counter",
            type_: type_.to_owned(),
        })
    }
}
