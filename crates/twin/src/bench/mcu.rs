//! The bench as an emulated MCU sees it: addressed by pads and units.

use sensedsl_model::design::PartIndex;
use sensedsl_model::kind::Role;

use super::{Bench, Chip};
use crate::world::FaultKind;
use sensedsl_surroundings::{CanFrame, I2cEvent, I2cReply, Pad, Surroundings, TimerOutput};

impl Surroundings for Bench {
    fn millivolts(&mut self, pad: Pad, now_ns: u64) -> f64 {
        self.pads.get(&pad).map_or(0.0, |(connection, _)| self.millivolts_at(*connection, now_ns))
    }

    fn level(&mut self, pad: Pad, now_ns: u64) -> Option<bool> {
        let (connection, role) = *self.pads.get(&pad)?;
        let unit = self.chips.iter().find(|one| one.connection == connection).map(|one| one.unit);
        match (role, unit) {
            // The lines of a bus have pull-up resistors.
            (Role::Scl, Some(unit)) => Some(!self.is_held(FaultKind::Hang, unit, now_ns)),
            (Role::Sda, Some(unit)) => Some(!self.is_held(FaultKind::StuckSda, unit, now_ns)),
            (_, _) => self.level_at(connection, role, now_ns),
        }
    }

    fn next_edge(&mut self, pad: Pad, after_ns: u64) -> Option<(u64, bool)> {
        let (connection, role) = *self.pads.get(&pad)?;
        self.next_edge_at(connection, role, after_ns)
    }

    fn driven(&mut self, pad: Pad, level: Option<bool>, now_ns: u64) {
        let what = level.map_or("released", |is_high| if is_high { "high" } else { "low" });
        self.note(now_ns, pad, what);
        if let Some((connection, role)) = self.pads.get(&pad).copied() {
            self.drive_at(connection, role, level, now_ns);
        }
    }

    fn i2c(&mut self, unit: u8, event: I2cEvent, now_ns: u64) -> I2cReply {
        let reply = self.reply(unit, event, now_ns);
        self.note_i2c(unit, event, reply, now_ns);
        reply
    }

    fn spi(&mut self, unit: u8, out: u8, now_ns: u64) -> u8 {
        self.note(now_ns, format_args!("SPI{unit}"), format_args!("0x{out:02X}"));
        if self.clocked(unit, out, now_ns) {
            return 0xFF;
        }
        let selected = |one: &Chip| one.unit == unit && one.is_selected && one.address.is_none();
        let Some(place) = self.chips.iter().position(selected) else { return 0xFF };
        let part = self.chips.get(place).map(|one| one.part);
        if part.is_none_or(|part| self.has(FaultKind::Torn, part, now_ns)) {
            return 0xFF;
        }
        let Some(chip) = self.chips.get_mut(place) else { return 0xFF };
        self.recorder.shifted(chip.connection, out);
        chip.registers.exchange(out, &self.subjects)
    }

    fn levels(&mut self, unit: u8, byte: u8, from_ps: u64, bit_ps: u64) {
        self.levels_out(unit, byte, from_ps, bit_ps);
    }

    fn uart_in(&mut self, unit: u8, now_ns: u64) -> Option<u8> {
        if let Some(line) = self.lines.get_mut(&unit) {
            return line.next(now_ns);
        }
        let part = self.talkers.get(&unit)?.part;
        let is_cut = [FaultKind::Torn, FaultKind::Silent]
            .into_iter()
            .any(|kind| self.has(kind, part, now_ns));
        let is_spoiled = self.has(FaultKind::BadChecksum, part, now_ns);
        let talking = self.talkers.get_mut(&unit)?;
        talking.talker.set_spoiled(is_spoiled);
        let byte = talking.talker.next(&self.subjects, now_ns);
        if is_cut {
            talking.talker.torn();
            return None;
        }
        byte
    }

    fn pwm(&mut self, output: TimerOutput, period_ns: u64, width_ns: u64, now_ns: u64) {
        let TimerOutput { timer, channel, is_complement } = output;
        let end = if is_complement { "N" } else { "" };
        let place = format_args!("TIM{timer}_CH{channel}{end}");
        self.note(now_ns, place, format_args!("{width_ns} of {period_ns} ns"));
        self.waves.insert(output, (period_ns, width_ns));
        self.recorder.timer(output, period_ns, width_ns);
    }

    fn pulse(&mut self, output: TimerOutput, from_ns: u64, width_ns: u64) {
        let TimerOutput { timer, channel, .. } = output;
        let place = format_args!("TIM{timer}_CH{channel}");
        self.note(from_ns, place, format_args!("a pulse of {width_ns} ns"));
        self.recorder.pulse(output, from_ns, width_ns);
    }

    fn dac(&mut self, channel: u8, millivolts: f64, now_ns: u64) {
        self.note(now_ns, format_args!("DAC{channel}"), format_args!("{millivolts:.1} mV"));
        self.recorder.converter(channel, millivolts);
    }

    fn uart_out(&mut self, unit: u8, byte: u8, now_ns: u64) {
        self.note(now_ns, format_args!("USART{unit}"), format_args!("0x{byte:02X}"));
        if !self.lines.contains_key(&unit) {
            self.recorder.sent(unit, byte, now_ns);
            return;
        }
        // On a line that several share, only what its part has taken counts.
        let faults = self.faults.iter().filter(|one| one.cuts(now_ns));
        let gone: Vec<PartIndex> = faults.filter_map(|one| one.part).collect();
        let (subjects, line) = (&self.subjects, self.lines.get_mut(&unit));
        let is_there = |part: PartIndex| !gone.contains(&part);
        let taken = line.and_then(|line| line.take(byte, subjects, is_there, now_ns));
        for byte in taken.unwrap_or_default() {
            self.recorder.sent(unit, byte, now_ns);
        }
    }

    fn can_out(&mut self, unit: u8, frame: CanFrame, now_ns: u64) {
        if let Some(peer) = &self.peer {
            peer.sent(unit, frame);
        }
        self.note_frame(unit, &frame, now_ns);
        self.recorder.frame(unit, frame, now_ns);
    }

    fn can_in(&mut self, unit: u8, now_ns: u64) -> Option<CanFrame> {
        if let Some(peer) = &self.peer {
            return peer.next(unit);
        }
        let faults = self.faults.iter().filter(|one| one.cuts(now_ns));
        let faults: Vec<PartIndex> = faults.filter_map(|one| one.part).collect();
        let senders = self.senders.get_mut(&unit)?;
        let mut due = senders.iter_mut();
        due.find_map(|(part, sender)| sender.next(&self.subjects, now_ns, faults.contains(part)))
    }
}

impl Bench {
    /// The reply on an I2C bus.
    fn reply(&mut self, unit: u8, event: I2cEvent, now_ns: u64) -> I2cReply {
        if self.is_held(FaultKind::StuckSda, unit, now_ns) {
            return I2cReply::Stuck;
        }
        if self.is_held(FaultKind::Hang, unit, now_ns) {
            return I2cReply::Silent;
        }
        if let I2cEvent::Start { address, read } = event {
            let place =
                self.chips.iter().position(|one| one.unit == unit && one.address == Some(address));
            let Some(place) = place else { return I2cReply::Nack };
            let part = self.chips.get(place).map(|one| one.part);
            let is_gone = part.is_none_or(|part| {
                self.has(FaultKind::NoAnswer, part, now_ns)
                    || self.has(FaultKind::Torn, part, now_ns)
            });
            let Some(chip) = self.chips.get_mut(place) else { return I2cReply::Nack };
            if is_gone || chip.registers.is_busy(now_ns) {
                self.talked_to.remove(&unit);
                return I2cReply::Nack;
            }
            chip.registers.start(read, &self.subjects, now_ns);
            let connection = chip.connection;
            self.recorder.addressed(unit, (!read).then_some(connection), now_ns);
            self.page_begins(connection);
            self.talked_to.insert(unit, place);
            return I2cReply::Ack;
        }
        let talked_to = self.talked_to.get(&unit).and_then(|place| self.chips.get_mut(*place));
        match (event, talked_to) {
            (I2cEvent::Write(byte), Some(chip)) => {
                chip.registers.write(byte);
                let connection = chip.connection;
                self.recorder.taken(unit, byte);
                self.page_goes_on(connection, byte);
                I2cReply::Ack
            }
            (I2cEvent::Read { .. }, Some(chip)) => I2cReply::Byte(chip.registers.read()),
            (I2cEvent::Stop, Some(chip)) => {
                chip.registers.stop(now_ns);
                let connection = chip.connection;
                self.recorder.addressed(unit, None, now_ns);
                self.page_ends(connection, now_ns);
                self.talked_to.remove(&unit);
                I2cReply::Ack
            }
            (I2cEvent::Stop, None) => I2cReply::Ack,
            (I2cEvent::Write(_), None) | (I2cEvent::Start { .. }, _) => I2cReply::Nack,
            (I2cEvent::Read { .. }, None) => I2cReply::Byte(0xFF),
        }
    }
}
