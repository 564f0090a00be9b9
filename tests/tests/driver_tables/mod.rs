//! Every driver of the library, from its vector file through the generator's tables and the
//! runtime's core to values: what a board would report, and what a host would show.
//!
//! The tables of all drivers are compiled into one program, `tests/drivers/main.c`, under
//! sanitizers. `rust` is the same program on the runtime in Rust, and `same` compares the two.

mod avr;
mod examples;
mod gaps;
mod judged;
mod library;
mod program;
mod rust;
mod rust_tables;
mod same;
mod vectors;

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_job::part::has_coding;
use sensedsl_model::design::{Device, Presentation};
use sensedsl_model::kind::Kind;
use sensedsl_model::kind::can::Can;
use sensedsl_model::kind::onewire::OneWire;
use sensedsl_tests::hex;
use sensedsl_wire::Direction;

use library::{Unit, others, units};
use program::{Outcome, ask, program};
use vectors::{Case, Command, Expected, Given};

/// The mistakes of a driver, one a line.
type Wrong = Vec<String>;

/// The library with the outcomes of all its cases; `None` without a compiler.
fn outcomes() -> Option<Vec<(Unit, Vec<Outcome>)>> {
    let (mut units, others) = (units(), others());
    let count = units.len();
    units.extend(others);
    let program = program(&units)?;
    let mut requests = Vec::new();
    for (index, unit) in units.iter().enumerate() {
        requests.extend(unit.cases.iter().map(|case| request(index, unit, case)));
    }
    // Units without cases only report whether their buffers have the sizes that the runtime counts.
    requests.extend((count..units.len()).map(|index| format!("unit {index}\nend")));
    let mut answers = ask(program, &requests).into_iter();
    units.truncate(count);
    let of_unit = |unit: Unit| {
        let own = answers.by_ref().take(unit.cases.len()).collect();
        (unit, own)
    };
    Some(units.into_iter().map(of_unit).collect())
}

#[test]
fn every_driver_agrees_with_its_vectors() {
    let Some(all) = outcomes() else { return };
    let mut wrong = Wrong::new();
    let mut statements = 0;
    for (unit, outcomes) in &all {
        for (case, outcome) in unit.cases.iter().zip(outcomes) {
            statements += case.expected.len() + case.shown.len() + case.commands.len();
            let of_case = judge(unit, case, outcome);
            wrong.extend(of_case.into_iter().map(|one| format!("{}: {one}", case.title)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(statements > 500, "only {statements} statements");
}

/// If any statement of any vector file is changed by one, the test reports it.
#[test]
fn what_disagrees_is_told() {
    let Some(all) = outcomes() else { return };
    for (unit, outcomes) in all {
        for (case, outcome) in unit.cases.into_iter().zip(outcomes) {
            let (mut case, mut changes) = (case, 0);
            for (name, expected) in &mut case.expected {
                changes += usize::from(name != "identity");
                *expected = match std::mem::replace(expected, Expected::Nothing) {
                    Expected::Values(mut values, slack) => {
                        *values.last_mut().unwrap() += 2 * slack + 1;
                        Expected::Values(values, slack)
                    }
                    Expected::Nothing => Expected::Invalid,
                    Expected::Invalid | Expected::WrongIdentity => Expected::Nothing,
                };
            }
            for (_, shown) in &mut case.shown {
                changes += 1;
                let last = shown.last_mut().unwrap();
                *last = format!("9{}", last.trim_start_matches('-'));
            }
            for effect in case.commands.iter_mut().flat_map(|command| &mut command.effects) {
                changes += 1;
                effect.push('1');
            }
            let unit = Unit {
                driver: unit.driver.clone(),
                design: unit.design.clone(),
                cases: Vec::new(),
            };
            let reported = judge(&unit, &case, &outcome);
            assert!(reported.len() >= changes, "{}: {changes} changes, {reported:?}", case.title);
        }
    }
}

/// Every value that is decoded is expected at least once; so are a wrong identity and answers that
/// are not a measurement.
#[test]
fn every_driver_has_vectors_of_all_it_does() {
    let mut wrong = Wrong::new();
    for unit in units() {
        let mut say = |what: &str| wrong.push(format!("{}: {what}", unit.driver));
        let named = |name: &str, what: fn(&Expected) -> bool| {
            let expected = unit.cases.iter().flat_map(|case| &case.expected);
            expected.into_iter().any(|(of, one)| of == name && what(one))
        };
        for device in unit.coded() {
            let name = Unit::value_name(device);
            let is_value = |one: &Expected| matches!(one, Expected::Values(..));
            let is_sensor = device.direction == Direction::Sensor;
            let is_commanded =
                unit.cases.iter().flat_map(|case| &case.commands).any(|one| one.name == name);
            if is_sensor && !named(&name, is_value) || !is_sensor && !is_commanded {
                say(&format!("nothing is expected of `{name}`"));
            }
        }
        for device in unit.devices() {
            let name = Unit::value_name(device);
            let can_be = !device.filter.invalid.is_empty() || device.coding.crc.is_some();
            if can_be && !named(&name, |one| *one == Expected::Invalid) {
                say(&format!("`{name}` is never invalid"));
            }
        }
        let has_identity = unit.protocol().is_some_and(|protocol| protocol.identity.is_some());
        if has_identity && !named("identity", |one| *one == Expected::WrongIdentity) {
            say("there is no wrong identity");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// There is exactly one vector file for each driver.
#[test]
fn vectors_and_drivers_are_the_same_set() {
    let folder = sensedsl_tests::root().join("tests/vectors/drivers");
    let stem = |path: std::path::PathBuf| path.file_stem().unwrap().to_string_lossy().into_owned();
    let files: BTreeSet<String> =
        sensedsl_tests::files(&folder, "txt").into_iter().map(stem).collect();
    assert_eq!(files, library::names().into_iter().collect());
}

#[test]
fn the_tables_are_the_same_each_time() {
    let print = || units().iter().map(program::tables).collect::<String>();
    assert_eq!(print(), print());
}

/// The request to the program for a case.
fn request(index: usize, unit: &Unit, case: &Case) -> String {
    let mut lines = vec![format!("unit {index}")];
    let protocol = unit.protocol();
    let is_bus = unit
        .devices()
        .any(|device| matches!(device.kind, Kind::I2c(_) | Kind::Spi(_) | Kind::OneWire(_)));
    let wire = wire(unit);
    if let Some(protocol) = protocol.filter(|_| is_bus) {
        let (size, mask) = (protocol.register_bytes, protocol.read_mask);
        lines.push(format!("registers {size} {mask} {}", u8::from(protocol.is_one_by_one)));
        if let Some(identity) = &protocol.identity {
            let (at, bytes) = (identity.register, hex(&identity.expected));
            lines.push(format!("register {at} {bytes}"));
        }
        // The first byte of its address, which is read as a register of 1-Wire.
        if let Some(family) = wire.and_then(|wire| wire.family) {
            lines.push(format!("register {READ_ROM} {}", hex(&[family, 0, 0, 0, 0, 0, 0, 0])));
        }
    }
    lines.extend(case.given.iter().map(|given| given_line(unit, given)));
    if is_bus {
        lines.push("run".to_owned());
    }
    for command in &case.commands {
        let Some(field) = unit.field(&command.name).filter(|field| unit.is_coded(*field)) else {
            continue;
        };
        let numbers: Vec<String> = command.values.iter().map(i64::to_string).collect();
        lines.push(format!("command {field} {} {}", numbers.len(), numbers.join(" ")));
    }
    lines.push("end".to_owned());
    lines.join("\n")
}

/// Asks a part on 1-Wire for its address.
const READ_ROM: u8 = 0x33;

/// The wire of a part that has only one.
fn wire(unit: &Unit) -> Option<&OneWire> {
    unit.devices().find_map(|device| device.kind.onewire())
}

fn given_line(unit: &Unit, given: &Given) -> String {
    match given {
        // What a command selects is to the program's bus what a register's number does.
        Given::Answer(Some(trigger), bytes) if wire(unit).is_some() => {
            let select = wire(unit).and_then(|wire| wire.read.first()).unwrap();
            format!("after {} {select} {}", hex(trigger), hex(bytes))
        }
        Given::Registers(None, at, bytes) | Given::WrongIdentity(at, bytes) => {
            format!("register {at} {}", hex(bytes))
        }
        Given::Registers(Some(trigger), at, bytes) => {
            format!("after {} {at} {}", hex(trigger), hex(bytes))
        }
        Given::Answer(trigger, bytes) => {
            format!("answer {} {}", hex(trigger.as_deref().unwrap_or_default()), hex(bytes))
        }
        Given::Exchange(sent, received) => format!("exchange {} {}", hex(sent), hex(received)),
        Given::Stream(bytes) => format!("feed {}", hex(bytes)),
        Given::Asked(request, answer) => format!("asked {} {}", hex(request), hex(answer)),
        Given::Raw(what, number) => {
            // All sensors of the kind that measures this; none of them is on a bus.
            let is_it = |device: &Device| match what.as_str() {
                "analog" => matches!(device.kind, Kind::Analog(_)),
                "level" => matches!(device.kind, Kind::Digital(_)),
                "counts" => matches!(device.kind, Kind::Encoder(_) | Kind::Stepper(_)),
                _ => matches!(device.kind, Kind::Icu(_)),
            };
            let is_sensor = |device: &Device| device.direction == Direction::Sensor;
            let sensors = unit.devices().enumerate();
            let sensors = sensors.filter(|(_, device)| is_sensor(device) && is_it(device));
            let line = |(field, device)| format!("raw {field} {}", measured(device, what, *number));
            sensors.map(line).collect::<Vec<_>>().join("\n")
        }
        Given::Frame(name, bytes) => {
            let fits = |can: &Can| frame_name(can) == *name && usize::from(can.byte) < bytes.len();
            let is_in = |device: &Device| {
                device.direction == Direction::Sensor && device.kind.can().is_some_and(fits)
            };
            let own = unit.devices().enumerate().filter(|(_, device)| is_in(device));
            let lines = own.map(|(field, _)| format!("frame {field} {}", hex(bytes)));
            lines.collect::<Vec<_>>().join("\n")
        }
        Given::Edges(times) => {
            let times: Vec<String> = times.iter().map(u32::to_string).collect();
            format!("edges {} {}", times.len(), times.join(" "))
        }
    }
}

/// The raw value that the hardware reports for a pulse, a level and so on.
fn measured(device: &Device, what: &str, number: i64) -> i64 {
    match &device.kind {
        Kind::Icu(icu) if what == "pulse" => number * i64::from(icu.tick_hz) / 1_000_000,
        Kind::Digital(digital) => i64::from((number != 0) != digital.active_low),
        _ => number,
    }
}

/// The differences between a case and its outcome.
fn judge(unit: &Unit, case: &Case, outcome: &Outcome) -> Wrong {
    let mut wrong = Wrong::new();
    let is_stranger = case.expected.iter().any(|(_, what)| *what == Expected::WrongIdentity);
    if let Some(is_wrong) = outcome.is_wrong_identity
        && is_wrong != is_stranger
    {
        wrong.push(format!("the identity is {}", if is_wrong { "wrong" } else { "right" }));
    }
    for (name, expected) in case.expected.iter().filter(|(name, _)| name != "identity") {
        let Some(field) = unit.field(name) else {
            wrong.push(format!("it has no `{name}`"));
            continue;
        };
        let found = outcome.fields.get(&field);
        let is_right = match (expected, found) {
            (Expected::Values(wanted, slack), Some(Expected::Values(found, _))) => {
                wanted.len() == found.len()
                    && wanted.iter().zip(found).all(|(one, other)| (one - other).abs() <= *slack)
            }
            (Expected::Nothing, None) => true,
            (wanted, found) => found == Some(wanted),
        };
        if !is_right {
            wrong.push(format!("{name}: {found:?}, not {expected:?}"));
        }
    }
    for (name, wanted) in &case.shown {
        let found = unit.field(name).and_then(|field| outcome.fields.get(&field));
        let (Some(Expected::Values(values, _)), Some(device)) = (found, unit.device(name)) else {
            wrong.push(format!("{name} is shown, and there is no value"));
            continue;
        };
        for (text, raw) in wanted.iter().zip(values) {
            let digits = text.split_once('.').map_or(0, |(_, digits)| digits.len());
            let slack = 0.500_000_1 * 10_f64.powi(-i32::try_from(digits).unwrap());
            let shown = visible(&device.shown, *raw);
            if (shown - text.parse::<f64>().unwrap()).abs() > slack || wanted.len() != values.len()
            {
                wrong.push(format!("{name} is shown as {shown}, not {text}"));
            }
        }
    }
    let mut written = outcome.written.iter();
    let mut levels = BTreeMap::new();
    for command in &case.commands {
        wrong.extend(effects(unit, command, &mut written, &mut levels));
    }
    wrong
}

/// The value that a host shows.
fn visible(shown: &Presentation, raw: i64) -> f64 {
    let value = raw as f64 * shown.scale.unwrap_or(1.0) + shown.offset.unwrap_or(0.0);
    let (Some(first), Some(last)) = (shown.curve.first(), shown.curve.last()) else { return value };
    let piece = shown.curve.windows(2).find(|piece| value < piece[1].0);
    match piece {
        _ if value <= first.0 => first.1,
        None => last.1,
        Some(piece) => {
            let ((x0, y0), (x1, y1)) = (piece[0], piece[1]);
            y0 + (y1 - y0) * (value - x0) / (x1 - x0)
        }
    }
}

/// The differences between a command's expected and actual effects. `levels` are the current levels
/// of the part's wires.
fn effects<'a>(
    unit: &Unit,
    command: &Command,
    written: &mut impl Iterator<Item = &'a Vec<String>>,
    levels: &mut BTreeMap<String, i64>,
) -> Wrong {
    let Some(device) = unit.device(&command.name) else {
        return vec![format!("it has no `{}`", command.name)];
    };
    let found: Vec<String> = if device.coding.drive.is_some() {
        for line in written.next().into_iter().flatten() {
            let (output, value) = line.split_once(' ').unwrap();
            let connection = device.connections[output.parse::<usize>().unwrap()];
            let name = unit.design.connections[connection.0].name.clone().unwrap();
            levels.insert(name, value.parse().unwrap());
        }
        levels.iter().map(|(name, level)| format!("{name} = {level}")).collect()
    } else if let Some(can) = device.kind.can() {
        let data = written.next().into_iter().flatten();
        data.map(|data| {
            let length = unit.frame_bytes(can);
            format!("frame {}: {}", frame_name(can), &data[..3 * length - 1])
        })
        .collect()
    } else if has_coding(device, unit.part()) {
        written.next().into_iter().flatten().cloned().collect()
    } else {
        vec![plain_effect(device, command.values[0])]
    };
    let missing =
        command.effects.iter().filter(|effect| !found.contains(&effect.replace("written ", "")));
    missing.map(|effect| format!("{}: {found:?}, not {effect}", command.name)).collect()
}

/// A frame identifier as three digits, or as eight if it has 29 bits.
fn frame_name(can: &Can) -> String {
    if can.is_extended { format!("{:08X}", can.frame_id) } else { format!("{:03X}", can.frame_id) }
}

/// The effect of a value on an output, computed without the code under test.
fn plain_effect(device: &Device, value: i64) -> String {
    match &device.kind {
        Kind::Pwm(pwm) => {
            let period_us = 1e6 / f64::from(pwm.frequency_hz);
            let least = pwm.min_us.map_or(0.0, f64::from);
            let greatest = pwm.max_us.map_or(period_us, f64::from);
            let us = least + (greatest - least) * value as f64 / 10_000.0;
            format!("width us {}", us.round())
        }
        Kind::Digital(digital) => {
            format!("pin = {}", i64::from((value != 0) != digital.active_low))
        }
        Kind::Stepper(_) => format!("goes {value}"),
        _ => String::new(),
    }
}
