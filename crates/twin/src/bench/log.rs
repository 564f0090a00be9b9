//! A log of everything that an emulated MCU puts on its pads and buses, one event a line: time,
//! place, event.

use std::fmt::{Display, Write as _};

use super::Bench;
use sensedsl_surroundings::{CanFrame, I2cEvent, I2cReply};

/// The lines so far, as CSV.
#[derive(Clone, Debug)]
pub(super) struct Log(String);

impl Bench {
    /// Starts the log: everything that leaves the MCU from now on is written to it.
    pub fn start_log(&mut self) {
        self.log = Some(Log("time_ns,place,what\n".to_owned()));
    }

    /// The log so far; logging stops.
    pub fn take_log(&mut self) -> Option<String> {
        self.log.take().map(|log| log.0)
    }

    pub(super) fn note(&mut self, now_ns: u64, place: impl Display, what: impl Display) {
        if let Some(log) = &mut self.log {
            // Writing to a string cannot fail.
            let _ = writeln!(log.0, "{now_ns},{place},{what}");
        }
    }

    pub(super) fn note_i2c(&mut self, unit: u8, event: I2cEvent, reply: I2cReply, now_ns: u64) {
        if self.log.is_none() {
            return;
        }
        let asked = match event {
            I2cEvent::Start { address, read } => {
                format!("{} 0x{address:02X}", if read { "read from" } else { "write to" })
            }
            I2cEvent::Write(byte) => format!("0x{byte:02X}"),
            I2cEvent::Read { ack } => if ack { "take" } else { "take the last" }.to_owned(),
            I2cEvent::Stop => "stop".to_owned(),
        };
        let answer = match reply {
            I2cReply::Ack => "",
            I2cReply::Nack => " not acknowledged",
            I2cReply::Byte(_) => " a byte",
            I2cReply::Stuck => " SDA held",
            I2cReply::Silent => " SCL held",
        };
        self.note(now_ns, format_args!("I2C{unit}"), format_args!("{asked}{answer}"));
    }

    pub(super) fn note_frame(&mut self, unit: u8, frame: &CanFrame, now_ns: u64) {
        if self.log.is_none() {
            return;
        }
        let data = frame.data.iter().take(usize::from(frame.length));
        let data: Vec<String> = data.map(|byte| format!("{byte:02X}")).collect();
        let sort = match (frame.extended, frame.remote) {
            (_, true) => " asked for",
            (true, false) => " extended",
            (false, false) => "",
        };
        let what = format!("0x{:X}{sort} {}", frame.id, data.join(" "));
        self.note(now_ns, format_args!("CAN{unit}"), what);
    }
}
