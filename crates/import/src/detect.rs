//! Bytes in, their format out: judged only by content, because names can be wrong.

use crate::decode::decode;
use crate::format::Format;
use crate::{arduino, betaflight, micropython, zephyr};

/// The number of bytes of a file that are examined.
pub(crate) const HEAD_BYTES: usize = 1 << 16;

/// The format of a file's content, if it is recognised.
#[must_use]
pub fn detect(bytes: &[u8]) -> Option<Format> {
    if bytes.starts_with(b"PK\x03\x04") {
        // The first member of an OpenDocument file is its type, uncompressed.
        let head = bytes.get(..200).unwrap_or(bytes);
        let ods = head.windows(8).any(|window| window == b"mimetype");
        return Some(if ods { Format::Ods } else { Format::Xlsx });
    }
    // The head of a large file is enough; half a character at its end does not matter.
    let text = decode(bytes.get(..HEAD_BYTES).unwrap_or(bytes))?.text;
    if text.trim().is_empty() {
        return None;
    }
    if text.trim_start().starts_with('<') {
        return text.contains("<Mcu").then_some(Format::CubeMx);
    }
    let lines = || text.lines().map(str::trim).filter(|line| !line.is_empty());
    if lines().any(|line| line.starts_with("Mcu.") && line.contains('=')) {
        return Some(Format::Ioc);
    }
    if betaflight::is_board(&text) {
        return Some(Format::Betaflight);
    }
    if zephyr::is_tree(&text) {
        return Some(Format::Zephyr);
    }
    if arduino::is_variant(&text) {
        return Some(Format::Arduino);
    }
    if micropython::is_list(&text) {
        return Some(Format::MicroPython);
    }
    let dbc = |line: &str| {
        let word = line.split([' ', '\t', ':']).next().unwrap_or_default();
        matches!(word, "NS_" | "BS_" | "BU_" | "BO_" | "SG_" | "CM_") && line.len() > word.len()
    };
    if lines().any(dbc) {
        return Some(Format::Dbc);
    }
    let content = || lines().filter(|line| !line.starts_with('#'));
    if content().next().is_some_and(|head| head.starts_with("Port,") && head.contains(",AF0,")) {
        return Some(Format::MicroPython);
    }
    let hwdef = |line: &str| {
        let mut words = line.split_whitespace();
        let first = words.next().unwrap_or_default();
        let start = matches!(first, "MCU" | "APJ_BOARD_ID" | "OSCILLATOR_HZ" | "include");
        start && words.next().is_some() && !line.contains([',', ';'])
    };
    Some(if content().any(hwdef) { Format::Hwdef } else { Format::Csv })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_told_by_content() {
        for (content, expected) in [
            ("Pin,ADC\nPA1,ADC1_IN1\n", Some(Format::Csv)),
            ("# mcu = STM32F407VG\nPin;ADC\n", Some(Format::Csv)),
            ("Port,,AF0,AF1\n,,SYS,TIM1/2\n", Some(Format::MicroPython)),
            ("# board\nLED_RED,PA13\n,PB2\n", Some(Format::MicroPython)),
            ("LED,GPIO25\nWL,EXT_GPIO0\n", Some(Format::MicroPython)),
            ("# Betaflight / STM32F405\nresource MOTOR 1 A08\n", Some(Format::Betaflight)),
            ("#pragma once\n#define FC_TARGET_MCU STM32F405\n", Some(Format::Betaflight)),
            ("/ {\n leds { };\n};\n", Some(Format::Zephyr)),
            ("&usart1 {\n\tstatus = \"okay\";\n};\n", Some(Format::Zephyr)),
            ("#pragma once\n#define LED_BUILTIN PA5\n", Some(Format::Arduino)),
            (
                "const PinMap PinMap_ADC[] = {\n {PA_0, ADC1, STM_PIN_DATA(0)},",
                Some(Format::Arduino),
            ),
            ("<?xml version=\"1.0\"?>\n<Mcu RefName=\"X\"/>", Some(Format::CubeMx)),
            ("<html/>", None),
            ("#c\nMcu.Name=STM32F407VGTx\n", Some(Format::Ioc)),
            ("# b\nMCU STM32F4xx STM32F405xx\nPA0 UART4_TX UART4\n", Some(Format::Hwdef)),
            ("include ../x/hwdef.dat\n", Some(Format::Hwdef)),
            ("VERSION \"\"\nBU_: A\nBO_ 1 A: 8 A\n", Some(Format::Dbc)),
            ("BU_ A\n", Some(Format::Dbc)),
            ("BO_\t1 A: 8 A\n", Some(Format::Dbc)),
            ("NS_ :\n\tCM_\n\nBS_:\n", Some(Format::Dbc)),
            ("CM_,ADC\nBO_,ADC1_IN1\n", Some(Format::Csv)),
            ("", None),
            ("\u{0}\u{1}\u{2}", None),
        ] {
            assert_eq!(detect(content.as_bytes()), expected, "{content:?}");
        }
    }
}
