//! ESP32-C3 and C6: projects, images, and reports of what there is no code for. No emulator runs these chips, so images
//! are linked and inspected.

use std::path::PathBuf;
use std::process::Command;

use sensedsl_generate::target;
use sensedsl_tests::{TempDir, is_exhaustive, printed, sensedsl, tree};

use super::{
    can_link, is_told, linked, links_images, versions_are_those_of_the_lock_file, with_job,
};

/// All that there is code for, with the link over a serial port.
const KINDS: &str = include_str!("../../firmware/embassy/esp32c6.sense");

/// What a small board carries, with the link over USB.
const SMALL: &str = r#"board XIAO_ESP32C3 {
    target = embassy;
    sensor Light returns uint16 { id = 1; type = analog; }
    chip Env { driver = bme280; sensor Air returns int16 { id = 2; reading = temperature; } }
    sensor Door returns bool { id = 3; type = digital; edge = both; debounce = 5 ms; }
    actuator Servo accepts uint16 { id = 4; type = pwm; frequency = 50 Hz; }
    actuator Drive accepts int16 { id = 6; driver = drv8833; reading = speed_a; }
}
"#;

/// Board, design and the triple of its core.
const BOARDS: [(&str, &str, &str); 2] = [
    ("ESP32_C6_DEVKITC_1", KINDS, "riscv32imac-unknown-none-elf"),
    ("XIAO_ESP32C3", SMALL, "riscv32imc-unknown-none-elf"),
];

/// Generates a design for a board; returns the folder of its project.
fn generated(scratch: &TempDir, board: &str, design: &str) -> PathBuf {
    let file = scratch.write(&format!("{board}.sense"), design).display().to_string();
    let out = scratch.join(board);
    let _ = sensedsl(["generate", &file, "-q", "-o"]).arg(&out).run().exits(0);
    out.join("firmware").join(board)
}

/// A project has its start and what its HAL is reached by, and nothing of the other HALs.
#[test]
fn projects_are_whole() {
    let scratch = TempDir::new("embassy-esp");
    for (board, design, triple) in BOARDS {
        let project = tree(&generated(&scratch, board, design));
        let text_of = |path: &str| String::from_utf8_lossy(&project[path]).into_owned();
        let lock = text_of("Cargo.lock");
        versions_are_those_of_the_lock_file(&text_of("Cargo.toml"), &lock, 7);
        versions_are_those_of_the_lock_file(&text_of("sense-embassy/Cargo.toml"), &lock, 10);
        let config = text_of(".cargo/config.toml");
        assert!(config.contains(triple) && config.contains("espflash flash"), "{config}");
        assert!(text_of("src/main.rs").contains("esp_bootloader_esp_idf::esp_app_desc!();"));
        for (path, bytes) in &project {
            let text = String::from_utf8_lossy(bytes);
            let others = ["embassy_stm32", "embassy_rp", "embassy_nrf", "cortex_m"];
            let has_other = others.into_iter().any(|other| text.contains(other));
            assert!(!(path.starts_with("src/") && has_other), "{path}");
        }
    }
    let wiring = tree(&scratch.join("ESP32_C6_DEVKITC_1/firmware/ESP32_C6_DEVKITC_1/src"));
    let wiring = String::from_utf8_lossy(&wiring["wiring.rs"]).into_owned();
    for line in [
        "link: crate::rt::ports::port(p.UART0, p.GPIO17, p.GPIO16, 115200),",
        "adc1: crate::rt::converter::Converter::new(p.ADC1, 2),",
        "i2c0: crate::rt::i2c::bus(p.I2C0, 100000, p.GPIO0, p.GPIO1),",
        "crate::rt::uart::config(9600, 7, crate::rt::uart::Ones::Even, 1)),",
        "turns: crate::rt::pcnt::Counter::new(0, p.GPIO23.into(), p.GPIO5.into()),",
        "[Some((0, p.GPIO22.into())), None]) },",
    ] {
        assert!(wiring.contains(line), "{line}\n{wiring}");
    }
}

#[test]
fn nothing_is_left_out_in_silence() {
    for (_, design, _) in BOARDS {
        with_job(design, None, is_told);
    }
}

/// What there is no code for is refused by name.
#[test]
fn what_the_chips_lack_is_told() {
    for (device, word) in [
        (
            "sensor Odd returns uint32 { id = 1; type = digital; edge = both; }",
            "edges counted without",
        ),
        (
            "actuator Odd accepts int16 { id = 1; driver = tb6612fng; reading = speed_a; }",
            "H-bridges with direction pins",
        ),
    ] {
        let text = format!("board XIAO_ESP32C6 {{ target = embassy; {device} }}");
        with_job(&text, None, |job| {
            let gaps = target::gaps(job);
            let own =
                gaps.iter().any(|gap| gap.code.name() == "E0501" && gap.message.contains(word));
            assert!(own, "{device}: {gaps:?}");
        });
    }
}

/// An image is linked for the core, with the description that the boot loader looks for.
#[test]
fn images_link() {
    if !links_images("esp") {
        return;
    }
    let scratch = TempDir::new("embassy-esp-link");
    for (board, design, triple) in &BOARDS[..if is_exhaustive() { 2 } else { 1 }] {
        if !can_link(triple) {
            return;
        }
        let elf = linked(&generated(&scratch, board, design), triple);
        let sections =
            printed(Command::new("riscv64-unknown-elf-size").args(["-A", "-d"]).arg(&elf));
        let size = |name: &str| -> u32 {
            let line = sections.lines().find(|line| line.split_whitespace().next() == Some(name));
            line.unwrap_or_else(|| panic!("{sections}"))
                .split_whitespace()
                .nth(1)
                .unwrap()
                .parse()
                .unwrap()
        };
        assert_eq!(size(".flash.appdesc"), 256, "{sections}");
        // The record of a hanging task is kept across a reset.
        assert_eq!(size(".rtc_fast.persistent"), 8, "{sections}");
        assert!((20_000..200_000).contains(&size(".text")), "{sections}");
    }
}
