//! `sensedsl doctor`: what this machine has of what the tool calls, and what to install for what somebody wants to do.
//!
//! Nothing here is needed to wire, check, simulate or watch: each purpose lists what it needs beyond that.

use std::path::PathBuf;
use std::process::{Command, Stdio};

use anyhow::Result;
use sensedsl_board::profile::full_name;
use sensedsl_diagnostics::{Diagnostic, SourceMap, Span, visible};
use sensedsl_host::port::{OpenError, Port, usb_ports};
use serde_json::{Value, json};

use super::monitor::cure;
use crate::cli::{DoctorArgs, DoctorFormat, Purpose};
use crate::files::shown;
use crate::firmware::{self, arduino, cargo, drive, probe};
use crate::status::Status;
use crate::terminal::Terminal;

/// The speed at which a port is opened to see whether it may be.
const BAUD: u32 = 115_200;
/// The processors for which Embassy's programs are built, with the MCUs that have them.
const CORES: [(&str, &str); 7] = [
    ("thumbv6m-none-eabi", "STM32 C0, F0, G0, L0, U0; RP2040"),
    ("thumbv7m-none-eabi", "STM32 F1, L1"),
    ("thumbv7em-none-eabi", "STM32 WL"),
    ("thumbv7em-none-eabihf", "STM32 F3, F4, F7, G4, H7, L4, WB; nRF52"),
    ("thumbv8m.main-none-eabihf", "STM32 H5, L5, U5; RP2350"),
    ("riscv32imc-unknown-none-elf", "ESP32-C3"),
    ("riscv32imac-unknown-none-elf", "ESP32-C6"),
];

/// Something that a purpose needs or can use.
struct Item {
    name: String,
    state: State,
}

enum State {
    /// It is there, in words: its version, or where it is.
    There(String),
    /// It is not there, and nothing else takes its place: why, and what helps.
    Missing(String, String),
    /// It is not there, and something else may take its place, or only some boards need it: what it is good for.
    Absent(String),
}

/// A purpose, and how far the machine serves it.
struct Finding {
    purpose: Purpose,
    items: Vec<Item>,
    /// Whether all that is needed is there.
    is_ready: bool,
}

pub(crate) fn run(args: &DoctorArgs, terminal: &Terminal) -> Result<Status> {
    let all = if args.purposes.is_empty() { &Purpose::ALL[..] } else { &args.purposes };
    let findings: Vec<Finding> = all.iter().map(|purpose| find(*purpose)).collect();
    match args.format {
        DoctorFormat::Human => terminal.result(&table(&findings))?,
        DoctorFormat::Json => terminal.result(&format!("{:#}\n", json(&findings)))?,
    }
    // Who names no purpose asks what there is, and there is always something.
    let is_ready = args.purposes.is_empty() || findings.iter().all(|one| one.is_ready);
    Ok(if is_ready { Status::Done } else { Status::Misused })
}

fn find(purpose: Purpose) -> Finding {
    let items = match purpose {
        Purpose::Chibios => chibios(),
        Purpose::Embassy => embassy(),
        Purpose::Arduino => arduino(),
        Purpose::Flash => flash(),
        Purpose::Boards => boards(),
        Purpose::Hosts => hosts(),
    };
    let lacks = items.iter().any(|one| matches!(one.state, State::Missing(..)));
    let is_any = items.iter().any(|one| matches!(one.state, State::There(_)));
    Finding { purpose, is_ready: !lacks && is_any, items }
}

/// A place for the diagnostics of others, whose texts are shown here.
fn nowhere() -> Span {
    Span::new(SourceMap::default().add("doctor", ""), 0..0)
}

fn missing(why: &Diagnostic) -> State {
    State::Missing(why.message.clone(), why.help.clone().unwrap_or_default())
}

fn item(name: impl Into<String>, state: State) -> Item {
    Item { name: name.into(), state }
}

/// The first line that a program prints, by these arguments; `None` if there is no such program.
fn version(program: &str, arguments: &[&str]) -> Option<String> {
    let mut command = Command::new(program);
    let output = command.args(arguments).stdin(Stdio::null()).output().ok()?;
    let text = if output.stdout.is_empty() { output.stderr } else { output.stdout };
    let text = String::from_utf8_lossy(&text).into_owned();
    output.status.success().then(|| text.lines().next().unwrap_or_default().trim().to_owned())
}

fn arduino() -> Vec<Item> {
    let builder = match arduino::builder(nowhere()) {
        Ok(arduino::Builder::Cli) => {
            let cli = version("arduino-cli", &["version"]).unwrap_or_default();
            State::There(format!("{cli}, with arduino:avr"))
        }
        Ok(arduino::Builder::Make(_, core)) => {
            let compiler = version("avr-gcc", &["-dumpversion"]).unwrap_or_default();
            State::There(format!("avr-gcc {compiler}, the core at {}", shown(&core)))
        }
        Err(why) => missing(&why),
    };
    let writer = match arduino::writer(nowhere()) {
        Ok(name) => State::There(name.to_owned()),
        Err(why) => missing(&why),
    };
    vec![item("compiler, core", builder), item("programmer", writer)]
}

fn chibios() -> Vec<Item> {
    let at = nowhere();
    let tools = match firmware::tools(at) {
        Ok(make) => {
            let compiler = version("arm-none-eabi-gcc", &["-dumpversion"]).unwrap_or_default();
            let make = version(make.0, &["--version"]).unwrap_or_default();
            State::There(format!("{make}; arm-none-eabi-gcc {compiler}, with newlib"))
        }
        Err(why) => missing(&why),
    };
    let named = std::env::var_os("CHIBIOS").filter(|path| !path.is_empty()).map(PathBuf::from);
    let wanted = full_name("chibios").and_then(|name| name.strip_prefix("chibios-"));
    let tree = match firmware::tree_of(named.as_deref(), wanted.unwrap_or_default(), at) {
        Ok(tree) => State::There(format!("{} at {}", firmware::release(&tree), shown(&tree))),
        Err(why) => missing(&why),
    };
    vec![item("make, compiler", tools), item("ChibiOS", tree)]
}

fn embassy() -> Vec<Item> {
    let at = nowhere();
    let mut items = Vec::new();
    match cargo::cargo(&[], at) {
        Ok(cargo) => {
            let version = version(&cargo.0, &["--version"]).unwrap_or_default();
            items.push(item("cargo", State::There(version)));
        }
        Err(why) => return vec![item("cargo", missing(&why))],
    }
    for (triple, mcus) in CORES {
        let state = match cargo::cargo(&[triple], at) {
            Ok(_) => State::There(mcus.to_owned()),
            Err(_) => State::Absent(format!("for {mcus}: `rustup target add {triple}`")),
        };
        items.push(item(triple, state));
    }
    let has_core = items.iter().skip(1).any(|one| matches!(one.state, State::There(_)));
    if !has_core {
        let why = "there is no core library for any microcontroller".to_owned();
        let help = "one of the lines above, for the microcontroller of your board".to_owned();
        items.push(item("core library", State::Missing(why, help)));
    }
    items
}

fn flash() -> Vec<Item> {
    let mut items: Vec<Item> = probe::installed()
        .into_iter()
        .map(|(tool, is_there, serves)| {
            let state = if is_there {
                State::There(serves.to_owned())
            } else {
                State::Absent(format!("not installed; it writes to {serves}"))
            };
            item(tool, state)
        })
        .collect();
    for drive in drive::mounted() {
        items.push(item("drive", State::There(shown(&drive.path))));
    }
    if !items.iter().any(|one| matches!(one.state, State::There(_))) {
        let why = "no tool that writes to a board is installed, and no board's drive is mounted"
            .to_owned();
        let help = "for ST's boards `sudo apt install stlink-tools`, or `brew install stlink`; a Pico needs nothing: \
                    hold BOOTSEL while you plug it in"
            .to_owned();
        items.push(item("a way to flash", State::Missing(why, help)));
    }
    items
}

fn boards() -> Vec<Item> {
    let ports = usb_ports();
    if ports.is_empty() {
        let why = "no USB port of this machine has a serial device".to_owned();
        let help =
            "plug the board in, by a cable that carries data; `sensedsl simulate` needs no board"
                .to_owned();
        return vec![item("serial ports", State::Missing(why, help))];
    }
    let names: Vec<String> = ports.iter().map(|(name, _)| name.clone()).collect();
    names
        .iter()
        .map(|name| {
            let state = match Port::open(name, BAUD) {
                Ok(_) => State::There("may be opened".to_owned()),
                // Whoever has it may.
                Err(why @ OpenError::Busy) => State::Absent(why.to_string()),
                Err(why) => State::Missing(why.to_string(), cure(&why, name, &names)),
            };
            item(name.clone(), state)
        })
        .collect()
}

fn hosts() -> Vec<Item> {
    let python = ["python3", "python"]
        .into_iter()
        .find_map(|name| Some((name, version(name, &["--version"])?)));
    let mut items = vec![of_program(
        "C++",
        "g++",
        &["-dumpfullversion"],
        "a compiler for the hosts `cpp` and `ros2`",
    )];
    items.push(of_program("C", "gcc", &["-dumpfullversion"], "a compiler for the host `c`"));
    match python {
        Some((name, version)) => {
            let has_serial =
                self::version(name, &["-c", "import serial; print(serial.__version__)"]);
            items.push(item("Python", State::There(version)));
            items.push(item(
                "pyserial",
                has_serial.map_or_else(
                    || {
                        State::Absent(
                            "the host `python` needs it for a serial port: `pip install pyserial`"
                                .to_owned(),
                        )
                    },
                    State::There,
                ),
            ));
        }
        None => items.push(item(
            "Python",
            State::Absent("not installed; the host `python` runs in it".to_owned()),
        )),
    }
    items.push(of_program(
        "Rust",
        "cargo",
        &["--version"],
        "the host `rust` is a crate: https://rustup.rs",
    ));
    items.push(of_program(
        "Octave",
        "octave-cli",
        &["--version"],
        "the host `matlab` reads records in it",
    ));
    let ros = std::env::var("ROS_DISTRO").ok().filter(|name| !name.is_empty());
    let no_ros = || {
        State::Absent(
            "no ROS 2 is set up in this shell; the host `ros2` is built in one".to_owned(),
        )
    };
    items.push(item("ROS 2", ros.map_or_else(no_ros, State::There)));
    items
}

fn of_program(name: &str, program: &str, arguments: &[&str], good_for: &str) -> Item {
    let state = version(program, arguments)
        .map_or_else(|| State::Absent(format!("no `{program}`: {good_for}")), State::There);
    item(name, state)
}

fn table(findings: &[Finding]) -> String {
    let mut text =
        "Nothing more is needed to wire, check, generate, simulate and watch.\n".to_owned();
    for Finding { purpose, items, is_ready } in findings {
        let verdict = if *is_ready { "ready" } else { "not ready" };
        text.push_str(&format!("\n{}: {verdict}\n", purpose.title()));
        let width = items.iter().map(|one| one.name.chars().count()).max().unwrap_or_default();
        for Item { name, state } in items {
            let (mark, what, help) = match state {
                State::There(what) => ('+', what, ""),
                State::Missing(why, help) => ('!', why, help.as_str()),
                State::Absent(what) => ('-', what, ""),
            };
            text.push_str(&format!("  {mark} {:width$}  {}\n", visible(name), visible(what)));
            if !help.is_empty() {
                text.push_str(&format!("    {:width$}  {}\n", "", visible(help)));
            }
        }
    }
    text
}

fn json(findings: &[Finding]) -> Value {
    let of_item = |Item { name, state }: &Item| {
        let (state, text, help) = match state {
            State::There(what) => ("there", what, None),
            State::Missing(why, help) => ("missing", why, Some(help)),
            State::Absent(what) => ("absent", what, None),
        };
        json!({ "name": name, "state": state, "text": text, "help": help })
    };
    let all = findings.iter().map(|one| {
        json!({
            "purpose": one.purpose.name(),
            "ready": one.is_ready,
            "items": one.items.iter().map(of_item).collect::<Vec<_>>(),
        })
    });
    json!({ "version": 1, "purposes": all.collect::<Vec<_>>() })
}
