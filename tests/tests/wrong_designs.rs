//! Designs that would harm their user if built. Each gives an error or a warning with a place in
//! the text before anything is wired. By class: address, level, range, unit, identifier, order,
//! rate.
//!
//! `corpus/err` has more of each class, and also records the places.

use std::collections::BTreeMap;

use sensedsl_tests::sensedsl;

/// The class, the items on a board, and the code that they must give.
const WRONG: &[(&str, &str, &str)] = &[
    ("address", "chip A { driver = mpu6050; address = 0x60; }", "E0232"),
    ("address", "chip A { driver = ads1115; address = 0x50; }", "E0232"),
    ("address", "chip A { driver = bme280; address = 0x70; }", "E0232"),
    ("address", "chip A { driver = vl53l0x; address = 0x2A; }", "E0232"),
    ("address", "sensor A returns uint16 { driver = as5600; address = 0x37; }", "E0232"),
    ("address", "sensor A returns uint16 { driver = srf08; address = 0x60; }", "E0232"),
    (
        "address",
        "sensor A returns uint16 { type = i2c; address = 0x100; register = 1; length = 2; }",
        "E0211",
    ),
    (
        "address",
        "sensor A returns uint16 { type = i2c; address = 0x10; register = 1; length = 2; unit = I2C1; } sensor B returns uint16 { type = i2c; address = 0x10; register = 2; length = 2; unit = I2C1; exclusive = true; }",
        "E0401",
    ),
    ("level", "sensor A returns uint16 { type = analog; level = 5 V; }", "E0321"),
    ("level", "sensor A returns bool { type = digital; level = 24 V; }", "E0321"),
    (
        "level",
        "sensor A returns uint16 { type = analog; quantity = V; scale = 3.3 / 4095; max = 12.6; }",
        "E0235",
    ),
    (
        "level",
        "sensor A returns uint16 { type = analog; quantity = mV; scale = 3300 / 4095; max = 5000; }",
        "E0235",
    ),
    ("level", "chip A { driver = mpu6050; level = 5 V; }", "W0613"),
    ("level", "chip A { driver = bme280; level = 5 V; }", "W0613"),
    (
        "range",
        "actuator A accepts uint16 { type = pwm; frequency = 50 Hz; min = 2 ms; max = 1 ms; }",
        "E0222",
    ),
    ("range", "actuator A accepts uint8 { type = pwm; frequency = 50 Hz; }", "W0611"),
    (
        "range",
        "actuator A accepts uint16 { type = pwm; frequency = 50 Hz; failsafe = 150 %; }",
        "E0234",
    ),
    (
        "range",
        "sensor A returns uint32 { type = can; bitrate = 500 kHz; frame = 0x120; byte = 6; }",
        "E0239",
    ),
    ("range", "sensor A returns uint8 { type = analog; }", "W0603"),
    (
        "range",
        "sensor A returns int16[3] { type = i2c; address = 0x10; register = 1; length = 6; elements = [0, 1, 3]; }",
        "E0229",
    ),
    ("range", "actuator A accepts uint16 { driver = servo; failsafe = 4000 us; }", "E0234"),
    ("unit", "sensor A returns uint16 { type = analog; delay = 50 Hz; }", "E0210"),
    ("unit", "actuator A accepts uint16 { type = pwm; frequency = 20 ms; }", "E0210"),
    ("unit", "actuator A accepts uint16 { driver = servo; failsafe = 90 cm; }", "E0234"),
    (
        "unit",
        "sensor A returns uint16 { type = analog; scale = 0.1; quantity = cm; max = 10 s; }",
        "E0234",
    ),
    ("unit", "sensor A returns uint16 { type = analog; level = 5 ms; }", "E0210"),
    (
        "unit",
        "sensor A returns uint16 { type = uart; baud = 3 s; start = [0x59]; length = 2; checksum = sum8; }",
        "E0209",
    ),
    ("unit", "sensor A returns uint16 { type = can; bitrate = 500 ms; frame = 0x120; }", "E0210"),
    (
        "identifier",
        "sensor A returns uint16 { id = 1; type = analog; } sensor B returns uint16 { id = 1; type = analog; }",
        "E0203",
    ),
    (
        "identifier",
        "sensor A returns uint16 { id = 1; type = analog; } actuator B accepts uint16 { id = 1; type = pwm; }",
        "E0203",
    ),
    ("identifier", "sensor A returns uint16 { id = 255; type = analog; }", "E0211"),
    (
        "identifier",
        "sensor A returns uint16 { type = can; bitrate = 500 kHz; frame = 0x20000000; }",
        "E0211",
    ),
    (
        "identifier",
        "sensor A returns uint16 { type = can; bitrate = 500 kHz; frame = 0x800; extended = false; }",
        "E0222",
    ),
    (
        "identifier",
        "actuator A accepts uint16 { type = can; bitrate = 500 kHz; frame = 0x120; } actuator B accepts uint16 { type = can; bitrate = 500 kHz; frame = 0x120; }",
        "E0237",
    ),
    (
        "identifier",
        "actuator A accepts uint16 { type = can; bitrate = 500 kHz; frame = 0x120; } sensor B returns uint16 { type = can; bitrate = 500 kHz; frame = 0x120; }",
        "E0238",
    ),
    (
        "order",
        "sensor A returns uint16 { type = can; bitrate = 500 kHz; frame = 0x120; order = middle; }",
        "E0212",
    ),
    ("order", "sensor A returns uint16 { type = analog; order = little; }", "E0213"),
    ("order", "actuator A accepts uint16 { type = pwm; order = big; }", "E0213"),
    ("rate", "sensor A returns uint16 { driver = srf08; address = 0x70; delay = 40 ms; }", "W0602"),
    ("rate", "chip A { driver = vl53l0x; delay = 5 ms; }", "W0602"),
    ("rate", "chip A { driver = ads1115; delay = 1 ms; address = 0x48; }", "W0602"),
    ("rate", "chip A { driver = bme280; delay = 1 ms; }", "W0623"),
    (
        "rate",
        "sensor A returns int16[64] { type = i2c; address = 0x10; register = 1; length = 128; delay = 1 ms; speed = 100 kHz; }",
        "E0621",
    ),
    (
        "rate",
        "link { transport = uart; baud = 9600; } sensor A returns uint16[64] { type = i2c; address = 0x10; register = 1; length = 128; delay = 10 ms; speed = 400 kHz; }",
        "E0622",
    ),
    ("rate", "actuator A accepts uint16 { type = pwm; frequency = 200 MHz; }", "E0211"),
    (
        "rate",
        "actuator A accepts uint16 { type = pwm; frequency = 1 kHz; min = 1 ms; max = 2 ms; }",
        "E0211",
    ),
    ("rate", "sensor A returns uint16 { type = analog; delay = 0; }", "E0211"),
    ("rate", "chip A { driver = mpu6050; speed = 1 MHz; }", "E0233"),
];

#[test]
fn each_is_told_with_a_place() {
    let (mut missed, mut counts) = (Vec::new(), BTreeMap::new());
    for (class, devices, code) in WRONG {
        let text = format!("board STM32F407G_DISC1 {{\n{devices}\n}}\n");
        let ran = sensedsl(["check", "-", "--format", "json"]).stdin(text).run();
        let json = ran.json();
        let said: Vec<_> = json["diagnostics"].as_array().unwrap().iter().collect();
        let is_told = |one: &&serde_json::Value| {
            one["code"] == *code
                && one["start"]["line"].as_u64() >= Some(2)
                && one["help"].is_string()
        };
        if !said.iter().any(|one| is_told(one)) {
            let codes: Vec<_> = said.iter().map(|one| one["code"].to_string()).collect();
            missed.push(format!("{class}: {devices}: {codes:?} and not {code}"));
        }
        *counts.entry(*class).or_insert(0) += 1;
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
    assert!(WRONG.len() >= 40 && counts.len() == 7, "{counts:?}");
}
