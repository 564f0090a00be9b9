//! A world for firmware on the twin, and the bytes that its host receives.

use std::collections::{BTreeMap, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard};

use sensedsl_machine::{LinkPort, Machine, Mcu, Settings};
use sensedsl_surroundings::{CanFrame, I2cEvent, I2cReply, Pad, Surroundings, TimerOutput};
use sensedsl_wire::{Decoder, Direction, Event, Scalar, Schema};

use crate::firmware::chibios::{build, write};

pub(super) const MS: u64 = 1_000_000;

/// The first output of the smallest design with pulses.
pub(super) const STEERING: TimerOutput = TimerOutput { timer: 9, channel: 1, is_complement: false };

/// A level that changes every `half_ns`, first at `shift_ns`.
#[derive(Clone, Copy)]
pub(super) struct Square {
    pub half_ns: u64,
    pub shift_ns: u64,
}

impl Square {
    fn level(self, now: u64) -> bool {
        now >= self.shift_ns && ((now - self.shift_ns) / self.half_ns).is_multiple_of(2)
    }

    fn next(self, after: u64) -> (u64, bool) {
        if after < self.shift_ns {
            return (self.shift_ns, true);
        }
        let next = ((after - self.shift_ns) / self.half_ns + 1) * self.half_ns + self.shift_ns;
        (next, self.level(next))
    }
}

/// The state of pads and buses, and the data that came from the MCU.
#[derive(Default)]
pub(super) struct World {
    pub squares: BTreeMap<Pad, Square>,
    pub levels: BTreeMap<Pad, bool>,
    /// Millivolts at time 0, and their increase per millisecond.
    pub voltages: BTreeMap<Pad, (f64, f64)>,
    /// Registers of chips that increment the register address by themselves; by chip address.
    pub chips: BTreeMap<u8, BTreeMap<u8, u8>>,
    /// The transfers written, each with its address.
    pub written: Vec<(u8, Vec<u8>)>,
    chosen: Option<(u8, bool)>,
    pointer: u8,
    pub spi_answers: VecDeque<u8>,
    pub spi_sent: Vec<u8>,
    pub to_uart: VecDeque<u8>,
    /// Frames to be received, by controller.
    pub to_can: BTreeMap<u8, VecDeque<CanFrame>>,
    /// Frames that were sent, with their controllers.
    pub from_can: Vec<(u8, CanFrame)>,
    pub driven: BTreeMap<Pad, Option<bool>>,
    pub waves: BTreeMap<TimerOutput, (u64, u64)>,
    /// Pulses that were made one by one: when each began, and its width.
    pub pulses: BTreeMap<TimerOutput, Vec<(u64, u64)>>,
    pub outputs: BTreeMap<u8, f64>,
    chip_selects: u32,
}

impl World {
    pub(super) fn chip_selects(&self) -> u32 {
        self.chip_selects
    }
}

impl Surroundings for World {
    fn millivolts(&mut self, pad: Pad, now_ns: u64) -> f64 {
        let (start, slope) = self.voltages.get(&pad).copied().unwrap_or_default();
        start + slope * (now_ns as f64 / MS as f64)
    }

    fn level(&mut self, pad: Pad, now_ns: u64) -> Option<bool> {
        let square = self.squares.get(&pad).map(|square| square.level(now_ns));
        square.or_else(|| self.levels.get(&pad).copied())
    }

    fn next_edge(&mut self, pad: Pad, after_ns: u64) -> Option<(u64, bool)> {
        self.squares.get(&pad).map(|square| square.next(after_ns))
    }

    fn driven(&mut self, pad: Pad, level: Option<bool>, _: u64) {
        self.chip_selects += u32::from(level == Some(false));
        self.driven.insert(pad, level);
    }

    fn i2c(&mut self, _: u8, event: I2cEvent, _: u64) -> I2cReply {
        match event {
            I2cEvent::Start { address, read } => {
                let is_here = self.chips.contains_key(&address);
                self.chosen = is_here.then_some((address, read));
                if is_here && !read {
                    self.written.push((address, Vec::new()));
                }
                if is_here { I2cReply::Ack } else { I2cReply::Nack }
            }
            I2cEvent::Write(byte) => {
                let (_, bytes) = self.written.last_mut().unwrap();
                if bytes.is_empty() {
                    self.pointer = byte;
                }
                bytes.push(byte);
                I2cReply::Ack
            }
            I2cEvent::Read { .. } => {
                let (address, _) = self.chosen.unwrap();
                let byte = self.chips[&address].get(&self.pointer).copied().unwrap_or(0xFF);
                self.pointer = self.pointer.wrapping_add(1);
                I2cReply::Byte(byte)
            }
            I2cEvent::Stop => {
                self.chosen = None;
                I2cReply::Ack
            }
        }
    }

    fn spi(&mut self, _: u8, out: u8, _: u64) -> u8 {
        self.spi_sent.push(out);
        let answer = self.spi_answers.pop_front().unwrap_or(0xFF);
        self.spi_answers.push_back(answer);
        answer
    }

    fn uart_in(&mut self, _: u8, _: u64) -> Option<u8> {
        self.to_uart.pop_front()
    }

    fn can_in(&mut self, unit: u8, _: u64) -> Option<CanFrame> {
        self.to_can.get_mut(&unit)?.pop_front()
    }

    fn can_out(&mut self, unit: u8, frame: CanFrame, _: u64) {
        self.from_can.push((unit, frame));
    }

    fn pwm(&mut self, output: TimerOutput, period_ns: u64, width_ns: u64, _: u64) {
        self.waves.insert(output, (period_ns, width_ns));
    }

    fn pulse(&mut self, output: TimerOutput, from_ns: u64, width_ns: u64) {
        self.pulses.entry(output).or_default().push((from_ns, width_ns));
    }

    fn dac(&mut self, channel: u8, millivolts: f64, _: u64) {
        self.outputs.insert(channel, millivolts);
    }
}

/// The pad with a name.
pub(super) fn pad(name: &str) -> Pad {
    Pad::named(name).unwrap()
}

/// A report: its time of arrival, and values by identifier.
pub(super) type Report = (u64, BTreeMap<u8, Vec<Scalar>>);

/// A board with its program, its world and its host.
pub(super) struct Bench {
    pub machine: Machine,
    world: Arc<Mutex<World>>,
    pub received: Vec<(u64, u8)>,
}

impl Bench {
    /// Generates, builds and loads the only board of a design.
    pub(super) fn build(
        tree: &std::path::Path,
        name: &str,
        text: &str,
        mode: &str,
        link: LinkPort,
    ) -> Self {
        let board = folder(name, text);
        build(tree, &board, mode);
        Self::load(&board, mode, link)
    }

    pub(super) fn load(board: &std::path::Path, mode: &str, link: LinkPort) -> Self {
        Self::of(&board.join("build").join(mode).join("sense.elf"), link)
    }

    /// A board that runs a program.
    pub(super) fn of(program: &std::path::Path, link: LinkPort) -> Self {
        let image = std::fs::read(program).unwrap();
        let world = Arc::new(Mutex::new(World::default()));
        let mcu = Mcu::find("STM32F407VGT6").unwrap();
        let settings = Settings { crystal_hz: 8_000_000, link, mcu };
        let mut machine =
            Machine::new(settings, Arc::clone(&world) as Arc<Mutex<dyn Surroundings>>);
        machine.load(&image).unwrap_or_else(|error| panic!("{error}"));
        Self { machine, world, received: Vec::new() }
    }

    pub(super) fn world(&self) -> MutexGuard<'_, World> {
        self.world.lock().unwrap()
    }

    pub(super) fn run_until_ms(&mut self, ms: u64) {
        self.machine.run_until(ms * MS);
        self.received.extend(self.machine.link_read());
        let halt = self.machine.halt();
        assert!(halt.is_none(), "{halt:?}");
    }

    /// The bytes that the host received, as text.
    pub(super) fn reported(&self) -> String {
        let bytes: Vec<u8> = self.received.iter().map(|(_, byte)| *byte).collect();
        String::from_utf8_lossy(&bytes).into_owned()
    }

    pub(super) fn reports(&self, schema: &Schema) -> Vec<Report> {
        let mut decoder = Decoder::new(schema, Direction::Sensor);
        let mut reports = Vec::new();
        for (at, byte) in &self.received {
            decoder.feed(&[*byte], |event| match event {
                Event::Report(_, values) => reports.push((*at, values.into_iter().collect())),
                Event::Hello(hash) => assert_eq!(hash, schema.hash()),
                other => panic!("{other:?}"),
            });
        }
        reports
    }

    /// The pads must be switched to these wires, and no pad to another wire of the same
    /// peripherals.
    pub(super) fn assert_wires(&self, wanted: &[(&str, &str)]) {
        let pads = self.machine.pads();
        for (name, wire) in wanted {
            let state = pads.iter().find(|state| state.pad == pad(name)).unwrap();
            assert!(state.wires.iter().any(|led| led == wire), "{wire}: {state:?}");
        }
    }
}

/// The folder of the only board of a design.
pub(super) fn folder(name: &str, text: &str) -> std::path::PathBuf {
    let folder = write(name, text);
    let mut boards = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
    boards.find(|path| path.is_dir()).unwrap()
}

/// The values of one item, with the times of their reports.
pub(super) fn values(reports: &[Report], id: u8) -> Vec<(u64, Vec<Scalar>)> {
    let of = |(at, report): &Report| report.get(&id).map(|values| (*at, values.clone()));
    reports.iter().filter_map(of).collect()
}

pub(super) fn unsigned(values: &[Scalar]) -> u64 {
    match values {
        [Scalar::Unsigned(value)] => *value,
        other => panic!("{other:?}"),
    }
}
