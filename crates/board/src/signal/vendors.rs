//! Names that the data sheets of other vendors than ST give to signals: a normalised name in, its meaning out.

use super::spelling::small;
use super::{CanLine, Function, I2cLine, SpiLine, TimerLine, UartLine, UnitName};

/// How the channels of a timer are called.
enum Channels {
    /// By these words, the first channel first.
    Words(&'static [&'static str]),
    /// By a word and a number, the first of which is 0.
    Counted(&'static str),
}

/// Timers and counters: the start of a unit's name, its channels, and what they are at a pin.
const TIMERS: [(&str, Channels, TimerLine); 15] = [
    // RP2040 and RP2350: slices.
    ("PWM", Channels::Words(&["A", "B"]), TimerLine::Both),
    // nRF: modules of four outputs, timers that capture, the decoder.
    ("PWM", Channels::Counted("OUT"), TimerLine::Output),
    ("TIMER", Channels::Counted("CC"), TimerLine::Input),
    ("QDEC", Channels::Words(&["A", "B"]), TimerLine::Input),
    // ESP32: outputs with the timer that they are on, counters, receivers of pulses.
    ("LEDC", Channels::Counted("CH"), TimerLine::Output),
    ("PCNT", Channels::Words(&["A", "B"]), TimerLine::Input),
    ("RMT", Channels::Words(&["IN"]), TimerLine::Input),
    // SAM D: waveform outputs, the decoder.
    ("TCC", Channels::Counted("WO"), TimerLine::Output),
    ("TC", Channels::Counted("WO"), TimerLine::Output),
    ("PDEC", Channels::Words(&["QDI0", "QDI1"]), TimerLine::Input),
    // SAM3X: channels of the PWM controller, each with a period of its own; timers with two pins.
    ("PWM", Channels::Words(&["H"]), TimerLine::Output),
    ("PWM", Channels::Words(&["L"]), TimerLine::Inverted),
    ("TC", Channels::Words(&["TIOA", "TIOB"]), TimerLine::Both),
    // RA: counters with two pins.
    ("GPT", Channels::Words(&["GTIOCA", "GTIOCB"]), TimerLine::Both),
    // i.MX RT: the decoders. Its other timers have units of two numbers.
    ("ENC", Channels::Words(&["A", "B"]), TimerLine::Input),
];

/// The function of a name that another vendor uses.
pub(super) fn function(name: &str) -> Option<Function> {
    timer(name)
        .or_else(|| avr_timer(name))
        .or_else(|| imxrt_timer(name))
        .or_else(|| spi_by_direction(name))
        .or_else(|| bus(name))
        .or_else(|| pio(name))
}

/// `PIO0` of RP2040.
fn pio(name: &str) -> Option<Function> {
    small(name.strip_prefix("PIO")?)?;
    Some(Function::Pio { unit: UnitName(name.to_owned()) })
}

fn timer(name: &str) -> Option<Function> {
    let (unit, line) = name.split_once('_')?;
    let channel_of = |channels: &Channels| match channels {
        Channels::Words(words) => {
            let index = words.iter().position(|word| *word == line)?;
            u8::try_from(index + 1).ok()
        }
        Channels::Counted(word) => Some(small(line.strip_prefix(word)?)? + 1),
    };
    TIMERS.iter().find_map(|(stem, channels, line)| {
        let number = unit.strip_prefix(stem)?;
        let is_unit = number.is_empty() && stem.ends_with("DEC") || small(number).is_some();
        let channel = channel_of(channels).filter(|_| is_unit)?;
        Some(Function::Timer { unit: UnitName(unit.to_owned()), channel, line: *line })
    })
}

/// `FLEXPWM2_PWMA3`, an output of a submodule, and `QTIMER1_TIMER2`, a timer with one line, of i.MX RT.
fn imxrt_timer(name: &str) -> Option<Function> {
    let (unit, line) = name.split_once('_')?;
    let both = |stem: &str, start: &str| {
        small(unit.strip_prefix(stem)?)?;
        let number = line.strip_prefix(start)?;
        small(number).map(|_| UnitName(format!("{unit}_{number}")))
    };
    let timer = |unit, channel, line| Some(Function::Timer { unit, channel, line });
    if let Some(unit) = both("FLEXPWM", "PWMA") {
        return timer(unit, 1, TimerLine::Output);
    }
    if let Some(unit) = both("FLEXPWM", "PWMB") {
        return timer(unit, 2, TimerLine::Output);
    }
    both("QTIMER", "TIMER").and_then(|unit| timer(unit, 1, TimerLine::Both))
}

/// `SERCOM0_SDA` of SAM D and `SERIAL0_TX` of nRF53, which can be a bus of any kind; `TWIM0_SCL`, `SPIM3_SCK` and
/// `UARTE0_TX` of nRF52; `TWAI0_TX` of ESP32; `LPI2C1_SCL` and `LPSPI4_SDO` of i.MX RT; `IIC1_SCL`, `RSPI0_SCK` and
/// `SCI2_TX` of RA.
fn bus(name: &str) -> Option<Function> {
    let (unit, line) = name.split_once('_')?;
    let stem = unit.trim_end_matches(|c: char| c.is_ascii_digit());
    small(unit.strip_prefix(stem)?)?;
    let unit = UnitName(unit.to_owned());
    let i2c = |unit| Some(Function::I2c { unit, line: I2cLine::from_name(line)? });
    let uart = |unit| Some(Function::Uart { unit, line: UartLine::from_name(line)? });
    let spi = |unit| Some(Function::Spi { unit, line: SpiLine::from_name(line)? });
    match stem {
        "TWIM" | "LPI2C" | "IIC" => i2c(unit),
        "UARTE" => uart(unit),
        "SPIM" | "RSPI" => spi(unit),
        "SERCOM" | "SCI" | "SERIAL" => {
            i2c(unit.clone()).or_else(|| uart(unit.clone())).or_else(|| spi(unit))
        }
        "TWAI" | "FLEXCAN" => Some(Function::Can { unit, line: CanLine::from_name(line)? }),
        "LPSPI" => {
            let line = match line {
                "SDI" => SpiLine::Miso,
                "SDO" => SpiLine::Mosi,
                "SCK" => SpiLine::Sck,
                "PCS0" => SpiLine::Nss,
                _ => return None,
            };
            Some(Function::Spi { unit, line })
        }
        _ => None,
    }
}

/// `SPI0_RX`, `SPI0_TX`, `SPI0_CSn` of RP2040, and `SPI_SS` of AVR. No misspelling is corrected to
/// one of these: too many other peripherals have such lines.
fn spi_by_direction(name: &str) -> Option<Function> {
    let (unit, line) = name.split_once('_')?;
    let number = unit.strip_prefix("SPI")?;
    let line = match line {
        "RX" => SpiLine::Miso,
        "TX" => SpiLine::Mosi,
        "CSN" | "CS" | "SS" => SpiLine::Nss,
        _ => return None,
    };
    if !number.is_empty() {
        small(number)?;
    }
    Some(Function::Spi { unit: UnitName(unit.to_owned()), line })
}

/// `OC1A`, `OC4AN` and `ICP1`: AVR's names for the outputs and the capture input of a
/// timer/counter.
fn avr_timer(name: &str) -> Option<Function> {
    let (number, channel, line) = if let Some(number) = name.strip_prefix("ICP") {
        (number, 1, TimerLine::Input)
    } else {
        let output = name.strip_prefix("OC")?;
        let plain = output.strip_suffix('N');
        let line = if plain.is_some() { TimerLine::Inverted } else { TimerLine::Output };
        let output = plain.unwrap_or(output);
        let number = output.strip_suffix(['A', 'B', 'C', 'D'])?;
        let channel = match output.strip_prefix(number)? {
            "A" => 1,
            "B" => 2,
            "C" => 3,
            _ => 4,
        };
        (number, channel, line)
    };
    small(number)?;
    Some(Function::Timer { unit: UnitName(format!("TC{number}")), channel, line })
}
