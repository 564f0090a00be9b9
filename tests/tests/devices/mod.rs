//! The core's device code in C, compared with plain definitions in Rust on random and hostile
//! input, under sanitizers.
//!
//! `tests/devices/main.c` answers each line with a line; it is compiled once and run in batches.

mod formulas;
mod messages;
mod numbers;
mod values;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use sensedsl_tests::{answered, files, has, is_thorough, root, run};

/// The program, or `None` without a compiler.
fn program() -> Option<&'static Path> {
    static PROGRAM: OnceLock<Option<PathBuf>> = OnceLock::new();
    PROGRAM.get_or_init(|| has("gcc").then(build)).as_deref()
}

fn build() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("devices");
    std::fs::create_dir_all(&folder).unwrap();
    let program = folder.join("devices");
    let core = root().join("crates/firmware-c/runtime");
    let mut command = Command::new("gcc");
    command.args(["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow"]);
    command.args(["-Werror", "-O1", "-g", "-fsanitize=address,undefined"]);
    command.arg("-fno-sanitize-recover=all").arg("-I").arg(&core);
    command.arg(root().join("tests/devices/main.c")).args(files(&core, "c"));
    run(command.arg("-o").arg(&program));
    program
}

/// The answer to each request, in order.
fn ask(program: &Path, requests: &[String]) -> Vec<String> {
    let output = answered(&mut Command::new(program), requests.join("\n") + "\n");
    let answers: Vec<_> = output.lines().map(str::to_owned).collect();
    assert_eq!(answers.len(), requests.len());
    answers
}

/// Sends all requests, and compares each answer with the wanted one.
fn check(cases: &[(String, String)]) {
    let Some(program) = program() else { return };
    let requests: Vec<_> = cases.iter().map(|(request, _)| request.clone()).collect();
    for ((request, wanted), answer) in cases.iter().zip(ask(program, &requests)) {
        assert_eq!(&answer, wanted, "{request}");
    }
}

/// The number of rounds; the variable is for long runs.
fn rounds(usual: usize) -> usize {
    let wanted = std::env::var("SENSEDSL_DEVICE_ROUNDS").ok();
    let usual = if is_thorough() { usual } else { usual / 8 };
    wanted.map_or(usual, |text| text.parse().expect("SENSEDSL_DEVICE_ROUNDS is a number"))
}

/// The scalar types in the order of the C enumeration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scalar {
    Bool,
    Unsigned(u32),
    Signed(u32),
    Float32,
    Float64,
}

const SCALARS: [Scalar; 11] = [
    Scalar::Bool,
    Scalar::Unsigned(8),
    Scalar::Signed(8),
    Scalar::Unsigned(16),
    Scalar::Signed(16),
    Scalar::Unsigned(32),
    Scalar::Signed(32),
    Scalar::Unsigned(64),
    Scalar::Signed(64),
    Scalar::Float32,
    Scalar::Float64,
];

impl Scalar {
    fn bytes(self) -> usize {
        match self {
            Self::Bool => 1,
            Self::Unsigned(bits) | Self::Signed(bits) => bits as usize / 8,
            Self::Float32 => 4,
            Self::Float64 => 8,
        }
    }

    /// The bits of a whole number in memory, saturated.
    fn store(self, number: i128) -> u64 {
        match self {
            Self::Bool => u64::from(number != 0),
            Self::Unsigned(bits) => number.clamp(0, (1 << bits) - 1) as u64,
            Self::Signed(bits) => {
                let number = number.clamp(-(1 << (bits - 1)), (1 << (bits - 1)) - 1);
                number as u64 & (u64::MAX >> (64 - bits))
            }
            Self::Float32 => u64::from((number as f32).to_bits()),
            Self::Float64 => (number as f64).to_bits(),
        }
    }

    /// The whole number that these bits represent.
    fn load(self, bits: u64) -> i128 {
        match self {
            Self::Bool | Self::Unsigned(_) => i128::from(bits),
            Self::Signed(size) => {
                let shift = 64 - size;
                i128::from(((bits << shift) as i64) >> shift)
            }
            Self::Float32 => f32::from_bits(bits as u32).round() as i128,
            Self::Float64 => f64::from_bits(bits).round() as i128,
        }
    }
}
