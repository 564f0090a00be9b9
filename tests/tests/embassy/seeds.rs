//! Mistakes in the wiring, put into the crate of `check --typecheck` and into a generated project, one at a time: which
//! does the Rust compiler refuse?
//!
//! The table is in `docs/seeded-mistakes.md`, written by `SENSEDSL_THOROUGH=2 SENSEDSL_BLESS=1 cargo test --workspace
//! --test all embassy::seeds`. With `SENSEDSL_THOROUGH=1` only the crate of the check is tried.

use std::path::Path;
use std::process::Command;

use sensedsl_session::{Ask, On, Workspace};
use sensedsl_tests::{Scratch, assert_section, is_exhaustive, is_thorough, root, sensedsl, tree};

use super::{Alone, KINDS, checked, source};

/// The board with wires of all kinds, and its link over USB.
fn bench() -> String {
    let text = KINDS.replace("    link { transport = uart; unit = USART2; }\n", "");
    assert!(text.len() < KINDS.len());
    text
}

/// Texts that are replaced wherever they stand, as whole words.
type Swaps = &'static [(&'static str, &'static str)];

/// What is wrong, in the crate of the check and in `wiring.rs` and `main.rs` of the project. Where a list is empty there
/// is nothing to get wrong.
type Seed = (&'static str, Swaps, Swaps);

const SEEDS: [Seed; 29] = [
    ("an analog pin without a converter", &[("PC1", "PD15")], &[("PC1", "PD15")]),
    ("a pin that the part does not have", &[("p.PD9", "p.PZ9")], &[("PD9", "PZ9")]),
    ("a pin that its package does not have", &[("p.PD9", "p.PG9")], &[("PD9", "PG9")]),
    ("one pin twice", &[("p.PD9", "p.PD0")], &[("p.PD9", "p.PD0")]),
    (
        "SCL and SDA swapped",
        &[("_>(p.PB6)", "_>(p.PBx)"), ("_>(p.PB7)", "_>(p.PB6)"), ("_>(p.PBx)", "_>(p.PB7)")],
        &[("p.PB6, p.PB7", "p.PB7, p.PB6")],
    ),
    ("another I2C bus", &[("I2C1", "I2C3")], &[("I2C1", "I2C3")]),
    (
        "D+ and D- swapped",
        &[("_>(p.PA11)", "_>(p.PAx)"), ("_>(p.PA12)", "_>(p.PA11)"), ("_>(p.PAx)", "_>(p.PA12)")],
        &[("p.PA12, p.PA11", "p.PA11, p.PA12")],
    ),
    (
        "RX and TX of CAN swapped",
        &[("_>(p.PD0)", "_>(p.PDx)"), ("_>(p.PD1)", "_>(p.PD0)"), ("_>(p.PDx)", "_>(p.PD1)")],
        &[("p.PD0, p.PD1", "p.PD1, p.PD0")],
    ),
    (
        "RX and TX of a serial port swapped",
        &[("_>(p.PC10)", "_>(p.PCx)"), ("_>(p.PC11)", "_>(p.PC10)"), ("_>(p.PCx)", "_>(p.PC11)")],
        &[("p.PC11, p.PC10", "p.PC10, p.PC11")],
    ),
    ("another serial port", &[("USART3", "USART6")], &[("USART3", "USART6")]),
    ("clock of SPI on a pin without it", &[("p.PB13", "p.PB12")], &[("p.PB13", "p.PB12")]),
    (
        "MISO and MOSI swapped",
        &[("_>(p.PB14)", "_>(p.PBx)"), ("_>(p.PB15)", "_>(p.PB14)"), ("_>(p.PBx)", "_>(p.PB15)")],
        &[("p.PB15, p.PB14", "p.PB14, p.PB15")],
    ),
    ("another SPI port", &[("SPI2", "SPI1")], &[("SPI2", "SPI1")]),
    ("a voltage on a pin without a DAC", &[("p.PA4", "p.PA6")], &[("p.PA4", "p.PA6")]),
    ("the other channel of the DAC", &[("p.PA4", "p.PA5")], &[("p.PA4", "p.PA5")]),
    ("pulses on a pin without the timer", &[("p.PE9", "p.PE7")], &[("p.PE9", "p.PE7")]),
    (
        "pulses on another channel",
        &[("channel::<TIM1, hal::timer::Ch1", "channel::<TIM1, hal::timer::Ch2")],
        &[(
            "Some(hal::timer::simple_pwm::PwmPin::new(p.PE9, OutputType::PushPull)), None,",
            "None, Some(hal::timer::simple_pwm::PwmPin::new(p.PE9, OutputType::PushPull)),",
        )],
    ),
    ("pulses of another timer", &[("TIM1", "TIM4")], &[("TIM1", "TIM4")]),
    ("a capture on a pin without the timer", &[("p.PC6", "p.PC10")], &[("p.PC6", "p.PC12")]),
    ("a capture by another timer", &[("TIM8", "TIM4")], &[("TIM8", "TIM4")]),
    (
        "the timer that the clock uses",
        &[("TIM8", "TIM5"), ("p.PC6", "p.PA0")],
        &[("TIM8", "TIM5"), ("TIM8_CC", "TIM5"), ("p.PC6", "p.PA0")],
    ),
    ("a track of an encoder on another pin", &[("p.PB4", "p.PB3")], &[("p.PB4", "p.PB3")]),
    (
        "tracks of an encoder swapped",
        &[("_>(p.PB4)", "_>(p.PBx)"), ("_>(p.PB5)", "_>(p.PB4)"), ("_>(p.PBx)", "_>(p.PB5)")],
        &[("p.PB4, p.PB5", "p.PB5, p.PB4")],
    ),
    ("an edge on the line of another pin", &[("EXTI6", "EXTI5")], &[("EXTI6", "EXTI5")]),
    (
        "two edges on one line",
        &[("p.PD7, p.EXTI7", "p.PE6, p.EXTI6")],
        &[("p.PD7, p.EXTI7", "p.PE6, p.EXTI6")],
    ),
    (
        "another stream of the controller",
        &[("DMA1_CH0", "DMA1_CH1")],
        &[("DMA1_CH0", "DMA1_CH1"), ("DMA1_STREAM0", "DMA1_STREAM1")],
    ),
    (
        "a stream of the other controller",
        &[("DMA1_CH0", "DMA2_CH0")],
        &[("DMA1_CH0", "DMA2_CH0"), ("DMA1_STREAM0", "DMA2_STREAM0")],
    ),
    (
        "an interrupt that nobody is bound to",
        &[],
        &[("    I2C1_ER => hal::i2c::ErrorInterruptHandler<I2C1>;\n", "")],
    ),
    ("another pin of the converter", &[("PC1", "PC2")], &[("PC1", "PC2")]),
];

/// What the types take, and who notices it.
const TAKEN: [(&str, &str); 4] = [
    ("the other channel of the DAC", "in the project: the HAL takes the channel from the pin"),
    ("another pin of the converter", "each pin is one of the converter's; a run notices it"),
    ("an encoder on TIM9", "the HAL has it for a timer with four channels; our profile refuses it"),
    ("periods on TIM10", "the HAL has it for a timer with four channels; our profile refuses it"),
];

/// Replaces whole words.
fn swapped(text: &str, swaps: Swaps) -> String {
    let is_word = |one: Option<char>| one.is_some_and(|one| one == '_' || one.is_alphanumeric());
    let mut text = text.to_owned();
    for (from, to) in swaps {
        let (mut done, mut rest) = (String::new(), text.as_str());
        let (starts_word, ends_word) =
            (is_word(from.chars().next()), is_word(from.chars().next_back()));
        while let Some(at) = rest.find(from) {
            let (before, after) = (&rest[..at], &rest[at + from.len()..]);
            done.push_str(before);
            let is_part = starts_word && is_word(done.chars().next_back())
                || ends_word && is_word(after.chars().next());
            done.push_str(if is_part { from } else { to });
            rest = after;
        }
        done.push_str(rest);
        text = done;
    }
    text
}

/// The compiler's first error; none where it takes everything.
fn refusal(folder: &Path, target: &Path, triple: Option<&str>) -> Option<String> {
    let mut cargo = Command::new("cargo");
    cargo.args(["check", "--locked", "--quiet", "--target-dir"]).arg(target);
    cargo.args(triple.map(|triple| ["--target", triple]).iter().flatten());
    let output = cargo.env_remove("RUSTFLAGS").current_dir(folder).output().unwrap();
    if output.status.success() {
        return None;
    }
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let code = said.split_once("error[").and_then(|(_, rest)| rest.split_once(']'));
    Some(code.unwrap_or_else(|| panic!("{said}")).0.to_owned())
}

/// STM32F1 moves the pins of a unit as a block.
const MOVED: &str = "board BLUEPILL_F103C8 { link { transport = none; }\n\
                     sensor A returns uint32 { id = 1; type = icu; pin = PB4; } }";
const MOVED_SEED: (&str, Swaps) =
    ("a block of pins that does not fit (STM32F1)", &[("AfioRemap<2>", "AfioRemap<3>")]);

/// What the crate of `check --typecheck` says of each mistake in a design.
fn of_the_check(text: &str, all: &[Swaps]) -> Vec<Option<Option<String>>> {
    let check = checked(text);
    let source = source(&check);
    let (folder, target) = (Scratch::new("seeds"), root().join("target/embassy-check"));
    for (path, file) in check.files.iter() {
        let _ = folder.write(path, &file.bytes);
    }
    let judge = |source: &str| {
        let _ = folder.write("src/lib.rs", source);
        refusal(folder.path(), &target, None)
    };
    assert_eq!(judge(&source), None, "the wiring is refused");
    let of = |swaps: Swaps| {
        let wrong = swapped(&source, swaps);
        assert!(wrong != source, "{swaps:?} is not in\n{source}");
        judge(&wrong)
    };
    all.iter().map(|swaps| (!swaps.is_empty()).then(|| of(swaps))).collect()
}

/// What the generated project says of each mistake.
fn of_the_project() -> Vec<Option<Option<String>>> {
    let scratch = Scratch::new("seeds-project");
    let file = scratch.write("bench.sense", bench()).display().to_string();
    let out = scratch.join("out").display().to_string();
    let call = ["generate", &file, "--target", "embassy", "--without", "host", "-q", "-o", &out];
    let _ = sensedsl(call).run().exits(0);
    let project = scratch.join("out/firmware/Bench");
    let target = root().join("target/embassy-host");
    let host = Command::new("rustc").args(["--print", "host-tuple"]).output().unwrap();
    let host = String::from_utf8(host.stdout).unwrap();
    let sources: Vec<(String, String)> = tree(&project.join("src"))
        .into_iter()
        .filter(|(path, _)| path == "wiring.rs" || path == "main.rs")
        .map(|(path, bytes)| (path, String::from_utf8(bytes).unwrap()))
        .collect();
    let judge = |swaps: Swaps| {
        let mut is_changed = swaps.is_empty();
        for (path, text) in &sources {
            let wrong = swapped(text, swaps);
            is_changed |= wrong != *text;
            std::fs::write(project.join("src").join(path), wrong).unwrap();
        }
        assert!(is_changed, "{swaps:?} is not in {}", sources[1].1);
        refusal(&project, &target, Some(host.trim()))
    };
    assert_eq!(judge(&[]), None, "the project is refused");
    SEEDS.iter().map(|(_, _, swaps)| (!swaps.is_empty()).then(|| judge(swaps))).collect()
}

fn cell(judged: &Option<Option<String>>) -> String {
    match judged {
        None => "-".to_owned(),
        Some(None) => "taken".to_owned(),
        Some(Some(code)) => code.clone(),
    }
}

/// The wiring compiles, and no mistake does but those that are known to.
#[test]
fn mistakes_do_not_compile() {
    if !is_thorough() {
        return;
    }
    let check = of_the_check(&bench(), &SEEDS.map(|(_, swaps, _)| swaps));
    let project = if is_exhaustive() { of_the_project() } else { vec![None; SEEDS.len()] };
    let mut table =
        "| mistake | `check --typecheck` | the project |\n| --- | --- | --- |\n".to_owned();
    for (((what, _, _), check), project) in SEEDS.iter().zip(&check).zip(&project) {
        table.push_str(&format!("| {what} | {} | {} |\n", cell(check), cell(project)));
        let is_taken = *check == Some(None) || *project == Some(None);
        assert!(!is_taken || TAKEN.iter().any(|one| one.0 == *what), "{what} compiles:\n{table}");
    }
    if is_exhaustive() {
        let (what, swaps) = MOVED_SEED;
        let judged = of_the_check(MOVED, &[swaps]).remove(0);
        assert_ne!(judged, Some(None), "{what} compiles");
        table.push_str(&format!("| {what} | {} | - |\n", cell(&judged)));
        let mut section = format!("{}{table}\nThe types take:\n", INTRO);
        for (what, why) in TAKEN {
            section.push_str(&format!("\n- **{what}**: {why}."));
        }
        section.push('\n');
        assert_section("docs/seeded-mistakes.md", HEADING, &section);
    }
}

const HEADING: &str = "In Rust, when it is compiled";

const INTRO: &str = "\
A board with wires of all kinds (STM32F407) is generated for Embassy. Each mistake is put into its `wiring.rs`, and
`main.rs` where it repeats a name, and into the crate of [`check --typecheck`](typecheck.md), as if our data were wrong;
then the compiler has its say. Named is its first error: E0277 is a pin, channel or stream that the unit does not have,
E0382 one that is taken twice, E0609 one that the chip does not have or that the clock has taken, E0271 and E0308 one
that does not fit beside another. A dash: there is nothing to get wrong. Written by `tests/tests/embassy/seeds.rs`.

";

/// Two mistakes that the types of the HAL take: an encoder on a timer that decodes none, and periods on a timer of one
/// channel. The profiles of both targets refuse them.
#[test]
fn what_types_take_the_profile_refuses() {
    let is_wired = |target: &str, device: &str| {
        let mut workspace = Workspace::default();
        let link = "link { transport = none; }";
        workspace.open("x.sense", format!("board B on STM32F407VGT6 {{ {link}\n{device}\n}}\n"));
        let on = On { board: None, target: Some(target) };
        workspace.snapshot("x.sense", on, &Alone).solve(&Ask::default()).wired().is_some()
    };
    let encoder =
        |pins: &str| format!("sensor A returns int32 {{ id = 1; type = encoder; {pins} }}");
    let period = |pin: &str| {
        format!("sensor A returns uint32 {{ id = 1; type = icu; mode = period; pin = {pin}; }}")
    };
    for target in ["chibios", "embassy"] {
        assert!(is_wired(target, &encoder("a = PB4; b = PB5;")), "{target}: TIM3");
        assert!(!is_wired(target, &encoder("a = PE5; b = PE6;")), "{target}: TIM9");
        assert!(is_wired(target, &period("PB4")), "{target}: TIM3");
        assert!(!is_wired(target, &period("PB8")), "{target}: TIM10");
    }
}
