//! Faults around a sketch: the loop goes on, health names the device and the cause, and the device recovers.

use sensedsl_wire::{Causes, ResetCause, Status};

use super::child::Reset;
use super::sketches::{built, made, written};
use super::tools::can_compile_sketches;
use super::trial::{Host, Trial, run};
use crate::embassy::with_job;
use sensedsl_tests::{Random, compiled_once, drawn};

const LIGHT: u8 = 1;
const NEAR: u8 = 2;
const RANGE: u8 = 3;
const WHEEL: u8 = 4;
const ACCELERATION: u8 = 6;

const ROVER: &str = "board Rover on ARDUINO_UNO_R3 {
    sensor Light returns uint16 { id = 1; type = analog; samples = 4; delay = 50 ms; }
    sensor Near returns uint32 { id = 2; driver = hcsr04; delay = 105 ms; }
    sensor Range returns uint16 { id = 3; driver = srf08; address = 0x70; delay = 105 ms; }
    sensor Wheel returns uint32 { id = 4; type = icu; }
    sensor Bump returns bool { id = 5; type = digital; edge = both; pull = up; active = low; }
    chip Imu {
        driver = mpu6050;
        delay = 20 ms;
        sensor Acceleration returns int16[3] { id = 6; }
    }
    actuator Steer accepts uint16 { id = 7; driver = servo; failsafe = 1500 us; }
}";
const WORLD: &str = "seed = 3
[devices]
Light = { sine = 900, offset = 1500, period = \"3 s\" }
Range = { ramp = [40, 300], over = \"10 s\" }
Wheel = { rate = 90 }
Acceleration = [{ sine = 0.5, period = \"2 s\" }, 0.25, 1]
";
/// Health is read while the fault is there, and at the end.
const ASKS_MS: [u64; 2] = [6_500, 9_900];

/// Runs the rover for ten seconds with a fault of the world; none without the tools.
fn with(fault: &str) -> Option<Trial> {
    with_host(fault, Host::that_asks(10, &ASKS_MS))
}

fn with_host(fault: &str, host: Host<'_>) -> Option<Trial> {
    if !can_compile_sketches() {
        return None;
    }
    let world =
        if fault.is_empty() { WORLD.to_owned() } else { format!("{WORLD}[[fault]]\n{fault}\n") };
    let trial = with_job(ROVER, None, |job| {
        let image = compiled_once("sketch for faults".to_owned(), || built(job, "faults"));
        run(job, &world, &image, host)
    });
    assert_eq!((&trial.halt, &trial.unwatched), (&None, &None), "{fault}");
    assert!(trial.mismatches.is_empty(), "{fault}: {:?}", trial.mismatches);
    assert!(trial.wrong().is_empty(), "{fault}: {:#?}", trial.wrong());
    assert_eq!(trial.health.len(), 2, "{fault}: {:?}", trial.health);
    Some(trial)
}

/// A fault of a device, from 4 s on for 3 s.
fn with_device(kind: &str, device: &str) -> Option<Trial> {
    with(&format!("kind = \"{kind}\"\ndevice = \"{device}\"\nat = \"4 s\"\nfor = \"3 s\""))
}

fn faults(causes: Causes) -> u32 {
    causes.counts().into_iter().map(u32::from).sum()
}

/// The devices that are not affected report all the time, and the faulty one before and after the fault.
#[track_caller]
fn others_go_on(trial: &Trial, broken: u8) {
    for id in [LIGHT, NEAR, WHEEL] {
        if id != broken {
            let count = trial.reports_of(id, 4_000, 7_000);
            assert!(count > 20, "{id} has told {count} values");
        }
    }
    let (before, after) =
        (trial.reports_of(broken, 0, 4_000), trial.reports_of(broken, 8_500, 10_000));
    assert!(before > 5 && after > 5, "{before} before, {after} after");
    assert_eq!(trial.device(1, broken).status, Status::Good);
}

#[test]
fn a_part_that_does_not_answer() {
    for kind in drawn("faults of sketches", &["no_answer", "torn"], 1) {
        let Some(trial) = with_device(kind, "Range") else { return };
        others_go_on(&trial, RANGE);
        let range = trial.device(0, RANGE);
        assert!(range.status == Status::Failed && range.causes.not_acknowledged > 3, "{range:?}");
        assert_eq!(faults(range.causes), u32::from(range.causes.not_acknowledged), "{range:?}");
        assert_eq!(trial.reports_of(RANGE, 4_300, 7_000), 0);
        // The other part on the bus does not suffer.
        assert!(trial.reports_of(ACCELERATION, 4_000, 7_000) > 100);
        assert_eq!(faults(trial.device(1, ACCELERATION).causes), 0);
    }
}

#[test]
fn a_bus_that_is_held() {
    for kind in drawn("faults of sketches", &["stuck_sda", "hang"], 1) {
        let Some(trial) = with_device(kind, "Range") else { return };
        others_go_on(&trial, RANGE);
        others_go_on(&trial, ACCELERATION);
        for id in [RANGE, ACCELERATION] {
            let device = trial.device(0, id);
            let causes = device.causes;
            let of_bus = causes.timed_out + causes.bus_error + causes.arbitration_lost;
            assert!(device.status == Status::Failed && of_bus > 3, "{kind}: {device:?}");
            assert_eq!(trial.reports_of(id, 4_300, 7_000), 0, "{kind}: {id}");
        }
    }
}

#[test]
fn an_echo_that_does_not_come() {
    for kind in drawn("faults of sketches", &["silent", "torn"], 1) {
        let Some(trial) = with_device(kind, "Near") else { return };
        others_go_on(&trial, NEAR);
        let near = trial.device(0, NEAR);
        assert!(near.status == Status::Stale && near.age_ms >= 2_000, "{kind}: {near:?}");
        assert_eq!(trial.reports_of(NEAR, 4_300, 7_000), 0);
    }
}

#[test]
fn a_supply_that_breaks_down() {
    let Some(trial) = with("kind = \"reset\"\nat = \"4 s\"\nfor = \"200 ms\"") else { return };
    assert!(matches!(trial.resets[..], [Reset { cause: Reset::POWER, .. }]), "{:?}", trial.resets);
    assert_eq!(trial.reports_of(LIGHT, 4_010, 4_190), 0);
    for id in [LIGHT, NEAR, RANGE, WHEEL, ACCELERATION] {
        assert!(trial.reports_of(id, 5_500, 10_000) > 35, "{id} is silent");
    }
    let (_, health) = &trial.health[0];
    assert!(health.uptime_ms < 2_400 && health.reset_cause == ResetCause::Power, "{health:?}");
}

#[test]
fn garbage_from_the_board() {
    let Some(trial) = with("kind = \"garbage\"\nat = \"4 s\"\nfor = \"500 ms\"") else { return };
    assert!(trial.dropped > 0);
    assert!(trial.reports_of(LIGHT, 4_600, 10_000) > 100);
}

/// The board takes none of it for a command, and hears what comes behind it.
#[test]
fn garbage_from_the_host() {
    let noise = |ms: u64| {
        let mut random = Random::new(ms);
        let count = if (4_000..4_500).contains(&ms) { 10 } else { 0 };
        (0..count).map(|_| u8::try_from(random.below(256)).unwrap()).collect()
    };
    let host = Host { seconds: 10, asks_ms: &ASKS_MS, sets: false, says: &noise };
    let Some(trial) = with_host("", host) else { return };
    assert_eq!((trial.dropped, trial.noticed().as_str()), (0, ""));
    let (_, health) = &trial.health[1];
    let steer = health.devices.iter().find(|one| one.id == 7).unwrap();
    assert_eq!(steer.status, Status::NeverRead, "{steer:?}");
}

/// Runs the rover with a file of the user's.
fn with_user(name: &str, user: &str, seconds: u64) -> Option<Trial> {
    if !can_compile_sketches() {
        return None;
    }
    with_job(ROVER, None, |job| {
        let folder = written(job, name);
        std::fs::write(folder.join("src/user/user.c"), user).unwrap();
        let image = made(job, &folder).unwrap_or_else(|said| panic!("{said}"));
        Some(run(job, WORLD, &image, Host::that_asks(seconds, &[9_900])))
    })
}

/// The watchdog ends what hangs, and the board then tells which device it was.
#[test]
fn a_transform_that_hangs_once() {
    let user = "#include <avr/io.h>\n#include \"../sense_model.h\"\n#include \"../up_rt.h\"\n\
                static uint8_t has_hung __attribute__((section(\".noinit\")));\n\
                void up_user_init(void) {\n  if (up_now_ms() > 1000U) {\n    has_hung = 0U;\n  }\n}\n\
                void sense_transform_Range(uint16_t *value) {\n  (void)value;\n\
                if (up_now_ms() > 2000U && has_hung != 0x5AU) {\n    has_hung = 0x5AU;\n\
                for (;;) {\n    }\n  }\n}\n";
    let Some(trial) = with_user("hangs-once", user, 10) else { return };
    let [bite] = trial.resets[..] else { panic!("{:?}", trial.resets) };
    assert_eq!(bite.cause, Reset::WATCHDOG);
    // It hangs after 2 s, and two seconds later the watchdog bites.
    assert!((4_000..4_400).contains(&(bite.at_ns / 1_000_000)), "{bite:?}");
    let (_, health) = &trial.health[0];
    assert_eq!((health.reset_cause, health.reset_device), (ResetCause::Watchdog, RANGE));
    for id in [LIGHT, NEAR, RANGE, WHEEL, ACCELERATION] {
        assert!(trial.reports_of(id, 5_500, 10_000) > 35, "{id} is silent");
    }
    assert_eq!(trial.halt, None);
}

/// A sketch that only ever starts ends the run, with the reason.
#[test]
fn a_transform_that_hangs_always() {
    let user = "#include \"../sense_model.h\"\n#include \"../up_rt.h\"\n\
                void sense_transform_Range(uint16_t *value) {\n  (void)value;\n  for (;;) {\n  }\n}\n";
    let Some(trial) = with_user("hangs-always", user, 20) else { return };
    let halt = trial.halt.unwrap();
    assert!(halt.contains("the watchdog has reset it 3 times"), "{halt}");
}
