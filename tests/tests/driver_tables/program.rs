//! The C program: the tables of all units are printed and compiled once, and the program is run on
//! one case at a time.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use sensedsl_firmware_c::{self as c, Wiring};
use sensedsl_job::part::{PartPlan, ValuePlan};
use sensedsl_model::design::{Device, PartIndex};
use sensedsl_model::words::Words;
use sensedsl_tests::{fed, files, has, is_thorough, root, run};
use sensedsl_wire::{Direction, ScalarType};

use super::library::Unit;
use super::vectors::Expected;

/// The outcome of a case.
#[derive(Debug, Default)]
pub struct Outcome {
    /// The outcome of each field, in the words of the vectors.
    pub fields: BTreeMap<usize, Expected>,
    /// What each command wrote: bytes separated by spaces, or outputs and their values.
    pub written: Vec<Vec<String>>,
    /// Whether the identity was wrong; only for a part on a bus.
    pub is_wrong_identity: Option<bool>,
}

/// The program, or `None` without a compiler.
pub fn program(units: &[Unit]) -> Option<&'static Path> {
    static PROGRAM: OnceLock<Option<PathBuf>> = OnceLock::new();
    PROGRAM.get_or_init(|| has("gcc").then(|| build(units))).as_deref()
}

fn build(units: &[Unit]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("drivers");
    std::fs::create_dir_all(&folder).unwrap();
    let mut text: String = units.iter().map(tables).collect();
    text.push_str("static const unit_t units[] = {\n");
    units.iter().for_each(|unit| text.push_str(&entry(unit)));
    text.push_str("};\n");
    std::fs::write(folder.join("tables.c"), text).unwrap();
    let (core, program) = (root().join("crates/firmware-c/runtime"), folder.join("drivers"));
    let mut command = Command::new("gcc");
    command.args(["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"]);
    let level = if is_thorough() { "-O1" } else { "-O0" };
    command.args([level, "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]);
    // On a board, the target decides where buffers are placed.
    command.arg("-DUP_DMA_BUFFER=").arg("-I").arg(&core).arg("-I").arg(&folder);
    command.arg(root().join("tests/drivers/main.c")).args(files(&core, "c"));
    run(command.arg("-o").arg(&program));
    program
}

pub fn plan(unit: &Unit) -> Option<PartPlan> {
    PartPlan::new(&unit.design, PartIndex(0))
}

fn type_macro(scalar: ScalarType) -> String {
    format!("UP_TYPE_{}", scalar.name().to_uppercase())
}

/// The schema of a unit, and the tables of its part.
pub fn tables(unit: &Unit) -> String {
    let (part, mut text) = (&unit.part().name.value, String::new());
    let names = unit.devices().map(|device| format!("SENSE_FIELD_{}", device.name.value));
    writeln!(text, "enum {{ {} }};", names.collect::<Vec<_>>().join(", ")).unwrap();
    writeln!(text, "static const up_field_t fields_{part}[] = {{").unwrap();
    for Device { name, id, value, direction, .. } in unit.devices() {
        let direction = match direction {
            Direction::Sensor => "UP_TO_HOST",
            Direction::Actuator => "UP_TO_BOARD",
        };
        let (ty, is_array) = (type_macro(value.value.scalar), value.value.length.is_some());
        let (name, id, count) = (&name.value, id.value, value.value.count());
        writeln!(text, "  {{\"{name}\", {id}U, {ty}, {direction}, {is_array}, {count}U, 0U}},")
            .unwrap();
    }
    let count = unit.devices().count();
    writeln!(
        text,
        "}};\nstatic const up_schema_t schema_{part} = {{fields_{part}, {count}U, false, 0U}};"
    )
    .unwrap();
    if let Some(plan) = plan(unit) {
        text.push_str(&c::tables(&plan, Wiring::default()));
        text.push('\n');
    }
    text.push_str(&unit_fields(unit));
    text
}

/// The table rows of each device.
fn unit_fields(unit: &Unit) -> String {
    let part = &unit.part().name.value;
    let plan = plan(unit);
    let one = |device: &Device| match &plan {
        Some(plan) => {
            let (own, can) = (unit_field(plan, &device.name.value), in_frame(device, part));
            let message = plan.message.iter().flat_map(|plan| &plan.commands);
            let name = &device.name.value;
            let is_told = message.filter(|one| one.field == *name).count() > 0;
            let compose = if is_told { format!("&compose_{name}") } else { "NULL".to_owned() };
            format!("  {{{own}, {can}, {compose}}},\n")
        }
        None => {
            let can = in_frame(device, part);
            format!("  {{NULL, NULL, 0U, NULL, NULL, 0U, NULL, NULL, {can}, NULL}},\n")
        }
    };
    let all: String = unit.devices().map(one).collect();
    let codings: String = unit.devices().filter_map(|one| frame_coding(one, part)).collect();
    format!("{codings}static const unit_field_t unit_fields_{part}[] = {{\n{all}}};\n")
}

/// The coding of a value in a CAN frame, as a C constant.
fn frame_coding(device: &Device, part: &str) -> Option<String> {
    device.kind.can()?;
    let how = ValuePlan::new(&Words::of(device)?);
    assert!(how.elements.is_empty() && how.crc.is_none(), "no driver in a frame has that yet");
    let (size, low, bits) = (how.word_bytes, how.low, how.bits);
    let code = c::words::code(&how.code);
    Some(format!(
        "static const up_value_t can_{part}_{} = {{.code = {code}, .word_bytes = {size}U, .low = {low}U, .bits = {bits}U, .is_signed = {}, .little_endian = {}}};\n",
        device.name.value, how.is_signed, how.is_little_endian
    ))
}

/// The reference to the constant of [`frame_coding`].
fn in_frame(device: &Device, part: &str) -> String {
    device.kind.can().map_or("NULL, 0U".to_owned(), |can| {
        format!("&can_{part}_{}, {}U", device.name.value, can.byte)
    })
}

fn unit_field(plan: &PartPlan, name: &str) -> String {
    let filter = plan.filters.iter().find(|one| one.field == name);
    let filter = filter.map_or("NULL, NULL, 0U".to_owned(), |one| {
        format!("&{0}_filter, &{0}_filter_state, {1}U", one.ident, one.memory_words)
    });
    let formula = plan.formulas.iter().find(|one| one.field == name);
    let formula = formula.map_or("NULL, NULL, 0U".to_owned(), |one| {
        format!("&{}, {}_parameters, {}U", c::words::formula(&one.formula), one.ident, one.output)
    });
    let train = plan.trains.iter().find(|one| one.field == name);
    let train = train.map_or("NULL".to_owned(), |one| format!("&{}_train_config", one.ident));
    let bridge = plan.bridges.iter().find(|one| one.field == name);
    let bridge = bridge.map_or("NULL".to_owned(), |one| format!("&{}_drive", one.ident));
    format!("{filter}, {formula}, {train}, {bridge}")
}

fn entry(unit: &Unit) -> String {
    let part = &unit.part().name.value;
    let mut text = format!("  {{.schema = &schema_{part}, .fields = unit_fields_{part}");
    let plan = plan(unit);
    if let Some(bus) = plan.as_ref().and_then(|plan| plan.buses.first()) {
        let prefix = &bus.prefix;
        write!(text, ", .chip = &{prefix}_chip, .chip_state = &{prefix}_chip_state, .work_bytes = sizeof {prefix}_work").unwrap();
        write!(text, ", .kept_bytes = {}U", bus.kept.len()).unwrap();
    }
    if let Some(message) = plan.as_ref().and_then(|plan| plan.message.as_ref()) {
        let prefix = &message.prefix;
        if !message.fields.is_empty() {
            write!(
                text,
                ", .message = &{prefix}_message, .message_state = &{prefix}_message_state"
            )
            .unwrap();
        }
        if !message.exchanges.is_empty() {
            let count = message.exchanges.len();
            write!(text, ", .exchanges = {prefix}_exchanges, .exchanges_count = {count}U").unwrap();
        }
        if !message.init.is_empty() {
            write!(text, ", .message_init = {prefix}_init").unwrap();
        }
    }
    text.push_str("},\n");
    text
}

/// The outcome of each request, in order.
pub fn ask(program: &Path, requests: &[String]) -> Vec<Outcome> {
    say(program, requests).iter().map(|answer| read(answer)).collect()
}

/// The answer of the program to each request.
pub fn say(program: &Path, requests: &[String]) -> Vec<String> {
    let output = fed(&mut Command::new(program), requests.join("\n") + "\n");
    let answers = String::from_utf8(output.stdout).unwrap();
    let all: Vec<String> = answers.split_inclusive("end\n").map(str::to_owned).collect();
    let log = String::from_utf8_lossy(&output.stderr);
    let at = requests.get(all.len().saturating_sub(1)).cloned().unwrap_or_default();
    assert!(output.status.success(), "{log}\nin or behind:\n{at}\n{answers:.0}");
    assert_eq!(all.len(), requests.len());
    all
}

pub fn read(answer: &str) -> Outcome {
    let mut outcome = Outcome::default();
    let mut outputs: Vec<String> = Vec::new();
    for line in answer.lines() {
        let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
        match word {
            "written" => outcome.written.push(vec![spaced(rest)]),
            "frame" => outcome.written.push(vec![spaced(rest)]),
            "output" => outputs.push(rest.to_owned()),
            "commanded" => outcome.written.push(std::mem::take(&mut outputs)),
            "identity" => outcome.is_wrong_identity = Some(rest == "wrong"),
            "end" => {}
            _ => {
                let mut numbers = rest.split(' ').map(|number| number.parse::<i64>().unwrap());
                let field = usize::try_from(numbers.next().unwrap()).unwrap();
                let what = match word {
                    "value" => Expected::Values(numbers.collect(), 0),
                    "invalid" => Expected::Invalid,
                    "error" => Expected::WrongIdentity,
                    _ => panic!("{line}"),
                };
                outcome.fields.insert(field, what);
            }
        }
    }
    outcome
}

/// Separates bytes by spaces: `407FF0` becomes `40 7F F0`.
fn spaced(digits: &str) -> String {
    let pairs = digits.as_bytes().chunks(2).map(|pair| String::from_utf8_lossy(pair).into_owned());
    pairs.collect::<Vec<_>>().join(" ")
}
