//! `PeripheralPins.c` of an Arduino core in; the board table of its MCU out.
//!
//! A row `{PA_0, TIM2, STM_PIN_DATA_EXT(…, GPIO_AF1_TIM2, 1, 0)}, // TIM2_CH1` stands in the list of
//! its role, such as `PinMap_TIM`.

use std::collections::BTreeMap;

use sensedsl_board::pin::PinName;
use sensedsl_board::signal::Signal;
use sensedsl_diagnostics::{FileId, Span};

use crate::assemble::{self, Row};
use crate::cubemx::largest;
use crate::log::Log;
use crate::project::pads::{lines, pad};
use crate::source::Texts;

/// What the names of lists begin with.
const LIST: &str = "PinMap_";
/// The lists whose rows have one signal of their unit each, with its name.
const LISTS: [(&str, &str); 12] = [
    ("I2C_SDA", "SDA"),
    ("I2C_SCL", "SCL"),
    ("UART_TX", "TX"),
    ("UART_RX", "RX"),
    ("UART_RTS", "RTS"),
    ("UART_CTS", "CTS"),
    ("SPI_MOSI", "MOSI"),
    ("SPI_MISO", "MISO"),
    ("SPI_SCLK", "SCK"),
    ("SPI_SSEL", "NSS"),
    ("CAN_RD", "RX"),
    ("CAN_TD", "TX"),
];

/// Whether a text has such lists.
pub(super) fn are_in(text: &str) -> bool {
    text.contains(LIST) && text.contains("STM_PIN_DATA")
}

/// The MCU: `Automatically generated from STM32F446R(C-E)Tx.xml`.
pub(super) fn mcu(text: &str) -> Option<String> {
    let (_, rest) = text.split_once("generated from ")?;
    let name = rest.split_whitespace().next()?.trim_end_matches(',').strip_suffix(".xml")?;
    name.starts_with("STM32").then(|| largest(name))
}

/// Imports the lists.
pub(super) fn import(file: FileId, text: &str, log: &mut Log) -> Texts {
    let whole = Span::new(file, 0..0);
    let mut rows: BTreeMap<PinName, Row> = BTreeMap::new();
    let mut list = "";
    for (line, start) in lines(text) {
        let line = line.trim_end();
        if let Some((_, rest)) = line.split_once(LIST) {
            list = rest.split(['[', ' ']).next().unwrap_or_default();
            continue;
        }
        let Some(row) = line.trim_start().strip_prefix('{') else { continue };
        let Some((name, rest)) = row.split_once(',') else { continue };
        let name = name.trim();
        if name == "NC" {
            continue;
        }
        let span = Span::new(file, start..start + line.len());
        // `PA_0_ALT1` is the pin for another unit.
        let Some(pin) = pad(name.split("_ALT").next().unwrap_or_default()) else {
            log.dropped(span, "", &format!("`{name}` is not a pin of a port"));
            continue;
        };
        let row = rows.entry(pin.clone()).or_insert_with(|| Row::new(pin));
        let Some(signal) = signal(list, rest) else { continue };
        if Signal::parse(&signal).1.is_some() {
            log.dropped(span, "", &format!("`{signal}` is not a signal"));
        } else {
            row.usages.push((signal, alternate(rest)));
        }
    }
    if rows.is_empty() {
        log.no_pins(whole, "no list has a row with a pin");
        return Texts::default();
    }
    let mcu = mcu(text).map(|mcu| ("mcu", mcu)).into_iter().collect::<Vec<_>>();
    let table = assemble::table(&mcu, rows.into_values().collect(), whole, log);
    Texts { table: table.map(|table| table.to_csv()), program: None }
}

/// The signal of a row: what its comment says, or its unit with the role of the list.
fn signal(list: &str, row: &str) -> Option<String> {
    let is_word =
        |text: &&str| text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    let said = row.rsplit_once("//").map(|(_, comment)| comment.trim());
    if let Some(said) = said.filter(is_word).filter(|said| said.contains('_')) {
        return Some(said.to_owned());
    }
    let (_, line) = LISTS.iter().find(|(name, _)| *name == list)?;
    let unit = row.split(',').next().map(str::trim).filter(is_word)?;
    Some(format!("{unit}_{line}"))
}

/// The number in `GPIO_AF7_USART2`.
fn alternate(row: &str) -> Option<u8> {
    let (_, rest) = row.split_once("GPIO_AF")?;
    let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
    digits.parse().ok().filter(|number| *number < 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_have_their_signal_and_its_number() {
        for (list, row, expected) in [
            (
                "TIM",
                " TIM8,  STM_PIN_DATA_EXT(X, Y, GPIO_AF3_TIM8, 1, 1)}, // TIM8_CH1N",
                "TIM8_CH1N 3",
            ),
            ("UART_TX", " USART2, STM_PIN_DATA(X, Y, GPIO_AF7_USART2)},", "USART2_TX 7"),
            ("CAN_RD", " CAN1, STM_PIN_DATA(X, Y, GPIO_AF9_CAN1)},", "CAN1_RX 9"),
            ("ADC", " ADC1, STM_PIN_DATA_EXT(X, Y, 0, 0, 0)}, // ADC1_IN0", "ADC1_IN0 -"),
        ] {
            let number = alternate(row).map_or("-".to_owned(), |number| number.to_string());
            assert_eq!(format!("{} {number}", signal(list, row).unwrap()), expected);
        }
        assert_eq!(signal("SD_CK", " SDIO, X}"), None);
    }
}
