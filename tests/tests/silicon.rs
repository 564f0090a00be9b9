//! The abilities of silicon under the names of its data sheets: units of RP2 and AVR, capture
//! inputs, analog-only pads, pins that tolerate 5 V.
#![expect(clippy::indexing_slicing, clippy::unwrap_used, reason = "a panic is a test's failure")]

use sensedsl_tests::{Scratch, sensedsl};
use serde_json::Value;

/// A board with devices, each given as a type with its properties.
fn file(board: &str, rules: &str, devices: &[&str]) -> String {
    let mut text = format!("board B on {board} {{ {rules}\n");
    for (index, device) in devices.iter().enumerate() {
        let kind = device.split(';').next().unwrap();
        let head = match kind {
            "pwm" => "actuator D{} accepts uint16",
            "digital" => "sensor D{} returns bool",
            "icu" => "sensor D{} returns uint32",
            "i2c" => "sensor D{} returns uint8",
            _ => "sensor D{} returns uint16",
        };
        let head = head.replace("{}", &index.to_string());
        text.push_str(&format!("{head} {{ id = {}; type = {device}; }}\n", index + 1));
    }
    text + "}\n"
}

/// Unit, pin and signal of each wire; `None` if there is no wiring.
fn wires(text: &str) -> Option<Vec<(String, String, String)>> {
    let solved = ["solve", "-", "-q", "--target", "none", "--format", "json"];
    let ran = sensedsl(solved).stdin(text.to_owned()).run();
    if ran.status != 0 {
        return None;
    }
    let answer: Value = serde_json::from_str(&ran.stdout).unwrap();
    let devices = answer["boards"][0]["devices"].as_array().unwrap();
    let of_device = |device: &Value| {
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        let unit = text(&device["unit"]);
        let wires = device["wires"].as_array().unwrap().iter();
        let wire = |wire: &Value| (unit.clone(), text(&wire["pin"]), text(&wire["signal"]));
        wires.map(wire).collect::<Vec<_>>()
    };
    Some(devices.iter().flat_map(of_device).collect())
}

/// The only wire of one device.
fn wire(board: &str, rules: &str, device: &str) -> (String, String, String) {
    wires(&file(board, rules, &[device])).unwrap().remove(0)
}

/// The code with which a file is refused.
fn refused(text: &str) -> String {
    let checked = ["check", "-", "-q", "--format", "json"];
    let ran = sensedsl(checked).stdin(text.to_owned()).run().exits(1);
    let said: Value = serde_json::from_str(&ran.stdout).unwrap();
    let errors = said["diagnostics"].as_array().unwrap().iter();
    let mut errors = errors.filter(|one| one["severity"] == "error");
    errors.next().unwrap()["code"].as_str().unwrap().to_owned()
}

const PICO: &str = "RASPBERRYPI_PICO";

#[test]
fn answers_name_units_as_the_data_sheet_does() {
    let devices =
        ["pwm; unit = PWM4", "icu; unit = PWM5", "i2c; unit = I2C1; address = 0x20; register = 0"];
    let text = file(PICO, "avoid unit = PWM3;", &devices);
    let scratch = Scratch::new("data-sheet-names");
    let path = scratch.write("robot.sense", &text).display().to_string();
    for format in ["human", "json", "csv", "markdown", "svg"] {
        let shown = sensedsl(["solve", &path, "-q", "--format", format]).run().exits(0).stdout;
        // Markdown escapes underscores.
        let shown = shown.replace('\\', "");
        for name in ["PWM4_A", "PWM5_B", "I2C1_SCL"] {
            assert!(shown.contains(name), "{format} does not show {name}:\n{shown}");
        }
        assert!(!shown.contains("TIM"), "{format}:\n{shown}");
    }
    let why = sensedsl(["explain", "wiring", &path, "D1", "-q"]).run().exits(0).stdout;
    assert!(why.contains("PWM5_B") && !why.contains("TIM"), "{why}");
}

#[test]
fn every_slice_and_channel_of_the_pico_can_be_asked_for() {
    for slice in 0..8 {
        let (unit, pin, signal) = wire(PICO, "", &format!("icu; unit = PWM{slice}"));
        assert_eq!((unit, signal), (format!("PWM{slice}"), format!("PWM{slice}_B")));
        let gpio: u8 = pin.trim_start_matches("GP").parse().unwrap();
        assert_eq!((gpio % 2, (gpio / 2) % 8), (1, slice), "{pin}");
    }
    assert_eq!(refused(&file(PICO, "", &["icu; pin = GP8"])), "E0320");
    assert_eq!(refused(&file(PICO, "", &["icu; unit = PWM8"])), "E0311");
    assert_eq!(wire("RP2350B", "", "pwm; unit = PWM11").0, "PWM11");
    for unit in ["UART0", "UART1"] {
        let device = format!("uart; unit = {unit}; start = 0x0A; length = 4");
        assert_eq!(wire(PICO, "", &device).0, unit);
    }
    for unit in ["SPI0", "SPI1"] {
        let device = format!("spi; unit = {unit}; read = [0x80]; length = 2");
        let wires = wires(&file(PICO, "", &[&device])).unwrap();
        let lines: Vec<&str> = wires.iter().map(|(.., signal)| signal.as_str()).collect();
        let named = ["SCK", "RX", "TX"].map(|line| format!("{unit}_{line}"));
        assert_eq!(lines[..3], named, "{wires:?}");
    }
}

/// Names in earlier files keep their meaning.
#[test]
fn earlier_names_of_units_are_understood() {
    for (earlier, now) in [
        (("", "pwm; unit = TIM4"), ("", "pwm; unit = PWM4")),
        (("", "analog; unit = ADC"), ("", "analog; unit = ADC1")),
        (("avoid unit = TIM0;", "pwm"), ("avoid unit = PWM0;", "pwm")),
        (("reserve TIM0;", "pwm"), ("reserve PWM0;", "pwm")),
        (("", "pwm; prefer unit = TIM7"), ("", "pwm; prefer unit = PWM7")),
    ] {
        assert_eq!(wire(PICO, earlier.0, earlier.1), wire(PICO, now.0, now.1), "{now:?}");
    }
    assert_ne!(wire(PICO, "reserve PWM0;", "pwm"), wire(PICO, "", "pwm"));
    let unused = sensedsl(["check", "-", "-q"]).stdin(file(PICO, "reserve TIM3;", &["pwm"])).run();
    assert!(!unused.stderr.contains("W0604"), "{}", unused.stderr);
    let uno = |device: &str| wire("ARDUINO_UNO_R3", "", device);
    assert_eq!(uno("pwm; unit = TIM2"), uno("pwm; unit = TC2"));
    let i2c = |unit: &str| uno(&format!("i2c; address = 0x20; register = 0; unit = {unit}"));
    assert_eq!(i2c("I2C0"), i2c("TWI"));
    // A table that an earlier version printed.
    let scratch = Scratch::new("earlier-table");
    let table = "# mcu = RP2040\nPin,TIM\nGP0,TIM0_CH1@4\nGP1,TIM0_CH2@4\nGP2,TIM1_CH1@4\n";
    let table = scratch.write("pico.csv", table).display().to_string();
    for unit in ["TIM1", "PWM1"] {
        let text = file(PICO, "", &[&format!("pwm; unit = {unit}")]);
        let solved = ["solve", "-", "-q", "--target", "none", "--format", "csv", "--board", &table];
        let shown = sensedsl(solved).stdin(text).run().exits(0).stdout;
        assert!(shown.contains("GP2,TIM1_CH1"), "{shown}");
    }
}

#[test]
fn avr_timers_capture_on_their_icp_pins() {
    let uno = "ARDUINO_UNO_R3";
    let named = |(unit, pin, signal): (String, String, String)| [unit, pin, signal].join(" ");
    assert_eq!(named(wire(uno, "", "icu")), "TC1 PB0 ICP1");
    assert_eq!(named(wire(uno, "", "pwm; pin = D9")), "TC1 PB1 OC1A");
    assert_eq!(wires(&file(uno, "", &["icu", "icu"])), None);
    for unit in ["TC0", "TC2", "TIM0"] {
        assert_eq!(refused(&file(uno, "", &[&format!("icu; unit = {unit}")])), "E0320");
    }
    assert_eq!(refused(&file(uno, "", &["icu; pin = D9"])), "E0320");
    let mega = "ARDUINO_MEGA_2560";
    let both = wires(&file(mega, "", &["icu", "icu"])).unwrap();
    let mut both: Vec<String> = both.into_iter().map(named).collect();
    both.sort();
    assert_eq!(both, ["TC4 PL0 ICP4", "TC5 PL1 ICP5"]);
    assert_eq!(wires(&file(mega, "", &["icu", "icu", "icu"])), None);
    assert_eq!(wires(&file("ATMEGA2560", "", &["icu"; 4])).unwrap().len(), 4);
    assert_eq!(named(wire("ARDUINO_LEONARDO", "", "icu; unit = TC3")), "TC3 PC7 ICP3");
    assert_eq!(named(wire("ARDUINO_LEONARDO", "", "icu")), "TC1 PD4 ICP1");
}

#[test]
fn analog_pads_are_for_the_converter_alone() {
    let nano = "ARDUINO_NANO";
    let both = wires(&file(nano, "", &["analog; pin = A6", "analog; pin = A7"])).unwrap();
    assert_eq!(both[1], ("ADC1".into(), "ADC7".into(), "ADC1_IN7".into()));
    assert!(wires(&file(nano, "", &["analog"; 8])).is_some());
    assert_eq!(wires(&file(nano, "", &["analog"; 9])), None);
    // Eighteen port pins, and two analog-only pads.
    let all = wires(&file(nano, "", &["digital"; 18])).unwrap();
    assert!(all.iter().all(|(_, pin, _)| !pin.starts_with("ADC")), "{all:?}");
    assert_eq!(wires(&file(nano, "", &["digital"; 19])), None);
    for device in ["digital; pin = A6", "spi; cs = A7; read = [0x80]; length = 2"] {
        assert_eq!(refused(&file(nano, "", &[device])), "E0320", "{device}");
    }
}

#[test]
fn five_volts_go_to_pins_that_stand_them() {
    let on =
        |part: &str, pin: &str| file(part, "", &[&format!("digital; level = 5 V; pin = {pin}")]);
    for (part, pins) in [
        ("STM32F072RB", ["PA0", "PC4"]),
        ("STM32F103ZE", ["PF6", "PF10"]),
        ("STM32F303VC", ["PB10", "PC3"]),
        ("STM32F429ZI", ["PA4", "PA5"]),
        ("STM32F746ZG", ["PA4", "PA5"]),
        ("STM32G474RE", ["PA0", "PB15"]),
        ("STM32H743ZI", ["PA7", "PC4"]),
        ("STM32L476RG", ["PA3", "PB0"]),
    ] {
        for pin in pins {
            assert_eq!(refused(&on(part, pin)), "E0321", "{pin} of {part}");
        }
    }
    let said = |text: String| sensedsl(["check", "-"]).stdin(text).run().exits(0).stderr;
    for (part, pin) in [("STM32F072RB", "PB10"), ("STM32F746ZG", "PC6"), ("STM32L476RG", "PB8")] {
        assert!(!said(on(part, pin)).contains("W0610"), "{pin} of {part}");
    }
    for (part, pin) in [("STM32G071RB", "PB8"), ("STM32WB55RG", "PB8"), ("STM32H743ZI", "PD12")] {
        assert!(said(on(part, pin)).contains("W0610"), "{pin} of {part}");
    }
}
