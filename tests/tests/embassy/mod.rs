//! Embassy: what is generated for it, and wirings that the Rust compiler judges by the types of its HAL.
//!
//! What needs cargo and its registry runs with `SENSEDSL_THOROUGH=1`.

mod esp;
mod nrf;
mod rp;
mod rp_machines;
mod rp_runs;
mod seeds;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::PoisonError;

use sensedsl_firmware_embassy::{TypeCheck, is_judged, type_check};
use sensedsl_generate::target;
use sensedsl_job::{BoardJob, JobConnection, jobs};
use sensedsl_model::NoFiles;
use sensedsl_model::kind::KindName;
use sensedsl_session::{Ask, On, Workspace};
use sensedsl_tests::{
    TempDir, drawn, has, is_exhaustive, is_thorough, missing, printed, root, sensedsl, text, tree,
};

use crate::firmware::embassy::{FOLDER, is_newer_than_others};

/// A board with wires of all kinds.
const KINDS: &str = include_str!("../../firmware/designs/bench.sense");

/// Hands on the job of a text's first board.
pub(crate) fn with_job<T>(
    text: &str,
    target: Option<&str>,
    then: impl FnOnce(&BoardJob<'_>) -> T,
) -> T {
    let mut workspace = Workspace::default();
    workspace.open("x.sense", text.to_owned());
    let snapshot = workspace.snapshot("x.sense", On { board: None, target }, &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = answer.wired().unwrap_or_else(|| panic!("{:?}", answer.diagnostics));
    then(&jobs(design, wiring).next().unwrap())
}

fn checked(text: &str) -> TypeCheck {
    with_job(text, None, |job| type_check(job).unwrap())
}

fn source(check: &TypeCheck) -> String {
    String::from_utf8(check.files.get("src/lib.rs").unwrap().bytes.clone()).unwrap()
}

/// One line a wire, with the block of pins where a unit is moved as a whole.
#[test]
fn every_wire_is_a_line() {
    let check = checked(KINDS);
    let source = source(&check);
    let lines = [
        "analog::<ADC1, _>(p.PC1);",
        "scl::<I2C1, _>(p.PB6);",
        "channel::<TIM3, hal::timer::Ch1, _>(p.PB4);",
        "edge!(p.PD6, p.EXTI6);",
        "mosi::<SPI2, _>(p.PB15);",
        "pin(p.PD9);",
        "can_rx::<CAN1, _>(p.PD0);",
        "dac_out::<DAC1, hal::dac::Ch1, _>(p.PA4);",
        "uart_tx::<USART2, _>(p.PD5);",
    ];
    for line in lines {
        assert_eq!(source.matches(line).count(), 1, "{line}\n{source}");
    }
    assert!(check.unjudged.is_empty(), "{:?}", check.unjudged);
    for (number, judged) in &check.lines {
        let line = source.lines().nth(number - 1).unwrap();
        assert!(line.contains("(p.") && !judged.what.is_empty(), "{line}");
    }
    let moved = "board BLUEPILL_F103C8 { link { transport = none; }\n\
                 sensor A returns uint32 { id = 1; type = icu; pin = PB4; } }";
    let source = self::source(&checked(moved));
    assert!(
        source.contains("channel::<TIM3, hal::timer::Ch1, hal::gpio::AfioRemap<2>, _>(p.PB4)"),
        "{source}"
    );
}

/// A project has all of the runtime, and its versions are those of the lock file.
#[test]
fn a_project_is_whole() {
    let scratch = TempDir::new("embassy");
    let out = scratch.join("out").display().to_string();
    let file = root().join("examples/fig2.sense").display().to_string();
    let _ = sensedsl(["generate", &file, "--target", "embassy", "-q", "-o", &out]).run().exits(0);
    let project = tree(&scratch.join("out/firmware/STM32F4DiscoveryBoard"));
    let text_of = |path: &str| String::from_utf8_lossy(&project[path]).into_owned();
    for name in ["sense-embassy", "sense-rt"] {
        for (path, bytes) in tree(&root().join(format!("crates/{name}/src"))) {
            let copy = project.get(&format!("{name}/src/{path}"));
            assert_eq!(copy, Some(&bytes), "{name}: {path}: is it in sources.rs?");
        }
        features_are_those_of_the_crate(name, &text_of(&format!("{name}/Cargo.toml")));
    }
    let lock = text_of("Cargo.lock");
    versions_are_those_of_the_lock_file(&text_of("Cargo.toml"), &lock, 6);
    versions_are_those_of_the_lock_file(&text_of("sense-embassy/Cargo.toml"), &lock, 12);
    let wiring = text_of("src/wiring.rs");
    assert!(wiring.contains("ir_front: hal::adc::AdcChannel::degrade_adc(p.PB0),"), "{wiring}");
    assert!(
        wiring.contains("TIM3 => hal::timer::CaptureCompareInterruptHandler<TIM3>;"),
        "{wiring}"
    );
    assert!(text_of("src/main.rs").contains("prediv: PllPreDiv::DIV8,"));
    // What is the user's stays, and a second run finds the folder as it was left.
    let own = "out/firmware/STM32F4DiscoveryBoard/src/user/mod.rs";
    scratch.write(own, "// mine\n");
    let _ = sensedsl(["generate", &file, "--target", "embassy", "-q", "-o", &out]).run().exits(0);
    assert_eq!(std::fs::read_to_string(scratch.join(own)).unwrap(), "// mine\n");
}

/// Each crate of a manifest is told exactly.
fn versions_are_those_of_the_lock_file(manifest: &str, lock: &str, crates: usize) {
    let exact: Vec<&str> = manifest.lines().filter(|line| line.contains("\"=")).collect();
    assert_eq!(exact.len(), crates, "{manifest}");
    for line in exact {
        let name = line.split(' ').next().unwrap();
        let version = line.split("\"=").nth(1).unwrap().split('"').next().unwrap();
        let package = format!("name = \"{name}\"\nversion = \"{version}\"");
        assert!(lock.contains(&package), "{package}");
    }
}

/// A project turns on the features it uses, so its copy of a crate must have each feature that the crate has.
fn features_are_those_of_the_crate(name: &str, manifest: &str) {
    let features = |text: &str| -> Vec<String> {
        let (_, rest) = text.split_once("[features]\n").unwrap();
        let own = rest.lines().take_while(|line| !line.starts_with("[dep"));
        let names = own.filter_map(|line| Some(line.split_once(" = [")?.0.to_owned()));
        let mut own: Vec<String> = names.filter(|name| name != "default").collect();
        own.sort();
        own
    };
    let ours = features(&text(&format!("crates/{name}/Cargo.toml")));
    assert!(ours.len() > 10 && features(manifest) == ours, "{name}: {manifest}");
}

/// Wirings of the default target on boards of all families, judged as a user has them judged.
#[test]
fn wirings_of_other_targets_compile() {
    if !is_thorough() {
        return;
    }
    let design = |board: &str| {
        format!(
            "board {board} {{ link {{ transport = none; }}\n\
             sensor A returns uint16 {{ id = 1; type = analog; }}\n\
             sensor B returns uint16 {{ id = 2; type = i2c; address = 0x20; register = 0; length = 2; }}\n\
             sensor C returns uint32 {{ id = 3; type = icu; }}\n\
             sensor D returns bool {{ id = 4; type = digital; edge = both; }}\n\
             sensor E returns uint16 {{ id = 5; type = spi; read = [0]; length = 2; }}\n\
             actuator F accepts uint16 {{ id = 6; type = pwm; }} }}\n"
        )
    };
    let boards = [
        "NUCLEO_F072RB",
        "BLUEPILL_F103C8",
        "NUCLEO_F303RE",
        "NUCLEO_F446RE",
        "NUCLEO_F746ZG",
        "NUCLEO_G071RB",
        "NUCLEO_G474RE",
        "NUCLEO_H743ZI2",
        "NUCLEO_L476RG",
    ];
    let cache = root().join("target/embassy-cache").display().to_string();
    let boards = boards.iter().step_by(if is_exhaustive() { 1 } else { 4 });
    for board in boards {
        let call = sensedsl(["check", "--typecheck", "-"]).env("XDG_CACHE_HOME", &cache);
        let ran = call.stdin(design(board)).run().exits(0);
        assert!(ran.stderr.contains("the compiler takes all"), "{board}: {}", ran.stderr);
    }
}

/// A compiler that comes with the source of its core library.
const RUSTC: &str = "/usr/bin/rustc";

/// The linker of a core. Each is that of the compilers for it.
fn linker(triple: &str) -> &'static str {
    if triple.starts_with("riscv") { "riscv64-unknown-elf-ld" } else { "arm-none-eabi-ld" }
}

/// Whether this run links images for a HAL beside that of STM32: a usual run does for one, which the seed draws.
fn links_images(hal: &str) -> bool {
    is_thorough() && drawn("HALs of images", &["esp", "nrf"], 1).contains(&&hal)
}

fn can_link(triple: &str) -> bool {
    let can = Path::new(RUSTC).exists() && has(linker(triple));
    if !can {
        missing(&format!("rustc-web with rust-web-src, and {}", linker(triple)));
    }
    can
}

/// The image of a project, which is built for its core without a warning. It is where `build` leaves it.
fn linked(project: &Path, triple: &str) -> PathBuf {
    // A test that failed there leaves nothing that others build on.
    let _building = FOLDER.lock().unwrap_or_else(PoisonError::into_inner);
    let target = root().join("target/embassy-build");
    is_newer_than_others(project);
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "--release", "-Zbuild-std=core", "--locked", "--target-dir"]).arg(&target);
    let variable = triple.to_uppercase().replace(['-', '.'], "_");
    cargo.env(format!("CARGO_TARGET_{variable}_LINKER"), linker(triple));
    if triple.starts_with("riscv32") {
        // The linker is that of 64 bits.
        let flags = format!("target.{triple}.rustflags=['-Clink-arg=-melf32lriscv']");
        cargo.args(["--config", &flags]);
    }
    cargo.env("RUSTC_BOOTSTRAP", "1").env("RUSTC", RUSTC).env_remove("RUSTFLAGS");
    let output = cargo.current_dir(project).output().unwrap();
    let log = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{log}");
    assert!(!log.contains("warning"), "{log}");
    let image = format!("{triple}/release/firmware");
    let own = project.join("target").join(&image);
    std::fs::create_dir_all(own.parent().unwrap()).unwrap();
    std::fs::copy(target.join(&image), &own).unwrap();
    own
}

/// The UF2 file that `build` makes of a project's image, which is built already.
fn uf2_of(project: &Path, elf: &Path) -> PathBuf {
    let project = project.display().to_string();
    let call = sensedsl(["build", &project]).env("CARGO", "true");
    let _ = call.env("CARGO_UNSTABLE_BUILD_STD", "core").run().exits(0);
    elf.with_extension("uf2")
}

/// Fig. 2 is built for the board, and small.
#[test]
fn fig2_builds() {
    // Its program runs elsewhere, put together in less time.
    if !is_exhaustive() {
        return;
    }
    if !can_link("thumbv7em-none-eabihf") {
        return;
    }
    let scratch = TempDir::new("embassy-fig2");
    let out = scratch.join("out").display().to_string();
    let file = root().join("examples/fig2.sense").display().to_string();
    let _ = sensedsl(["generate", &file, "--target", "embassy", "-q", "-o", &out]).run().exits(0);
    let elf = linked(&scratch.join("out/firmware/STM32F4DiscoveryBoard"), "thumbv7em-none-eabihf");
    let size = printed(Command::new("arm-none-eabi-size").arg(elf));
    let bytes: u32 =
        size.lines().nth(1).unwrap().split_whitespace().next().unwrap().parse().unwrap();
    assert!((8_000..39_000).contains(&bytes), "{size}");
}

/// `cargo xtask typecheck --boards NAME --write` writes the row of a board; none of them may be refused.
#[test]
fn boards_that_were_judged_are_taken() {
    let page = text("docs/typecheck.md");
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| ")).skip(2).collect();
    assert!(rows.len() > 50);
    for row in rows {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let board = sensedsl_board::catalog::find(cells[0]).unwrap();
        assert!(is_judged(board.mcu) && board.mcu == cells[1], "{row}");
        let lines: u32 = cells[3].parse().unwrap();
        assert!(lines > 5, "{row}");
    }
}

/// Whatever a device's code is made of: where it is missing the device is named, and there is no firmware without it.
#[test]
fn nothing_is_left_out_in_silence() {
    let kinds = std::fs::read_to_string(root().join("examples/all_kinds.sense")).unwrap();
    with_job(&kinds, Some("embassy"), |job| {
        is_told(job);
        no_interrupt(job, &["Heading", "Angle", "Speed", "Drops", "Ahead", "Torque"]);
    });
    with_job(MORE, Some("embassy"), |job| {
        is_told(job);
        no_interrupt(job, &["Near"]);
    });
}

/// The same of the other target: a wire or a port that no driver takes is told.
#[test]
fn nothing_is_left_out_in_silence_on_chibios() {
    let kinds = std::fs::read_to_string(root().join("examples/all_kinds.sense")).unwrap();
    with_job(&kinds, Some("chibios"), |job| {
        let target = target::of(job.profile.unwrap()).unwrap();
        assert!(target.generate(job).is_ok(), "{:?}", target.generate(job));
        let mut changed = 0;
        for (index, one) in job.connections.iter().enumerate() {
            let kind = one.connection.kind.name();
            let has_port = [KindName::I2c, KindName::Spi, KindName::Uart, KindName::Can];
            if has_port.contains(&kind) {
                let mut less = job.clone();
                less.connections[index].unit = None;
                let told = target.generate(&less).unwrap_err();
                let name = format!("`{}` needs", one.part.name.value);
                assert!(told.iter().any(|one| one.message.contains(&name)), "{told:?}");
                changed += 1;
            }
        }
        assert!(changed > 3);
    });
}

/// A part that is on two buses has a table for each, and what only the whole part has is told.
#[test]
fn a_part_on_two_buses_has_two_tables() {
    let design = |start: &str| {
        format!(
            "driver Pair {{
 connection accel for i2c {{ address = 0x19; }}
 \
             connection gyro for spi {{ mode = 3; clock = 1 MHz; }}
 \
             connection magnet for i2c {{ address = 0x1E; }}
 {start}\
             reading A returns uint8 {{ via = accel; register = 1; }}
 \
             reading G returns uint8 {{ via = gyro; register = 2; }}
 \
             reading M returns uint8 {{ via = magnet; register = 3; }}
}}
\
             board B on STM32F407VGT6 {{ link {{ transport = uart; }} chip Imu {{ driver = Pair; }} }}
"
        )
    };
    for name in ["chibios", "embassy"] {
        with_job(&design(""), Some(name), |job| {
            let buses = &job.parts[0].plan.buses;
            let tables: Vec<(&str, u8, &[u8])> = buses
                .iter()
                .map(|bus| (bus.prefix.as_str(), bus.address, &*bus.transfers[0].select))
                .collect();
            let wanted: [(&str, u8, &[u8]); 3] =
                [("imu_accel", 0x19, &[1]), ("imu_gyro", 0, &[2]), ("imu_magnet", 0x1E, &[3])];
            assert_eq!(tables, wanted);
            assert!(target::gaps(job).is_empty(), "{:?}", target::gaps(job));
        });
        with_job(
            &design(
                "init = [[1, 2]];
",
            ),
            Some(name),
            |job| {
                let gaps = target::gaps(job);
                assert!(gaps.iter().any(|gap| gap.message.contains("on two buses")), "{gaps:?}");
            },
        );
    }
}

/// Controllers with a memory for messages: each has its two interrupts, a clock that its bit is made of, and what the
/// firmware sets of that clock. Those with banks share them.
#[test]
fn controllers_of_all_sorts_are_started() {
    // The bit is a divider, with steps before and after the sample.
    let cases: [(&str, &[&str], [u8; 3], &str); 8] = [
        ("STM32C092RCT6", &["FDCAN1"], [6, 13, 2], ""),
        ("STM32G0B1RET6", &["FDCAN1", "FDCAN2"], [8, 13, 2], ""),
        (
            "STM32G474RET6",
            &["FDCAN1", "FDCAN2", "FDCAN3"],
            [17, 16, 3],
            "mux.fdcansel = mux::Fdcansel::PCLK1",
        ),
        (
            "STM32H563ZIT6",
            &["FDCAN1", "FDCAN2"],
            [5, 16, 3],
            "mux.fdcan12sel = mux::Fdcansel::PLL1_Q",
        ),
        (
            "STM32H743ZIT6",
            &["FDCAN1", "FDCAN2"],
            [5, 13, 2],
            "mux.fdcansel = mux::Fdcansel::PLL1_Q",
        ),
        ("STM32U575ZIT6", &["FDCAN1"], [5, 13, 2], "mux.fdcan1sel = mux::Fdcansel::PLL1_Q"),
        ("STM32F105RCT6", &["CAN1", "CAN2"], [1, 13, 2], "registers: hal::pac::CAN1, first: 14"),
        ("STM32L496ZGT6", &["CAN2"], [10, 13, 2], "hal::rcc::enable_and_reset::<CAN1>();"),
    ];
    for (mcu, units, [divider, before, after], also) in cases {
        let bit = format!("divider: {divider}, before: {before}, after: {after}");
        let has_memory = units[0].starts_with("FD");
        let handler = if has_memory { "IT0InterruptHandler" } else { "Rx0InterruptHandler" };
        let device = |(at, unit): (usize, &&str)| {
            format!(
                "sensor S{at} returns uint8 {{ type = can; unit = {unit}; bitrate = 500 kHz; frame = 1; }}\n"
            )
        };
        let devices: String = units.iter().enumerate().map(device).collect();
        let text = format!("board B on {mcu} {{ link {{ transport = uart; }}\n{devices}}}\n");
        with_job(&text, Some("embassy"), |job| {
            let files = target::of(job.profile.unwrap()).unwrap().generate(job).unwrap();
            let read =
                |path: &str| String::from_utf8(files.get(path).unwrap().bytes.clone()).unwrap();
            let (main, wiring) = (read("src/main.rs"), read("src/wiring.rs"));
            assert_eq!(main.matches(&bit).count(), units.len(), "{mcu}: {main}");
            assert!(main.contains(also), "{mcu}: {main}");
            for unit in units {
                assert!(
                    wiring.contains(&format!("hal::can::{handler}<{unit}>")),
                    "{mcu}: {wiring}"
                );
            }
        });
    }
}

/// The HAL turns the interrupt of STM32F1's converters on, and no type asks for its handler. It does not make the pin
/// analog.
#[test]
fn converters_that_interrupt_have_a_handler_and_analog_pins() {
    let text =
        "board BLUEPILL_F103C8 { sensor Light returns uint16 { type = analog; pin = PA5; } }";
    with_job(text, Some("embassy"), |job| {
        let files = target::of(job.profile.unwrap()).unwrap().generate(job).unwrap();
        let wiring = &files.get("src/wiring.rs").unwrap().bytes;
        let wiring = String::from_utf8_lossy(wiring);
        assert!(wiring.contains("ADC1_2 => hal::adc::InterruptHandler<ADC1>;"), "{wiring}");
        let makes = "let mut pin = p.PA5; drop(hal::gpio::Flex::new(pin.reborrow())); pin";
        assert!(wiring.contains(makes), "{wiring}");
    });
}

/// What else there is of several wires.
const MORE: &str = include_str!("../../firmware/designs/more.sense");

/// Generates the firmware without the interrupts of its profile.
fn no_interrupt(job: &BoardJob<'_>, names: &[&str]) {
    let mut profile = job.profile.unwrap().clone();
    profile.own.file.get_mut("interrupts").unwrap().as_array_mut().unwrap().clear();
    let less = BoardJob { profile: Some(&profile), ..job.clone() };
    let told = target::of(&profile).unwrap().generate(&less).unwrap_err();
    for name in names {
        let is_told = told.iter().any(|one| one.message.contains(&format!("`{name}` needs")));
        assert!(is_told, "{name}: {told:?}");
    }
}

/// Generates the firmware without the pins, the unit or the DMA of each wire.
fn is_told(job: &BoardJob<'_>) {
    let target = target::of(job.profile.unwrap()).unwrap();
    assert!(
        target.generate(job).is_ok() && target::gaps(job).is_empty(),
        "{:?}",
        target.generate(job)
    );
    for (index, one) in job.connections.iter().enumerate() {
        let is_shared = |other: &JobConnection<'_>| one.unit.is_some() && other.unit == one.unit;
        let own: Vec<usize> = (0..job.connections.len())
            .filter(|at| *at == index || is_shared(&job.connections[*at]))
            .collect();
        let without = |change: fn(&mut JobConnection<'_>)| {
            let mut less = job.clone();
            own.iter().for_each(|at| change(&mut less.connections[*at]));
            let told = target.generate(&less).unwrap_err();
            let told: Vec<String> = told.into_iter().map(|one| one.message).collect();
            let name = &job.connections[own[0]].part.name.value;
            assert!(told.iter().any(|one| one.contains(&format!("`{name}` needs"))), "{told:?}");
        };
        without(|wire| wire.pads.clear());
        if one.unit.is_some() {
            without(|wire| wire.unit = None);
        }
        if !one.streams.is_empty() {
            without(|wire| wire.streams.clear());
        }
    }
}

/// The clock needs a timer, too.
#[test]
fn devices_that_take_all_timers_are_told() {
    let kinds = std::fs::read_to_string(root().join("examples/all_kinds.sense")).unwrap();
    with_job(&kinds, Some("embassy"), |job| {
        let mut profile = job.profile.unwrap().clone();
        let is_taken = |timer: &String| job.connections.iter().any(|one| one.unit == Some(timer));
        profile.kernel.timers.retain(is_taken);
        let less = BoardJob { profile: Some(&profile), ..job.clone() };
        let told = target::of(&profile).unwrap().generate(&less).unwrap_err();
        assert!(told[0].message.contains("no timer for Embassy's clock"), "{told:?}");
    });
}

/// The clock of a bus is that of its slowest part, and no faster than the unit: one of the first sort makes 400 kHz.
#[test]
fn a_bus_is_no_faster_than_its_unit() {
    for (mcu, hz) in [
        ("STM32F407VGT6", 400_000),
        ("STM32F103C8T6", 400_000),
        ("STM32F303RET6", 1_000_000),
        ("STM32G474RET6", 1_000_000),
    ] {
        let design = format!(
            "board B on {mcu} {{ link {{ transport = uart; }}
chip Servos {{ driver = pca9685; actuator Pan accepts uint16 {{ reading = output0; }} }} }}"
        );
        with_job(&design, Some("embassy"), |job| {
            let files = target::of(job.profile.unwrap()).unwrap().generate(job).unwrap();
            let wiring = String::from_utf8(files.get("src/wiring.rs").unwrap().bytes.clone());
            let wiring = wiring.unwrap();
            assert!(wiring.contains(&format!("i2c::config({hz})")), "{mcu}: {wiring}");
        });
    }
}
