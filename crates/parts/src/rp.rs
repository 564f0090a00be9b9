//! RP2040 and RP2350: their function tables are regular, so they are rules.
//!
//! Names and numbers are those of the chips' data sheets, section "GPIO functions", with `_` where
//! these have a space: `PWM4 A` is `PWM4_A`.

/// A chip.
#[derive(Debug, PartialEq, Eq)]
pub struct Chip {
    /// The part number.
    pub name: &'static str,
    /// The package.
    pub package: &'static str,
    /// The cores that run the firmware.
    pub core: &'static str,
    /// Bytes of RAM. The flash is a separate chip of any size.
    pub ram_bytes: usize,
    /// Number of GPIO pins.
    pub pins: u8,
    /// The first pin that is an input of the converter; all later ones are too.
    first_analog: u8,
    /// Number of PIO blocks.
    pio: u8,
    /// Whether it has the functions that came with RP2350.
    second: bool,
}

/// All chips; cores and RAM are those of the data sheets' first pages.
pub static CHIPS: [Chip; 3] = [
    Chip {
        name: "RP2040",
        package: "QFN56",
        core: "Cortex-M0+ + Cortex-M0+",
        ram_bytes: 264 << 10,
        pins: 30,
        first_analog: 26,
        pio: 2,
        second: false,
    },
    Chip {
        name: "RP2350A",
        package: "QFN60",
        core: "Cortex-M33 + Cortex-M33",
        ram_bytes: 520 << 10,
        pins: 30,
        first_analog: 26,
        pio: 3,
        second: true,
    },
    Chip {
        name: "RP2350B",
        package: "QFN80",
        core: "Cortex-M33 + Cortex-M33",
        ram_bytes: 520 << 10,
        pins: 48,
        first_analog: 40,
        pio: 3,
        second: true,
    },
];

/// A usage and the number of its function.
pub type Usage = (String, Option<u8>);

impl Chip {
    /// The usages of a pin.
    #[must_use]
    pub fn usages(&self, pin: u8) -> Vec<Usage> {
        let of = |list: [&'static str; 4]| list.into_iter().nth(usize::from(pin % 4)).unwrap_or("");
        let spi = (pin / 8) % 2;
        let uart = (pin / 4).div_ceil(2) % 2;
        let i2c = (pin / 2) % 2;
        let slice = if pin < 32 { (pin / 2) % 8 } else { 8 + (pin / 2) % 4 };
        let mut usages = Vec::new();
        if pin >= self.first_analog {
            usages.push((format!("ADC1_IN{}", pin - self.first_analog), None));
        }
        let mut push = |name: String, function: u8| usages.push((name, Some(function)));
        push(format!("SPI{spi}_{}", of(["RX", "CSn", "SCK", "TX"])), 1);
        push(format!("UART{uart}_{}", of(["TX", "RX", "CTS", "RTS"])), 2);
        push(format!("I2C{i2c}_{}", if pin.is_multiple_of(2) { "SDA" } else { "SCL" }), 3);
        push(format!("PWM{slice}_{}", if pin.is_multiple_of(2) { "A" } else { "B" }), 4);
        for pio in 0..self.pio {
            push(format!("PIO{pio}"), 6 + pio);
        }
        if self.second && pin % 4 >= 2 {
            push(format!("UART{uart}_{}", of(["", "", "TX", "RX"])), 11);
        }
        usages
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(chip: usize, pin: u8) -> String {
        let usages = CHIPS[chip].usages(pin);
        let names = usages.iter().filter(|(name, _)| !name.starts_with("PIO"));
        names.map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(" ")
    }

    /// Rows of the data sheets' tables.
    #[test]
    fn rows_of_the_data_sheets() {
        assert_eq!(line(0, 0), "SPI0_RX UART0_TX I2C0_SDA PWM0_A");
        assert_eq!(line(0, 5), "SPI0_CSn UART1_RX I2C0_SCL PWM2_B");
        assert_eq!(line(0, 8), "SPI1_RX UART1_TX I2C0_SDA PWM4_A");
        assert_eq!(line(0, 12), "SPI1_RX UART0_TX I2C0_SDA PWM6_A");
        assert_eq!(line(0, 23), "SPI0_TX UART1_RTS I2C1_SCL PWM3_B");
        assert_eq!(line(0, 29), "ADC1_IN3 SPI1_CSn UART0_RX I2C0_SCL PWM6_B");
        assert_eq!(line(1, 2), "SPI0_SCK UART0_CTS I2C1_SDA PWM1_A UART0_TX");
        assert_eq!(line(2, 40), "ADC1_IN0 SPI1_RX UART1_TX I2C0_SDA PWM8_A");
        assert_eq!(line(2, 47), "ADC1_IN7 SPI1_TX UART0_RTS I2C1_SCL PWM11_B UART0_RX");
    }
}
