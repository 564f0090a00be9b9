//! The diagram for Wokwi: its parts, contacts and wires are what Wokwi has and what the wiring says, and no part lies
//! on another. `tests/wokwi/contacts.txt` has the facts.

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_tests::{RunOutput, sensedsl, text};
use serde_json::Value;

/// A part of Wokwi's: its size, and by contact the MCU's pin where it has one.
struct Facts {
    width: i64,
    height: i64,
    contacts: BTreeMap<String, Option<String>>,
}

fn facts() -> BTreeMap<String, Facts> {
    let file = text("tests/wokwi/contacts.txt");
    let part = |line: &str| {
        let mut words = line.split(' ');
        let kind = words.next().unwrap().to_owned();
        let (width, height) = words.next().unwrap().split_once('x').unwrap();
        let contact = |word: &str| match word.split_once('=') {
            Some((contact, pin)) => (contact.to_owned(), Some(pin.to_owned())),
            None => (word.to_owned(), None),
        };
        let contacts = words.map(contact).collect();
        (kind, Facts { width: width.parse().unwrap(), height: height.parse().unwrap(), contacts })
    };
    file.lines().filter(|line| !line.starts_with('#')).map(part).collect()
}

/// The boards that Wokwi has.
const BOARDS: [&str; 19] = [
    "ARDUINO_UNO_R3",
    "ARDUINO_NANO",
    "ARDUINO_MEGA_2560",
    "RASPBERRYPI_PICO",
    "RASPBERRYPI_PICO_W",
    "RASPBERRYPI_PICO_2",
    "NUCLEO_C031C6",
    "NUCLEO_L031K6",
    "NUCLEO_L432KC",
    "BLUEPILL_F103C8",
    "BLACKPILL_F411CE",
    "ESP32_DEVKITC_V4",
    "ESP32_C3_DEVKITM_1",
    "ESP32_C6_DEVKITC_1",
    "ESP32_S3_DEVKITC_1",
    "ARDUINO_NANO_ESP32",
    "XIAO_ESP32C3",
    "XIAO_ESP32C6",
    "XIAO_ESP32S3",
];

/// Parts that every board has pins for.
const FEW: &str = "
    chip Imu { driver = mpu6050; address = 0x69; }
    sensor Knob returns uint16 { driver = potentiometer; }
    sensor Go returns bool { driver = push_button; }
    actuator Lamp accepts bool { driver = led; }
    actuator Arm accepts uint16 { driver = servo; }
";

/// All that there is a part or a stand-in for, as far as a board carries it at once.
const ALL: [&str; 2] = [
    "
    sensor Range returns uint16 { driver = hcsr04; }
    chip Imu { driver = \"GY-521\"; }
    actuator Arm accepts uint16 { driver = servo; }
    actuator Fan accepts uint16 { driver = esc; }
    actuator Lamp accepts bool { driver = led; }
    actuator Row accepts bool[3] { driver = led; }
    sensor Go returns bool { driver = push_button; }
    sensor End returns bool { driver = limit_switch; }
    actuator Pump accepts bool { driver = relay; }
    actuator Beep accepts bool { driver = buzzer; }
    sensor Floor returns uint16[2] { driver = reflectance_analog; }
    sensor Wheel returns uint16 { driver = hall_speed; }
",
    "
    actuator Back accepts uint16 { driver = esc_reversible; }
    actuator Glow accepts uint16 { driver = led_dimmable; }
    sensor Stop returns bool { driver = emergency_stop; }
    actuator Valve accepts bool { driver = relay_active_low; }
    actuator Tune accepts uint16 { driver = buzzer_passive; }
    sensor Turn returns int32 { driver = quadrature_encoder; }
    chip Shift { driver = hc595_pins; }
    sensor Dark returns bool { driver = reflectance_digital; }
    sensor Plain returns uint16 { type = analog; }
    sensor Level returns bool { type = digital; }
    actuator Out accepts bool { type = digital; }
    actuator Duty accepts uint16 { type = pwm; frequency = 1 kHz; }
    sensor Pulses returns uint32 { type = icu; }
",
];

fn solve(board: &str, devices: &str, form: &str) -> RunOutput {
    let text = format!("board {board} {{ {devices} }}");
    sensedsl(["solve", "-", "--format", form]).stdin(text).run()
}

fn words(value: &Value, key: &str) -> String {
    value[key].as_str().unwrap().to_owned()
}

/// The wires of a diagram whose ends all exist: for each contact of a part, that of the board, or of another part.
fn wires(diagram: &Value, facts: &BTreeMap<String, Facts>) -> Vec<[String; 2]> {
    let parts = diagram["parts"].as_array().unwrap();
    let mut kinds = BTreeMap::new();
    for part in parts {
        let (id, kind) = (words(part, "id"), words(part, "type"));
        assert!(kind == "wokwi-text" || facts.contains_key(&kind), "{kind}");
        assert!(!id.contains(':') && kinds.insert(id, kind).is_none(), "{part}");
    }
    let connections = diagram["connections"].as_array().unwrap();
    let ends = connections.iter().map(|wire| [0, 1].map(|end| wire[end].as_str().unwrap()));
    for end in ends.clone().flatten() {
        let (id, contact) = end.split_once(':').unwrap();
        if id == "$serialMonitor" {
            assert!(["RX", "TX"].contains(&contact), "{end}");
            continue;
        }
        let kind = kinds.get(id).unwrap_or_else(|| panic!("{end}"));
        assert!(facts[kind].contacts.contains_key(contact), "{kind} has no {contact}");
    }
    ends.map(|pair| pair.map(str::to_owned)).collect()
}

/// No part is on another, with the line of text above it.
fn nothing_overlaps(diagram: &Value, facts: &BTreeMap<String, Facts>) {
    let boxes: Vec<[i64; 4]> = diagram["parts"]
        .as_array()
        .unwrap()
        .iter()
        .map(|part| {
            let (left, top) = (part["left"].as_i64().unwrap(), part["top"].as_i64().unwrap());
            let (width, height) = match facts.get(&words(part, "type")) {
                Some(facts) => (facts.width, facts.height),
                None => {
                    let text = part["attrs"]["text"].as_str().unwrap();
                    let letters = text.lines().map(str::len).max().unwrap_or_default();
                    (8 * letters as i64, 20 * text.lines().count() as i64)
                }
            };
            [left, top, left + width, top + height]
        })
        .collect();
    for (number, one) in boxes.iter().enumerate() {
        for other in &boxes[..number] {
            let apart = one[0] >= other[2]
                || other[0] >= one[2]
                || one[1] >= other[3]
                || other[1] >= one[3];
            assert!(apart, "{one:?} is on {other:?} in {diagram}");
        }
    }
}

/// The pins of a wiring in JSON, with how many wires there are at each; `left_out` are not counted.
fn pins(answer: &Value, left_out: &[&str]) -> BTreeMap<String, usize> {
    let mut pins = BTreeMap::new();
    for board in answer["boards"].as_array().unwrap() {
        for device in board["devices"].as_array().unwrap() {
            let names = [&device["name"], &device["chip"]];
            if names.iter().any(|name| left_out.iter().any(|one| *name == one)) {
                continue;
            }
            for wire in device["wires"].as_array().unwrap() {
                if wire["role"] != "miso" {
                    *pins.entry(words(wire, "pin")).or_default() += 1;
                }
            }
        }
        for wire in board["link"]["wires"].as_array().into_iter().flatten() {
            *pins.entry(words(wire, "pin")).or_default() += 1;
        }
    }
    pins
}

/// The MCU's pin at a contact of an Arduino, by what our table says is printed there.
fn printed_pin(board: &str, contact: &str) -> Option<String> {
    let table = sensedsl_board::catalog::find(board).unwrap().table();
    let is_it = |label: &str| label == contact || label.strip_prefix('D') == Some(contact);
    let pin = table.pins.iter().find(|pin| {
        let places = pin.places.iter().filter_map(|place| place.label.as_deref());
        places.chain(pin.label.as_deref()).any(is_it)
    });
    pin.map(|pin| pin.name.to_string())
}

/// A diagram is complete: each wire of the wiring is in it once, between contacts that exist.
fn is_the_wiring(board: &str, devices: &str) -> Value {
    let facts = facts();
    let ran = solve(board, devices, "wokwi").exits(0);
    assert!(!ran.stderr.contains("W0617"), "{}", ran.stderr);
    let diagram = ran.json();
    assert_eq!(diagram["version"], 1);
    nothing_overlaps(&diagram, &facts);
    let kind = words(&diagram["parts"][0], "type");
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    let mut at_parts = BTreeSet::new();
    for [from, to] in wires(&diagram, &facts) {
        assert!(at_parts.insert(to.clone()) || to.starts_with('$'), "two wires at {to}");
        let Some(contact) = from.strip_prefix(&format!("{board}:")) else { continue };
        let pin = match &facts[&kind].contacts[contact] {
            Some(pin) => Some(pin.clone()),
            None => printed_pin(board, contact).filter(|_| kind.contains("arduino")),
        };
        match pin {
            Some(pin) => *found.entry(pin).or_default() += 1,
            None => assert!(
                ["GND", "3", "5V", "VBUS"].iter().any(|rail| contact.starts_with(rail)),
                "{from}"
            ),
        }
    }
    let answer = solve(board, devices, "json").exits(0).json();
    // A device of a chip has all wires of the chip.
    let wanted: BTreeMap<String, usize> = pins(&answer, &[]);
    let names = |all: &BTreeMap<String, usize>| all.keys().cloned().collect::<BTreeSet<_>>();
    assert_eq!(names(&found), names(&wanted), "{board}: {diagram}");
    diagram
}

#[test]
fn each_board_has_its_contacts() {
    for board in BOARDS {
        let diagram = is_the_wiring(board, FEW);
        let all = diagram["connections"].to_string();
        // Its address is made by a contact at the supply.
        assert!(all.contains("\"Imu:AD0\",\"red\""), "{all}");
        assert!(all.contains("[\"Lamp-resistor:2\",\"Lamp:A\""), "{all}");
    }
}

#[test]
fn each_part_has_its_contacts() {
    let mut drawn = BTreeSet::new();
    let mut labels = BTreeMap::new();
    for devices in ALL {
        let diagram = is_the_wiring("BLACKPILL_F411CE", devices);
        for part in diagram["parts"].as_array().unwrap() {
            drawn.insert(words(part, "type"));
            labels.insert(words(part, "id"), part["attrs"]["text"].clone());
        }
    }
    let is_board = |kind: &str| {
        ["board-", "wokwi-arduino-", "wokwi-pi-"].iter().any(|begin| kind.starts_with(begin))
    };
    for kind in facts().into_keys().filter(|kind| !is_board(kind)) {
        assert!(drawn.contains(&kind), "{kind} is not drawn");
    }
    assert_eq!(labels["Floor-1-name"], "Floor[1] (for reflectance_analog)");
    assert_eq!(labels["Range-name"], "Range");
}

#[test]
fn what_wokwi_lacks_is_told() {
    let devices = "chip Air { driver = bme280; } actuator Lamp accepts bool { driver = led; }";
    let ran = solve("RASPBERRYPI_PICO", devices, "wokwi").exits(0);
    assert!(
        ran.stderr.contains("warning[W0617]: `Air` is left out of the diagram"),
        "{}",
        ran.stderr
    );
    let facts = facts();
    nothing_overlaps(&ran.json(), &facts);
    let wires = wires(&ran.json(), &facts);
    assert!(wires.iter().flatten().all(|end| !end.starts_with("Air")), "{wires:?}");
    let note = ran.json()["parts"].as_array().unwrap().last().unwrap()["attrs"]["text"].clone();
    let answer = solve("RASPBERRYPI_PICO", devices, "json").json();
    for pin in pins(&answer, &["Lamp"]).into_keys() {
        assert!(note.as_str().unwrap().contains(&pin), "{pin}: {note}");
    }
    let ran = solve("STM32F407G_DISC1", devices, "wokwi").exits(1);
    assert!(ran.stderr.contains("error[E0529]") && ran.stdout.is_empty(), "{}", ran.stderr);
    assert!(BOARDS.iter().all(|board| ran.stderr.contains(board)), "{}", ran.stderr);
}
