//! The runtime in Rust with the same tables. It agrees with the vectors, and with the runtime in C
//! for any answers of parts, failures of buses and passage of time.

use sensedsl_model::kind::Kind;
use sensedsl_tests::{Random, hex, is_thorough};
use sensedsl_wire::Direction;

use super::library::{Unit, units};
use super::program::{program, read, say};
use super::rust::answer;
use super::rust_tables::Tables;
use super::{Wrong, judge, request};

fn rust_units() -> Vec<(Unit, Tables)> {
    let with_tables = |unit: Unit| {
        let tables = Tables::new(&unit);
        (unit, tables)
    };
    units().into_iter().map(with_tables).collect()
}

#[test]
fn rust_agrees_with_the_vectors() {
    let units = rust_units();
    let mut wrong = Wrong::new();
    for (index, (unit, _)) in units.iter().enumerate() {
        for case in &unit.cases {
            let outcome = read(&answer(&units, &request(index, unit, case)));
            let of_case = judge(unit, case, &outcome);
            wrong.extend(of_case.into_iter().map(|one| format!("{}: {one}", case.title)));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn some_bytes(random: &mut Random, count: usize) -> Vec<u8> {
    // Formulas and filters depend on the ends of ranges, so these are frequent.
    let style = random.below(4);
    let one = |random: &mut Random| match (style, random.below(3)) {
        (0, _) => 0,
        (1, _) => 0xFF,
        (2, 0) => 0x80,
        _ => random.next() as u8,
    };
    (0..count).map(|_| one(random)).collect()
}

/// A part on a bus that sometimes has the right identity, answers arbitrary bytes, and fails.
fn on_bus(index: usize, unit: &Unit, random: &mut Random) -> String {
    let mut lines = vec![format!("unit {index}")];
    let protocol = unit.protocol();
    if let Some(protocol) = protocol {
        let (size, mask) = (protocol.register_bytes, protocol.read_mask);
        lines.push(format!("registers {size} {mask} 0"));
    }
    for turn in 0..6 {
        for (at, count) in [(0, 256), (0x80, 128)] {
            lines.push(format!("register {at} {}", hex(&some_bytes(random, count))));
        }
        lines.push(format!("answer - {}", hex(&some_bytes(random, 32))));
        let identity = protocol.and_then(|one| one.identity.as_ref()).filter(|_| turn % 3 != 1);
        if let Some(identity) = identity {
            lines.push(format!("register {} {}", identity.register, hex(&identity.expected)));
        }
        for device in unit.devices().filter(|device| !device.coding.exchange.is_empty()) {
            let (sent, count) = (&device.coding.exchange, device.coding.exchange.len());
            lines.push(format!("exchange {} {}", hex(sent), hex(&some_bytes(random, count))));
        }
        // The first turn has no faults, so that the behaviour after a long start is seen as well.
        lines.push(format!("faults {}", if turn == 0 { 0 } else { 1 + random.below(1 << 20) }));
        lines.push(format!("steps {}", 10 + random.below(40)));
        for (field, device) in unit.devices().enumerate() {
            if device.direction == Direction::Actuator && unit.is_coded(field) && turn > 0 {
                let count = device.value.value.count();
                let numbers = (0..count).map(|_| number(random).to_string());
                let numbers = numbers.collect::<Vec<_>>().join(" ");
                lines.push(format!("command {field} {count} {numbers}"));
            }
        }
    }
    lines.push("end".to_owned());
    lines.join("\n")
}

fn number(random: &mut Random) -> i64 {
    let bits = random.below(64) as u32;
    (random.next() as i64) >> bits
}

/// Messages of the vectors, intact and damaged, with noise between them, in pieces.
fn on_port(index: usize, unit: &Unit, random: &mut Random) -> String {
    let mut lines = vec![format!("unit {index}"), "trace 1".to_owned()];
    let streams: Vec<&Vec<u8>> = unit
        .cases
        .iter()
        .flat_map(|case| &case.given)
        .filter_map(|given| match given {
            super::Given::Stream(bytes) => Some(bytes),
            _ => None,
        })
        .collect();
    // A part that is asked speaks only then: the damaged answers of its vectors are in those.
    let rounds = if streams.is_empty() { 0 } else { 12 };
    for _ in 0..rounds {
        let mut bytes = (*random.pick(&streams).unwrap()).clone();
        for _ in 0..random.below(3) {
            let at = random.below(bytes.len());
            match random.below(4) {
                0 => bytes[at] = random.next() as u8,
                1 => bytes[at] ^= 1 << random.below(8),
                2 => bytes.truncate(at + 1),
                _ => bytes.insert(at, *random.pick(b"0123456789.,-*$ \r\nAN").unwrap()),
            }
        }
        for piece in bytes.chunks(1 + random.below(40)) {
            lines.push(format!("feed {}", hex(piece)));
        }
        lines.push(format!("later {}", random.below(500)));
    }
    lines.push("end".to_owned());
    lines.join("\n")
}

/// Inputs and outputs that are on no bus: analog values, levels, pulse trains, bridges.
fn on_pins(index: usize, unit: &Unit, random: &mut Random) -> String {
    let mut lines = vec![format!("unit {index}"), "trace 1".to_owned()];
    for _ in 0..20 {
        for (field, device) in unit.devices().enumerate() {
            let is_train = matches!(&device.kind, Kind::Icu(icu) if icu.mode == sensedsl_model::kind::icu::Mode::Ppm);
            let is_sensor = device.direction == Direction::Sensor;
            if is_train {
                let count = random.below(14);
                let times = (0..count).map(|_| (300 + random.below(4000)).to_string());
                let times: Vec<String> = times.collect();
                lines.push(format!("edges {count} {}", times.join(" ")));
            } else if is_sensor && unit.is_coded(field) {
                lines.push(format!("raw {field} {}", random.below(4100)));
            } else if is_sensor {
                lines.push(format!("raw {field} {}", number(random)));
            } else if device.coding.drive.is_some() {
                lines.push(format!("command {field} 1 {}", number(random)));
            }
        }
        lines.push(format!("later {}", random.below(500)));
    }
    lines.push("end".to_owned());
    lines.join("\n")
}

/// Random requests for all units.
fn requests(units: &[(Unit, Tables)], rounds: usize) -> Vec<String> {
    let mut random = Random::new(7);
    let mut all = Vec::new();
    for _ in 0..rounds {
        for (index, (unit, tables)) in units.iter().enumerate() {
            let is_alone = unit.protocol().is_some_and(|protocol| protocol.is_one_by_one);
            all.push(match (tables.chip, tables.message) {
                (Some(_), _) if is_alone => continue,
                (Some(_), _) => on_bus(index, unit, &mut random),
                (None, Some(_)) => on_port(index, unit, &mut random),
                (None, None) => on_pins(index, unit, &mut random),
            });
        }
    }
    all
}

#[test]
fn rust_says_what_c_says() {
    let units = rust_units();
    let plain: Vec<Unit> = super::library::units();
    let mut with_others = plain;
    with_others.extend(super::others());
    let Some(program) = program(&with_others) else { return };
    let requests = requests(&units, if is_thorough() { 100 } else { 2 });
    let (mut lines, mut fresh) = (0, 0);
    for (request, of_c) in requests.iter().zip(say(program, &requests)) {
        let of_rust = answer(&units, request);
        let mut pairs = of_c.lines().zip(of_rust.lines()).enumerate();
        if let Some((line, (c, rust))) = pairs.find(|(_, (c, rust))| c != rust) {
            let before: Vec<&str> = of_c.lines().skip(line.saturating_sub(6)).take(6).collect();
            panic!(
                "C: {c}\nRust: {rust}\nbehind {before:#?}\n{}",
                &request[..request.len().min(400)]
            );
        }
        assert_eq!(of_c, of_rust, "{request}");
        lines += of_c.lines().count();
        fresh +=
            of_c.lines().filter(|line| line.starts_with("told") && line.contains(" 1 ")).count();
    }
    assert!(lines > 20_000 && fresh > 2_000, "only {lines} lines, {fresh} of them values");
}
