//! Parts on serial lines, from a board's job: what each is asked and told.

use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::design::Device;
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use super::Bench;
use crate::parts::dialogue::{Asked, Station, Told};

impl Bench {
    /// The part of a connection.
    pub(super) fn station(&self, job: &BoardJob<'_>, one: &JobConnection<'_>) -> Station {
        let mut station = Station {
            part: one.connection.part,
            connection: one.index,
            asked: Vec::new(),
            told: Vec::new(),
        };
        let all = job.devices.iter().map(|of| of.device);
        for device in all.filter(|device| device.part == one.connection.part) {
            match device.direction {
                Direction::Sensor => self.asked(&mut station.asked, device),
                Direction::Actuator => station.told.extend(told(device)),
            }
        }
        station
    }

    fn asked(&self, all: &mut Vec<Asked>, device: &Device) {
        let Some(uart) = device.kind.uart() else { return };
        let field = self.field(device);
        let is_same = |one: &&mut Asked| one.uart.exchange.request == uart.exchange.request;
        match all.iter_mut().find(is_same) {
            Some(one) => one.fields.extend(field),
            None => all.push(Asked { uart: uart.clone(), fields: field.into_iter().collect() }),
        }
    }
}

fn told(device: &Device) -> Option<Told> {
    let uart = device.kind.uart()?.clone();
    let value_bytes = Words::of(device).map(|words| usize::from(words.wire_bytes()));
    Some(Told { uart, value_bytes })
}
