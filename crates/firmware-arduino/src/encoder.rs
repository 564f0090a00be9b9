//! Quadrature encoders: both edges of both wires interrupt.

use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::{block, templates};
use sensedsl_model::kind::{KindName, Role};

use crate::context::{Context, level};
use crate::section::{Change, Cost, Section};

/// An `up_quadrature_t`, the count that was told, and when.
const WHEEL_BYTES: u32 = 6 + 4;

templates! {
    s: Encoders;
    Tables = "encoder.c.txt";
}

struct Encoders {
    sensors: Vec<Sensor>,
}

struct Sensor {
    ident: String,
    name: String,
    places: Vec<String>,
}

pub(crate) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut all = Encoders { sensors: Vec::new() };
    for (device, wires) in context.devices(KindName::Encoder) {
        for (index, wire) in wires.iter().enumerate() {
            let (Some(a), Some(b)) = (wire.pad(Role::A), wire.pad(Role::B)) else { continue };
            let line = format!(
                "up_quadrature_on_change(&{}_wheels[{index}], {}, {});",
                device.ident,
                level(&a.pin.name),
                level(&b.pin.name)
            );
            for pad in [a, b] {
                let number = context.names.number(&pad.pin.name);
                section
                    .pads
                    .extend(number.map(|number| format!("pinMode({number}, INPUT_PULLUP);")));
                section.changes.push(Change { pin: pad.pin.name.clone(), line: line.clone() });
            }
            section.starts.push(line);
        }
        let bytes = WHEEL_BYTES * u32::try_from(wires.len()).unwrap_or(0) + 5;
        section.costs.push(Cost::new(format!("the encoder {}", device.name()), bytes, 0));
        section.polls.push(format!("up_encoder_poll(&{}_encoder);", device.ident));
        all.sensors.push(Sensor {
            ident: device.ident.clone(),
            name: device.name().to_owned(),
            places: wires.iter().map(|wire| wire.place()).collect(),
        });
    }
    if !all.sensors.is_empty() {
        section.headers.push("up_encoder.h");
        section.costs.push(Cost::new("encoders", 0, 600));
        section.tables = block(&Tables { s: &all });
    }
    section
}
