//! Generated sketches, compiled with the Arduino core and run on the emulated AVR in simulated worlds.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_firmware_arduino::Arduino;
use sensedsl_job::{BoardJob, Target as _};
use sensedsl_tests::{printed, read, write_all};

use super::tools::{CORE, can_compile_sketches};
use super::trial::{Host, run};
use crate::embassy::with_job;
use crate::firmware::tools::empty;

/// A rover with what many begin with.
const ROVER: &str = "board Rover on ARDUINO_UNO_R3 {
    sensor Light returns uint16 { id = 1; type = analog; pin = A0; samples = 4; delay = 50 ms; }
    sensor Near returns uint32 { id = 2; driver = hcsr04; delay = 105 ms; }
    sensor Bump returns bool { id = 3; type = digital; edge = both; pull = up; active = low; }
    sensor Range returns uint16 { id = 4; driver = srf08; address = 0x70; delay = 105 ms; }
    actuator Steer accepts uint16 { id = 6; driver = servo; failsafe = 1500 us; }
    actuator Lamp accepts bool { id = 7; type = digital; }
}";
const IMU: &str = "board Bot on ARDUINO_UNO_R3 {
    chip Imu {
        driver = mpu6050;
        delay = 20 ms;
        sensor Acceleration returns int16[3] {}
        sensor Temperature returns int16 {}
        sensor Rate returns int16[3] {}
    }
    sensor Level returns uint16 { type = analog; samples = 8; delay = 50 ms; }
}";
/// The link is the MCU's own USB; outputs of timers and a captured input are beside it.
const USB: &str = "board Bot on ARDUINO_LEONARDO {
    link { silence = 500 ms; }
    sensor Light returns uint16 { id = 1; type = analog; pin = A0; samples = 4; delay = 50 ms; }
    sensor Slow returns uint32 { id = 2; type = icu; mode = period; pin = D4; unit = TC1; }
    sensor Near returns uint32 { id = 3; driver = hcsr04; delay = 105 ms; }
    chip Imu {
        driver = mpu6050;
        delay = 20 ms;
        sensor Acceleration returns int16[3] { id = 4; }
    }
    actuator Steer accepts uint16 { id = 5; driver = servo; failsafe = 1500 us; }
    actuator Lamp accepts bool { id = 6; type = digital; active = low; }
    actuator Say accepts uint16 { id = 7; type = uart; baud = 9600; start = [0x55]; length = 2; }
}";
const GPS: &str = "board Bot on ARDUINO_MEGA_2560 {
    chip NmeaGps {
        driver = nmea_gps;
        sensor Time returns uint32 {}
        sensor Latitude returns int32 {}
        sensor Longitude returns int32 {}
        sensor Speed returns uint32 {}
        sensor Course returns uint16 {}
    }
    sensor Wheels returns int32[2] { type = encoder; counts = 360; }
}";

/// Writes the files of a job's sketch, as users get them.
pub(super) fn written(job: &BoardJob<'_>, name: &str) -> PathBuf {
    let folder = empty(&format!("avr-sketch-{name}"));
    let files = Arduino.generate(job).unwrap_or_else(|why| panic!("{name}: {why:#?}"));
    write_all(&folder, files.iter().map(|(path, file)| (path, &file.bytes)));
    folder
}

/// Builds a sketch as users build it, with all warnings as errors; or tells what the compilers say.
pub(super) fn made(job: &BoardJob<'_>, folder: &Path) -> Result<PathBuf, String> {
    let mut make = Command::new("make");
    make.args(["--silent", "-j2", "WARNINGS=-Wall -Wextra -Werror"]);
    let output = make.arg(format!("ARDUINO_CORE={CORE}")).arg("-C").arg(folder).output().unwrap();
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    Ok(folder.join("build").join(format!("{}.ino.elf", job.board.name.value)))
}

/// The sketch of a job.
pub(super) fn built(job: &BoardJob<'_>, name: &str) -> PathBuf {
    let folder = written(job, name);
    let image = made(job, &folder).unwrap_or_else(|said| panic!("{name}: {said}"));
    assert_memory(name, &read(&folder.join("README.md")), &image);
    image
}

/// What the sketch's page says of its memory is what it takes: of RAM without the stack nothing less.
fn assert_memory(name: &str, page: &str, image: &Path) {
    let after = |mark: &str| page.split_once(mark).unwrap().1.split_whitespace().next().unwrap();
    let said = ["About ", "of RAM with the stack, and ", "| the stack | "];
    let [said_ram, said_flash, stack] = said.map(|mark| after(mark).parse::<u32>().unwrap());
    let said_ram = said_ram - stack;
    let sizes = printed(Command::new("avr-size").arg(image));
    let words = sizes.lines().nth(1).unwrap().split_whitespace();
    let sizes: Vec<u32> = words.filter_map(|word| word.parse().ok()).collect();
    let (flash, ram) = (sizes[0] + sizes[1], sizes[1] + sizes[2]);
    println!("{name}: {ram} of {said_ram} bytes of RAM, {flash} of {said_flash} of flash");
    assert!((ram..=ram + ram / 6).contains(&said_ram), "{name}: {ram} bytes, not {said_ram}");
    let flashes = flash - flash / 10..=flash + flash / 3;
    assert!(flashes.contains(&said_flash), "{name}: {flash} bytes, not {said_flash}");
}

/// Runs a board for ten seconds under a host that asks how it is, or under one that sets actuators and falls silent.
fn agrees(name: &str, text: &str, sets: bool) {
    if !can_compile_sketches() {
        return;
    }
    with_job(text, None, |job| {
        let image = built(job, name);
        let asks_ms: Vec<u64> = (0..10).map(|second| second * 1_000 + 600).collect();
        let asks = Host::that_asks(10, &asks_ms);
        let trial = run(job, "", &image, if sets { Host::that_sets(10) } else { asks });
        assert_eq!(trial.noticed(), "", "{name}");
        let (values, health) = (trial.reported.len(), trial.health.len());
        assert!(values > 100, "{name}: {values} values");
        assert_eq!(health, if sets { 1 } else { asks_ms.len() }, "{name}");
        let unset = trial.outputs.iter().find(|one| one.commands < 3 || one.is_silence_left);
        assert!(unset.is_none(), "{name}: {unset:?}");
    });
}

#[test]
fn a_rover_agrees_with_its_world() {
    agrees("rover", ROVER, false);
}

#[test]
fn a_chip_agrees_with_its_world() {
    agrees("imu", IMU, false);
}

#[test]
fn a_receiver_and_encoders_agree_with_their_world() {
    agrees("gps", GPS, false);
}

#[test]
fn a_leonardo_agrees_with_its_world() {
    agrees("leonardo", USB, true);
}

/// An encoder at the rate that the profile states for all handlers together, and other work beside it.
const WHEEL: &str = "board Bot on ARDUINO_UNO_R3 {
    sensor Wheel returns int32 { type = encoder; }
    sensor Light returns uint16 { type = analog; samples = 8; delay = 20 ms; }
}";

#[test]
fn an_encoder_counts_at_the_rate_that_is_stated() {
    if !can_compile_sketches() {
        return;
    }
    with_job(WHEEL, None, |job| {
        let image = built(job, "wheel");
        let rate_hz = job.profile.unwrap().edges.as_ref().unwrap().rate_max_hz;
        let ramp = format!("ramp = [0, {}], over = \"10 s\"", rate_hz * 10);
        let world = format!("[devices]\nWheel = {{ {ramp} }}");
        let trial = run(job, &world, &image, Host::that_asks(3, &[600, 1_600]));
        assert_eq!(trial.noticed(), "", "{rate_hz} edges a second");
    });
}
