//! The grammar of signal names: a spelling in, its meaning or a better spelling out.

use sensedsl_diagnostics::nearest;

use super::{CanLine, Function, I2cLine, SpiLine, UartLine, UnitName};

/// Upper case, `²` as 2, and `_` for every other separator.
pub(super) fn normalise(spelled: &str) -> String {
    spelled
        .trim()
        .chars()
        .flat_map(char::to_uppercase)
        .map(|c| match c {
            '²' => '2',
            '-' | '.' | ' ' | '\u{2010}'..='\u{2015}' => '_',
            other => other,
        })
        .collect()
}

/// The one name of a function that has several spellings.
pub(super) fn canonical(function: &Function) -> Option<String> {
    match function {
        Function::Adc { units, channel } => {
            let units: String = units.iter().map(u8::to_string).collect();
            Some(format!("ADC{units}_IN{channel}"))
        }
        Function::Timer { timer, channel, complementary } => {
            Some(format!("TIM{timer}_CH{channel}{}", if *complementary { "N" } else { "" }))
        }
        Function::Dac { unit, channel } => Some(format!("DAC{unit}_OUT{channel}")),
        Function::I2c { .. }
        | Function::Uart { .. }
        | Function::Spi { .. }
        | Function::Can { .. }
        | Function::Other => None,
    }
}

/// What a normalised name was read as.
pub(super) enum Reading {
    Function(Function),
    /// Free text, or a line that no device kind uses (`USART1_CTS`).
    Unused,
    Malformed,
}

/// The peripheral families and the lines of each that no device kind uses (a trailing `*` stands
/// for anything).
const FAMILIES: [(&str, &[&str]); 10] = [
    ("LPUART", &["CK", "CTS*", "RTS*", "DE", "NSS"]),
    ("USART", &["CK", "CTS*", "RTS*", "DE", "NSS"]),
    ("UART", &["CK", "CTS*", "RTS*", "DE", "NSS"]),
    ("FDCAN", &[]),
    ("ADC", &["INN*", "EXTI*", "VINM*", "VINP*", "PDM*", "PGA*"]),
    ("I2C", &["SMBA*", "WS"]),
    ("TIM", &["ETR*", "BKIN*"]),
    ("SPI", &["RDY"]),
    ("CAN", &[]),
    ("DAC", &["EXTI*"]),
];

/// Peripherals with a name one letter from a family's, which are something else.
const NEIGHBOURS: [&str; 9] = ["I2S", "I3C", "SAI", "QSPI", "OSPI", "HSPI", "XSPI", "FSPI", "VSPI"];

pub(super) fn read(name: &str) -> Reading {
    let Some((stem, number, line)) = split(name) else {
        return if misses_separator(name) { Reading::Malformed } else { Reading::Unused };
    };
    let Some((family, unused)) = FAMILIES.iter().find(|(family, _)| *family == stem) else {
        return if misspelt_family(stem, line) { Reading::Malformed } else { Reading::Unused };
    };
    if let Some(function) = function(family, number, line) {
        return Reading::Function(function);
    }
    let fits = |pattern: &&str| match pattern.strip_suffix('*') {
        Some(start) => line.starts_with(start),
        None => line == *pattern,
    };
    let numbered = number.parse::<u32>().is_ok();
    // Inputs of the second bank of the converter of an STM32L1, which has to be switched to.
    let second = line.strip_prefix("IN").and_then(|line| line.strip_suffix('B'));
    let second = *family == "ADC" && second.and_then(small).is_some();
    if numbered && (second || unused.iter().any(fits)) {
        Reading::Unused
    } else {
        Reading::Malformed
    }
}

/// `TIM3_CH1` to (`TIM`, `3`, `CH1`). A stem ends in a letter; `I2C` holds a digit of its own.
fn split(name: &str) -> Option<(&str, &str, &str)> {
    let (unit, line) = name.split_once('_')?;
    let stem = unit.trim_end_matches(|c: char| c.is_ascii_digit());
    Some((stem, unit.strip_prefix(stem)?, line))
}

/// A family's name and a digit, with no separator behind: `ADC12IN8`, `TIM3`.
fn misses_separator(name: &str) -> bool {
    FAMILIES.iter().any(|(family, _)| {
        name.strip_prefix(family).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    })
}

/// An unknown stem one slip from a family's, before a line of just that family: `USRAT1_TX`.
fn misspelt_family(stem: &str, line: &str) -> bool {
    if stem.len() < 2 || NEIGHBOURS.contains(&stem) || stem.starts_with("LP") {
        return false;
    }
    let families = FAMILIES.iter().map(|(family, _)| *family);
    nearest(stem, families.filter(|family| function(family, "1", line).is_some())).is_some()
}

/// The function of a family's line, when that is what it is.
fn function(family: &str, number: &str, line: &str) -> Option<Function> {
    // A number has no sign and no leading zero; `ADC_IN5` and `DAC_OUT1` stand for the only unit.
    let unit = || small(number);
    let only = || if number.is_empty() { Some(1) } else { small(number) };
    match family {
        "ADC" => {
            let channel = line.strip_prefix("INP").or_else(|| line.strip_prefix("IN"))?;
            Some(Function::Adc { units: adc_units(number)?, channel: small(channel)? })
        }
        "I2C" => Some(Function::I2c { unit: unit()?, line: i2c_line(line)? }),
        "TIM" => timer(unit()?, line),
        "SPI" => Some(Function::Spi { unit: unit()?, line: spi_line(line)? }),
        "DAC" => Some(Function::Dac { unit: only()?, channel: small(line.strip_prefix("OUT")?)? }),
        "USART" | "UART" | "LPUART" => {
            let unit = UnitName(format!("{family}{}", unit()?));
            let line = match line {
                "TX" => UartLine::Tx,
                "RX" => UartLine::Rx,
                _ => return None,
            };
            Some(Function::Uart { unit, line })
        }
        "CAN" | "FDCAN" => {
            only()?;
            let unit = UnitName(format!("{family}{number}"));
            let line = match line {
                "TX" => CanLine::Tx,
                "RX" => CanLine::Rx,
                _ => return None,
            };
            Some(Function::Can { unit, line })
        }
        _ => None,
    }
}

fn i2c_line(line: &str) -> Option<I2cLine> {
    match line {
        "SCL" => Some(I2cLine::Scl),
        "SDA" => Some(I2cLine::Sda),
        _ => None,
    }
}

fn spi_line(line: &str) -> Option<SpiLine> {
    match line {
        "SCK" => Some(SpiLine::Sck),
        "MISO" => Some(SpiLine::Miso),
        "MOSI" => Some(SpiLine::Mosi),
        "NSS" => Some(SpiLine::Nss),
        _ => None,
    }
}

/// `CH2`, `CH2N`, and `CH1_ETR` where the channel shares its pin with the trigger input.
fn timer(timer: u8, line: &str) -> Option<Function> {
    let channel = line.strip_prefix("CH")?;
    let channel = channel.strip_suffix("_ETR").unwrap_or(channel);
    let plain = channel.strip_suffix('N');
    let complementary = plain.is_some();
    let channel = small(plain.unwrap_or(channel)).filter(|n| (1..=6).contains(n))?;
    Some(Function::Timer { timer, channel, complementary })
}

/// One digit a unit, ascending; `ADC_IN5` is the only unit's.
fn adc_units(digits: &str) -> Option<Vec<u8>> {
    if digits.is_empty() {
        return Some(vec![1]);
    }
    let units: Vec<u8> = digits.bytes().map(|b| b.checked_sub(b'0')).collect::<Option<_>>()?;
    let ascending = units.windows(2).all(|pair| pair.first() < pair.last());
    ascending.then_some(units)
}

/// A number from 0 to 99 without sign or leading zero.
fn small(digits: &str) -> Option<u8> {
    let plain = digits.len() <= 2
        && digits.bytes().all(|b| b.is_ascii_digit())
        && (digits.len() == 1 || !digits.starts_with('0'));
    if plain { digits.parse().ok() } else { None }
}

/// The known spelling nearest to a malformed one.
pub(super) fn mend(name: &str) -> Option<String> {
    let digits = |text: &str| -> String { text.chars().filter(char::is_ascii_digit).collect() };
    let start = FAMILIES.iter().map(|(family, _)| *family).find(|f| name.starts_with(f));
    let (family, rest) = if let Some(family) = start {
        (family, name.strip_prefix(family)?)
    } else {
        let (stem, _, _) = split(name)?;
        let family = nearest(stem, FAMILIES.iter().map(|(family, _)| *family))?;
        (family, name.strip_prefix(stem)?)
    };
    // A unit that is not given is the first: nobody can know which was meant.
    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let (number, line) = rest.split_at_checked(end)?;
    let unit = if number.is_empty() && family != "CAN" { "1" } else { number };
    let channel = digits(line).trim_start_matches('0').to_owned();
    let channel = if channel.is_empty() { "1".to_owned() } else { channel };
    let lines: Vec<String> = match family {
        "ADC" => vec![format!("IN{channel}")],
        "DAC" => vec![format!("OUT{channel}")],
        "TIM" => vec![format!("CH{channel}"), format!("CH{channel}N")],
        "I2C" => vec!["SCL".to_owned(), "SDA".to_owned()],
        "SPI" => ["SCK", "MISO", "MOSI", "NSS"].map(str::to_owned).to_vec(),
        _ => vec!["TX".to_owned(), "RX".to_owned()],
    };
    let line = line.trim_start_matches('_');
    let meant = match nearest(line, lines.iter().map(String::as_str)) {
        Some(meant) => meant.to_owned(),
        None if lines.len() == 1 || (family == "TIM" && !line.is_empty()) => lines.first()?.clone(),
        None => return None,
    };
    let mended = format!("{family}{unit}_{meant}");
    function(family, unit, &meant).is_some().then_some(mended)
}
