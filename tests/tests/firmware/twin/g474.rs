//! Images for boards with an STM32G474, judged through the command that users run. Its units are later versions than
//! those of STM32F4, and any stream of its DMA serves any request.
//!
//! A small robot with ChibiOS always runs, over both links. Each kind, the other board and Embassy's programs run only
//! with `SENSEDSL_THOROUGH=3`, a twelfth of them with `SENSEDSL_THOROUGH=2`.

use sensedsl_tests::{is_drawn, is_exhaustive, text};

use super::images::alarm_of;
use super::trial::System;
use crate::false_alarms::is_wired;

const UART: &str = "link { transport = uart; unit = USART2; baud = 115200; checksum = crc16; }";
const USB: &str = "link { transport = usb; }";

/// Most kinds at once, with converters of both groups.
const ROBOT: &str = "
    sensor Light returns uint16 { type = analog; delay = 20 ms; }
    sensor Battery returns uint16 { type = analog; pin = PB13; delay = 50 ms; }
    sensor Range returns uint16 { driver = srf08; address = 0x70; delay = 100 ms; }
    sensor Wheel returns int32 { type = encoder; }
    sensor Stick returns uint32 { type = icu; mode = width; }
    sensor Touch returns bool { type = digital; debounce = 5 ms; }
    sensor Drops returns uint32 { type = digital; edge = rising; delay = 50 ms; }
    sensor Gyro returns uint16 { type = spi; read = [0]; length = 2; delay = 20 ms; }
    sensor Place returns uint16 { type = uart; baud = 9600; length = 2; }
    actuator Servo accepts uint16 { type = pwm; frequency = 50 Hz; min = 1 ms; max = 2 ms; }
    actuator Relay accepts bool { type = digital; }
}
";
/// What the robot lacks: CAN, both converters that have outputs, and a serial port of the low-power sort, over the link
/// of the other board.
const OTHERS: &str = "
    sensor Speed returns uint16 { type = can; bitrate = 500 kHz; frame = 0x120; byte = 2; }
    actuator Torque accepts int16 { type = can; bitrate = 500 kHz; frame = 0x18FF1234; }
    actuator A accepts uint16 { type = dac; failsafe = 0; }
    actuator B accepts uint16 { type = dac; failsafe = 0; }
    actuator C accepts uint16 { type = dac; failsafe = 0; }
    sensor Distance returns uint16 { type = analog; samples = 8; delay = 20; }
    sensor Slow returns uint16 { type = uart; tx = PC1; rx = PC0; baud = 9600; length = 2; }
}
";
const KINDS: [&str; 10] =
    ["analog", "can", "dac", "digital", "encoder", "i2c", "icu", "pwm", "spi", "uart"];

fn on(board: &str, link: &str, inside: &str) -> String {
    format!("board {board} {{\n    {link}{inside}")
}

#[track_caller]
fn agrees(system: System, name: &str, text: &str) {
    if let Some(image) = system.image(name, text) {
        assert_eq!(alarm_of(system, name, text, &image), None);
    }
}

#[test]
fn a_robot_agrees_over_a_serial_line() {
    agrees(System::Chibios, "g474_uart", &on("NUCLEO_G474RE", UART, ROBOT));
}

#[test]
fn a_robot_agrees_over_usb() {
    agrees(System::Chibios, "g474_usb", &on("NUCLEO_G474RE", USB, ROBOT));
}

#[test]
fn every_kind_agrees_over_both_links() {
    if !is_exhaustive() {
        return;
    }
    let agrees_if_drawn = |system, name: &str, design: &str| {
        if is_drawn(name) {
            agrees(system, name, design);
        }
    };
    for system in [System::Chibios, System::Embassy] {
        let target = system.target().unwrap_or("chibios");
        for (link, transport) in [(USB, "usb"), (UART, "uart")] {
            for kind in KINDS {
                let kind_text = text(&format!("tests/firmware/kinds/{kind}.sense"));
                let (_, inside) = kind_text.split_once('{').unwrap();
                let design = on("NUCLEO_G474RE", link, inside);
                assert!(is_wired(&design, target), "{system:?} {kind} {transport}");
                agrees_if_drawn(system, &format!("g474_{system:?}_{kind}_{transport}"), &design);
            }
            let robot = on("NUCLEO_G474RE", link, ROBOT);
            agrees_if_drawn(system, &format!("g474_{system:?}_robot_{transport}"), &robot);
        }
        let other = on("B_G474E_DPOW1", "", OTHERS);
        assert!(is_wired(&other, target), "{system:?}");
        agrees_if_drawn(system, &format!("g474_{system:?}_dpow1"), &other);
    }
}
