//! Faults around a board, on a real image: the other devices continue, health names the device and
//! the cause, and the faulty one recovers.

use sensedsl_machine::{Event, ResetCause};
use sensedsl_wire::{Causes, DeviceHealth, ResetCause as Cause, Status};

use super::bench::folder;
use super::trial::{System, Trial, image, rover, rover_image, rover_world, run};
use crate::firmware::chibios::{build, tree};
use crate::firmware::embassy;

const NEAR: u8 = 1;
const REAR: u8 = 3;
const WHEEL: u8 = 4;
const STEERING: u8 = 5;
const LIDAR: u8 = 8;
const SPEED: u8 = 9;
const IMU: u8 = 11;
const FRONT: u8 = 12;

/// Runs the rover for ten seconds, with a fault from 4 s on for 3 s; health is read at 6.5 s and at
/// the end.
fn with(system: System, fault: &str) -> Option<Trial> {
    let world = format!("{}\n[[fault]]\n{fault}\n", rover_world());
    let image = rover_image(system)?;
    let trial = run(system, (&rover(), &world), &image, 10, &[6_500, 9_900]);
    assert!(
        trial.halt.is_none() && trial.mismatches.is_empty(),
        "{:?} {:?}",
        trial.halt,
        trial.mismatches
    );
    assert!(trial.wrong().is_empty(), "{fault}: {:#?}", trial.wrong());
    Some(trial)
}

fn with_device(system: System, kind: &str, device: &str) -> Option<Trial> {
    with(system, &format!("kind = \"{kind}\"\ndevice = \"{device}\"\nat = \"4 s\"\nfor = \"3 s\""))
}

fn health(trial: &Trial, at: usize, id: u8) -> DeviceHealth {
    let (_, health) = &trial.health[at];
    *health.devices.iter().find(|one| one.id == id).unwrap()
}

fn faults(causes: Causes) -> u32 {
    causes.counts().into_iter().map(u32::from).sum()
}

/// The devices that are not affected report all the time, and the faulty one before and after the
/// fault.
#[track_caller]
fn others_go_on(trial: &Trial, broken: u8) {
    for id in [NEAR, WHEEL, STEERING, SPEED] {
        if id != broken {
            assert!(trial.reports_of(id, 4_000, 7_000) > 20, "{id} is silent");
        }
    }
    assert!(trial.reports_of(broken, 0, 4_000) > 0 && trial.reports_of(broken, 8_500, 10_000) > 0);
    assert_eq!(health(trial, 1, broken).status, Status::Good);
}

/// Runs each test on both targets. On Embassy only the marked ones always run, because its programs
/// take long to build and the others need no other code of the target.
macro_rules! on_both {
    ($($name:ident $(, $always:ident)?;)*) => {
        mod on_chibios {
            $(
                #[test]
                fn $name() {
                    super::$name(super::System::Chibios);
                }
            )*
        }

        mod on_embassy {
            $(
                #[test]
                fn $name() {
                    let is_always = false $(|| stringify!($always) == "always")?;
                    if is_always || sensedsl_tests::is_drawn(stringify!($name)) {
                        super::$name(super::System::Embassy);
                    }
                }
            )*
        }
    };
}

on_both! {
    a_chip_that_does_not_answer, always;
    a_bus_that_is_held;
    a_torn_cable;
    inputs_that_fall_silent;
    a_supply_that_breaks_down;
    garbage_on_the_link;
}

fn a_chip_that_does_not_answer(system: System) {
    let Some(trial) = with_device(system, "no_answer", "Rear") else { return };
    others_go_on(&trial, REAR);
    let rear = health(&trial, 0, REAR);
    assert!(rear.status == Status::Failed && rear.causes.not_acknowledged > 3, "{rear:?}");
    assert_eq!(trial.reports_of(REAR, 4_300, 7_000), 0);
    assert_eq!(faults(health(&trial, 1, IMU).causes), 0);
}

fn a_bus_that_is_held(system: System) {
    for kind in ["stuck_sda", "hang"] {
        let Some(trial) = with_device(system, kind, "Rear") else { return };
        others_go_on(&trial, REAR);
        let rear = health(&trial, 0, REAR);
        assert!(rear.status != Status::Good && faults(rear.causes) > 0, "{kind}: {rear:?}");
        let causes = rear.causes;
        let of_bus = causes.timed_out + causes.bus_error + causes.arbitration_lost;
        assert!(of_bus > 0, "{kind}: {causes:?}");
    }
}

fn a_torn_cable(system: System) {
    let Some(trial) = with_device(system, "torn", "Rear") else { return };
    others_go_on(&trial, REAR);
    assert!(health(&trial, 0, REAR).causes.not_acknowledged > 3);
    let Some(trial) = with_device(system, "torn", "Wheel") else { return };
    // The count stays constant and is reported: an input without edges cannot be told from a wheel
    // at rest.
    assert!(trial.reports_of(WHEEL, 8_500, 10_000) > 20);
    assert!(trial.reports_of(NEAR, 4_000, 7_000) > 20);
}

fn inputs_that_fall_silent(system: System) {
    for (name, id) in [("Lidar", LIDAR), ("Speed", SPEED), ("Steering", STEERING), ("Front", FRONT)]
    {
        let Some(trial) = with_device(system, "silent", name) else { return };
        others_go_on(&trial, id);
        let broken = health(&trial, 0, id);
        assert!(broken.age_ms >= 2_000, "{name}: {broken:?}");
        // Nobody asks a receiver for its pulses, so they cannot be late.
        assert!(id == STEERING || broken.status != Status::Good, "{name}: {broken:?}");
    }
}

fn a_supply_that_breaks_down(system: System) {
    let Some(trial) = with(system, "kind = \"reset\"\nat = \"4 s\"\nfor = \"200 ms\"") else {
        return;
    };
    let resets: Vec<_> = trial.told.iter().collect();
    let is_power = |one: &&&Event| matches!(one, Event::Reset { cause: ResetCause::Power, .. });
    assert_eq!(resets.iter().filter(is_power).count(), 1, "{resets:?}");
    assert_eq!(trial.reports_of(NEAR, 4_010, 4_190), 0);
    assert!(trial.reports_of(NEAR, 5_500, 10_000) > 100);
    assert!(trial.reports_of(IMU, 5_500, 10_000) > 100);
    let (_, health) = &trial.health[0];
    assert!(health.uptime_ms < 2_400 && health.reset_cause == Cause::Power, "{health:?}");
}

fn garbage_on_the_link(system: System) {
    let Some(trial) = with(system, "kind = \"garbage\"\nat = \"4 s\"\nfor = \"500 ms\"") else {
        return;
    };
    assert!(trial.dropped > 0);
    assert!(trial.reports_of(NEAR, 4_600, 10_000) > 200);
}

/// The watchdog ends a thread that hangs, and the board then reports which one it was.
#[test]
fn a_thread_that_hangs() {
    let Some(tree) = tree() else { return };
    let board = folder("trial_hang", &rover());
    let user = "#include \"up_life.h\"\n#include \"up_rt.h\"\n\
                void sense_transform_Rear(uint16_t *value) {\n  (void)value;\n\
                while (up_now_ms() > 2000U && up_reset_cause() != UP_CAUSE_WATCHDOG) {\n  }\n}\n";
    std::fs::write(board.join("user/user.c"), user).unwrap();
    build(&tree, &board, "production");
    let trial = run(System::Chibios, (&rover(), &rover_world()), &image(&board), 14, &[13_500]);
    assert_is_bitten(&trial);
}

/// A task that waits for ever, for example for a bus transfer that never ends.
#[test]
fn a_task_that_hangs() {
    let Some(board) = embassy::project("trial_hang_embassy", &rover()) else { return };
    let path = board.join("src/main.rs");
    let text = std::fs::read_to_string(&path).unwrap();
    let beats: Vec<&str> =
        text.lines().filter(|line| line.contains("WATCH.beat(tables::I2C1_100MS")).collect();
    let [beat] = beats[..] else { panic!("{beats:?}") };
    let hang = "if now_ms() > 2_000 && STATUS.cause() != sense_rt::Cause::Watchdog {\n\
                core::future::pending::<()>().await;\n}\n";
    std::fs::write(&path, text.replacen(beat, &format!("{hang}{beat}"), 1)).unwrap();
    let program = std::fs::read(embassy::build(&board)).unwrap();
    let trial = run(System::Embassy, (&rover(), &rover_world()), &program, 14, &[13_500]);
    assert_is_bitten(&trial);
}

/// Checks that the watchdog has bitten once, and that the board reports for which device and
/// continues.
#[track_caller]
fn assert_is_bitten(trial: &Trial) {
    let is_bite = |one: &&Event| matches!(one, Event::Reset { cause: ResetCause::Watchdog, .. });
    assert_eq!(trial.told.iter().filter(is_bite).count(), 1, "{:?}", trial.told);
    let (_, health) = trial.health.first().unwrap();
    assert_eq!(health.reset_cause, Cause::Watchdog);
    // The thread that serves the bus reports one of its devices.
    assert!([REAR, IMU].contains(&health.reset_device), "{}", health.reset_device);
    assert!(trial.reports_of(REAR, 10_000, 14_000) > 10);
}

/// A program that only restarts ends the run, with the reason.
#[test]
fn a_program_that_only_starts() {
    let Some(tree) = tree() else { return };
    let board = folder("trial_loop", &rover());
    let user = "#include \"up_rt.h\"\n\
                void sense_transform_Rear(uint16_t *value) {\n  (void)value;\n  for (;;) {\n  }\n}\n";
    std::fs::write(board.join("user/user.c"), user).unwrap();
    build(&tree, &board, "production");
    let trial = run(System::Chibios, (&rover(), &rover_world()), &image(&board), 40, &[]);
    let halt = trial.halt.unwrap();
    assert!(halt.why.contains("the watchdog has reset it 3 times"), "{halt}");
}
