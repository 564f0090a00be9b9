//! Generated sketches, compiled with the Arduino core and run on the emulated AVR in simulated worlds.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_diagnostics::SourceMap;
use sensedsl_files::FileSet;
use sensedsl_firmware_arduino::Arduino;
use sensedsl_job::{BoardJob, Target as _};
use sensedsl_tests::{printed, run};
use sensedsl_twin::bench::Bench;
use sensedsl_twin::judge::{DeviceFindings, Judge};
use sensedsl_twin::world::{self, Scene};
use sensedsl_wire::{
    Decoder, Direction, Event, Health, encode_health_request, encode_hello_request,
};

use super::board::AvrBoard;
use super::tools::{CORE, can_compile_sketches};
use super::units::MS;
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

/// A sketch of a job, built as users build it, with all warnings as errors.
pub(super) fn built(job: &BoardJob<'_>, name: &str) -> PathBuf {
    let folder = empty(&format!("avr-sketch-{name}"));
    let files = Arduino.generate(job).unwrap_or_else(|why| panic!("{name}: {why:#?}"));
    for (path, file) in files.iter() {
        let to = folder.join(path);
        std::fs::create_dir_all(to.parent().unwrap()).unwrap();
        std::fs::write(to, &file.bytes).unwrap();
    }
    let mut make = Command::new("make");
    make.args(["--silent", "-j2", "WARNINGS=-Wall -Wextra -Werror"]);
    run(make.arg(format!("ARDUINO_CORE={CORE}")).arg("-C").arg(&folder));
    let image = folder.join("build").join(format!("{}.ino.elf", job.board.name.value));
    assert_memory(name, &files, &image);
    image
}

/// What the sketch's page says of its memory is what it takes: of RAM without the stack nothing less.
fn assert_memory(name: &str, files: &FileSet, image: &Path) {
    let page = String::from_utf8_lossy(&files.get("README.md").unwrap().bytes).into_owned();
    let after = |mark: &str| page.split_once(mark).unwrap().1.split_whitespace().next().unwrap();
    let said: Vec<u32> = ["About ", "of RAM with the stack, and ", "| the stack | "]
        .map(|mark| after(mark).parse().unwrap())
        .into();
    let sizes = printed(Command::new("avr-size").arg(image));
    let sizes: Vec<u32> = sizes
        .lines()
        .nth(1)
        .unwrap()
        .split_whitespace()
        .filter_map(|word| word.parse().ok())
        .collect();
    let (flash, ram) = (sizes[0] + sizes[1], sizes[1] + sizes[2]);
    println!(
        "{name}: {ram} of {} bytes of RAM, {flash} of {} of flash",
        said[0] - said[2],
        said[1]
    );
    assert!((ram..=ram + ram / 6).contains(&(said[0] - said[2])), "{name}: {ram} bytes, {said:?}");
    assert!(
        (flash - flash / 10..=flash + flash / 3).contains(&said[1]),
        "{name}: {flash} bytes, {said:?}"
    );
}

/// A bench in a world.
pub(super) fn bench(job: &BoardJob<'_>, text: &str) -> Bench {
    let file = SourceMap::default().add("world.toml", text);
    let devices: Vec<_> = job.devices.iter().map(|one| one.index).collect();
    let scene = Scene {
        design: job.design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: None,
        samples: &|_| Err("there are no files".to_owned()),
    };
    let (world, mistakes) = world::read(file, text, &scene);
    assert!(mistakes.is_empty(), "{mistakes:?}");
    Bench::new(job, &world, 1)
}

/// What a host has heard of a board, and what the judge found.
pub(super) struct Heard {
    pub(super) reports: u64,
    pub(super) health: Option<Health>,
    pub(super) findings: Vec<DeviceFindings>,
}

/// Runs a board under a host that asks for its identity, and for its health once a second.
pub(super) fn judged(
    job: &BoardJob<'_>,
    board: &mut AvrBoard,
    bench: &Bench,
    seconds: u64,
) -> Heard {
    let mut judge = Judge::new(job, bench);
    let mut decoder = Decoder::new(&job.schema, Direction::Sensor);
    let mut heard = Heard { reports: 0, health: None, findings: Vec::new() };
    board.link_open(true);
    for ms in 1..=seconds * 1_000 {
        if ms % 1_000 == 100 {
            board.link_write(&encode_hello_request(&job.schema));
        }
        if ms % 1_000 == 600 {
            board.link_write(&encode_health_request(&job.schema));
        }
        board.run_until(ms * MS);
        let bytes = board.link_read();
        let now_ns = board.now_ns();
        decoder.feed(&bytes, |event| match event {
            Event::Report(_, values) => judge.take(now_ns, &values),
            Event::Hello(hash) => {
                assert_eq!(hash, job.schema.hash());
                judge.answered();
            }
            Event::Health(health) => {
                judge.health(now_ns, &health, judge.received());
                heard.health = Some(health);
                judge.answered();
            }
            Event::OtherHealth(_) | Event::HelloRequest | Event::HealthRequest => {}
        });
    }
    judge.transfers(board.now_ns(), &board.odd_transfers());
    heard.reports = judge.received();
    heard.findings = judge.finish(board.now_ns());
    heard
}

fn agrees(name: &str, text: &str, world: &str) {
    if !can_compile_sketches() {
        return;
    }
    with_job(text, None, |job| {
        let image = built(job, name);
        let own = bench(job, world);
        let mut board = AvrBoard::new(job, bench(job, world), &image);
        let heard = judged(job, &mut board, &own, 10);
        assert!(heard.reports > 100, "{name}: {} reports", heard.reports);
        assert!(heard.health.is_some(), "{name}: it does not answer");
        assert_eq!(board.resets().len(), 0);
        assert_eq!((board.halt(), board.unwatched()), (None, None), "{name}");
        let wrong: Vec<_> = heard.findings.iter().filter(|one| one.wrong > 0).collect();
        assert!(wrong.is_empty(), "{name}: {wrong:#?}");
    });
}

#[test]
fn a_rover_agrees_with_its_world() {
    agrees("rover", ROVER, "");
}

#[test]
fn a_chip_agrees_with_its_world() {
    agrees("imu", IMU, "");
}

#[test]
fn a_receiver_and_encoders_agree_with_their_world() {
    agrees("gps", GPS, "");
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
        let stated_hz = job.profile.unwrap().edges.as_ref().unwrap().rate_max_hz;
        let rate_hz = std::env::var("EDGES_HZ").ok().and_then(|hz| hz.parse().ok());
        let rate_hz: u32 = rate_hz.unwrap_or(stated_hz);
        let world =
            format!("[devices]\nWheel = {{ ramp = [0, {}], over = \"10 s\" }}", rate_hz * 10);
        let own = bench(job, &world);
        let mut board = AvrBoard::new(job, bench(job, &world), &image);
        let heard = judged(job, &mut board, &own, 3);
        let wrong: Vec<_> = heard.findings.iter().filter(|one| one.wrong > 0).collect();
        assert!(wrong.is_empty(), "{rate_hz} edges a second: {wrong:#?}");
    });
}
