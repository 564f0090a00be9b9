//! Every built-in board: its facts agree with each other, the places that it names in a ChibiOS
//! tree exist, and the devices of Fig. 2 are wired on it without a pin that the board needs.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use sensedsl_board::catalog::{self, Entry};
use sensedsl_board::pin::PinName;
use sensedsl_board::profile::{self, Target, Transport};
use sensedsl_board::signal::Function;
use sensedsl_board::silicon;
use sensedsl_board::table::{Occupation, Pin, Table};
use sensedsl_firmware_chibios::Facts;
use sensedsl_model::design::Design;
use sensedsl_model::{NoFiles, Request, resolve};
use sensedsl_parts::{Completion, complete, find};
use sensedsl_tests::{TempDir, few, one_in, sensedsl, text};
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Solved, Wiring};

/// The complete table of a board.
fn whole(entry: &Entry) -> Table {
    let mut table = entry.table();
    match complete(&mut table) {
        Completion::Own => {}
        Completion::Unknown => panic!("{}: {} is not a known part", entry.name, entry.mcu),
        Completion::Part { found, strangers } => {
            assert!(!found.ambiguous, "{}: {} means several packages", entry.name, entry.mcu);
            assert_eq!(strangers, [], "{}: not on {}", entry.name, entry.mcu);
        }
    }
    table
}

#[test]
fn there_are_many_and_each_has_its_names() {
    let mut names: BTreeMap<String, &str> = BTreeMap::new();
    for entry in catalog::all() {
        let is_own = complete(&mut entry.table()) == Completion::Own;
        assert!(is_own || find(entry.mcu).is_some(), "{}: {} is unknown", entry.name, entry.mcu);
        for name in std::iter::once(&entry.name).chain(entry.aliases) {
            let folded = name.replace(['-', '_'], "").to_lowercase();
            let other = names.insert(folded, entry.name);
            assert_eq!(other, None, "{}: {name} is taken", entry.name);
        }
    }
    assert!(catalog::all().len() >= 120, "{} boards", catalog::all().len());
    let with_headers = catalog::all().iter().filter(|entry| {
        entry.table().pins.iter().filter(|pin| !pin.headers().is_empty()).count() >= 10
    });
    assert!(with_headers.count() >= 50);
}

/// For every signal that a system's drivers serve, the number of its alternate function is known.
/// F1 has none.
#[test]
fn alternate_functions_of_served_pins_are_known() {
    let mut unknown = Vec::new();
    let mut numbers = 0;
    for entry in catalog::all() {
        let Ok(Target::Profile(profile)) = profile::find(profile::DEFAULT, entry.mcu) else {
            continue;
        };
        if profile.family == "STM32F1" {
            continue;
        }
        for pin in &whole(entry).pins {
            for usage in &pin.usages {
                let function = usage.signal.function();
                let is_analog = matches!(function, Function::Adc { .. } | Function::Dac { .. });
                if is_analog || !profile.serves(function) {
                    continue;
                }
                let number =
                    usage.alternate.or_else(|| profile.alternate(&usage.signal, &pin.name));
                numbers += usize::from(number.is_some());
                if number.is_none() {
                    unknown.push(format!("{}: {} at {}", entry.name, usage.signal, pin.name));
                }
            }
        }
    }
    assert!(numbers > 1_000, "{numbers}");
    assert!(unknown.is_empty(), "{unknown:#?}");
}

fn pin<'a>(table: &'a Table, name: &PinName, of: &str) -> &'a Pin {
    table.pin(name).unwrap_or_else(|| panic!("{of}: {name} is not in the table"))
}

fn has(pin: &Pin, signal: &str) -> bool {
    pin.usages.iter().any(|usage| usage.signal.name() == signal)
}

#[test]
fn facts_agree_with_the_table() {
    for entry in catalog::all() {
        let board = entry.board().unwrap();
        // The table of the paper has 26 pins, and not all that the board's facts name.
        if entry.name == "STM32F4DiscoveryBoard" {
            continue;
        }
        let table = whole(entry);
        for source in &board.source {
            let output = [&source.what, &source.from, &source.licence];
            assert!(output.iter().all(|text| !text.is_empty()), "{}: empty source", entry.name);
        }
        for lever in board.button.iter().chain(&board.led) {
            let part = &pin(&table, &lever.pin, entry.name).onboard;
            assert!(part.is_some(), "{}: nothing is at {}", entry.name, lever.pin);
        }
        for link in &board.link {
            let pins: Vec<&Pin> =
                link.pins.iter().map(|name| pin(&table, name, entry.name)).collect();
            let carries = match link.transport {
                Transport::Uart => {
                    let wanted = [format!("{}_TX", link.unit), format!("{}_RX", link.unit)];
                    pins.len() == 2 && pins.iter().zip(&wanted).all(|(pin, s)| has(pin, s))
                }
                Transport::Usb => {
                    let ends = |pin: &Pin, end: &str| {
                        let names = pin.usages.iter().map(|usage| usage.signal.name());
                        names.into_iter().any(|n| n.starts_with("USB") && n.ends_with(end))
                    };
                    // No pins: the data lines are none of the table.
                    pins.is_empty() || ends(pins[0], "_DM") && ends(pins[1], "_DP")
                }
            };
            assert!(carries, "{}: {:?} does not carry {}", entry.name, link.pins, link.unit);
            let taken =
                |pin: &&Pin| pin.onboard.as_ref().is_some_and(|part| part.how == Occupation::Taken);
            assert!(pins.iter().all(taken), "{}: {:?} are free", entry.name, link.pins);
        }
    }
}

/// Whether a pin has a signal of a bus.
fn is_of_bus(pin: &Pin) -> bool {
    let starts = ["I2C", "FMPI2C", "SPI", "CAN", "FDCAN", "SERCOM"];
    pin.usages.iter().any(|usage| starts.iter().any(|s| usage.signal.name().starts_with(s)))
}

#[test]
fn joinable_pins_are_pins_of_a_bus() {
    for entry in catalog::all() {
        for pin in &whole(entry).pins {
            let Some(part) = &pin.onboard else { continue };
            let sound = part.how != Occupation::Bus || is_of_bus(pin);
            assert!(sound, "{}: {} is no pin of a bus", entry.name, pin.name);
            assert!(!part.part.is_empty(), "{}: {}", entry.name, pin.name);
        }
    }
}

/// The devices of Fig. 2. The display of one board leaves too few pins, so it is released.
fn fig2_on(entry: &Entry, target: Option<&str>) -> String {
    let rule = if entry.name == "STM32L-DISCOVERY" { "release LCD;" } else { "" };
    format!(
        "board Fig2 on {} {{
            {rule}
            sensor Front returns uint16 {{ id = 17; type = analog; delay = 60; prio = 1; }}
            sensor FrontRight returns uint16 {{ id = 18; type = analog; delay = 1 s; }}
            sensor Rear returns uint16 {{
                id = 19; type = i2c; driver = srf08; address = 0x73; delay = 70; prio = 2;
            }}
            {}
        }}",
        entry.name.replace('-', "_"),
        // Where nothing captures, there is no wheel.
        if captures(entry) && has_driver(entry, target) {
            "sensor Wheel returns uint32 { id = 20; type = icu; }"
        } else {
            ""
        }
    )
}

/// Whether any timer of the board's MCU captures.
pub(crate) fn captures(entry: &Entry) -> bool {
    let capture = silicon::of(entry.mcu).and_then(|silicon| silicon.timers.capture.as_ref());
    capture.is_none_or(|ability| !ability.channels.is_empty())
}

/// Whether the target that a file has by itself, if `target` names no other, drives a timer that captures.
fn has_driver(entry: &Entry, target: Option<&str>) -> bool {
    let target = target.unwrap_or_else(|| profile::usual(entry.mcu));
    match profile::find(target, entry.mcu) {
        Ok(Target::Profile(profile)) => {
            !profile.pios.is_empty() || profile.timers.iter().any(|timer| timer.icu.is_some())
        }
        // The pins alone count.
        Ok(Target::None) | Err(_) => true,
    }
}

#[track_caller]
fn wired(entry: &Entry, target: Option<&str>) -> (Design, Assignment) {
    let text = fig2_on(entry, target);
    let request = Request { path: "fig2.sense", text: &text, board: None, target };
    let resolved = resolve(&request, &NoFiles);
    let output: Vec<&str> = resolved.diagnostics.iter().map(|output| output.code.name()).collect();
    // Without a profile for the MCU the design is still wired, and a hint names what is not
    // checked.
    let known = target.is_some() || !output.contains(&"H0702") || output == ["H0702"];
    assert!(known, "{}: {output:?}", entry.name);
    let design = resolved.design.unwrap_or_else(|| panic!("{}: {output:?}", entry.name));
    match Wiring::new(&design, None).solve_only(false) {
        Solved::Wired(wiring) => (design, *wiring),
        _ => panic!("{} cannot carry Fig. 2", entry.name),
    }
}

#[test]
fn each_carries_fig2_and_keeps_what_it_needs() {
    for entry in one_in(5, catalog::all()) {
        for target in [None, Some("none")] {
            let (design, wiring) = wired(entry, target);
            let board = &design.boards[0];
            let wires = wiring.boards[0].devices.iter().flat_map(|device| &device.wires);
            for pin in wires.filter_map(|wire| wire.pin(board)) {
                let released = |part: &str| board.released.iter().any(|rule| rule.value == part);
                let taken = pin
                    .onboard
                    .as_ref()
                    .is_some_and(|part| part.how == Occupation::Taken && !released(&part.part));
                assert!(!taken, "{}: {} is taken", entry.name, pin.name);
            }
        }
    }
}

/// Each chosen pin is printed with its cost.
#[test]
fn costs_of_fig2_on_the_discovery_are_told() {
    let entry = catalog::find("STM32F407G-DISC1").unwrap();
    let ran = sensedsl(["solve", "-", "-q", "--format", "json"]).stdin(fig2_on(entry, None)).run();
    let answer = ran.exits(0).json();
    let table = whole(entry);
    let mut sum = 0;
    let mut pins = BTreeSet::new();
    for device in answer["boards"][0]["devices"].as_array().unwrap() {
        for wire in device["wires"].as_array().unwrap() {
            let name = PinName::parse(wire["pin"].as_str().unwrap()).unwrap();
            let cost = u64::from(pin(&table, &name, entry.name).cost());
            assert_eq!(wire["usages"].as_u64(), Some(cost), "{name}");
            if pins.insert(name) {
                sum += cost;
            }
        }
    }
    assert_eq!(answer["cost"].as_u64(), Some(sum));
}

/// Checks the places in the tree that `CHIBIOS` names.
#[test]
fn places_in_the_tree_exist() {
    let Some(tree) = std::env::var_os("CHIBIOS") else {
        eprintln!("SKIPPED: CHIBIOS names no tree");
        return;
    };
    let tree = Path::new(&tree);
    for entry in catalog::all() {
        let facts = entry.board().unwrap();
        let (Some(chibios), name) = (Facts::of(&facts).unwrap(), entry.name) else { continue };
        let board = tree.join("os/hal/boards").join(&chibios.board).join("board.mk");
        assert!(board.is_file(), "{name}: {}", board.display());
        let mcuconf = tree.join(&chibios.demo).join(&chibios.cfg).join("mcuconf.h");
        let output = std::fs::read(&mcuconf).unwrap_or_else(|e| panic!("{name}: {e}"));
        let output = String::from_utf8_lossy(&output).into_owned();
        assert!(output.contains(&chibios.mcuconf), "{name}: no {}", chibios.mcuconf);
        let folder = "os/common/startup/ARMCMx/compilers/GCC/ld";
        let script = tree.join(folder).join(&chibios.ldscript);
        assert!(script.is_file(), "{name}: {}", script.display());
        // The files of the tree that the sources cite exist.
        for source in entry.board().unwrap().source {
            let Some(paths) = source.from.strip_prefix("ChibiOS 21.11: ") else { continue };
            let first = paths.split(", ").next().unwrap();
            assert!(tree.join(first).exists(), "{name}: {first}");
        }
    }
}

/// If a profile and a folder of the tree are known, firmware is generated for the paper's example.
#[test]
fn boards_with_a_profile_have_firmware() {
    let names =
        ["NUCLEO-F072RB", "NUCLEO-F103RB", "NUCLEO-G474RE", "NUCLEO-H743ZI", "NUCLEO-L476RG"];
    for name in few(&names, 2) {
        let scratch = TempDir::new("template");
        let file = scratch.write("fig2.sense", fig2_on(catalog::find(name).unwrap(), None));
        let (file, out) = (file.display().to_string(), scratch.path().join("out"));
        let out = out.display().to_string();
        let ran = sensedsl(["generate", &file, "-o", &out]).run();
        assert_eq!(ran.status, 0, "{name}: {}", ran.stderr);
        assert!(Path::new(&out).join("firmware").exists());
    }
}

#[test]
fn the_printed_table_is_whole() {
    let scratch = TempDir::new("printed");
    for name in ["NUCLEO-F411RE", "RASPBERRYPI-PICO", "ARDUINO-NANO", "STM32F407G-DISC1"] {
        let printed = sensedsl(["boards", name]).run().exits(0).stdout;
        let table = scratch.write("printed.csv", &printed).display().to_string();
        let file = fig2_on(catalog::find(name).unwrap(), None);
        let of_board = ["solve", "-", "-q", "--format", "csv", "--target", "none"];
        let of_table = [&of_board[..], &["--board", &table]].concat();
        let left = sensedsl(of_board).stdin(file.clone()).run().exits(0).stdout;
        assert_eq!(sensedsl(of_table).stdin(file).run().exits(0).stdout, left, "{name}");
    }
    let all = sensedsl(["boards"]).run().exits(0).stdout;
    assert!(all.lines().count() >= 80 && all.lines().all(|line| line.chars().count() <= 110));
    // The table of the paper is printed unchanged.
    let printed = sensedsl(["boards", "STM32F4DiscoveryBoard"]).run().exits(0).stdout;
    assert_eq!(printed, text("crates/board/boards/STM32F4DiscoveryBoard/pins.csv"));
}

/// The picture has all contacts, with the printed labels, and a pin at two of them is at both.
#[test]
fn the_picture_shows_the_connectors() {
    let file = fig2_on(catalog::find("NUCLEO-F411RE").unwrap(), None);
    let svg = sensedsl(["solve", "-", "-q", "--format", "svg"]).stdin(file).run().exits(0).stdout;
    for text in
        [">CN7<", ">CN10<", ">A0 PA0<", "<title>CN7.28: PA0; printed A0", "<title>CN8.1: PA0"]
    {
        assert!(svg.contains(text), "{text} is not shown");
    }
    assert!(svg.contains("<title>CN7.8: GND</title>"));
}

/// Facts on which the makers' pages and public board files agree, and which a table once had wrong.
#[test]
fn labels_and_lights_are_where_the_boards_have_them() {
    let facts = [
        ("NUCLEO-WL55JC1", "PB7", "D0", ""),
        ("NUCLEO-WL55JC1", "PB6", "D1", ""),
        ("NUCLEO-WL55JC1", "PA12", "D15", ""),
        ("STM32F746G-DISCO", "PI1", "D13", "LED LD1"),
        ("STM32F769I-DISC1", "PA12", "D13", "LED LD3"),
        ("NUCLEO-F302R8", "PB15", "D11", ""),
        ("NUCLEO-F302R8", "PB14", "D12", ""),
        ("NUCLEO-F302R8", "PB13", "D13", "LED LD2"),
        ("NUCLEO-F302R8", "PA5", "", ""),
        ("NUCLEO-F070RB", "PA5", "D13", "LED LD2"),
        ("NUCLEO-F072RB", "PA5", "D13", "LED LD2"),
        ("NUCLEO-L452RE-P", "PA10", "D0", ""),
        ("NUCLEO-H743ZI", "PG9", "D0", ""),
        ("NUCLEO-H743ZI", "PB7", "", "LED LD2"),
        ("NUCLEO-H743ZI", "PG6", "", "USB"),
        ("NUCLEO-H743ZI2", "PB7", "D0", ""),
        ("NUCLEO-H743ZI2", "PE1", "", "LED LD2"),
        ("NUCLEO-H743ZI2", "PD10", "", "USB"),
        ("RASPBERRYPI-PICO", "GP23", "", "Supply mode"),
    ];
    for (board, pin, label, part) in facts {
        let table = catalog::find(board).unwrap().table();
        let row = table.pin(&PinName::parse(pin).unwrap()).unwrap();
        assert_eq!(row.label.as_deref().unwrap_or_default(), label, "{board} {pin}");
        let on = row.onboard.as_ref().map_or("", |on| on.part.as_str());
        assert_eq!(on, part, "{board} {pin}");
    }
}

/// A connector label is on one pin only, and the LED that firmware uses is marked as an LED.
#[test]
fn labels_are_on_one_pin_and_lights_are_marked() {
    for entry in catalog::all() {
        let pins = entry.table().pins;
        let mut labels: BTreeMap<&str, &str> = BTreeMap::new();
        for pin in &pins {
            // Labels such as D13 and A0; `EXT` is on a whole connector.
            let labels_here = pin.label.iter().flat_map(|label| label.split([' ', '/']));
            let numbered = labels_here.filter(|label| {
                let number = label.strip_prefix(['A', 'D']);
                number.is_some_and(|number| number.parse::<u8>().is_ok())
            });
            for label in numbered {
                let other = labels.insert(label, pin.name.as_str());
                assert_eq!(other, None, "{}: {label} is on {} as well", entry.name, pin.name);
            }
        }
        let Some(led) = entry.board().unwrap().led else { continue };
        let Some(pin) = pins.iter().find(|pin| pin.name == led.pin) else { continue };
        let marked = pin.onboard.as_ref().is_some_and(|part| part.part.starts_with("LED"));
        assert!(marked, "{}: {} is a light and not marked", entry.name, led.pin);
    }
}
