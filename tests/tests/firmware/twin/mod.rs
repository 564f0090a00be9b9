//! Generated applications, unchanged, on the emulated MCU: drivers, DMA, interrupts, links,
//! watchdog.
//!
//! Needs the feature `machine` and a ChibiOS tree.

mod bench;
mod bluepill;
mod both;
mod buses;
mod examples;
mod faults;
mod frames;
mod g474;
mod hosted;
mod images;
mod kinds;
mod lamps;
mod lines;
mod mcus;
mod onewire;
mod seeded;
mod seeded_profiles;
mod seeded_rust;
mod silent;
mod trial;

use std::collections::BTreeMap;

use sensedsl_machine::{Event, LinkPort, ResetCause};
use sensedsl_tests::text;
use sensedsl_wire::{Checksum, Schema};

use self::bench::{Bench, MS, Square, folder, pad, unsigned, values};
use super::chibios::{build, tree};
use crate::hosts::designs;

/// Fig. 2 of the paper on the complete Discovery board, with the given link.
fn fig2(link: &str) -> String {
    let text = text("examples/fig2.sense");
    text.replacen("board STM32F4DiscoveryBoard {", &format!("board STM32F407G_DISC1 {{\n{link}"), 1)
}

const UART: &str = "link { transport = uart; unit = USART3; }";

/// A sonar at 0x73, a wheel that turns at 1 kHz, two rising voltages.
fn set_up(bench: &Bench) {
    let mut world = bench.world();
    world.voltages = BTreeMap::from([(pad("PC1"), (200.0, 0.5)), (pad("PC4"), (900.0, 0.25))]);
    world.chips = BTreeMap::from([(0x73, BTreeMap::from([(2, 0), (3, 42)]))]);
    for name in ["PE5", "PE9"] {
        world.squares.insert(pad(name), Square { half_ns: MS / 2, shift_ns: 2 * MS });
    }
}

fn fig2_schema(checksum: Checksum) -> Schema {
    Schema { checksum, ..designs::fig2().remove(0).schema }
}

/// Compares every report with the world, and allows for the age that the cycles and the line may
/// add.
fn assert_agrees(bench: &Bench, schema: &Schema, begins_ns: u64) -> usize {
    let reports = bench.reports(schema);
    let ramp =
        |start: f64, slope: f64, at: u64| (start + slope * at as f64 / MS as f64) / 3300.0 * 4096.0;
    for (id, start, slope) in [(17, 200.0, 0.5), (18, 900.0, 0.25)] {
        for (at, value) in values(&reports, id) {
            let value = unsigned(&value) as f64;
            let (low, high) =
                (ramp(start, slope, at.saturating_sub(15 * MS)), ramp(start, slope, at));
            assert!(
                low - 1.0 <= value && value <= high + 1.0,
                "{id} at {at}: {value}, not {low} to {high}"
            );
        }
    }
    let ranges = values(&reports, 19);
    assert!(ranges.iter().all(|(_, value)| unsigned(value) == 42), "{ranges:?}");
    let counts = values(&reports, 20);
    for (at, value) in counts.iter().filter(|(at, _)| *at > begins_ns + 20 * MS) {
        let edges = (at - begins_ns) / MS;
        let value = unsigned(value);
        assert!(value <= edges + 2 && value + 15 >= edges, "{at}: {value} of {edges} edges");
    }
    let kinds = [17, 18, 19, 20].map(|id| values(&reports, id).len());
    assert!(kinds.iter().all(|count| *count > 0), "{kinds:?}");
    kinds.iter().sum()
}

#[test]
fn fig2_over_a_serial_line_agrees_with_the_world() {
    let Some(tree) = tree() else { return };
    let mut bench =
        Bench::build(&tree, "twin_fig2", &fig2(UART), "production", LinkPort::Serial(3));
    set_up(&bench);
    bench.run_until_ms(3_000);
    let wires = [
        ("PA8", "I2C3_SCL"),
        ("PC9", "I2C3_SDA"),
        ("PE5", "TIM9_CH1"),
        ("PD8", "USART3_TX"),
        ("PD9", "USART3_RX"),
    ];
    bench.assert_wires(&wires);
    assert_eq!(bench.machine.core_hz(), 168_000_000);
    let count = assert_agrees(&bench, &fig2_schema(Checksum::Crc16), 2 * MS);
    assert!(count > 350, "{count}");
}

#[test]
fn a_run_is_the_same_each_time() {
    let Some(tree) = tree() else { return };
    let board = folder("twin_again", &fig2(UART));
    build(&tree, &board, "production");
    let run = |steps: &[u64]| {
        let mut bench = Bench::load(&board, "production", LinkPort::Serial(3));
        set_up(&bench);
        steps.iter().for_each(|ms| bench.run_until_ms(*ms));
        bench.received
    };
    let once = run(&[700]);
    assert!(once.len() > 500);
    assert_eq!(once, run(&[700]));
    // The interval at which the caller looks does not matter.
    assert_eq!(once, run(&[1, 13, 14, 200, 699, 700]));
}

#[test]
fn the_usb_link_enumerates_and_carries_reports() {
    let Some(tree) = tree() else { return };
    let mut bench = Bench::build(&tree, "twin_usb", &fig2(""), "production", LinkPort::Usb);
    set_up(&bench);
    bench.run_until_ms(5_000);
    // The values of the first report were measured before the host was there.
    let reports = bench.reports(&fig2_schema(Checksum::None));
    let (second, _) = reports[1];
    bench.received.retain(|(at, _)| *at > second);
    let count = assert_agrees(&bench, &fig2_schema(Checksum::None), 2 * MS);
    assert!(count > 100, "{count}");
}

#[test]
fn the_shell_answers_over_usb() {
    let Some(tree) = tree() else { return };
    let mut bench = Bench::build(&tree, "twin_shell", &fig2(""), "development", LinkPort::Usb);
    set_up(&bench);
    bench.run_until_ms(2_000);
    bench.machine.link_write(b"\r\nsensors\r\n");
    bench.run_until_ms(2_200);
    let reported = bench.reported();
    assert!(reported.contains(" 19 USRear                   42 ("), "{reported}");
    bench.machine.link_write(b"doctor\r\n");
    bench.run_until_ms(6_000);
    let reported = bench.reported();
    // This world has no pull-ups on the bus.
    assert!(
        reported.contains("I2C3 at PA8 (I2C3_SCL): no resistor pulls this wire up"),
        "{reported}"
    );
}

/// If the reporter of a program hangs, the watchdog restarts it, and the program reports that.
#[test]
fn the_watchdog_bites() {
    let Some(tree) = tree() else { return };
    let board = folder("twin_watchdog", &fig2(UART));
    let user = "#include \"up_rt.h\"\n\
                void sense_transform_USRear(uint8_t *value) {\n  (void)value;\n\
                if (up_now_ms() > 500U) {\n    for (;;) {\n    }\n  }\n}\n";
    std::fs::write(board.join("user/user.c"), user).unwrap();
    build(&tree, &board, "production");
    let mut bench = Bench::load(&board, "production", LinkPort::Serial(3));
    set_up(&bench);
    bench.machine.run_until(8_000 * MS);
    let is_bite = |event: &Event| matches!(event, Event::Reset { cause: ResetCause::Watchdog, .. });
    let events = bench.machine.events();
    assert_eq!(events.iter().filter(|event| is_bite(event)).count(), 1, "{events:?}");
}

/// A program that reads an unmapped address ends with the address of the instruction.
#[test]
fn a_program_that_fails_says_where() {
    let Some(tree) = tree() else { return };
    let board = folder("twin_fault", &fig2(UART));
    let user = "#include \"up_rt.h\"\n\
                __attribute__((noinline, used)) void sense_transform_USRear(uint8_t *value) {\n\
                *value = *(volatile uint8_t *)0x60000000U;\n}\n";
    std::fs::write(board.join("user/user.c"), user).unwrap();
    build(&tree, &board, "production");
    let mut bench = Bench::load(&board, "production", LinkPort::Serial(3));
    set_up(&bench);
    bench.machine.run_until(500 * MS);
    let halt = bench.machine.halt().unwrap();
    assert!(halt.why.contains("nothing is at 0x60000000"), "{halt}");
    let symbols = std::process::Command::new("arm-none-eabi-nm")
        .args(["-S", "--defined-only"])
        .arg(board.join("build/production/sense.elf"))
        .output()
        .unwrap();
    let symbols = String::from_utf8_lossy(&symbols.stdout).into_owned();
    let hook = symbols.lines().find(|line| line.ends_with("sense_transform_USRear")).unwrap();
    let number =
        |at: usize| u32::from_str_radix(hook.split_whitespace().nth(at).unwrap(), 16).unwrap();
    let (begin, length) = (number(0) & !1, number(1));
    assert!((begin..begin + length).contains(&halt.pc), "{halt}, but the function is {hook}");
}

/// A wrong alternate function number leads a pad elsewhere: the wire is then missing on the twin.
#[test]
fn a_wrong_alternate_function_is_seen() {
    let Some(tree) = tree() else { return };
    let board = folder("twin_mutant", &fig2(UART));
    let path = board.join("generated/sense_hw.c");
    let text = std::fs::read_to_string(&path).unwrap();
    let right = "PAL_LINE(GPIOE, 5U), PAL_MODE_ALTERNATE(3)";
    assert!(text.contains(right), "{text}");
    std::fs::write(&path, text.replace(right, "PAL_LINE(GPIOE, 5U), PAL_MODE_ALTERNATE(2)"))
        .unwrap();
    build(&tree, &board, "production");
    let mut bench = Bench::load(&board, "production", LinkPort::Serial(3));
    set_up(&bench);
    bench.run_until_ms(1_500);
    let state = bench.machine.pads().into_iter().find(|state| state.pad == pad("PE5")).unwrap();
    assert!(!state.wires.iter().any(|wire| wire == "TIM9_CH1"), "{state:?}");
    let counts = values(&bench.reports(&fig2_schema(Checksum::Crc16)), 20);
    assert!(counts.iter().all(|(_, value)| unsigned(value) == 0), "{counts:?}");
}
