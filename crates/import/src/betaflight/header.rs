//! The `config.h` of a flight controller: `#define MOTOR1_PIN PA8`, `TIMER_PIN_MAP(0, PA8, 1, 0)`,
//! `#define GYRO_1_SPI_INSTANCE SPI1`.

use sensedsl_diagnostics::FileId;

use super::{Board, OnTimer, Resource};
use crate::project::Addressed;
use crate::project::pads::{Define, defines, pad};

/// Whether a text is such a header.
pub(super) fn is_header(text: &str) -> bool {
    text.contains("#define FC_TARGET_MCU")
}

/// Reads a header.
pub(super) fn read(file: FileId, text: &str) -> Board {
    let mut board = Board::default();
    let all = defines(file, text);
    for define in &all {
        let Define { name, value, span } = define;
        match name.as_str() {
            "FC_TARGET_MCU" => board.mcu = Some((value.clone(), *span)),
            "BOARD_NAME" => board.name = Some(value.clone()),
            _ => {}
        }
        if let Some(part) = name.strip_suffix("_SPI_INSTANCE")
            && value.starts_with("SPI")
        {
            board.buses.insert(part.to_ascii_lowercase(), value.clone());
        }
        if let (Some(what), Some(pin)) = (name.strip_suffix("_PIN"), pad(value)) {
            let (what, index) = resource(what);
            board.resources.push(Resource { what, index, pin, span: *span });
        }
    }
    timers(text, &mut board);
    addressed(&all, &mut board);
    board
}

/// A use in the words of a dump: `MOTOR1` is `MOTOR 1`, `UART3_TX` is `SERIAL_TX 3`, `GYRO_1_CS` is
/// `GYRO_CS 1`.
fn resource(name: &str) -> (String, String) {
    let digits = |c: char| c.is_ascii_digit();
    if let Some((unit, line)) = name.rsplit_once('_') {
        let stem = unit.trim_end_matches(digits);
        let number = unit.get(stem.len()..).unwrap_or_default().to_owned();
        match (stem, line) {
            ("UART" | "LPUART", "TX" | "RX") => return (format!("SERIAL_{line}"), number),
            ("I2C" | "SPI", _) if !number.is_empty() => return (format!("{stem}_{line}"), number),
            (_, "CS" | "EXTI") if !number.is_empty() && stem.ends_with('_') => {
                return (format!("{stem}{line}"), number);
            }
            _ => {}
        }
    }
    let known = match name {
        "RX_PPM" => "PPM",
        "MAX7456_SPI_CS" => "MAX7456_CS",
        "SDCARD_SPI_CS" => "SDCARD_CS",
        name => name,
    };
    let stem = known.trim_end_matches(digits);
    let number = known.get(stem.len()..).unwrap_or_default().to_owned();
    match stem {
        "MOTOR" | "SERVO" | "LED" | "PINIO" => (stem.to_owned(), number),
        "RX_PWM" => ("PWM".to_owned(), number),
        _ => (known.to_owned(), String::new()),
    }
}

/// The lines `TIMER_PIN_MAP(index, pin, place, dma)`.
fn timers(text: &str, board: &mut Board) {
    for map in text.split("TIMER_PIN_MAP(").skip(1) {
        let arguments = map.split(')').next().unwrap_or_default();
        let arguments: Vec<&str> = arguments.split(',').map(str::trim).take(4).collect();
        if let [_, pin, place, ..] = arguments.as_slice()
            && let (Some(pin), Ok(place)) = (pad(pin), place.parse())
        {
            board.timers.entry(pin).or_insert(OnTimer::Place(place));
        }
    }
}

/// The barometer and the compass, where bus and address are there.
fn addressed(all: &[Define], board: &mut Board) {
    let value = |name: String| all.iter().find(|one| one.name == name);
    for part in ["BARO", "MAG"] {
        let bus =
            value(format!("{part}_I2C_INSTANCE")).and_then(|bus| bus.value.strip_prefix("I2CDEV_"));
        let Some(at) = value(format!("DEFAULT_{part}_I2C_ADDRESS")) else { continue };
        let address = match at.value.strip_prefix("0x") {
            Some(digits) => u8::from_str_radix(digits, 16).ok(),
            None => at.value.parse().ok(),
        };
        let address = address.filter(|address| (1..0x80).contains(address));
        if let (Some(bus), Some(address)) = (bus, address) {
            let (name, unit) = (part.to_ascii_lowercase(), format!("I2C{bus}"));
            board.addressed.push(Addressed { name, unit, address, span: at.span });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_headers_are_those_of_dumps() {
        for (name, expected) in [
            ("MOTOR12", ("MOTOR", "12")),
            ("UART3_TX", ("SERIAL_TX", "3")),
            ("SPI1_SDO", ("SPI_SDO", "1")),
            ("GYRO_1_CS", ("GYRO_CS", "1")),
            ("GYRO_2_EXTI", ("GYRO_EXTI", "2")),
            ("FLASH_CS", ("FLASH_CS", "")),
            ("ADC_VBAT", ("ADC_VBAT", "")),
            ("LED_STRIP", ("LED_STRIP", "")),
            ("LED0", ("LED", "0")),
            ("RX_PPM", ("PPM", "")),
        ] {
            let (what, index) = resource(name);
            assert_eq!((what.as_str(), index.as_str()), expected, "{name}");
        }
    }
}
