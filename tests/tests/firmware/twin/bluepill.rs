//! Images for the Blue Pill, judged through the command that users run. Its STM32F103 has another
//! core than STM32F4, and other versions of most units.
//!
//! A small robot with ChibiOS always runs, over both links. Each kind that the board has and the robot on Embassy run
//! only with `SENSEDSL_THOROUGH=3`, a twelfth of them with `SENSEDSL_THOROUGH=2`.

use sensedsl_tests::{is_drawn, is_exhaustive, text};

use super::images::alarm_of;
use super::trial::System;
use crate::false_alarms::is_wired;

/// The board's own link, and a serial one.
const USB: &str = "";
const UART: &str = "link { transport = uart; unit = USART1; baud = 115200; checksum = crc16; }";

/// Everything that the board can carry at once. TIM2 and SPI1 move to other pads, which the debug
/// port has to give away.
const ROBOT: &str = "
    sensor Light returns uint16 { type = analog; delay = 20 ms; }
    sensor Battery returns uint16 { type = analog; delay = 50 ms; }
    sensor Range returns uint16 { driver = srf08; address = 0x70; delay = 100 ms; }
    sensor Wheel returns int32 { type = encoder; }
    sensor Stick returns uint32 { type = icu; pin = PA15; mode = width; }
    sensor Touch returns bool { type = digital; debounce = 5 ms; }
    sensor Drops returns uint32 { type = digital; edge = rising; delay = 50 ms; }
    sensor Gyro returns uint16 { type = spi; sck = PB3; read = [0]; length = 2; delay = 20 ms; }
    sensor Place returns uint16 { type = uart; baud = 9600; length = 2; }
    actuator Servo accepts uint16 { type = pwm; frequency = 50 Hz; min = 1 ms; max = 2 ms; }
    actuator Relay accepts bool { type = digital; }
}
";
/// The kinds of which the board has the hardware. USB and CAN exclude each other.
const KINDS: [&str; 9] =
    ["analog", "can", "digital", "encoder", "i2c", "icu", "pwm", "spi", "uart"];

fn on_bluepill(link: &str, inside: &str) -> String {
    format!("board BLUEPILL_F103C8 {{\n    {link}{inside}")
}

#[track_caller]
fn agrees(system: System, name: &str, text: &str) {
    if let Some(image) = system.image(name, text) {
        assert_eq!(alarm_of(system, name, text, &image), None);
    }
}

#[test]
fn a_robot_agrees_over_usb() {
    agrees(System::Chibios, "bluepill_usb", &on_bluepill(USB, ROBOT));
}

#[test]
fn a_robot_agrees_over_a_serial_line() {
    agrees(System::Chibios, "bluepill_uart", &on_bluepill(UART, ROBOT));
}

#[test]
fn every_kind_agrees_over_both_links() {
    if !is_exhaustive() {
        return;
    }
    agrees(System::Embassy, "bluepill_embassy_usb", &on_bluepill(USB, ROBOT));
    for system in [System::Chibios, System::Embassy] {
        let target = system.target().unwrap_or("chibios");
        for (link, transport) in [(USB, "usb"), (UART, "uart")] {
            let mut lacking = Vec::new();
            for kind in KINDS {
                let kind_text = text(&format!("tests/firmware/kinds/{kind}.sense"));
                let design = on_bluepill(link, kind_text.split_once('{').unwrap().1);
                let name = format!("bluepill_{system:?}_{kind}_{transport}");
                if !is_wired(&design, target) {
                    lacking.push(kind);
                } else if is_drawn(&name) {
                    agrees(system, &name, &design);
                }
            }
            assert!(
                lacking.is_empty() || lacking == ["can"],
                "{system:?} {transport}: {lacking:?}"
            );
        }
    }
}
