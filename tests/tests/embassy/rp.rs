//! RP2040 and RP2350 on Embassy: projects, what the compiler makes of them, and what is told instead of done.
//!
//! What needs cargo and its registry runs with `SENSEDSL_THOROUGH=1`, images are linked with `SENSEDSL_THOROUGH=2`.

use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_generate::target;
use sensedsl_tests::{TempDir, is_exhaustive, is_thorough, sensedsl, tree};

use super::{
    can_link, checked, is_told, linked, source, uf2_of, versions_are_those_of_the_lock_file,
    with_job,
};

/// Board, folder of its project, and triple of its core.
const BOARDS: [(&str, &str); 2] = [
    ("RASPBERRYPI_PICO", "thumbv6m-none-eabi"),
    ("RASPBERRYPI_PICO_2", "thumbv8m.main-none-eabihf"),
];

/// All that there is code for, on a board that is told first.
const KINDS: &str = r#" {
    target = embassy;
    sensor Light returns uint16 { id = 1; type = analog; pin = GP26; samples = 4; }
    sensor Pair returns uint16[2] { id = 2; type = analog; pin = [GP27, GP28]; median = 3; }
    sensor Range returns uint16 { id = 3; type = i2c; address = 0x70; register = 2; length = 2; sda = GP4; scl = GP5; }
    sensor Wheel returns uint32 { id = 4; type = icu; pin = GP7; }
    sensor Stick returns uint16 { id = 5; type = icu; mode = width; edge = falling; pin = GP9; }
    sensor Touch returns bool { id = 6; type = digital; pin = GP10; edge = rising; }
    sensor Bump returns bool { id = 7; type = digital; pin = GP11; debounce = 5 ms; }
    sensor Door returns bool { id = 8; type = digital; pin = GP13; pull = up; active = low; }
    sensor Rain returns uint32 { id = 9; type = digital; pin = GP12; edge = falling; debounce = 20 ms; }
    sensor Gyro returns uint16 { id = 10; type = spi; sck = GP18; miso = GP16; mosi = GP19; cs = GP17; read = [0]; length = 2; }
    sensor Place returns uint16 { id = 11; type = uart; unit = UART0; rx = GP1; tx = GP0; length = 2; }
    actuator Servo accepts uint16 { id = 12; type = pwm; pin = GP2; frequency = 50 Hz; failsafe = 5000; }
    actuator Lamps accepts uint16[2] { id = 13; type = pwm; pin = [GP20, GP21]; frequency = 1000 Hz; }
    actuator Relay accepts bool { id = 14; type = digital; pin = GP22; }
    sensor Near returns uint32 { id = 15; driver = hcsr04; divider = [5.6 kOhm, 10 kOhm]; prio = 2; }
}
"#;

/// What state machines and bridges are for.
const MACHINES: &str = r#" {
    target = embassy;
    sensor Wheels returns int32[2] { id = 1; type = encoder; a = [GP0, GP4]; b = [GP1, GP6]; }
    sensor Speed returns uint32 { id = 2; type = icu; mode = period; pin = GP14; }
    sensor Share returns uint16 { id = 3; type = icu; mode = duty; pin = GP16; }
    sensor Rate returns uint32 { id = 4; type = icu; mode = frequency; edge = falling; pin = GP18; }
    sensor Sticks returns uint16[8] { id = 5; driver = ppm; pin = GP20; }
    actuator Drive accepts int16 { id = 7; driver = drv8833; reading = speed_a; }
    actuator Winch accepts int16 { id = 8; driver = tb6612fng; reading = speed_a; failsafe = 0; }
}
"#;

/// The link over a serial port, and ports with one direction.
const PORTS: &str = r#" {
    target = embassy;
    link { transport = uart; unit = UART1; checksum = crc16; }
    sensor Place returns uint16 { id = 1; type = uart; unit = UART0; rx = GP1; length = 2; invert = true; }
    sensor Sticks returns uint16[2] { id = 2; type = icu; mode = width; prio = 3; }
}
"#;

/// Generates a design for a board; returns the folder of its project.
pub(super) fn generated(scratch: &TempDir, board: &str, design: &str) -> PathBuf {
    let file = scratch.write(&format!("{board}.sense"), format!("board {board}{design}"));
    let (file, out) = (file.display().to_string(), scratch.join(board).display().to_string());
    let _ = sensedsl(["generate", &file, "-q", "-o", &out]).run().exits(0);
    scratch.join(board).join("firmware").join(board)
}

/// A project has its memory, its start and what its HAL is reached by, and nothing of the other HAL.
#[test]
fn projects_are_whole() {
    let scratch = TempDir::new("embassy-rp");
    for (board, triple) in BOARDS {
        let project = tree(&generated(&scratch, board, KINDS));
        let text_of = |path: &str| String::from_utf8_lossy(&project[path]).into_owned();
        let lock = text_of("Cargo.lock");
        versions_are_those_of_the_lock_file(&text_of("Cargo.toml"), &lock, 6);
        versions_are_those_of_the_lock_file(&text_of("sense-embassy/Cargo.toml"), &lock, 12);
        let starts_with_boot2 = triple.starts_with("thumbv6m");
        let config = text_of(".cargo/config.toml");
        assert!(config.contains(&format!("target = \"{triple}\"")), "{config}");
        assert_eq!(config.contains("-Tlink-rp.x"), starts_with_boot2, "{config}");
        let memory = text_of("memory.x");
        assert_eq!(memory.contains("BOOT2"), starts_with_boot2, "{memory}");
        assert_eq!(memory.contains(".start_block"), !starts_with_boot2, "{memory}");
        let wiring = text_of("src/wiring.rs");
        for line in [
            "link: hal::usb::Driver::new(p.USB, Irqs),",
            "light: hal::adc::Channel::new_pin(p.PIN_26, Pull::None),",
            "Pwm::new_output_ab(p.PWM_SLICE2, p.PIN_20, p.PIN_21,",
            "led: Output::new(p.PIN_25, Level::Low),",
        ] {
            assert!(wiring.contains(line), "{line}\n{wiring}");
        }
        for (path, bytes) in &project {
            let text = String::from_utf8_lossy(bytes);
            let is_other = path.starts_with("src/") && text.contains("embassy_stm32");
            assert!(!is_other, "{path}");
        }
    }
}

/// One line a wire, by the HAL's names.
#[test]
fn every_wire_is_a_line() {
    let check = checked(&format!("board RASPBERRYPI_PICO{KINDS}"));
    let source = source(&check);
    let lines = [
        "analog::<_>(p.PIN_26);",
        "scl::<I2C0, _>(p.PIN_5);",
        "channel_b::<PWM_SLICE3, _>(p.PIN_7);",
        "channel_a::<PWM_SLICE2, _>(p.PIN_20);",
        "mosi::<SPI0, _>(p.PIN_19);",
        "uart_tx::<UART0, _>(p.PIN_0);",
        "pin(p.PIN_10);",
        "unit(p.USB);",
    ];
    for line in lines {
        assert_eq!(source.matches(line).count(), 1, "{line}\n{source}");
    }
    assert!(check.unjudged.is_empty(), "{:?}", check.unjudged);
}

/// Where a pin, a unit or a DMA channel is missing, the device is named, and there is no firmware without it.
#[test]
fn nothing_is_left_out_in_silence() {
    for (board, _) in BOARDS {
        with_job(&format!("board {board}{KINDS}"), None, is_told);
    }
}

/// What a slice cannot count, and edges that tasks cannot, are refused by name.
#[test]
fn what_cannot_be_counted_is_told() {
    let refused = |device: &str, word: &str| {
        let text = format!("board RASPBERRYPI_PICO {{ target = embassy; {device} }}");
        with_job(&text, None, |job| {
            let gaps = target::gaps(job);
            let own =
                gaps.iter().any(|gap| gap.code.name() == "E0501" && gap.message.contains(word));
            assert!(own, "{device}: {gaps:?}");
        });
    };
    let sensor = |rest: &str| format!("sensor Odd returns uint32 {{ id = 1; {rest} }}");
    refused(&sensor("type = icu; edge = both;"), "counts of both edges");
    refused(&sensor("type = digital; edge = both;"), "edges counted without");
}

/// What the dividers of a slice and of a state machine do not make.
#[test]
fn clocks_out_of_reach_are_told() {
    let refused = |device: &str, word: &str| {
        let text = format!("board RASPBERRYPI_PICO {{ target = embassy; {device} }}");
        with_job(&text, None, |job| {
            let told = target::of(job.profile.unwrap()).unwrap().generate(job).unwrap_err();
            assert!(told[0].message.contains(&format!("`Odd` needs {word}")), "{told:?}");
        });
    };
    refused("actuator Odd accepts uint16 { id = 1; type = pwm; frequency = 5 Hz; }", "5 pulses");
    let width = "sensor Odd returns uint32 { id = 1; type = icu; mode = width; unit = PWM4; resolution = 100 us; }";
    refused(width, "a resolution of 10000 Hz");
    let period =
        "sensor Odd returns uint32 { id = 1; type = icu; mode = period; resolution = 500 Hz; }";
    refused(period, "a resolution of 500 Hz");
}

/// The whole firmware is taken by the types of the HAL.
#[test]
fn projects_compile() {
    if !is_thorough() {
        return;
    }
    let scratch = TempDir::new("embassy-rp-check");
    let boards = BOARDS.iter().take(if is_exhaustive() { 2 } else { 1 });
    for (board, triple) in boards {
        for design in [KINDS, PORTS, MACHINES] {
            // Both have the same file name.
            compiles(&generated(&scratch, board, design), triple);
        }
    }
}

/// Checks a project for this computer.
fn compiles(project: &Path, triple: &str) {
    let target = sensedsl_tests::root().join("target/embassy-cache/rp");
    let mut cargo = Command::new("cargo");
    cargo.args(["check", "--locked", "--target", "x86_64-unknown-linux-gnu", "--target-dir"]);
    // The HAL names registers that the core's crate has for ARMv8-M alone.
    let flags = if triple.starts_with("thumbv8m") { "--cfg armv8m --cfg armv8m_main" } else { "" };
    cargo.arg(target).env("RUSTFLAGS", flags).env("CARGO_INCREMENTAL", "0");
    let output = cargo.current_dir(project).output().unwrap();
    let log = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && !log.contains("warning"), "{log}");
}

/// An image for each core begins as the boot loader of its chip wants it.
#[test]
fn images_link() {
    if !is_exhaustive() {
        return;
    }
    if !can_link("thumbv6m-none-eabi") {
        return;
    }
    let scratch = TempDir::new("embassy-rp-link");
    for (board, triple) in BOARDS {
        let project = generated(&scratch, board, KINDS);
        let elf = linked(&project, triple);
        let uf2 = std::fs::read(uf2_of(&project, &elf)).unwrap();
        let bytes = scratch.join("image.bin");
        let mut copy = Command::new("arm-none-eabi-objcopy");
        assert!(copy.args(["-O", "binary"]).args([&elf, &bytes]).status().unwrap().success());
        is_in_the_file(&uf2, &std::fs::read(bytes).unwrap(), triple);
        let sections = Command::new("arm-none-eabi-size").arg("-A").arg(elf).output().unwrap();
        let sections = String::from_utf8_lossy(&sections.stdout).into_owned();
        let address = |name: &str| -> Option<u32> {
            let line = sections.lines().find(|line| line.starts_with(name))?;
            line.split_whitespace().nth(2)?.parse().ok()
        };
        if triple.starts_with("thumbv6m") {
            assert_eq!(address(".boot2"), Some(0x1000_0000), "{sections}");
            assert_eq!(address(".vector_table"), Some(0x1000_0100), "{sections}");
        } else {
            assert_eq!(address(".vector_table"), Some(0x1000_0000), "{sections}");
            assert!(address(".start_block").unwrap() < 0x1000_1000, "{sections}");
        }
    }
}

/// A UF2 file has the bytes of the flash, read by the definition: magic, flags, address, size, number, count, family.
fn is_in_the_file(uf2: &[u8], flash: &[u8], triple: &str) {
    let family = if triple.starts_with("thumbv6m") { 0xE48B_FF56 } else { 0xE48B_FF59 };
    let mut blocks: Vec<(Vec<u32>, &[u8])> = Vec::new();
    for block in uf2.chunks(512) {
        let word = |at: usize| u32::from_le_bytes(block[at..at + 4].try_into().unwrap());
        assert_eq!((word(0), word(4), word(508)), (0x0A32_4655, 0x9E5D_5157, 0x0AB1_6F30));
        blocks.push(((2..8).map(|at| word(4 * at)).collect(), &block[32..288]));
    }
    if family == 0xE48B_FF59 {
        assert_eq!(blocks.remove(0).0, [0xA000, 0x10FF_FF00, 256, 0, 2, 0xE48B_FF57]);
    }
    let count = u32::try_from(blocks.len()).unwrap();
    let mut read: Vec<u8> = Vec::new();
    for (number, (words, payload)) in (0..).zip(blocks) {
        let address = 0x1000_0000 + 256 * number;
        assert_eq!(words, [0x2000, address, 256, number, count, family]);
        read.extend(payload);
    }
    assert!(read.len() - flash.len() < 256, "{} of {}", read.len(), flash.len());
    assert_eq!(read[..flash.len()], *flash);
    assert!(read[flash.len()..].iter().all(|byte| *byte == 0xFF));
}
