//! A HAL that no profile names yet takes nothing but its own file: [`made`] is one, and projects are planned for it.

mod made;

use sensedsl_board::profile::TargetProfile;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::FileSet;
use sensedsl_job::{BoardJob, jobs};
use sensedsl_model::kind::KindName;
use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_wiring::{Search, Solved, Wiring};

use crate::gaps;
use crate::generate::generate;
use crate::hal::contract::Hal;
use crate::hal::{HALS, Opened};
use made::MadeUp;

/// All HALs, and the one of these tests.
const ALL: &[&dyn Hal] = &[HALS[0], HALS[1], HALS[2], &MadeUp];

/// A board with the kinds that the HAL has drivers for.
const SERVED: &str = "board Rover on RaspberryPiPico {
    sensor Touch returns bool { id = 1; type = digital; pin = GP2; pull = up; }
    sensor Light returns uint16 { id = 2; type = analog; pin = GP26; }
    actuator Lamp accepts bool { id = 3; type = digital; pin = GP3; initial = true; }
}";

/// The keys of `[system]` that all HALs have in common.
const COMMON: [&str; 5] = ["target", "dma", "source", "peripherals", "interrupts"];

/// A profile with the HAL of these tests in place of its own.
fn named(profile: &TargetProfile) -> TargetProfile {
    let mut profile = profile.clone();
    let own = &mut profile.own.file;
    own.retain(|key, _| COMMON.contains(&key));
    own.insert("hal".to_owned(), "made-up".into());
    own.insert("saadc_bits".to_owned(), 12.into());
    profile
}

/// Hands on the job of a text's only board, with such a profile.
fn with_job<T>(text: &str, then: impl FnOnce(&BoardJob<'_>) -> T) -> T {
    let target = Some("embassy");
    let request = Request { path: "rover.sense", text, target, ..Request::default() };
    let resolved = resolve(&request, &NoFiles);
    let design = resolved.design.unwrap_or_else(|| panic!("{:?}", resolved.diagnostics));
    let Solved::Wired(wiring) = Wiring::new(&design, None).solve(&Search::default()) else {
        panic!("there is no wiring")
    };
    let mut job = jobs(&design, &wiring).next().unwrap();
    let profile = named(job.profile.unwrap());
    job.profile = Some(&profile);
    then(&job)
}

fn project(text: &str) -> Result<FileSet, Vec<Diagnostic>> {
    with_job(text, |job| generate(job, ALL))
}

fn file(files: &FileSet, path: &str) -> String {
    String::from_utf8(files.get(path).unwrap().bytes.clone()).unwrap()
}

/// Asserts that a file of a project has each line once.
fn has_lines(files: &FileSet, path: &str, lines: &[&str]) {
    let text = file(files, path);
    for line in lines {
        let count = text.lines().filter(|one| one.trim() == *line).count();
        assert_eq!(count, 1, "{path}: {line}\n{text}");
    }
}

#[test]
fn a_project_is_in_the_words_of_its_hal() {
    let files = project(SERVED).unwrap();
    has_lines(
        &files,
        "src/wiring.rs",
        &[
            "use embassy_made_up::{self as hal, Peri, Peripherals, bind_interrupts, peripherals::*};",
            "touch: Input::new(p.P0_02, Pull::Up),",
            "light: hal::saadc::Input::degrade_saadc(p.P0_26),",
            "adc1: hal::saadc::Saadc::new(p.ADC, Irqs, hal::saadc::Resolution::_12BIT),",
            "lamp: Output::new(p.P0_03, Level::High, OutputDrive::Standard),",
            "link: hal::usb::Driver::new(p.USB, Irqs),",
            "ADC_IRQ_FIFO => hal::saadc::InterruptHandler;",
        ],
    );
    has_lines(
        &files,
        "src/main.rs",
        &[
            "let wiring = wiring::wire(hal::init(config()));",
            "for [s0] in samples.as_chunks_mut().0 { adc.sample(&mut light, s0).await; }",
            "outputs.lamp.set_level(if Scalar::Bool.load(value.get(0..).unwrap_or_default()) != 0 \
             { Level::High } else { Level::Low });",
        ],
    );
}

#[test]
fn manifests_are_those_of_the_hal() {
    let files = project(SERVED).unwrap();
    let own = "embassy-made-up = { version = \"=0.9.0\", features = [\"rp2040\", \"gpiote\"] }";
    has_lines(&files, "Cargo.toml", &[own]);
    let runtime = "embassy-made-up = { version = \"=0.9.0\", features = [\"unstable-pac\"] }";
    has_lines(&files, "sense-embassy/Cargo.toml", &[runtime, "made-up = []"]);
    for path in ["Cargo.toml", "src/main.rs", "src/wiring.rs", "README.md", ".cargo/config.toml"] {
        let text = file(&files, path).to_lowercase();
        for other in ["embassy-rp", "embassy_rp", "embassy-stm32", "embassy_stm32", "bootsel"] {
            assert!(!text.contains(other), "{path}: {other}\n{text}");
        }
    }
}

/// A kind that the HAL has no driver for is not among those that are served, and its devices are left out.
#[test]
fn what_the_hal_lacks_is_a_gap() {
    let text = "board Rover on RaspberryPiPico {
        sensor Touch returns bool { id = 1; type = digital; pin = GP2; edge = rising; }
        actuator Servo accepts uint16 { id = 2; type = pwm; pin = GP4; frequency = 50 Hz; }
        actuator Lamp accepts bool { id = 3; type = digital; pin = GP3; }
    }";
    with_job(text, |job| {
        let opened = Opened::new(job.profile.unwrap(), ALL).unwrap();
        let drivers = &*opened.drivers;
        assert_eq!(gaps::kinds(drivers), [KindName::Analog, KindName::Digital, KindName::Code]);
        let lacks: Vec<_> =
            job.connections.iter().map(|one| gaps::lacks(drivers, job, one)).collect();
        assert_eq!(lacks, [Some("edges of digital inputs on this MCU"), None, None]);
        let wires = file(&generate(job, ALL).unwrap(), "src/wiring.rs");
        assert!(wires.contains("lamp:") && !wires.contains("servo"), "{wires}");
    });
}

#[test]
fn an_unknown_hal_is_reported_with_the_known_ones() {
    with_job(SERVED, |job| {
        let error = Opened::new(job.profile.unwrap(), HALS).err();
        let expected = "unknown HAL `made-up`, expected one of `stm32`, `rp`, `nrf`, `esp`";
        assert_eq!(error.as_deref(), Some(expected));
        let reports = generate(job, HALS).unwrap_err();
        assert!(reports[0].message.contains(expected), "{reports:?}");
    });
}

/// Each HAL knows its own keys and refuses those of others.
#[test]
fn keys_of_another_hal_are_refused() {
    with_job(SERVED, |job| {
        let mut profile = job.profile.unwrap().clone();
        let refused = |profile: &TargetProfile| Opened::new(profile, ALL).err().unwrap_or_default();
        assert_eq!(refused(&profile), "");
        profile.own.file.insert("start".to_owned(), "boot2".into());
        assert!(refused(&profile).contains("start"), "{}", refused(&profile));
        profile.own.file.insert("hal".to_owned(), "rp".into());
        assert!(refused(&profile).contains("saadc_bits"), "{}", refused(&profile));
    });
}
