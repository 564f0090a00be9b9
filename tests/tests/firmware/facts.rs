//! Generated files are read back and compared with the wiring and the design by a second reader,
//! which shares nothing with the generator. It only knows a few forms of the generated C: those of
//! pads, tables and options.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_generate::target;
use sensedsl_model::NoFiles;
use sensedsl_model::design::Design;
use sensedsl_model::kind::Kind;
use sensedsl_session::{Ask, On, Workspace};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment};

use super::applications::{CAR, FIG2};
use super::details;

/// The files of one board, by their path in its folder.
pub(crate) type Folder = BTreeMap<String, String>;

/// Solves and generates a design with one board, and passes the results to `then`.
pub(crate) fn with<T>(text: &str, then: impl FnOnce(&Design, &Assignment, Folder) -> T) -> T {
    let mut workspace = Workspace::default();
    workspace.open("facts.sense", text);
    let snapshot = workspace.snapshot("facts.sense", On::default(), &NoFiles);
    let answer = snapshot.solve(&Ask::default());
    let (design, wiring) = answer.wired().unwrap();
    let files = target::firmware(design, wiring).unwrap();
    let file = |(path, entry): (&str, &sensedsl_files::FileEntry)| {
        let (_, path) = path.split_once('/').unwrap();
        (path.to_owned(), String::from_utf8(entry.bytes.clone()).unwrap())
    };
    let folder = files.iter().map(file).collect();
    then(design, wiring, folder)
}

/// The text after each `prefix`, up to the first character that is not part of a number or a word.
pub(super) fn after<'a>(text: &'a str, prefix: &str) -> Vec<&'a str> {
    let rest = text.split(prefix).skip(1);
    let word = |rest: &'a str| {
        let end = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '-');
        &rest[..end.unwrap_or(rest.len())]
    };
    rest.map(word).collect()
}

/// The numbers after each `prefix`: `17U`, `0x73U`, `-3`.
pub(super) fn numbers(text: &str, prefix: &str) -> Vec<i64> {
    let number = |word: &str| {
        let word = word.trim_end_matches('U');
        word.strip_prefix("0x")
            .map_or_else(|| word.parse(), |hex| i64::from_str_radix(hex, 16))
            .ok()
    };
    after(text, prefix).into_iter().filter_map(number).collect()
}

fn set<T: Ord + Clone>(all: &[T]) -> BTreeSet<T> {
    all.iter().cloned().collect()
}

/// Collects the differences.
pub(super) struct Differences(Vec<String>);

impl Differences {
    pub(super) fn same<T: PartialEq + std::fmt::Debug>(&mut self, what: &str, found: T, wanted: T) {
        if found != wanted {
            self.0.push(format!("{what}: {found:?}, should be {wanted:?}"));
        }
    }
}

/// All differences of the files from the wiring and the design.
pub(crate) fn differences(design: &Design, wiring: &Assignment, folder: &Folder) -> Vec<String> {
    let mut differences = Differences(Vec::new());
    let (on, _) = wiring.used(design).next().unwrap();
    let hardware = &folder["generated/sense_hw.c"];
    pads(design, on, hardware, &mut differences);
    units(design, on, hardware, &mut differences);
    buses(design, on, hardware, &mut differences);
    captures(design, on, hardware, &mut differences);
    threads(design, on, folder, &mut differences);
    schema(design, on, folder, &mut differences);
    streams(on, &folder["cfg/mcuconf.h"], &mut differences);
    details::details(design, on, folder, &mut differences);
    differences.0
}

/// Each pin must have its own number, and the function of its wire.
fn pads(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let board = design.board(on.board).unwrap();
    let mut modes = BTreeMap::new();
    let table = hardware.split("pads[] = {").nth(1).unwrap().split("\n};").next().unwrap();
    for line in table.lines().filter(|line| line.contains("PAL_LINE(")) {
        let pin = line.trim().strip_prefix("/* ").unwrap().split(' ').next().unwrap();
        let port = after(line, "GPIO")[0];
        differences.same(
            "a pad",
            format!("P{port}{}", numbers(line, &format!("GPIO{port}, "))[0]),
            pin.to_owned(),
        );
        let _ = modes.insert(pin.to_owned(), line.to_owned());
    }
    let links = on.link.iter().flat_map(|link| &link.wires);
    let wires = on.connections.iter().flat_map(|one| &one.wires).chain(links);
    for wire in wires {
        let pin = wire.pin(board).unwrap();
        let mode = modes.get(pin.name.as_str()).cloned().unwrap_or_default();
        let Some(usage) = wire.usage(board) else { continue };
        let signal = usage.signal.to_string();
        if signal.contains("ADC") {
            differences.same(&format!("mode of {}", pin.name), mode.contains("ANALOG"), true);
            continue;
        }
        let usual = || board.profile()?.alternate(&usage.signal, &pin.name);
        let number = usage.alternate.or_else(usual).unwrap();
        let wanted = vec![i64::from(number)];
        differences.same(
            &format!("{signal} at {}", pin.name),
            numbers(&mode, "PAL_MODE_ALTERNATE("),
            wanted,
        );
        let (open, bus) = (mode.contains("OPENDRAIN"), signal.starts_with("I2C"));
        differences.same(&format!("drive of {}", pin.name), open, bus);
    }
}

/// The driver objects must be those of the units in the wiring, the channels those of the signals.
fn units(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let board = design.board(on.board).unwrap();
    for (unit, driver) in [("ADC", "&ADCD"), ("I2C", "&I2CD"), ("TIM", "&ICUD")] {
        let numbers_of = |name: &String| name.strip_prefix(unit)?.parse::<i64>().ok();
        let wanted: BTreeSet<i64> =
            on.connections.iter().filter_map(|one| numbers_of(one.unit.as_ref()?)).collect();
        differences.same(driver, set(&numbers(hardware, driver)), wanted);
    }
    let signals =
        on.connections.iter().flat_map(|one| &one.wires).filter_map(|wire| wire.usage(board));
    let signals: Vec<String> = signals.map(|usage| usage.signal.to_string()).collect();
    let inputs = signals.iter().filter(|signal| signal.starts_with("ADC"));
    let inputs: BTreeSet<i64> = inputs.flat_map(|signal| numbers(signal, "IN")).collect();
    differences.same("channels", set(&numbers(hardware, "ADC_CHANNEL_IN")), inputs.clone());
    differences.same("sampling times", set(&numbers(hardware, "_SMP_AN")), inputs);
    let lengths = numbers(hardware, "ADC_SQR1_NUM_CH(");
    differences.same("lengths of sequences", lengths, numbers(hardware, ".num_channels = "));
    let mut captured: Vec<i64> = on
        .connections
        .iter()
        .filter(|one| one.unit.as_deref().is_some_and(|unit| unit.starts_with("TIM")))
        .flat_map(|one| numbers(&one.wires[0].usage(board).unwrap().signal.to_string(), "_CH"))
        .collect();
    let mut found = numbers(hardware, ".channel = ICU_CHANNEL_");
    captured.sort_unstable();
    found.sort_unstable();
    differences.same("capture channels", found, captured);
}

/// Checks how devices on buses are read: addresses, registers, lengths, waits and so on.
fn buses(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let all: Vec<_> = on
        .devices
        .iter()
        .filter_map(|one| match &design.device(one.device)?.kind {
            Kind::I2c(i2c) => Some(i2c),
            _ => None,
        })
        .collect();
    let of = |take: &dyn Fn(&sensedsl_model::kind::i2c::I2c) -> i64| -> BTreeSet<i64> {
        all.iter().map(|one| take(one)).collect()
    };
    let found = |prefix: &str| set(&numbers(hardware, prefix));
    differences.same("addresses", found(".address = "), of(&|one| i64::from(one.address)));
    differences.same(
        "registers",
        set(&numbers(&hardware.replace("_select_0[] = {", "\nselect "), "\nselect ")),
        all.iter().filter_map(|one| one.register.map(i64::from)).collect(),
    );
    differences.same("lengths", found(".length = "), of(&|one| i64::from(one.length_bytes)));
    differences.same(
        "waits",
        found(".wait_ms = "),
        of(&|one| i64::from(one.wait_us.div_ceil(1000))),
    );
    let is_little = |one: &&&sensedsl_model::kind::i2c::I2c| {
        one.order == sensedsl_model::kind::i2c::ByteOrder::Little
    };
    let found_little = hardware.matches(".little_endian = true").count();
    differences.same("byte order", found_little, all.iter().filter(is_little).count());
    let triggers: BTreeSet<Vec<u8>> = all.iter().map(|one| one.trigger.clone()).collect();
    let text = hardware.split("_trigger_").filter_map(|rest| rest.split_once("[] = {"));
    let bytes = text.filter(|(name, _)| name.len() < 4).map(|(_, rest)| {
        let inside = rest.split('}').next().unwrap();
        inside.split(',').map(|one| numbers(&format!("={}", one.trim()), "=")[0] as u8).collect()
    });
    differences.same("triggers", bytes.collect::<BTreeSet<Vec<u8>>>(), triggers);
    let fastest = all.iter().map(|one| i64::from(one.speed_hz)).min().unwrap_or(i64::MAX);
    let clocks = numbers(hardware, ".clock_speed = ");
    differences.same("clocks", clocks.iter().all(|hz| *hz <= fastest && *hz * 2 > fastest), true);
}

/// Checks edges and ticks.
fn captures(design: &Design, on: &BoardAssignment, hardware: &str, differences: &mut Differences) {
    let mut ticks = Vec::new();
    for one in &on.devices {
        if let Kind::Icu(icu) = &design.device(one.device).unwrap().kind {
            ticks.push(i64::from(icu.tick_hz));
        }
    }
    let mut found = numbers(hardware, ".frequency = ");
    ticks.sort_unstable();
    found.sort_unstable();
    differences.same("ticks", found.clone(), ticks.clone());
    let mut reported = numbers(hardware, ".tick_hz = ");
    reported.sort_unstable();
    differences.same("ticks of the runtime", reported, ticks);
    let both = hardware.matches(".both_edges = true").count();
    let wanted = on.devices.iter().filter(|one| {
        matches!(&design.device(one.device).unwrap().kind, Kind::Icu(icu)
            if icu.edge == sensedsl_model::kind::icu::Edge::Both)
    });
    differences.same("both edges", both, wanted.count());
    let falling = hardware.matches("ICU_INPUT_ACTIVE_LOW").count();
    let wanted = on.devices.iter().filter(|one| {
        matches!(&design.device(one.device).unwrap().kind, Kind::Icu(icu)
            if icu.edge == sensedsl_model::kind::icu::Edge::Falling)
    });
    differences.same("falling edges", falling, wanted.count());
}

/// Each class must have a thread with its cycle and priority.
fn threads(design: &Design, on: &BoardAssignment, folder: &Folder, differences: &mut Differences) {
    let (hardware, conf) = (&folder["generated/sense_hw.c"], &folder["cfg/up_conf.h"]);
    let devices = on.devices.iter().filter_map(|one| design.device(one.device));
    let cyclic: Vec<_> = devices.filter(|one| !matches!(one.kind, Kind::Icu(_))).collect();
    let pairs: BTreeSet<(i64, i64)> =
        cyclic.iter().map(|one| (i64::from(one.delay_ms), i64::from(one.prio))).collect();
    let found: BTreeSet<(i64, i64)> = numbers(hardware, ".delay_ms = ")
        .into_iter()
        .zip(numbers(hardware, ".prio = "))
        .filter(|(delay, _)| *delay > 0)
        .collect();
    let pulses = hardware.contains("up_pulse_cycle");
    differences.same("cycles and priorities", pulses || found == pairs, true);
    let tasks = i64::try_from(hardware.matches("        .cycle = ").count()).unwrap();
    differences.same("number of threads", numbers(conf, "UP_TASKS_COUNT "), vec![tasks]);
    // Each sensor must be read in exactly one place.
    let names = on.devices.iter().filter_map(|one| design.device(one.device));
    let mut names: Vec<&str> = names.map(|one| one.name.value.as_str()).collect();
    let mut read = after(hardware, ".field = SENSE_FIELD_");
    names.sort_unstable();
    read.sort_unstable();
    differences.same("who is read", read, names);
}

/// Identifiers, types and directions, in the file's order.
fn schema(design: &Design, on: &BoardAssignment, folder: &Folder, differences: &mut Differences) {
    let model = &folder["generated/sense_model.c"];
    let indices: Vec<_> = on.devices.iter().map(|one| one.device).collect();
    let schema = design.schema(on.board, &indices);
    let ids: Vec<i64> = schema.items.iter().map(|item| i64::from(item.id)).collect();
    differences.same("identifiers", numbers(model, ".id = "), ids);
    let names: Vec<String> = schema.items.iter().map(|item| item.name.clone()).collect();
    let quoted = model.split("char name_").skip(1).map(|rest| rest.split('"').nth(1).unwrap());
    differences.same("names", quoted.map(str::to_owned).collect(), names.clone());
    let places: Vec<i64> = (0..).take(names.len()).collect();
    differences.same("numbers of names", numbers(model, ".name = name_"), places);
    let types: Vec<String> =
        schema.items.iter().map(|item| item.value.scalar.name().to_uppercase()).collect();
    let found = after(model, ".type = UP_TYPE_");
    differences.same("types", found.iter().map(|one| (*one).to_owned()).collect(), types);
    let offsets = after(model, "offsetof(sense_values_t, SENSE_");
    differences.same(
        "places",
        offsets.iter().map(|one| (*one).to_owned()).collect(),
        names.clone(),
    );
    let to_host = |item: &sensedsl_wire::Item| item.direction == sensedsl_wire::Direction::Sensor;
    let directions: Vec<bool> = schema.items.iter().map(to_host).collect();
    let found = after(model, ".direction = UP_TO_");
    differences.same("directions", found.iter().map(|one| *one == "HOST").collect(), directions);
    differences.same("checksum", after(model, "checksum[] = \""), vec![schema.checksum.name()]);
    let count = vec![i64::try_from(names.len()).unwrap()];
    differences.same("number of fields", numbers(model, ".fields_count = "), count.clone());
    differences.same(
        "fields in the sizes",
        numbers(&folder["cfg/up_conf.h"], "UP_FIELDS_COUNT "),
        count,
    );
    let hash = after(model, ".hash = ");
    differences.same("hash", hash[0].to_owned(), format!("{:#010x}U", schema.hash()));
    let header = &folder["generated/sense_model.h"];
    for (at, name) in names.iter().enumerate() {
        let found = numbers(header, &format!("SENSE_FIELD_{name} = "));
        differences.same(&format!("number of {name}"), found, vec![i64::try_from(at).unwrap()]);
        let scalar = schema.items[at].value.scalar.name();
        let declared = header.contains(&format!("  {scalar}_t SENSE_{name}"))
            || !(scalar.starts_with("int") || scalar.starts_with("uint"));
        differences.same(&format!("stored type of {name}"), declared, true);
    }
}

/// The DMA streams of the wiring, each as its option states.
fn streams(on: &BoardAssignment, settings: &str, differences: &mut Differences) {
    let wanted: BTreeSet<String> = on
        .dma
        .iter()
        .map(|one| {
            let (unit, stream) = (&one.unit, one.stream.replace(',', ", "));
            let way = one.request.strip_prefix(unit.as_str()).unwrap_or("");
            let kind = unit.trim_end_matches(|c: char| c.is_ascii_digit());
            format!("STM32_{kind}_{unit}{way}_DMA_STREAM STM32_DMA_STREAM_ID({stream})")
        })
        .collect();
    let found = settings.lines().filter_map(|line| line.strip_prefix("#define "));
    let found = found.filter(|line| line.contains("_DMA_STREAM STM32")).map(str::to_owned);
    differences.same("streams", found.collect(), wanted);
}

#[test]
fn generated_files_say_what_the_wiring_says() {
    for text in [FIG2, CAR] {
        with(text, |design, wiring, folder| {
            let found = differences(design, wiring, &folder);
            assert!(found.is_empty(), "{found:#?}");
        });
    }
}
