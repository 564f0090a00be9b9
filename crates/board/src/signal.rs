//! Signals: a table's spelling in, a canonical name and its meaning out.
//!
//! The grammar of the names is that of the language page: a peripheral unit, `_`, a line. It is the
//! same for every MCU; the table and the target profile determine which units exist.

mod spelling;
mod vendors;

use std::cmp::Ordering;
use std::fmt;

use self::spelling::{Reading, canonical, mend, normalise, read};
use crate::pin::{named, natural};

/// A signal, identified by its canonical name: `I2C1-SCL`, `i2c1_scl` and `I²C1-SCL` are equal.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Signal {
    name: String,
    function: Function,
}

/// The function of a signal, as far as a device kind can use it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// An input of one of several converters: `ADC12_IN8`.
    Adc {
        /// The units that can sample it, in ascending order.
        units: Vec<u8>,
        /// The input number.
        channel: u8,
    },
    /// `I2C1_SCL`.
    I2c {
        /// The unit: `I2C1`, or `TWI` where the data sheet uses that name.
        unit: UnitName,
        /// The wire of the bus.
        line: I2cLine,
    },
    /// `TIM1_CH2`, `TIM1_CH2N`; `PWM4_A` of RP2040; `OC1A` and `ICP1` of AVR; `LEDC0_CH1` of ESP32.
    Timer {
        /// The unit: `TIM1`, `PWM4`, `TC1`.
        unit: UnitName,
        /// The channel's number, from 1; A is 1.
        channel: u8,
        /// The pin's role for the channel.
        line: TimerLine,
    },
    /// `USART1_TX`.
    Uart {
        /// The unit: `USART1`, `UART4`, `LPUART1`.
        unit: UnitName,
        /// The wire of the port.
        line: UartLine,
    },
    /// `SPI1_SCK`.
    Spi {
        /// The unit: `SPI1`, or `SPI` if the MCU has only one.
        unit: UnitName,
        /// The wire of the bus.
        line: SpiLine,
    },
    /// `CAN1_TX`, `FDCAN1_TX`.
    Can {
        /// The unit: `CAN1`, `FDCAN1`, or `CAN` if the MCU has only one.
        unit: UnitName,
        /// The wire of the controller.
        line: CanLine,
    },
    /// `DAC1_OUT2`.
    Dac {
        /// The unit's number.
        unit: u8,
        /// The output's number.
        channel: u8,
    },
    /// `PIO0` of RP2040: a block of programmable state machines, which read and drive pins.
    Pio {
        /// The unit: `PIO0`.
        unit: UnitName,
    },
    /// Any other usage: it counts in the pin's cost, but no device kind needs it.
    Other,
}

/// Makes a type of the wires of a peripheral, each as signals name it.
macro_rules! lines {
    ($(#[$doc:meta])* $name:ident { $($(#[$line_doc:meta])* $line:ident = $word:literal,)+ }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $name {
            $($(#[$line_doc])* $line,)+
        }

        impl $name {
            /// The name in signals.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$line => $word,)+
                }
            }

            fn from_name(name: &str) -> Option<Self> {
                match name {
                    $($word => Some(Self::$line),)+
                    _ => None,
                }
            }
        }
    };
}

lines!(
    /// A wire of an I²C bus.
    I2cLine {
        /// The clock wire.
        Scl = "SCL",
        /// The data wire.
        Sda = "SDA",
    }
);

/// The role of a pin for a timer's channel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TimerLine {
    /// Output and capture input.
    Both,
    /// Only an output: `OC1A`.
    Output,
    /// The inverted output: `TIM1_CH2N`.
    Inverted,
    /// Only a capture input: `ICP1`.
    Input,
}

impl TimerLine {
    /// Whether edges can be captured on the pin.
    #[must_use]
    pub const fn is_input(self) -> bool {
        matches!(self, Self::Both | Self::Input)
    }

    /// Whether pulses come out of the pin without inversion.
    #[must_use]
    pub const fn is_output(self) -> bool {
        matches!(self, Self::Both | Self::Output)
    }
}

lines!(
    /// A wire of a serial port, seen from the MCU.
    UartLine {
        /// The transmit wire.
        Tx = "TX",
        /// The receive wire.
        Rx = "RX",
    }
);

lines!(
    /// A wire of an SPI bus.
    SpiLine {
        /// The clock wire.
        Sck = "SCK",
        /// The wire to the controller.
        Miso = "MISO",
        /// The wire from the controller.
        Mosi = "MOSI",
        /// The unit's own select line.
        Nss = "NSS",
    }
);

lines!(
    /// A wire of a CAN controller, seen from the MCU.
    CanLine {
        /// The transmit wire.
        Tx = "TX",
        /// The receive wire.
        Rx = "RX",
    }
);

/// The name of a peripheral instance: `ADC1`, `TIM3`, `LPUART1`. The order is natural.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct UnitName(String);

impl UnitName {
    /// Normalises a spelling (`i²c1` is `I2C1`).
    #[must_use]
    pub fn new(spelled: &str) -> Self {
        Self(normalise(spelled))
    }

    /// The canonical spelling.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

named!(UnitName: as_str, Signal: name);

/// A spelling that looks like a signal of a known peripheral, but is not one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Malformed {
    /// The known spelling that was probably meant.
    pub nearest: Option<String>,
}

impl Signal {
    /// Reads a spelling. Every text is a signal; a malformed one has the function
    /// [`Function::Other`] and comes with what was probably meant.
    #[must_use]
    pub fn parse(spelled: &str) -> (Self, Option<Malformed>) {
        let name = normalise(spelled);
        match read(&name) {
            Reading::Function(function) => {
                let name = canonical(&function).unwrap_or(name);
                (Self { name, function }, None)
            }
            Reading::Unused => (Self { name, function: Function::Other }, None),
            Reading::Malformed => {
                let nearest = mend(&name);
                (Self { name, function: Function::Other }, Some(Malformed { nearest }))
            }
        }
    }

    /// The canonical name: `ADC12_IN8`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The function of the signal.
    #[must_use]
    pub fn function(&self) -> &Function {
        &self.function
    }
}

impl Function {
    /// The peripheral instances that can serve the signal, lowest first: `ADC1` and `ADC2` for
    /// `ADC12_IN8`. Empty for [`Function::Other`].
    #[must_use]
    pub fn units(&self) -> Vec<UnitName> {
        let numbered = |stem: &str, number: u8| UnitName(format!("{stem}{number}"));
        match self {
            Self::Adc { units, .. } => units.iter().map(|&n| numbered("ADC", n)).collect(),
            Self::Dac { unit, .. } => vec![numbered("DAC", *unit)],
            Self::I2c { unit, .. }
            | Self::Timer { unit, .. }
            | Self::Spi { unit, .. }
            | Self::Uart { unit, .. }
            | Self::Can { unit, .. }
            | Self::Pio { unit } => vec![unit.clone()],
            Self::Other => Vec::new(),
        }
    }

    /// Whether the pin can be an input for it.
    #[must_use]
    pub const fn is_input(&self) -> bool {
        match self {
            Self::Uart { line, .. } => matches!(line, UartLine::Rx),
            Self::Can { line, .. } => matches!(line, CanLine::Rx),
            Self::Spi { line, .. } => matches!(line, SpiLine::Miso),
            Self::Timer { line, .. } => line.is_input(),
            Self::Dac { .. } => false,
            Self::Adc { .. } | Self::I2c { .. } | Self::Pio { .. } | Self::Other => true,
        }
    }

    /// Whether the pin can be an output for it; a bus that devices hold low is both.
    #[must_use]
    pub const fn is_output(&self) -> bool {
        match self {
            Self::Adc { .. } => false,
            Self::I2c { .. } | Self::Pio { .. } | Self::Other => true,
            Self::Timer { line, .. } => !matches!(line, TimerLine::Input),
            Self::Uart { .. } | Self::Spi { .. } | Self::Can { .. } | Self::Dac { .. } => {
                !self.is_input()
            }
        }
    }

    /// Whether the function bypasses the alternate-function multiplexer, as analog functions do.
    #[must_use]
    pub fn is_analog(&self) -> bool {
        matches!(self, Self::Adc { .. } | Self::Dac { .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The canonical name; for a malformed one `?` and what was probably meant.
    fn read(spelled: &str) -> String {
        match Signal::parse(spelled) {
            (signal, None) => signal.name().to_owned(),
            (_, Some(Malformed { nearest })) => format!("?{}", nearest.unwrap_or_default()),
        }
    }

    #[test]
    fn spellings_of_one_signal_are_one_name() {
        for (spelled, expected) in [
            ("ADC123-IN1", "ADC123_IN1"),
            ("adc12_inp8", "ADC12_IN8"),
            ("ADC_IN5", "ADC1_IN5"),
            ("I2C1-SCL", "I2C1_SCL"),
            ("I²C1-SCL", "I2C1_SCL"),
            ("i2c1_scl", "I2C1_SCL"),
            ("I2C1\u{2013}SCL", "I2C1_SCL"),
            ("TIM2_CH1_ETR", "TIM2_CH1"),
            ("tim8-ch2n", "TIM8_CH2N"),
            ("DAC_OUT1", "DAC1_OUT1"),
            ("LPUART1_TX", "LPUART1_TX"),
            ("CAN_RX", "CAN_RX"),
            ("USART2_CTS_NSS", "USART2_CTS_NSS"),
            ("TIM1_BKIN2", "TIM1_BKIN2"),
            ("ADC1_INN3", "ADC1_INN3"),
            ("FSMC_D4", "FSMC_D4"),
            ("I3C1_SCL", "I3C1_SCL"),
            ("QSPI1_NSS", "QSPI1_NSS"),
            ("SPINDLE", "SPINDLE"),
            ("pwm4-a", "PWM4_A"),
            ("PWM4 B", "PWM4_B"),
            ("PWM1", "PWM1"),
            ("oc1a", "OC1A"),
            ("OC4AN", "OC4AN"),
            ("ICP1", "ICP1"),
            ("OC", "OC"),
            ("TWI_SCL", "TWI_SCL"),
            ("twi1-sda", "TWI1_SDA"),
            ("SPI_SCK", "SPI_SCK"),
            ("SPI_SS", "SPI_NSS"),
            ("SPI0_RX", "SPI0_MISO"),
            ("SPI0_TX", "SPI0_MOSI"),
            ("SPI1_CSn", "SPI1_NSS"),
            ("LEDC3_CH6", "LEDC3_CH6"),
            ("sercom4-mosi", "SERCOM4_MOSI"),
            ("TIMER1_CC0", "TIMER1_CC0"),
            ("TWAI0_TX", "TWAI0_TX"),
            ("tacho", "TACHO"),
        ] {
            assert_eq!(read(spelled), expected, "{spelled}");
        }
    }

    #[test]
    fn malformed_signals_come_with_what_was_meant() {
        for (spelled, expected) in [
            ("ADC12IN8", "?ADC12_IN8"),
            ("ADC12_8", "?ADC12_IN8"),
            ("ADC21_IN8", "?"),
            ("TIM_CH1", "?TIM1_CH1"),
            ("TIM3_C2", "?TIM3_CH2"),
            ("TIM3_CH9", "?"),
            ("TIM3", "?"),
            ("I2C1-SLC", "?I2C1_SCL"),
            ("I2C1SDA", "?I2C1_SDA"),
            ("I2C_SDA", "?I2C1_SDA"),
            ("TWI0SDA", "?TWI0_SDA"),
            ("USRAT1_TX", "?USART1_TX"),
            ("SPI1_SKC", "?SPI1_SCK"),
            ("SPI1_QUUX", "?"),
            ("DAC1_1", "?DAC1_OUT1"),
            ("CAN1_TXD", "?CAN1_TX"),
            ("TIM256_CH1", "?"),
        ] {
            assert_eq!(read(spelled), expected, "{spelled}");
        }
    }

    #[test]
    fn functions_know_their_units() {
        let units = |spelled: &str| -> Vec<String> {
            let (signal, _) = Signal::parse(spelled);
            signal.function().units().iter().map(UnitName::to_string).collect()
        };
        assert_eq!(units("ADC123-IN1"), ["ADC1", "ADC2", "ADC3"]);
        assert_eq!(units("TIM12_CH1"), ["TIM12"]);
        assert_eq!(units("UART4_TX"), ["UART4"]);
        assert_eq!(units("FDCAN2_RX"), ["FDCAN2"]);
        assert_eq!(units("nothing"), Vec::<String>::new());
        let (signal, _) = Signal::parse("TIM8_CH2N");
        let timer =
            |unit, channel, line| Function::Timer { unit: UnitName::new(unit), channel, line };
        assert_eq!(signal.function(), &timer("TIM8", 2, TimerLine::Inverted));
        for (spelled, expected) in [
            ("TIM8_CH2", timer("TIM8", 2, TimerLine::Both)),
            ("PWM11_B", timer("PWM11", 2, TimerLine::Both)),
            ("OC1C", timer("TC1", 3, TimerLine::Output)),
            ("OC4DN", timer("TC4", 4, TimerLine::Inverted)),
            ("ICP5", timer("TC5", 1, TimerLine::Input)),
            ("PWM3_OUT2", timer("PWM3", 3, TimerLine::Output)),
            ("LEDC1_CH3", timer("LEDC1", 4, TimerLine::Output)),
            ("QDEC_B", timer("QDEC", 2, TimerLine::Input)),
            ("FLEXPWM2_PWMB3", timer("FLEXPWM2_3", 2, TimerLine::Output)),
            ("QTIMER1_TIMER2", timer("QTIMER1_2", 1, TimerLine::Both)),
            ("ENC4_A", timer("ENC4", 1, TimerLine::Input)),
            ("PDEC_QDI1", timer("PDEC", 2, TimerLine::Input)),
            ("TCC0_WO3", timer("TCC0", 4, TimerLine::Output)),
        ] {
            assert_eq!(Signal::parse(spelled).0.function(), &expected, "{spelled}");
        }
    }

    proptest::proptest! {
        /// A canonical name reads as itself, and a suggestion is well formed.
        #[test]
        fn reading_is_stable(spelled in "[A-Za-z0-9_²-]{0,12}|(ADC|TIM|I2C|SPI|USART|CAN|PWM|TWI|OC|ICP|LEDC|SERCOM|TCC|UARTE|LPSPI)[0-9]{0,3}[_-]?[A-Z]{0,4}[0-9]{0,2}") {
            let (signal, malformed) = Signal::parse(&spelled);
            if let Some(nearest) = malformed.clone().and_then(|malformed| malformed.nearest) {
                proptest::prop_assert_eq!(Signal::parse(&nearest).1, None);
            }
            let (again, twice) = Signal::parse(signal.name());
            proptest::prop_assert_eq!(again, signal);
            proptest::prop_assert_eq!(twice, malformed);
        }
    }
}
