//! Wires of RP2040 and RP2350 in the HAL's types.

use sensedsl_board::signal::{Function, I2cLine, SpiLine, TimerLine, UartLine};

/// What the check for ARMv8-M needs of cargo: the HAL names registers that the core's crate has for these cores alone,
/// whatever it is checked for.
pub(crate) const CONFIG: &str = include_str!("../templates/rp/check_config.toml.txt");

/// The functions that the lines call; only those in use are printed.
pub(crate) const CALLS: &[(&str, &str)] = &[
    ("analog", "<P: hal::adc::AdcPin>(_: Peri<'static, P>)"),
    ("scl", "<T: hal::i2c::Instance, P: hal::i2c::SclPin<T>>(_: Peri<'static, P>)"),
    ("sda", "<T: hal::i2c::Instance, P: hal::i2c::SdaPin<T>>(_: Peri<'static, P>)"),
    ("sck", "<T: hal::spi::Instance, P: hal::spi::ClkPin<T>>(_: Peri<'static, P>)"),
    ("miso", "<T: hal::spi::Instance, P: hal::spi::MisoPin<T>>(_: Peri<'static, P>)"),
    ("mosi", "<T: hal::spi::Instance, P: hal::spi::MosiPin<T>>(_: Peri<'static, P>)"),
    ("uart_tx", "<T: hal::uart::Instance, P: hal::uart::TxPin<T>>(_: Peri<'static, P>)"),
    ("uart_rx", "<T: hal::uart::Instance, P: hal::uart::RxPin<T>>(_: Peri<'static, P>)"),
    ("channel_a", "<T: hal::pwm::Slice, P: hal::pwm::ChannelAPin<T>>(_: Peri<'static, P>)"),
    ("channel_b", "<T: hal::pwm::Slice, P: hal::pwm::ChannelBPin<T>>(_: Peri<'static, P>)"),
];

/// The line of a wire with a signal; none where the HAL has no types for it.
pub(crate) fn wire(unit: &str, function: &Function, pin: &str) -> Option<String> {
    let call = match function {
        // There is one converter.
        Function::Adc { .. } => return Some(format!("analog::<_>(p.{pin});")),
        Function::I2c { line, .. } => match line {
            I2cLine::Scl => "scl",
            I2cLine::Sda => "sda",
        },
        Function::Timer { channel, line, .. } => match (line, channel) {
            (TimerLine::Inverted, _) => return None,
            (TimerLine::Both | TimerLine::Output | TimerLine::Input, 1) => "channel_a",
            (TimerLine::Both | TimerLine::Output | TimerLine::Input, _) => "channel_b",
        },
        Function::Uart { line, .. } => match line {
            UartLine::Tx => "uart_tx",
            UartLine::Rx => "uart_rx",
        },
        Function::Spi { line, .. } => match line {
            SpiLine::Sck => "sck",
            SpiLine::Miso => "miso",
            SpiLine::Mosi => "mosi",
            SpiLine::Nss => return None,
        },
        Function::Can { .. } | Function::Dac { .. } | Function::Other => return None,
    };
    Some(format!("{call}::<{unit}, _>(p.{pin});"))
}
