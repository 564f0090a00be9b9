//! The grammar of signal names: a spelling in, its meaning or a better spelling out.

use sensedsl_diagnostics::nearest;

use super::{CanLine, Function, I2cLine, SpiLine, TimerLine, UartLine, UnitName, vendors};

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

/// The canonical name of a function that has several spellings.
pub(super) fn canonical(function: &Function) -> Option<String> {
    match function {
        Function::Adc { units, channel } => {
            let units: String = units.iter().map(u8::to_string).collect();
            Some(format!("ADC{units}_IN{channel}"))
        }
        Function::Timer { unit, channel, line } if is_tim(unit) => {
            let inverted = if *line == TimerLine::Inverted { "N" } else { "" };
            Some(format!("{unit}_CH{channel}{inverted}"))
        }
        Function::Spi { unit, line } => Some(format!("{unit}_{}", line.name())),
        Function::Dac { unit, channel } => Some(format!("DAC{unit}_OUT{channel}")),
        Function::I2c { .. }
        | Function::Timer { .. }
        | Function::Uart { .. }
        | Function::Can { .. }
        | Function::Pio { .. }
        | Function::Other => None,
    }
}

/// Whether it is a timer of STM32, not one of nRF (`TIMER1`).
fn is_tim(unit: &UnitName) -> bool {
    let number = unit.as_str().strip_prefix("TIM");
    number.is_some_and(|number| number.starts_with(|c: char| c.is_ascii_digit()))
}

/// The result of reading a normalised name.
pub(super) enum Reading {
    Function(Function),
    /// Free text, or a line that no device kind uses (`USART1_CTS`).
    Unused,
    Malformed,
}

/// The peripheral families, and for each family the lines that no device kind uses (a trailing `*`
/// stands for anything).
const FAMILIES: [(&str, &[&str]); 11] = [
    ("LPUART", &["CK", "CTS*", "RTS*", "DE", "NSS"]),
    ("USART", &["CK", "CTS*", "RTS*", "DE", "NSS"]),
    ("UART", &["CK", "CTS*", "RTS*", "DE", "NSS"]),
    ("FDCAN", &[]),
    ("ADC", &["INN*", "EXTI*", "VINM*", "VINP*", "PDM*", "PGA*"]),
    ("I2C", &["SMBA*", "WS"]),
    ("TWI", &[]),
    ("TIM", &["ETR*", "BKIN*"]),
    ("SPI", &["RDY"]),
    ("CAN", &[]),
    ("DAC", &["EXTI*"]),
];

/// Other peripherals with a name one letter away from a family's.
const NEIGHBOURS: [&str; 9] = ["I2S", "I3C", "SAI", "QSPI", "OSPI", "HSPI", "XSPI", "FSPI", "VSPI"];

pub(super) fn read(name: &str) -> Reading {
    if let Some(function) = vendors::function(name) {
        return Reading::Function(function);
    }
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
    // An input of the second bank of an STM32L1's converter, which has to be switched to.
    let second = line.strip_prefix("IN").and_then(|line| line.strip_suffix('B'));
    let second = *family == "ADC" && second.and_then(small).is_some();
    if numbered && (second || unused.iter().any(fits)) {
        Reading::Unused
    } else {
        Reading::Malformed
    }
}

/// Splits `TIM3_CH1` into (`TIM`, `3`, `CH1`). A stem ends in a letter; `I2C` itself contains a
/// digit.
fn split(name: &str) -> Option<(&str, &str, &str)> {
    let (unit, line) = name.split_once('_')?;
    let stem = unit.trim_end_matches(|c: char| c.is_ascii_digit());
    Some((stem, unit.strip_prefix(stem)?, line))
}

/// Whether a family's name is followed by a digit, with no separator after it: `ADC12IN8`, `TIM3`.
fn misses_separator(name: &str) -> bool {
    FAMILIES.iter().any(|(family, _)| {
        name.strip_prefix(family).is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
    })
}

/// Whether this is an unknown stem, one typing mistake away from a family's, before a line of that
/// family: `USRAT1_TX`.
fn misspelt_family(stem: &str, line: &str) -> bool {
    if stem.len() < 2 || NEIGHBOURS.contains(&stem) || stem.starts_with("LP") {
        return false;
    }
    let families = FAMILIES.iter().map(|(family, _)| *family);
    nearest(stem, families.filter(|family| function(family, "1", line).is_some())).is_some()
}

/// The function of a family's line, if it is one.
fn function(family: &str, number: &str, line: &str) -> Option<Function> {
    // A number has no sign and no leading zero; `ADC_IN5` and `DAC_OUT1` stand for the only unit.
    let unit = || small(number);
    let only = || if number.is_empty() { Some(1) } else { small(number) };
    let name = || UnitName(format!("{family}{number}"));
    match family {
        "ADC" => {
            let channel = line.strip_prefix("INP").or_else(|| line.strip_prefix("IN"))?;
            Some(Function::Adc { units: adc_units(number)?, channel: small(channel)? })
        }
        "I2C" => unit().and(Some(Function::I2c { unit: name(), line: I2cLine::from_name(line)? })),
        "TWI" => only().and(Some(Function::I2c { unit: name(), line: I2cLine::from_name(line)? })),
        "TIM" => unit().and(timer(name(), line)),
        "SPI" => only().and(Some(Function::Spi { unit: name(), line: SpiLine::from_name(line)? })),
        "DAC" => Some(Function::Dac { unit: only()?, channel: small(line.strip_prefix("OUT")?)? }),
        "USART" | "UART" | "LPUART" => {
            unit().and(Some(Function::Uart { unit: name(), line: UartLine::from_name(line)? }))
        }
        "CAN" | "FDCAN" => {
            only().and(Some(Function::Can { unit: name(), line: CanLine::from_name(line)? }))
        }
        _ => None,
    }
}

/// `CH2`, `CH2N`, and `CH1_ETR` if the channel shares its pin with the trigger input.
fn timer(unit: UnitName, line: &str) -> Option<Function> {
    let channel = line.strip_prefix("CH")?;
    let channel = channel.strip_suffix("_ETR").unwrap_or(channel);
    let plain = channel.strip_suffix('N');
    let line = if plain.is_some() { TimerLine::Inverted } else { TimerLine::Both };
    let channel = small(plain.unwrap_or(channel)).filter(|n| (1..=6).contains(n))?;
    Some(Function::Timer { unit, channel, line })
}

/// One digit per unit, in ascending order; `ADC_IN5` belongs to the only unit.
fn adc_units(digits: &str) -> Option<Vec<u8>> {
    if digits.is_empty() {
        return Some(vec![1]);
    }
    let units: Vec<u8> = digits.bytes().map(|b| b.checked_sub(b'0')).collect::<Option<_>>()?;
    let ascending = units.windows(2).all(|pair| pair.first() < pair.last());
    ascending.then_some(units)
}

/// A number from 0 to 99 without sign or leading zero.
pub(super) fn small(digits: &str) -> Option<u8> {
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
    // If no unit is given, this is the first one, because nothing shows which was meant.
    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    let (number, line) = rest.split_at_checked(end)?;
    let unit = if number.is_empty() && family != "CAN" { "1" } else { number };
    let channel = digits(line).trim_start_matches('0').to_owned();
    let channel = if channel.is_empty() { "1".to_owned() } else { channel };
    let lines: Vec<String> = match family {
        "ADC" => vec![format!("IN{channel}")],
        "DAC" => vec![format!("OUT{channel}")],
        "TIM" => vec![format!("CH{channel}"), format!("CH{channel}N")],
        "I2C" | "TWI" => vec!["SCL".to_owned(), "SDA".to_owned()],
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
