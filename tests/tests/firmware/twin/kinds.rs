//! The smallest design of each kind on the twin: the host receives the values of the world, and the
//! pads follow the host's commands.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_machine::LinkPort;
use sensedsl_model::kind::KindName;
use sensedsl_surroundings::CanFrame;
use sensedsl_tests::{drawn, read, root};
use sensedsl_wire::{Checksum, Scalar, Schema};

use super::bench::{Bench, MS, STEERING, Square, pad, unsigned, values};
use crate::firmware::chibios::tree;
use crate::firmware::embassy;
use crate::firmware::emulated::frame;
use crate::hosts::designs::schema;

/// The design of a kind on a Discovery board, its link over a serial port.
fn design(kind: &str) -> String {
    let path = root().join("tests/firmware/kinds").join(format!("{kind}.sense"));
    let text = read(&path);
    let head = "board STM32F407G_DISC1 {\n    link { transport = uart; unit = USART3; }";
    let release = if kind == "dac" { "\n    release CS43L22;" } else { "" };
    text.replacen("board BOARD {", &format!("{head}{release}"), 1)
}

fn chibios_bench(kind: &str) -> Option<Bench> {
    let name = format!("twin_{kind}");
    Some(Bench::build(&tree()?, &name, &design(kind), "production", LinkPort::Serial(3)))
}

fn embassy_bench(kind: &str) -> Option<Bench> {
    let program = embassy::program(&format!("twin_embassy_{kind}"), &design(kind))?;
    Some(Bench::of(&program, LinkPort::Serial(3)))
}

/// Whether this run builds the image of a kind on Embassy: a usual run builds half of them, which the seed draws.
fn is_on_embassy(kind: &str) -> bool {
    drawn("kinds on Embassy", KINDS, KINDS.len() / 2).contains(&&kind)
}

/// Runs each test on both targets, with the image of the kind.
macro_rules! on_both {
    ($($kind:literal: $name:ident,)*) => {
        /// The kinds with a test.
        const KINDS: &[&str] = &[$($kind),*];

        mod on_chibios {
            $(
                #[test]
                fn $name() {
                    if let Some(bench) = super::chibios_bench($kind) {
                        super::$name(bench);
                    }
                }
            )*
        }

        mod on_embassy {
            $(
                #[test]
                fn $name() {
                    if super::is_on_embassy($kind)
                        && let Some(bench) = super::embassy_bench($kind)
                    {
                        super::$name(bench);
                    }
                }
            )*
        }
    };
}

on_both! {
    "analog": analog_values_are_those_of_the_pads,
    "can": frames_of_a_can_bus_come_and_go,
    "dac": the_dac_follows_the_host,
    "digital": digital_inputs_count_and_settle_and_outputs_follow,
    "encoder": an_encoder_counts_every_edge_of_both_tracks,
    "i2c": chips_on_an_i2c_bus_are_read_and_written,
    "icu": a_frequency_is_captured,
    "pwm": pulses_have_the_widths_that_the_host_sets,
    "stepper": motors_make_as_many_steps_as_the_host_asks_for,
    "spi": chips_on_an_spi_bus_are_read_and_written,
    "uart": messages_of_a_serial_port_are_taken,
}

#[test]
fn every_kind_is_here() {
    // Parts on one wire are judged by their world, in a file of their own.
    let here: BTreeSet<&str> = KINDS.iter().copied().chain(["onewire"]).collect();
    let all: BTreeSet<&str> = KindName::wired().map(KindName::name).collect();
    assert_eq!(here, all, "a test in {}", file!());
}

pub(super) fn items(items: &[&str]) -> Schema {
    schema(Checksum::Crc16, items)
}

fn analog_values_are_those_of_the_pads(mut bench: Bench) {
    bench.world().voltages =
        BTreeMap::from([(pad("PC1"), (330.0, 1.0)), (pad("PC4"), (1650.0, 0.0))]);
    bench.run_until_ms(1_500);
    let schema = items(&["1 sensor Distance uint16", "2 sensor Battery float32"]);
    let reports = bench.reports(&schema);
    let distances = values(&reports, 1);
    // One value every 20 ms.
    assert!((74..=75).contains(&distances.len()), "{}", distances.len());
    for (at, value) in distances {
        // A ramp of 1 mV per millisecond is converted up to 12 ms before the report arrives.
        let volts = |at: u64| (330.0 + at as f64 / MS as f64) / 3300.0 * 4096.0;
        let (low, high) = (volts(at.saturating_sub(12 * MS)) - 1.0, volts(at) + 1.0);
        let value = unsigned(&value) as f64;
        assert!(low <= value && value <= high, "{at}: {value} is not in {low} to {high}");
    }
    assert_eq!(values(&reports, 2)[0].1, [Scalar::Float32(2048.0)]);
}

fn frames_of_a_can_bus_come_and_go(mut bench: Bench) {
    bench.run_until_ms(300);
    let frame_of = |id, value: u8| {
        let data = [9, 9, 0x12, value, 9, 9, 9, 9];
        CanFrame { id, extended: false, remote: false, length: 8, data }
    };
    // A frame with another identifier is not for this board.
    let frames = [frame_of(0x121, 1), frame_of(0x120, 0x34)];
    bench.world().to_can.entry(1).or_default().extend(frames);
    bench.machine.link_write(&frame(&[2, 0xFE, 0xDC]));
    bench.run_until_ms(2_500);
    bench.assert_wires(&[("PD0", "CAN1_RX"), ("PD1", "CAN1_TX")]);
    let schema = items(&["1 sensor Speed uint16", "2 actuator Torque int16"]);
    let speeds = values(&bench.reports(&schema), 1);
    assert_eq!(speeds.iter().map(|(_, value)| unsigned(value)).collect::<Vec<_>>(), [0x1234]);
    let sent = bench.world().from_can.clone();
    let (_, first) = sent.first().unwrap();
    assert!(first.extended && first.id == 0x18FF_1234, "{first:?}");
    assert_eq!(first.data.get(..usize::from(first.length)), Some(&[0xFE, 0xDC][..]));
}

fn the_dac_follows_the_host(mut bench: Bench) {
    bench.run_until_ms(100);
    bench.machine.link_write(&frame(&[1, 0x08, 0x00]));
    bench.run_until_ms(150);
    let outputs = bench.world().outputs.clone();
    let half = outputs.values().filter(|millivolts| (**millivolts - 1650.0).abs() < 1.0);
    assert_eq!(half.count(), 1, "{outputs:?}");
}

fn digital_inputs_count_and_settle_and_outputs_follow(mut bench: Bench) {
    let drops = Square { half_ns: 5 * MS, shift_ns: 2 * MS };
    bench.world().squares.insert(pad("PC4"), drops);
    bench.run_until_ms(200);
    // Active low, with a pull-up: if nobody drives the pin, the value is off.
    bench.world().levels.insert(pad("PC1"), false);
    bench.machine.link_write(&frame(&[3, 0]));
    // The contact is read once a second.
    bench.run_until_ms(2_100);
    let schema = items(&["1 sensor Bumper bool", "2 sensor Drops uint32", "3 actuator Light bool"]);
    let reports = bench.reports(&schema);
    let bumps: Vec<Scalar> = values(&reports, 1).iter().map(|(_, value)| value[0]).collect();
    assert_eq!(bumps.first(), Some(&Scalar::Bool(false)));
    assert_eq!(bumps.last(), Some(&Scalar::Bool(true)));
    let counts = values(&reports, 2);
    assert!(counts.len() > 50, "{}", counts.len());
    for (at, value) in counts {
        // A rising edge every 10 ms from 2 ms on; a report is at most 11 ms old.
        let (newest, oldest) =
            ((at - 2 * MS) / (10 * MS) + 1, at.saturating_sub(13 * MS) / (10 * MS));
        let value = unsigned(&value);
        assert!(oldest <= value && value <= newest, "{at}: {value} is not in {oldest} to {newest}");
    }
    assert_eq!(bench.world().driven.get(&pad("PC13")), Some(&Some(false)));
}

fn an_encoder_counts_every_edge_of_both_tracks(mut bench: Bench) {
    let half_ns = 100_000;
    // The first track leads: the wheel turns forward, one count every 50 us.
    let tracks = [("PE9", 20 * MS), ("PE11", 20 * MS + half_ns / 2)];
    for (name, shift_ns) in tracks {
        bench.world().squares.insert(pad(name), Square { half_ns, shift_ns });
    }
    bench.run_until_ms(300);
    bench.assert_wires(&[("PE9", "TIM1_CH1"), ("PE11", "TIM1_CH2")]);
    let schema = items(&["1 sensor Turns int32"]);
    let turns = values(&bench.reports(&schema), 1);
    assert!(turns.len() > 25, "{}", turns.len());
    for (at, value) in turns.iter().filter(|(at, _)| *at > 40 * MS) {
        let [Scalar::Signed(value)] = value[..] else { panic!("{value:?}") };
        let expected = i64::try_from((at - 20 * MS) / (half_ns / 2)).unwrap();
        // Serialisation and the cycle take 1 ms.
        assert!((expected - 30..=expected + 1).contains(&value), "{at}: {value}, not {expected}");
    }
}

fn chips_on_an_i2c_bus_are_read_and_written(mut bench: Bench) {
    let heading = [0x01, 0x02, 0x03, 0x04, 0xFF, 0xFE];
    let registers =
        heading.into_iter().zip(3..).map(|(value, register)| (register, value)).collect();
    let range = BTreeMap::from([(2, 0x01), (3, 0x23)]);
    let chips = [(0x70, range), (0x1E, registers), (0x22, BTreeMap::new())];
    bench.world().chips = BTreeMap::from(chips);
    bench.run_until_ms(400);
    bench.machine.link_write(&frame(&[3, 0xAB, 0xCD]));
    bench.run_until_ms(600);
    bench.assert_wires(&[("PA8", "I2C3_SCL"), ("PC9", "I2C3_SDA")]);
    let schema =
        items(&["1 sensor Range uint16", "2 sensor Heading int16[3]", "3 actuator Lamps uint16"]);
    let reports = bench.reports(&schema);
    let ranges = values(&reports, 1);
    assert!(
        ranges.len() >= 4 && ranges.iter().all(|(_, value)| unsigned(value) == 0x0123),
        "{ranges:?}"
    );
    let headings = values(&reports, 2);
    let wanted = [0x0102, 0x0304, -2].map(Scalar::Signed);
    assert!(
        headings.len() >= 25 && headings.iter().all(|(_, value)| *value == wanted),
        "{headings:?}"
    );
    let written = &bench.world().written;
    assert!(written.contains(&(0x22, vec![0x10, 0xAB, 0xCD])), "{written:?}");
    assert!(written.contains(&(0x70, vec![0x00, 0x51])), "{written:?}");
}

fn a_frequency_is_captured(mut bench: Bench) {
    bench.world().squares.insert(pad("PE5"), Square { half_ns: 400_000, shift_ns: MS });
    bench.run_until_ms(300);
    let schema = items(&["1 sensor Wheel uint32"]);
    let wheel = values(&bench.reports(&schema), 1);
    let late: Vec<u64> =
        wheel.iter().filter(|(at, _)| *at > 50 * MS).map(|(_, value)| unsigned(value)).collect();
    // 800 us correspond to 1250 Hz, and to a whole number of ticks.
    assert!(late.len() > 20 && late.iter().all(|value| *value == 1_250), "{late:?}");
}

fn pulses_have_the_widths_that_the_host_sets(mut bench: Bench) {
    bench.run_until_ms(50);
    // Embassy's timer has the finest tick with which 16 bits cover the period, here 310 ns; widths
    // are right within a ten-thousandth of 1.5 ms.
    let near = |is: u64, wanted: u64| is.abs_diff(wanted) * 10_000 <= wanted;
    let steers = |bench: &Bench, width_ns: u64| {
        let (period, width) = bench.world().waves[&STEERING];
        assert!(near(period, 20 * MS) && near(width, width_ns), "{period} {width}");
    };
    // The middle of 1 to 2 ms, until the host sends a command.
    steers(&bench, 1_500_000);
    bench.machine.link_write(&frame(&[1, 0x27, 0x10]));
    bench.run_until_ms(100);
    steers(&bench, 2_000_000);
    bench.machine.link_write(&frame(&[1, 0x00, 0x00]));
    bench.run_until_ms(150);
    steers(&bench, 1_000_000);
}

/// The times between pulses in nanoseconds.
fn intervals(pulses: &[(u64, u64)]) -> Vec<u64> {
    pulses.windows(2).map(|pair| pair[1].0 - pair[0].0).collect()
}

fn motors_make_as_many_steps_as_the_host_asks_for(mut bench: Bench) {
    let schema =
        items(&["1 actuator Feed int32", "2 actuator Target int32", "3 sensor Position int32"]);
    bench.run_until_ms(100);
    assert!(bench.world().pulses.is_empty());
    let target = |bench: &mut Bench, id: u8, value: i32, until_ms: u64| {
        bench.machine.link_write(&frame(&[&[id][..], &value.to_be_bytes()].concat()));
        bench.run_until_ms(until_ms);
    };
    target(&mut bench, 2, 400, 400);
    let steps = |bench: &Bench| -> usize { bench.world().pulses.values().map(Vec::len).sum() };
    assert_eq!(steps(&bench), 400);
    let (axis, pulses) = bench.world().pulses.pop_first().unwrap();
    bench.world().pulses.insert(axis, pulses.clone());
    // Pulses of 2 us; 20000 steps/s^2 from rest: two steps take 10 ms and 4.14 ms, and none comes sooner than at
    // 4000 steps/s, which is reached in the middle.
    assert!(pulses.iter().all(|(_, width)| (2_000..2_500).contains(width)), "{pulses:?}");
    let between = intervals(&pulses);
    assert!((4_142_000..4_160_000).contains(&between[0]), "{between:?}");
    let least = between.iter().min().unwrap();
    assert!((353_000..361_000).contains(least), "{least}");
    // Back, and a new target on the way: what is overshot is made good.
    target(&mut bench, 2, -400, 480);
    target(&mut bench, 2, 300, 900);
    let position = values(&bench.reports(&schema), 3).last().map(|(_, value)| value.clone());
    assert_eq!(position, Some(vec![Scalar::Signed(300)]));
    // Without the host motors stop, and a speed needs it.
    target(&mut bench, 1, 2_000, 1_300);
    let feed = bench.world().pulses.iter().find(|(output, _)| **output != axis).unwrap().1.clone();
    let fastest = *intervals(&feed).iter().min().unwrap();
    assert!((499_700..506_000).contains(&fastest), "{fastest}");
    bench.run_until_ms(2_000);
    let stopped = steps(&bench);
    bench.run_until_ms(2_500);
    assert_eq!(steps(&bench), stopped);
}

fn chips_on_an_spi_bus_are_read_and_written(mut bench: Bench) {
    bench.world().spi_answers.extend([0x5A]);
    bench.run_until_ms(300);
    bench.machine.link_write(&frame(&[2, 0x77]));
    bench.run_until_ms(400);
    let schema = items(&["1 sensor Angle uint16", "2 actuator Pot uint8"]);
    let angles = values(&bench.reports(&schema), 1);
    assert!(
        angles.len() > 30 && angles.iter().all(|(_, value)| unsigned(value) == 0x5A5A),
        "{angles:?}"
    );
    let world = bench.world();
    assert!(world.spi_sent.windows(2).any(|bytes| bytes == [0x00, 0x77]), "{:?}", world.spi_sent);
    // The chip is selected for each transfer.
    assert!(world.chip_selects() > 30);
}

fn messages_of_a_serial_port_are_taken(mut bench: Bench) {
    let message = |low: u8, high: u8| {
        let body = [0x59, 0x59, low, high];
        let sum = body.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
        [&body[..], &[sum]].concat()
    };
    bench.run_until_ms(20);
    // The first message is damaged.
    bench.world().to_uart.extend([0x59, 0x59, 7, 7, 0]);
    bench.world().to_uart.extend(message(0x34, 0x12));
    bench.run_until_ms(1_200);
    bench.world().to_uart.extend(message(0x78, 0x56));
    bench.run_until_ms(2_500);
    let schema = items(&["1 sensor Frame uint16"]);
    let frames = values(&bench.reports(&schema), 1);
    let frames: Vec<u64> = frames.iter().map(|(_, value)| unsigned(value)).collect();
    assert_eq!(frames, [0x1234, 0x5678]);
}
