//! The board's units against programs that use their registers: converter, edges, buses, pulses, serial ports, watchdog.

use std::collections::BTreeMap;
use std::time::Instant;

use sensedsl_surroundings::{I2cEvent, I2cReply, Pad, Surroundings, TimerOutput};

use super::child::{Around, Avr, Link, Reset, Serial, Setting, Setup};
use super::tools::{is_possible, program};

pub(super) const MS: u64 = 1_000_000;
const US: u64 = 1_000;
pub(super) const CLOCK_HZ: u32 = 16_000_000;
/// The setting of the programs' port: 250,000 baud are 16 MHz divided without a remainder.
const SERIAL: Serial = Serial { baud: 250_000, data_bits: 8, odd_parity: None, stop_bits: 1 };
/// The chip that is there.
const CHIP: u8 = 0x50;

/// A level that changes every `half_ns`, first at `shift_ns`, to high.
#[derive(Clone, Copy)]
struct Square {
    half_ns: u64,
    shift_ns: u64,
}

impl Square {
    fn level(self, now_ns: u64) -> bool {
        now_ns >= self.shift_ns && ((now_ns - self.shift_ns) / self.half_ns).is_multiple_of(2)
    }
}

/// What is around the board, and what it did.
#[derive(Default)]
pub(super) struct World {
    millivolts: BTreeMap<Pad, f64>,
    inputs: BTreeMap<u8, f64>,
    squares: BTreeMap<Pad, Square>,
    is_stuck: bool,
    /// The bus, with what was answered.
    bus: Vec<(I2cEvent, I2cReply)>,
    shifted: Vec<u8>,
    pub(super) driven: Vec<(u64, Pad, Option<bool>)>,
    waves: Vec<(u64, TimerOutput, u64, u64)>,
}

impl Surroundings for World {
    fn millivolts(&mut self, pad: Pad, _: u64) -> f64 {
        self.millivolts.get(&pad).copied().unwrap_or_default()
    }

    fn level(&mut self, pad: Pad, now_ns: u64) -> Option<bool> {
        self.squares.get(&pad).map(|square| square.level(now_ns))
    }

    fn next_edge(&mut self, pad: Pad, after_ns: u64) -> Option<(u64, bool)> {
        let square = *self.squares.get(&pad)?;
        if after_ns < square.shift_ns {
            return Some((square.shift_ns, true));
        }
        let halves = (after_ns - square.shift_ns) / square.half_ns + 1;
        let at_ns = square.shift_ns + halves * square.half_ns;
        Some((at_ns, square.level(at_ns)))
    }

    fn driven(&mut self, pad: Pad, level: Option<bool>, now_ns: u64) {
        self.driven.push((now_ns, pad, level));
    }

    fn i2c(&mut self, unit: u8, event: I2cEvent, _: u64) -> I2cReply {
        assert_eq!(unit, 1);
        let reply = match event {
            _ if self.is_stuck => I2cReply::Stuck,
            I2cEvent::Start { address, .. } if address != CHIP => I2cReply::Nack,
            I2cEvent::Read { .. } => I2cReply::Byte(0x42),
            I2cEvent::Start { .. } | I2cEvent::Write(_) | I2cEvent::Stop => I2cReply::Ack,
        };
        self.bus.push((event, reply));
        reply
    }

    fn spi(&mut self, unit: u8, out: u8, _: u64) -> u8 {
        assert_eq!(unit, 1);
        self.shifted.push(out);
        !out
    }

    fn pwm(&mut self, output: TimerOutput, period_ns: u64, width_ns: u64, now_ns: u64) {
        self.waves.push((now_ns, output, period_ns, width_ns));
    }
}

impl Around for World {
    fn input_millivolts(&mut self, input: u8, _: u64) -> f64 {
        self.inputs.get(&input).copied().unwrap_or_default()
    }
}

pub(super) fn pad(name: &str) -> Pad {
    Pad::named(name).unwrap()
}

/// A program on an ATmega328P, in a world.
fn start(name: &str, world: World) -> Avr<World> {
    start_with(name, world, SERIAL)
}

fn start_with(name: &str, world: World, serial: Serial) -> Avr<World> {
    let setup = Setup {
        mcu: "atmega328p",
        clock_hz: CLOCK_HZ,
        image: &program(name),
        link: Link::Serial(0),
        serials: BTreeMap::from([(0, serial)]),
        pads: world.squares.keys().copied().collect(),
    };
    Avr::start(&setup, world)
}

/// Runs in steps of a millisecond, and prints how long that takes.
pub(super) fn run(avr: &mut Avr<World>, to_ms: u64) -> Vec<(u64, u8)> {
    let (from_ms, begin) = (avr.now_ns() / MS, Instant::now());
    for ms in from_ms + 1..=to_ms {
        avr.run_until(ms * MS);
    }
    let seconds = begin.elapsed().as_secs_f64();
    eprintln!("{:.1} virtual seconds a second", (to_ms - from_ms) as f64 / 1e3 / seconds);
    avr.link_read()
}

fn bytes(received: &[(u64, u8)]) -> Vec<u8> {
    received.iter().map(|(_, byte)| *byte).collect()
}

#[test]
fn voltages_are_converted_within_a_step() {
    if !is_possible() {
        return;
    }
    for [millivolts, other] in [[1_234.5, 4_000.0], [0.0, 5_000.0], [4_999.9, 2.5]] {
        let world = World {
            millivolts: BTreeMap::from([(pad("PC0"), millivolts)]),
            inputs: BTreeMap::from([(6, other)]),
            ..World::default()
        };
        let sent = bytes(&run(&mut start("adc", world), 20));
        let steps: Vec<f64> = sent
            .chunks_exact(2)
            .map(|pair| f64::from(u16::from_le_bytes([pair[0], pair[1]])))
            .collect();
        assert!(steps.len() > 20, "{steps:?}");
        for pair in steps.chunks_exact(2) {
            for (step, millivolts) in [(pair[0], millivolts), (pair[1], other)] {
                let wanted = (millivolts / 5_000.0 * 1_024.0).min(1_023.0);
                assert!((step - wanted).abs() <= 1.0, "{millivolts} mV: {step}, not {wanted}");
            }
        }
    }
}

/// The program's clock begins with it, a few microseconds after power.
#[test]
fn edges_have_their_times() {
    if !is_possible() {
        return;
    }
    let square = |half_us, shift_us| Square { half_ns: half_us * US, shift_ns: shift_us * US };
    let (outside, change, capture) =
        (square(1_000, 2_000), square(1_500, 2_300), square(700, 2_100));
    let pads = [("PD2", outside), ("PD7", change), ("PB0", capture)];
    let squares = pads.into_iter().map(|(name, square)| (pad(name), square)).collect();
    let mut avr = start("edges", World { squares, ..World::default() });
    let sent = bytes(&run(&mut avr, 30));
    let of = |which: u8| -> Vec<f64> {
        let all = sent.chunks_exact(3).filter(|edge| edge[0] == which);
        all.map(|edge| f64::from(u16::from_le_bytes([edge[1], edge[2]])) / 2.0).collect()
    };
    // The capture unit knows the time of an edge; how far its clock is behind is not known.
    let captured = of(b'c');
    let behind = 2_100.0 - captured[0];
    assert!((0.0..200.0).contains(&behind), "{behind}");
    // Handlers come some instructions later.
    for (which, square, late, every_us) in
        [(b'c', capture, 0.5, 1_400.0), (b'i', outside, 4.0, 1_000.0), (b'p', change, 4.0, 1_500.0)]
    {
        let times = of(which);
        assert!(times.len() >= 15, "{which}: {times:?}");
        for (at, time) in (0..).zip(&times) {
            let wanted = square.shift_ns as f64 / 1e3 + every_us * f64::from(at);
            let found = time + behind - wanted;
            assert!((0.0..=late).contains(&found), "{which}: {time}, {found} after {wanted}");
        }
        let apart = times.windows(2).map(|pair| pair[1] - pair[0]);
        assert!(apart.clone().all(|us| (us - every_us).abs() <= 2.0), "{which}: {times:?}");
    }
}

const DOT: u8 = b'.';

#[test]
fn a_chip_is_written_and_read_and_another_is_not_there() {
    if !is_possible() {
        return;
    }
    let mut avr = start("i2c", World::default());
    let sent = bytes(&run(&mut avr, 20));
    let states = [0x08, 0x18, 0x28, 0x10, 0x40, 0x50, 0x42, 0x58, 0x42, 0x08, 0x20, DOT];
    assert!(sent.len() >= 3 * states.len(), "{sent:02x?}");
    for round in sent.chunks_exact(states.len()) {
        assert_eq!(round, states);
    }
    let start = |address, read| I2cEvent::Start { address, read };
    let wanted = [
        (start(CHIP, false), I2cReply::Ack),
        (I2cEvent::Write(0x07), I2cReply::Ack),
        (start(CHIP, true), I2cReply::Ack),
        (I2cEvent::Read { ack: true }, I2cReply::Byte(0x42)),
        (I2cEvent::Read { ack: false }, I2cReply::Byte(0x42)),
        (I2cEvent::Stop, I2cReply::Ack),
        (start(CHIP + 1, false), I2cReply::Nack),
        (I2cEvent::Stop, I2cReply::Ack),
    ];
    assert_eq!(avr.around.bus[..wanted.len()], wanted);
    assert_eq!(avr.settings()[&('i', 1)], Setting::I2c { clock_hz: 100_000 });
}

/// The program goes on, and so does time; the bus works again when it is free.
#[test]
fn a_bus_that_is_stuck_ends_nothing() {
    if !is_possible() {
        return;
    }
    let mut avr = start("i2c", World { is_stuck: true, ..World::default() });
    let sent = bytes(&run(&mut avr, 100));
    assert!(sent.contains(&0xEE) && !sent.contains(&0x18), "{sent:02x?}");
    avr.around.is_stuck = false;
    let sent = bytes(&run(&mut avr, 200));
    assert!(sent.ends_with(&[DOT]) || sent.contains(&0x42), "{sent:02x?}");
    assert!(sent.windows(2).any(|pair| pair == [0x18, 0x28]), "{sent:02x?}");
}

#[test]
fn bytes_are_exchanged_with_the_chip_that_is_selected() {
    if !is_possible() {
        return;
    }
    let mut avr = start("spi", World::default());
    let sent = bytes(&run(&mut avr, 10));
    assert!(sent.len() >= 20, "{sent:?}");
    let shifted = &avr.around.shifted;
    assert!(shifted.iter().zip(0..).all(|(byte, wanted)| *byte == wanted), "{shifted:?}");
    assert!(sent.iter().zip(shifted).all(|(byte, out)| *byte == !*out), "{sent:?}");
    let select: Vec<u64> = avr
        .around
        .driven
        .iter()
        .filter(|(_, pad, _)| *pad == Pad { port: 1, pin: 2 })
        .map(|(at, ..)| *at)
        .collect();
    // It is low for three bytes of 8 us each, and what the program does in between.
    let low_ns = select[3] - select[2];
    assert!((24 * US..60 * US).contains(&low_ns), "{select:?}");
    assert_eq!(avr.settings()[&('s', 1)], Setting::Spi { clock_hz: 1_000_000, mode: 0 });
}

#[test]
fn pulses_have_their_period_and_width() {
    if !is_possible() {
        return;
    }
    let mut avr = start("pwm", World::default());
    run(&mut avr, 250);
    let output = |timer, channel| TimerOutput { timer, channel, is_complement: false };
    let at = |output: TimerOutput, ms: u64| {
        let mut before =
            avr.around.waves.iter().filter(|(at, of, ..)| *of == output && *at <= ms * MS);
        before.next_back().map(|(.., period_ns, width_ns)| (*period_ns, *width_ns))
    };
    // The top of timer 1 is 39,999 of half a microsecond; a new width counts from the next round on.
    assert_eq!(at(output(1, 1), 90), Some((20 * MS, 1_500 * US)));
    assert_eq!(at(output(1, 1), 130), Some((20 * MS, 2_000 * US)));
    assert_eq!(at(output(0, 1), 90), Some((1_024 * US, 256 * US)));
    assert_eq!(at(output(0, 1), 210), Some((0, 0)));
    // Up and down: twice 255 steps of 4 us.
    assert_eq!(at(output(2, 2), 90), Some((2_040 * US, 408 * US)));
    // The pad is the timer's, and then the port's again.
    let of_pad = |name| {
        let all =
            avr.around.driven.iter().filter(move |(_, pad, _)| *pad == Pad::named(name).unwrap());
        all.map(|(_, _, level)| *level).collect::<Vec<_>>()
    };
    assert_eq!(of_pad("PD6"), [Some(false), None, Some(false)]);
    assert_eq!(of_pad("PD4"), [Some(false), Some(true)]);
}

#[test]
fn a_serial_port_sends_and_receives_in_time() {
    if !is_possible() {
        return;
    }
    let mut avr = start("echo", World::default());
    run(&mut avr, 5);
    avr.link_write(b"hello");
    let sent = run(&mut avr, 10);
    assert_eq!(bytes(&sent), b"ifmmp");
    // A byte takes 40 us each way.
    assert!(
        sent.windows(2).all(|pair| (39 * US..=42 * US).contains(&(pair[1].0 - pair[0].0))),
        "{sent:?}"
    );
    assert!((5 * MS + 80 * US..5 * MS + 90 * US).contains(&sent[0].0), "{sent:?}");
    run(&mut avr, 1_000);
    assert!(avr.asleep_ns() > 990 * MS, "{}", avr.asleep_ns());
    assert_eq!(avr.settings()[&('u', 0)], Setting::Serial(SERIAL));
}

#[test]
fn another_rate_or_format_is_garbled() {
    if !is_possible() {
        return;
    }
    let fast = Serial { baud: 270_000, ..SERIAL };
    let even = Serial { odd_parity: Some(false), ..SERIAL };
    for other in [fast, even] {
        let mut avr = start_with("echo", World::default(), other);
        run(&mut avr, 5);
        avr.link_write(b"hello");
        let sent = bytes(&run(&mut avr, 10));
        assert!(sent.len() == 5 && sent != b"ifmmp", "{other:?}: {sent:?}");
    }
}

/// The program counts its starts in the EEPROM, and feeds the watchdog of 60 ms for 200 ms.
#[test]
fn the_watchdog_resets_and_the_eeprom_stays() {
    if !is_possible() {
        return;
    }
    let mut avr = start("watchdog", World::default());
    let sent = run(&mut avr, 100);
    assert_eq!(bytes(&sent), [Reset::POWER, 0]);
    assert_eq!(avr.watchdog_ns(), Some(64 * MS));
    let sent = run(&mut avr, 600);
    assert_eq!(bytes(&sent), [Reset::WATCHDOG, 1, Reset::WATCHDOG, 2]);
    let resets = avr.resets();
    assert!(
        resets.iter().all(|one| one.cause == Reset::WATCHDOG) && resets.len() == 2,
        "{resets:?}"
    );
    assert!((262 * MS..268 * MS).contains(&resets[0].at_ns), "{resets:?}");
    avr.power(false);
    avr.run_until(700 * MS);
    avr.power(true);
    let sent = run(&mut avr, 750);
    assert_eq!(bytes(&sent), [Reset::POWER, 3]);
    assert_eq!(avr.resets().last(), Some(&Reset { at_ns: 700 * MS, cause: Reset::POWER }));
}

/// What simavr's own timers and requests get wrong; the program says what each byte should be.
#[test]
fn counts_and_requests_are_those_of_the_data_sheet() {
    if !is_possible() {
        return;
    }
    let sent = bytes(&run(&mut start("core", World::default()), 10));
    let [0x07, 1, 0, 2, down, up, 3, low, 0xFF] = sent[..] else { panic!("{sent:02x?}") };
    assert!((62..=64).contains(&down) && (64..=66).contains(&up) && low < 0x20, "{sent:02x?}");
}
