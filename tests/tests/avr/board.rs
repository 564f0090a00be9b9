//! A board's image on an AVR, on the bench of the board's job: as `EmulatedBoard` for the emulated STM32.

use std::collections::BTreeMap;
use std::path::Path;

use sensedsl_job::BoardJob;
use sensedsl_model::design::{ConnectionIndex, Transport};
use sensedsl_model::kind::uart::Parity;
use sensedsl_model::kind::{Interface, Role};
use sensedsl_surroundings::{I2cEvent, I2cReply, Pad, Surroundings, TimerOutput};
use sensedsl_twin::bench::{Bench, UncheckedIdentity, number_of};
use sensedsl_twin::commands::outputs::Outputs;
use sensedsl_twin::trial::{Culprit, Stopped, Tested};

use super::child::{Around, Avr, Link, Reset, Serial, Setting, Setup};

const MS_NS: u64 = 1_000_000;
const SECOND_NS: u64 = 1_000 * MS_NS;
const CRYSTAL_HZ: u32 = 16_000_000;
/// The bench's voltages are parts of what its converters measure at most. An AVR's measures up to its supply.
const OF_BENCH_MV: f64 = 3_300.0;
const SUPPLY_MV: f64 = 5_000.0;
/// A watchdog with a longer timeout than this counts as missing; the time after a start at which that is checked.
const WATCHDOG_NS: u64 = 10 * SECOND_NS;
const WATCHED_NS: u64 = 2_500 * MS_NS;
/// After this many resets that nobody asked for, the program counts as one that only ever starts.
const RESETS_MAX: usize = 3;

/// The bench with the supply of the board, and inputs that no port has.
struct OnBench {
    bench: Bench,
    inputs: BTreeMap<u8, ConnectionIndex>,
    /// The pads that make parts measure.
    triggers: BTreeMap<Pad, Trigger>,
}

/// The pulses on a wire that makes a part measure.
#[derive(Clone, Copy, Debug, Default)]
struct Trigger {
    rose_ns: Option<u64>,
    shortest_ns: Option<u64>,
}

impl Trigger {
    fn driven(&mut self, level: Option<bool>, now_ns: u64) {
        let pulse_ns = self.rose_ns.take().map(|rose_ns| now_ns - rose_ns);
        self.rose_ns = (level == Some(true)).then_some(now_ns);
        self.shortest_ns = self.shortest_ns.into_iter().chain(pulse_ns).min();
    }
}

impl OnBench {
    fn new(job: &BoardJob<'_>, bench: Bench) -> Self {
        let of_pad = |name: &str| name.strip_prefix("ADC")?.parse().ok();
        let pads =
            job.connections.iter().flat_map(|one| one.pads.iter().map(move |pad| (one, pad)));
        let inputs =
            pads.filter_map(|(one, pad)| Some((of_pad(&pad.pin.name.to_string())?, one.index)));
        let all = job.connections.iter().flat_map(|one| &one.pads);
        let all = all.filter(|pad| pad.role == Role::Trigger);
        let triggers = all.filter_map(|pad| Pad::named(&pad.pin.name.to_string()));
        let triggers = triggers.map(|pad| (pad, Trigger::default())).collect();
        Self { inputs: inputs.collect(), triggers, bench }
    }
}

fn of_supply(of_bench_mv: f64) -> f64 {
    of_bench_mv * SUPPLY_MV / OF_BENCH_MV
}

impl Surroundings for OnBench {
    fn millivolts(&mut self, pad: Pad, now_ns: u64) -> f64 {
        of_supply(self.bench.millivolts(pad, now_ns))
    }

    fn level(&mut self, pad: Pad, now_ns: u64) -> Option<bool> {
        self.bench.level(pad, now_ns)
    }

    fn next_edge(&mut self, pad: Pad, after_ns: u64) -> Option<(u64, bool)> {
        self.bench.next_edge(pad, after_ns)
    }

    fn driven(&mut self, pad: Pad, level: Option<bool>, now_ns: u64) {
        if let Some(trigger) = self.triggers.get_mut(&pad) {
            trigger.driven(level, now_ns);
        }
        self.bench.driven(pad, level, now_ns);
    }

    fn i2c(&mut self, unit: u8, event: I2cEvent, now_ns: u64) -> I2cReply {
        self.bench.i2c(unit, event, now_ns)
    }

    fn spi(&mut self, unit: u8, out: u8, now_ns: u64) -> u8 {
        self.bench.spi(unit, out, now_ns)
    }

    fn levels(&mut self, unit: u8, byte: u8, from_ps: u64, bit_ps: u64) {
        self.bench.levels(unit, byte, from_ps, bit_ps);
    }

    fn uart_in(&mut self, unit: u8, now_ns: u64) -> Option<u8> {
        self.bench.uart_in(unit, now_ns)
    }

    fn uart_out(&mut self, unit: u8, byte: u8, now_ns: u64) {
        self.bench.uart_out(unit, byte, now_ns);
    }

    fn pwm(&mut self, output: TimerOutput, period_ns: u64, width_ns: u64, now_ns: u64) {
        self.bench.pwm(output, period_ns, width_ns, now_ns);
    }
}

impl Around for OnBench {
    fn input_millivolts(&mut self, input: u8, now_ns: u64) -> f64 {
        let connection = self.inputs.get(&input);
        connection.map_or(0.0, |one| of_supply(self.bench.millivolts_at(*one, now_ns)))
    }
}

/// The MCU with its surroundings.
pub(crate) struct AvrBoard {
    avr: Avr<OnBench>,
    steps: u64,
    is_off: bool,
    garbage: Vec<u8>,
    /// How many of the resets came before the supply did.
    forgiven: usize,
    watched_at_ns: Option<u64>,
    unwatched: Option<String>,
}

impl AvrBoard {
    /// Puts an image, an ELF file, into the flash of a job's MCU.
    pub(crate) fn new(job: &BoardJob<'_>, bench: Bench, image: &Path) -> Self {
        let mcu = mcu_of(job.board.mcu.as_deref().unwrap_or_default());
        let crystal = job.board.facts.as_ref().and_then(|facts| facts.crystal.hse_hz);
        let unit = job.link.as_ref().and_then(|link| number_of(link.unit));
        let link = match (job.board.link.transport, unit) {
            (Transport::Uart, Some(unit)) => Link::Serial(unit),
            (Transport::Usb, _) => Link::Usb,
            (Transport::Uart | Transport::None, _) => Link::None,
        };
        let pads = job.connections.iter().flat_map(|one| &one.pads);
        let setup = Setup {
            mcu,
            clock_hz: crystal.unwrap_or(CRYSTAL_HZ),
            image,
            link,
            serials: serials(job),
            pads: pads.filter_map(|pad| Pad::named(&pad.pin.name.to_string())).collect(),
        };
        Self {
            avr: Avr::start(&setup, OnBench::new(job, bench)),
            steps: 0,
            is_off: false,
            garbage: Vec::new(),
            forgiven: 0,
            watched_at_ns: Some(WATCHED_NS),
            unwatched: None,
        }
    }

    fn bench(&self) -> &Bench {
        &self.avr.around.bench
    }

    /// The bench, of which something is changed now.
    pub(crate) fn bench_mut(&mut self) -> &mut Bench {
        self.avr.surroundings_changed();
        &mut self.avr.around.bench
    }

    pub(crate) const fn now_ns(&self) -> u64 {
        self.avr.now_ns()
    }

    /// Runs until the given time, in steps of a millisecond: the supply may fail in each of them.
    pub(crate) fn run_until(&mut self, until_ns: u64) {
        while self.steps < until_ns / MS_NS {
            self.steps += 1;
            let now_ns = self.steps * MS_NS;
            self.supply(now_ns);
            if self.bench().has_plants() {
                self.bench_mut().advance(now_ns);
            }
            self.avr.run_until(now_ns);
            let garbage = self.bench().garbage(now_ns);
            self.garbage.extend(garbage);
            self.watch(now_ns);
        }
        self.avr.run_until(until_ns);
    }

    /// Takes the supply away and gives it back, as the world says.
    fn supply(&mut self, now_ns: u64) {
        let is_off = self.bench().is_off(now_ns);
        if is_off != self.is_off {
            self.is_off = is_off;
            self.avr.power(!is_off);
            self.watched_at_ns = (!is_off).then(|| now_ns + WATCHED_NS);
            if !is_off {
                self.bench_mut().power_up(now_ns);
            }
        }
    }

    /// Checks whether the watchdog runs if it is time.
    fn watch(&mut self, now_ns: u64) {
        let all = self.avr.resets();
        if let Some(Reset { at_ns, cause }) =
            all.last().copied().filter(|one| one.at_ns + MS_NS > now_ns)
        {
            self.watched_at_ns = Some(at_ns + WATCHED_NS);
            self.forgiven = if cause == Reset::POWER { all.len() } else { self.forgiven };
        }
        if self.watched_at_ns.is_some_and(|at_ns| at_ns <= now_ns) {
            self.watched_at_ns = None;
            self.unwatched = match self.avr.watchdog_ns() {
                None => Some("does not run".to_owned()),
                Some(ns) if ns > WATCHDOG_NS => Some("bites too late".to_owned()),
                Some(_) => None,
            };
        }
    }

    pub(crate) fn link_write(&mut self, bytes: &[u8]) {
        if !self.is_off {
            self.avr.link_write(bytes);
        }
    }

    pub(crate) fn link_open(&mut self, is_open: bool) {
        self.avr.link_open(is_open);
    }

    /// The bytes that have arrived at the host since the last call.
    pub(crate) fn link_read(&mut self) -> Vec<u8> {
        let mut bytes = std::mem::take(&mut self.garbage);
        bytes.extend(self.avr.link_read().into_iter().map(|(_, byte)| byte));
        bytes
    }

    pub(crate) fn outputs(&self) -> Outputs {
        self.bench().outputs().clone()
    }

    /// Period and width, in nanoseconds, of the pulses that the board sends, by timer and channel.
    pub(crate) fn waves(&self) -> BTreeMap<TimerOutput, (u64, u64)> {
        self.bench().waves().clone()
    }

    /// The shortest pulse on a pad that makes a part measure; none if there was no pulse.
    pub(crate) fn shortest_trigger_ns(&self, pad: Pad) -> Option<u64> {
        self.avr.around.triggers.get(&pad)?.shortest_ns
    }

    /// The parts on buses that the board has read without asking for their identity.
    pub(crate) fn unasked(&self) -> Vec<UncheckedIdentity> {
        self.bench().unasked()
    }

    /// The parts on buses that the board has treated in a way that their drivers do not describe.
    pub(crate) fn odd_transfers(&self) -> Vec<(String, String)> {
        self.bench().odd_transfers()
    }

    /// How the ports are set up, by unit.
    pub(crate) fn ports(&self) -> &BTreeMap<(char, u8), Setting> {
        self.avr.settings()
    }

    /// What the program has written to DDRx and PORTx, by port from A on.
    pub(crate) fn registers(&mut self) -> Vec<(u8, u8)> {
        self.avr.registers()
    }

    /// All resets after the first start.
    pub(crate) fn resets(&self) -> &[Reset] {
        self.avr.resets()
    }

    /// The watchdog's fault, if one was found since the last call.
    pub(crate) fn unwatched(&mut self) -> Option<String> {
        self.unwatched.take()
    }

    /// The time that the processor has worked so far.
    pub(crate) fn worked_ns(&self) -> u64 {
        self.now_ns().saturating_sub(self.avr.asleep_ns())
    }

    /// Why the program cannot go on.
    pub(crate) fn halt(&self) -> Option<String> {
        if let Some(pc) = self.avr.crash() {
            return Some(format!("the program left its code or its memory at 0x{pc:05x}"));
        }
        let resets = self.resets().len() - self.forgiven;
        (resets >= RESETS_MAX).then(|| format!("the watchdog has reset it {resets} times"))
    }
}

impl Tested for AvrBoard {
    fn now_ns(&self) -> u64 {
        self.now_ns()
    }

    fn run_until(&mut self, until_ns: u64) {
        self.run_until(until_ns);
    }

    fn link_open(&mut self) {
        self.link_open(true);
    }

    fn link_write(&mut self, bytes: &[u8]) {
        self.link_write(bytes);
    }

    fn link_read(&mut self) -> Vec<u8> {
        self.link_read()
    }

    fn outputs(&self) -> Option<Outputs> {
        Some(self.outputs())
    }

    fn stopped(&mut self) -> Option<Stopped> {
        let at_ns = self.now_ns();
        let of_program = self.halt().map(|why| Stopped { at_ns, culprit: Culprit::Board, why });
        of_program.or_else(|| self.bench().trouble().map(Stopped::of_plant))
    }
}

/// The MCU of a part.
fn mcu_of(part: &str) -> &'static str {
    let known = ["atmega328p", "atmega2560", "atmega32u4"];
    let part = part.to_ascii_lowercase();
    let found = known.into_iter().find(|name| part.starts_with(name));
    found.unwrap_or_else(|| panic!("{part} is none of {known:?}"))
}

/// What is at the serial ports: the parts of the job, and its host.
fn serials(job: &BoardJob<'_>) -> BTreeMap<u8, Serial> {
    let of_parts = job.connections.iter().filter_map(|one| {
        let Interface::Uart(own) = one.connection.kind.interface() else { return None };
        let odd_parity = match own.parity {
            Parity::None => None,
            Parity::Even => Some(false),
            Parity::Odd => Some(true),
        };
        let serial = Serial {
            baud: own.baud,
            data_bits: own.data_bits,
            odd_parity,
            stop_bits: own.stop_bits,
        };
        Some((number_of(one.unit?)?, serial))
    });
    let baud = job.board.link.baud;
    let of_host = Serial { baud, data_bits: 8, odd_parity: None, stop_bits: 1 };
    let link = job.link.as_ref().and_then(|link| number_of(link.unit));
    of_parts.chain(link.map(|unit| (unit, of_host))).collect()
}
