//! The table is held to the readers: what is read is described, what is described is read, ranges and words are equal.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_diagnostics::{Diagnostic, Severity};
use sensedsl_wire::Direction;

use super::*;
use crate::fields::asked::{Asked, during};
use crate::part::properties::ABOUT_PART;
use crate::{NoFiles, Request, facts, resolve};

const BOARD: &str = "STM32F407G_DISC1";

fn diagnostics(text: &str) -> Vec<Diagnostic> {
    let request = Request { path: "x.sense", text, ..Request::default() };
    resolve(&request, &NoFiles).diagnostics
}

/// What the reader of a text asks for.
fn asked(text: &str) -> Asked {
    during(|| drop(diagnostics(text)))
}

fn device(kind: KindName, direction: Direction, body: &str) -> String {
    let head = match direction {
        Direction::Sensor => format!("sensor X returns {}", kind.spec().natural),
        Direction::Actuator => format!("actuator X accepts {}", kind.spec().natural),
    };
    let type_of = kind.name();
    format!("board B on {BOARD} {{ {head} {{ type = {type_of}; {body} }} }}")
}

/// What a reader would call it: people write some numbers in hexadecimal.
fn as_read(meaning: &Meaning) -> String {
    if let Takes::Hex(least, most) = meaning.takes {
        return Takes::Whole(least, most).to_string();
    }
    meaning.takes.to_string()
}

/// Whether the reader that asked for the property takes what is described.
fn is_as_read(meaning: &Meaning, asked: &Asked) -> bool {
    let Some(takes) = asked.get(meaning.name) else { return false };
    // The period of the example's frequency.
    let is_pulse = matches!(meaning.takes, Takes::Pulse) && takes.len() == 1;
    takes.is_empty() || is_pulse || takes.contains(&as_read(meaning))
}

#[test]
fn every_property_of_a_kind_is_described_as_it_is_read() {
    for kind in KindName::ALL {
        let described: Vec<&str> = of_kind(kind).iter().map(|one| one.name).collect();
        assert_eq!(described, kind.spec().properties, "{kind}");
        let wires = devices::WIRES.iter().map(|one| one.name);
        let wires: BTreeSet<&str> = wires.collect();
        for own in kind.meanings() {
            let is_listed = kind.spec().properties.contains(&own.name);
            assert!(is_listed, "{kind}: `{}` is described, and the kind has it not", own.name);
        }
        // A `start` of sixteen bytes has the checksum begin anywhere; `bit` is what `bits` needs.
        let mut all = Asked::new();
        for direction in kind.spec().directions {
            let text = device(
                kind,
                *direction,
                "start = \"1234567812345678\"; mode = width; pulse = 1 ms;",
            );
            for (name, takes) in asked(&text) {
                all.entry(name).or_default().extend(takes);
            }
        }
        for meaning in of_kind(kind) {
            let read = all.get(meaning.name);
            let is_wire = wires.contains(meaning.name) && matches!(meaning.takes, Takes::Pin);
            let name = meaning.name;
            assert!(is_wire || is_as_read(meaning, &all), "{kind}: `{name}` is read as {read:?}");
        }
    }
}

/// A text with everything that is not of one kind.
fn everything() -> String {
    let mut text = format!(
        "board B on {BOARD} {{ target = chibios; link {{ }} sensor A returns uint16[2] {{ type = analog; }}\n\
         actuator P accepts uint16 {{ type = i2c; address = 0x20; failsafe = 1; quantity = us; }}\n\
         controller K every 5 ms {{ reads = [A]; sets = P; takes = 1 ms; host = override; }}\n"
    );
    for part in ["mpu6050", "bme280", "tb6612", "gearmotor_tb6612", "hcsr04", "mcp23017_pins"] {
        text.push_str(&format!("chip C{part} {{ driver = {part}; }}\n"));
    }
    text.push_str(
        "chip O { driver = own; actuator S accepts bool { reading = on; failsafe = true; } }\n}\n",
    );
    text.push_str("test T { world = \"w.toml\"; for = 1 s; seed = 1; always A[0] < 5; }\n");
    text.push_str(
        "driver own for i2c { address = 0x20; compensate = ntc; reading level returns uint16 { register = 1; }\n\
         command on accepts bool { register = 2; } }\n",
    );
    text
}

#[test]
fn everything_else_is_described_as_it_is_read() {
    // What is said of a part is read for its page.
    let asked = during(|| {
        drop(diagnostics(&everything()));
        drop(facts::find("mpu6050"));
    });
    let others = || general().chain(of_blocks());
    let of_kinds: Vec<&Meaning> = KindName::ALL.iter().flat_map(|kind| of_kind(*kind)).collect();
    for (name, takes) in &asked {
        let entries: Vec<&Meaning> =
            others().chain(of_kinds.iter().copied()).filter(|one| one.name == name).collect();
        assert!(!entries.is_empty(), "`{name}` is read, and nothing describes it");
        for one in takes {
            let is_described = |meaning: &&Meaning| {
                as_read(meaning) == *one || matches!(meaning.takes, Takes::Pulse)
            };
            assert!(entries.iter().any(is_described), "`{name}` takes {one}: {entries:?}");
        }
    }
    for meaning in others() {
        // Looked at, and not taken: it is of the part, or of its connection.
        let is_peeked = meaning.name == "pull" || meaning.name == "reading";
        let is_wire = matches!(meaning.takes, Takes::Pin);
        let name = meaning.name;
        let read = asked.get(name);
        assert!(
            is_peeked || is_wire || is_as_read(meaning, &asked),
            "`{name}` is read as {read:?}"
        );
    }
}

#[test]
fn lists_of_readers_are_described() {
    let lists = [COMMON_PROPERTIES, PRESENTATION, FILTER, CODING, PROTOCOL, ABOUT_PART];
    let chips = [CHIP, OF_DEVICE, PLACED, GIVEN, OF_CONNECTION];
    for name in lists.iter().chain(&chips).copied().flatten() {
        assert_eq!(named([name].into_iter()).len(), 1, "`{name}`");
    }
    let wishes: BTreeSet<&str> = Block::Wish.properties().iter().map(|one| one.name).collect();
    assert_eq!(wishes, rule::wishes().collect());
    for (block, list) in [
        (Block::Controller, crate::control::PROPERTIES),
        (Block::Test, crate::test::words::PROPERTIES),
    ] {
        let described: BTreeSet<&str> = block.properties().iter().map(|one| one.name).collect();
        assert_eq!(described, list.iter().copied().collect(), "{block:?}");
    }
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    general().for_each(|one| *seen.entry(one.name).or_default() += 1);
    assert_eq!(seen.iter().filter(|one| *one.1 > 1).collect::<Vec<_>>(), []);
}

/// The properties of blocks that are no devices.
fn of_blocks() -> impl Iterator<Item = &'static Meaning> {
    let of_boards = boards::BOARD.iter().chain(boards::LINK);
    of_boards.chain(control::CONTROLLER).chain(control::TEST)
}

/// Everything that is described: of kinds, of devices, of drivers, of boards and links.
fn all() -> Vec<&'static Meaning> {
    let of_kinds = KindName::ALL.iter().flat_map(|kind| kind.meanings());
    general().chain(of_blocks()).chain(of_kinds).collect()
}

#[test]
fn what_is_described_is_told_in_sentences() {
    for meaning in all() {
        let name = meaning.name;
        assert!(meaning.text.ends_with('.'), "{name}: {}", meaning.text);
        assert!(!meaning.text.contains("  "), "{name}: {}", meaning.text);
        assert!(!meaning.default.is_empty() && !meaning.default.ends_with('.'), "{name}");
        assert!(meaning.example.starts_with(&format!("{name} = ")), "{name}: {}", meaning.example);
        assert!(meaning.example.ends_with(';'), "{name}: {}", meaning.example);
        let parsed =
            sensedsl_syntax::parse(&format!("sensor X returns bool {{ {} }}", meaning.example));
        assert_eq!(parsed.errors(), [], "{name}: {}", meaning.example);
    }
}

/// The codes for a value of the wrong shape.
const SHAPE: [&str; 6] = ["E0201", "E0209", "E0210", "E0211", "E0212", "E0213"];

/// The mistakes in the shape of what a text says.
fn misshapen(text: &str) -> Vec<String> {
    let wrong = diagnostics(text).into_iter().filter(|one| one.severity == Severity::Error);
    let wrong = wrong.filter(|one| SHAPE.contains(&one.code.name()));
    // The selector is another device.
    wrong.map(|one| one.message).filter(|message| !message.starts_with("`mux`")).collect()
}

#[test]
fn the_example_of_a_kinds_property_is_right() {
    for kind in KindName::ALL {
        for meaning in of_kind(kind) {
            let name = meaning.name;
            let given = format!(
                "{} start = \"$GPGGA\"; pulse = 10 us; duplex = direction;",
                kind.spec().example
            );
            let given: Vec<&str> = given
                .split(';')
                .map(str::trim)
                .filter(|one| {
                    let other = one.split(' ').next().unwrap_or_default();
                    let is_known = kind.spec().properties.contains(&other);
                    other != name
                        && (is_known && (other != "start" || name == "checksum_from"))
                        && (other != "pulse" || ["wait", "trigger"].contains(&name))
                        && (other != "duplex" || name == "direction")
                })
                .collect();
            let given: String = given.iter().map(|one| format!("{one}; ")).collect();
            let ways = kind
                .spec()
                .directions
                .iter()
                .filter(|way| meaning.only.is_none_or(|only| only == **way));
            for direction in ways {
                let text = device(kind, *direction, &format!("{given}{}", meaning.example));
                assert_eq!(misshapen(&text), [] as [&str; 0], "{text}");
            }
        }
    }
}

#[test]
fn the_examples_of_drivers_are_right() {
    for meaning in drivers::ABOUT.iter().chain(drivers::PROTOCOL) {
        let i2c = "i2c { address = 0x20; reading r returns uint16 { register = 1; }";
        let uart = "uart { start = [0x59]; length = 2; reading r returns uint16 { byte = 0; }";
        let spi = "spi { reading r returns uint16 { register = 1; }";
        let of = match meaning.name {
            "init_checksum" => uart,
            "read_mask" => spi,
            _ => i2c,
        };
        let example = meaning.example;
        let text = format!("board B on {BOARD} {{ }}\ndriver own for {of} {example} }}");
        assert_eq!(misshapen(&text), [] as [&str; 0], "{text}");
    }
}

#[test]
fn every_property_is_on_the_pages() {
    let pages = [
        include_str!("../../../../docs/language.md"),
        include_str!("../../../../docs/driver-language.md"),
    ];
    for meaning in all() {
        let quoted = format!("`{}`", meaning.name);
        assert!(pages.iter().any(|page| page.contains(&quoted)), "{quoted}");
    }
}

/// What a library's driver states is among what a driver may have.
#[test]
fn drivers_of_the_library_have_nothing_else() {
    use sensedsl_syntax::parse;
    let kinds: BTreeMap<String, Vec<KindName>> =
        facts::all().into_iter().map(|part| (part.name, part.kinds)).collect();
    for driver in crate::LIBRARY.iter().flat_map(|(_, text)| parse(text).ast().drivers()) {
        let name = driver.name().unwrap().text().to_owned();
        let kinds = &kinds[&name];
        let known = |block: Block<'_>, property: sensedsl_syntax::ast::Property| {
            let written = property.name().unwrap().text().to_owned();
            assert!(block.property(&written).is_some(), "{name}: `{written}` in {block:?}");
        };
        driver.properties().for_each(|one| known(Block::Driver(kinds), one));
        for reading in driver.readings() {
            let block = Block::OfDriver(kinds, Direction::Sensor);
            reading.properties().for_each(|one| known(block, one));
        }
        for command in driver.commands() {
            let block = Block::OfDriver(kinds, Direction::Actuator);
            command.properties().for_each(|one| known(block, one));
        }
        for connection in driver.connections() {
            let kind = connection.kind().and_then(|kind| KindName::from_name(kind.text())).unwrap();
            connection.properties().for_each(|one| known(Block::Connection(kind), one));
        }
    }
}
