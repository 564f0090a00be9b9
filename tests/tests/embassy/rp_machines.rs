//! State machines and bridges of the RP2040 on an emulator by others: encoders, times of edges, motors.
//!
//! Runs with `SENSEDSL_THOROUGH=2`, as `rp_runs.rs` does.

use std::ops::Range;

use sensedsl_wire::{Causes, Direction, Scalar, encode_health_request, encode_report};
use serde_json::json;

use super::rp_runs::{Run, hex, is_possible, made_of, run};

/// Inputs are on pins without a channel that captures, where they are on a state machine.
const DEVICES: &str = r"
    sensor Left returns int32 { id = 1; type = encoder; a = GP0; b = GP1; delay = 50 ms; }
    sensor Right returns int32 { id = 2; type = encoder; a = GP9; b = GP6; delay = 50 ms; }
    sensor Speed returns uint32 { id = 3; type = icu; mode = period; resolution = 1 us; pin = GP14; delay = 50 ms; }
    sensor Share returns uint16 { id = 4; type = icu; mode = duty; resolution = 1 us; pin = GP16; delay = 50 ms; }
    sensor Rate returns uint32 { id = 5; type = icu; mode = frequency; resolution = 1 us; pin = GP18; delay = 50 ms; }
    sensor Near returns uint32 { id = 6; driver = hcsr04; divider = [5.6 kOhm, 10 kOhm]; pin = GP20; trigger = GP21; delay = 100 ms; }
    actuator Drive accepts int16 { id = 7; driver = drv8833; reading = speed_a; forward_a = GP2; backward_a = GP3; sleep = GP4; frequency = 1 kHz; }
    actuator Winch accepts int16 { id = 8; driver = tb6612fng; reading = speed_a; pwm_a = GP10; in1_a = GP11; in2_a = GP12; standby = GP13; frequency = 1 kHz; }
}
";

const MS: u64 = 1_000;

/// A wheel's tracks: `steps` from `state` on, forwards or backwards, one each `every_us`.
fn turn(levels: &mut Vec<(u64, u8, u8)>, pins: [u8; 2], from_us: u64, steps: i32, every_us: u64) {
    // Both tracks in each state of a step forwards; a wheel begins with both low.
    const STATES: [[u8; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];
    let mut at = from_us;
    for step in 1..=steps.abs() {
        let state = STATES[(step * steps.signum()).rem_euclid(4) as usize];
        levels.extend(pins.iter().zip(state).map(|(pin, level)| (at, *pin, level)));
        at += every_us;
    }
}

fn signed(run: &Run, id: u8) -> i64 {
    match run.last(id) {
        [Scalar::Signed(value)] => *value,
        other => panic!("{id}: {other:?}"),
    }
}

fn unsigned(run: &Run, id: u8) -> u64 {
    match run.last(id) {
        [Scalar::Unsigned(value)] => *value,
        other => panic!("{id}: {other:?}"),
    }
}

#[test]
fn encoders_times_and_motors_are_the_worlds() {
    if !is_possible() {
        return;
    }
    let made = made_of("embassy-rp-machines", "", DEVICES);
    let mut levels = Vec::new();
    // A quick wheel forwards, and a slow one backwards: 4,000 steps, and 100.
    turn(&mut levels, [0, 1], 300 * MS, 4_000, 20);
    turn(&mut levels, [9, 6], 300 * MS, -100, 2 * MS);
    for at in (200 * MS..1_900 * MS).step_by(4_000) {
        levels.extend([(at, 14, 1), (at + 700, 14, 0)]);
        levels.extend([(at, 16, 1), (at + 1_000, 16, 0)]);
        levels
            .extend((0..4).flat_map(|n| [(at + n * 1_000, 18, 1), (at + n * 1_000 + 300, 18, 0)]));
    }
    for at in (200 * MS..1_900 * MS).step_by(100_000) {
        levels.extend([(at, 20, 1), (at + 5_831, 20, 0)]);
    }
    levels.sort_by_key(|(at, ..)| *at);
    let set = |drive: i64, winch: i64| {
        let values = [(7, vec![Scalar::Signed(drive)]), (8, vec![Scalar::Signed(winch)])];
        hex(&encode_report(&made.schema, Direction::Actuator, &values).unwrap())
    };
    let world = json!({
        "image": made.image, "until": 2_000 * MS, "analog": [0, 0, 0, 0], "chips": {}, "spi": [0],
        "levels": levels,
        "said": [
            [800 * MS, set(2_500, -7_500)], [1_000 * MS, set(-5_000, 4_000)], [1_200 * MS, set(-5_000, 0)],
            [1_850 * MS, hex(&encode_health_request(&made.schema))],
        ],
    });
    let run = run(&made, &world);
    let health = run.health.last().unwrap();
    assert!(health.devices.iter().all(|one| one.causes == Causes::default()), "{health:?}");
    assert_eq!((signed(&run, 1), signed(&run, 2)), (4_000, -100));
    let values = [3, 4, 5, 6].map(|id| unsigned(&run, id));
    assert_eq!(values, [4_000, 2_500, 1_000, 5_831]);
    pulses(&run, 2, 810..990, 250);
    pulses(&run, 3, 1_010..1_190, 500);
    pulses(&run, 10, 810..990, 750);
    pulses(&run, 10, 1_010..1_190, 400);
    for at in (0..2_000 * MS).step_by(100) {
        assert!(!(is_high(&run, 2, at) && is_high(&run, 3, at)), "both inputs at {at}");
    }
    // A direction is changed while there is no pulse, and both pins of it are never high.
    for (at, level) in run.pins["11"].iter().chain(&run.pins["12"]) {
        assert!(!is_high(&run, 10, *at), "a pulse at {at}");
        assert!(*level == 0 || !(is_high(&run, 11, *at) && is_high(&run, 12, *at)), "{at}");
    }
    assert!(is_high(&run, 12, 900 * MS) && is_high(&run, 11, 1_100 * MS));
    assert!(![10, 11, 12].iter().any(|pin| is_high(&run, *pin, 1_300 * MS)));
}

/// The level of a pin after what happened in that microsecond.
fn is_high(run: &Run, pin: u8, at_us: u64) -> bool {
    let before = run.pins[&pin.to_string()].iter().take_while(|(at, _)| *at <= at_us);
    before.last().is_some_and(|(_, level)| *level == 1)
}

/// All pulses of a pin in these milliseconds have this length, one a millisecond.
fn pulses(run: &Run, pin: u8, within_ms: Range<u64>, length_us: u64) {
    let widths = run.widths(&pin.to_string());
    let own: Vec<_> = widths.iter().filter(|(at, _)| within_ms.contains(&(at / MS))).collect();
    let asked = usize::try_from(within_ms.end - within_ms.start).unwrap();
    assert!(own.len().abs_diff(asked) <= 1, "{pin}: {} of {asked}", own.len());
    assert!(own.iter().all(|(_, us)| us.abs_diff(length_us) <= 1), "{pin}: {own:?}");
}
