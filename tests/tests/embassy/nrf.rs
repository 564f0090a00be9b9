//! nRF52 on Embassy: projects, images, and reports of what there is no code for. No emulator runs these chips, so images
//! are linked and inspected.
//!
//! Some images are linked with `SENSEDSL_THOROUGH=1`, all with `SENSEDSL_THOROUGH=2`.

use std::path::PathBuf;
use std::process::Command;

use sensedsl_generate::target;
use sensedsl_tests::{TempDir, is_exhaustive, printed, sensedsl, tree};

use super::{
    can_link, checked, is_told, linked, links_images, source, uf2_of,
    versions_are_those_of_the_lock_file, with_job,
};

/// All that there is code for, with the link over a serial port.
const KINDS: &str = include_str!("../../firmware/embassy/nrf52840.sense");

/// What every board carries.
const SMALL: &str = r#" {
    target = embassy;
    sensor Light returns uint16 { id = 1; type = analog; }
    chip Env { driver = bme280; sensor Air returns int16 { id = 2; reading = temperature; } }
    sensor Stick returns uint16 { id = 3; type = icu; mode = duty; }
    actuator Servo accepts uint16 { id = 4; type = pwm; frequency = 50 Hz; }
    actuator Lamp accepts bool { id = 5; type = digital; }
    actuator Drive accepts int16 { id = 6; driver = drv8833; reading = speed_a; }
}
"#;

/// Boards with each chip, with and without a boot loader: name, design, where its program begins.
fn boards() -> [(&'static str, String, u32); 4] {
    let small = |board: &'static str, from| (board, format!("board {board}{SMALL}"), from);
    [
        ("NRF52840_DK", KINDS.to_owned(), 0),
        small("XIAO_NRF52840", 0x0002_7000),
        small("MICROBIT_V2", 0),
        small("FEATHER_NRF52832", 0),
    ]
}

/// Generates a design for a board; returns the folder of its project.
fn generated(scratch: &TempDir, board: &str, design: &str) -> PathBuf {
    let file = scratch.write(&format!("{board}.sense"), design).display().to_string();
    let out = scratch.join(board);
    let _ = sensedsl(["generate", &file, "-q", "-o"]).arg(&out).run().exits(0);
    out.join("firmware").join(board)
}

/// A project has its memory, its start and what its HAL is reached by, and nothing of the other HALs.
#[test]
fn projects_are_whole() {
    let scratch = TempDir::new("embassy-nrf");
    let project = tree(&generated(&scratch, "NRF52840_DK", KINDS));
    let text_of = |path: &str| String::from_utf8_lossy(&project[path]).into_owned();
    let lock = text_of("Cargo.lock");
    versions_are_those_of_the_lock_file(&text_of("Cargo.toml"), &lock, 6);
    versions_are_those_of_the_lock_file(&text_of("sense-embassy/Cargo.toml"), &lock, 12);
    assert!(text_of("Cargo.toml").contains("tick-hz-32_768"));
    assert!(text_of("memory.x").contains("ORIGIN = 0x00000000, LENGTH = 1024K"));
    let wiring = text_of("src/wiring.rs");
    for line in [
        "light: hal::saadc::Input::degrade_saadc(p.P0_03),",
        "hal::twim::Twim::new(p.TWISPI0, Irqs, p.P0_26, p.P0_27, crate::rt::i2c::config(100000), COPY.take())",
        "wheel: crate::rt::timer::Count::new(p.TIMER",
        "hal::pwm::SimplePwm::new_2ch(p.PWM",
        "has_parity: true, stop_bits: 1",
        "turns: crate::rt::qdec::Qdec::new(p.QDEC, p.P0_29.into(), p.P0_30.into()),",
        "led: Output::new(p.P0_13, Level::High, OutputDrive::Standard),",
    ] {
        assert!(wiring.contains(line), "{line}\n{wiring}");
    }
    for (path, bytes) in &project {
        let text = String::from_utf8_lossy(bytes);
        let is_other = path.starts_with("src/")
            && (text.contains("embassy_stm32") || text.contains("embassy_rp"));
        assert!(!is_other, "{path}");
    }
}

/// One line a wire, by the HAL's names.
#[test]
fn every_wire_is_a_line() {
    let check = checked(KINDS);
    let source = source(&check);
    let lines = [
        "analog::<_>(p.P0_03);",
        "i2c::<TWISPI0, _>(p.P0_27);",
        "spi::<SPI2, _>(p.P1_06);",
        "serial::<UARTE1, _>(p.P1_12);",
        "decodes::<QDEC, _>(p.P0_29);",
        "pin(p.P1_04);",
        "unit(p.SAADC);",
    ];
    for line in lines {
        assert_eq!(source.matches(line).count(), 1, "{line}\n{source}");
    }
    assert!(check.unjudged.is_empty(), "{:?}", check.unjudged);
}

#[test]
fn nothing_is_left_out_in_silence() {
    for (_, design, _) in boards() {
        with_job(&design, None, is_told);
    }
}

/// What a port cannot do, and edges that tasks cannot count, are refused by name.
#[test]
fn what_the_chips_lack_is_told() {
    let refused = |board: &str, device: &str, word: &str| {
        let text = format!("board {board} {{ target = embassy; {device} }}");
        with_job(&text, None, |job| {
            let gaps = target::gaps(job);
            let own =
                gaps.iter().any(|gap| gap.code.name() == "E0501" && gap.message.contains(word));
            assert!(own, "{device}: {gaps:?}");
        });
    };
    let port = |rest: &str| {
        format!("sensor Odd returns uint16 {{ id = 1; type = uart; length = 2; {rest} }}")
    };
    refused("XIAO_NRF52840", &port("frame = \"8O1\";"), "odd parity");
    refused("XIAO_NRF52840", &port("frame = \"7E1\";"), "seven data bits");
    let two = port("frame = \"8N2\";");
    refused("FEATHER_NRF52832", &format!("link {{ transport = none; }} {two}"), "two stop bits");
    let counted = "sensor Odd returns uint32 { id = 1; type = digital; edge = both; }";
    refused("XIAO_NRF52840", counted, "edges counted without");
    let bridge = "actuator Odd accepts int16 { id = 1; driver = tb6612fng; reading = speed_a; }";
    refused("XIAO_NRF52840", bridge, "H-bridges with direction pins");
}

/// An image begins where the boot loader of its board leaves room for it, and a UF2 file says the same.
#[test]
fn images_link() {
    if !links_images("nrf") {
        return;
    }
    if !can_link("thumbv7em-none-eabihf") {
        return;
    }
    let scratch = TempDir::new("embassy-nrf-link");
    for (board, design, from) in &boards()[..if is_exhaustive() { 4 } else { 2 }] {
        let project = generated(&scratch, board, design);
        let elf = linked(&project, "thumbv7em-none-eabihf");
        let sections = printed(Command::new("arm-none-eabi-size").args(["-A", "-d"]).arg(&elf));
        let line = sections.lines().find(|line| line.starts_with(".vector_table")).unwrap();
        let address: u32 = line.split_whitespace().nth(2).unwrap().parse().unwrap();
        assert_eq!(address, *from, "{sections}");
        if *from > 0 {
            let uf2 = std::fs::read(uf2_of(&project, &elf)).unwrap();
            let word = |at: usize| u32::from_le_bytes(uf2[at..at + 4].try_into().unwrap());
            assert_eq!((word(0), word(12), word(28)), (0x0A32_4655, *from, 0xADA5_2840));
        }
    }
}
