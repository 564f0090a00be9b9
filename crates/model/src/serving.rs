//! Whether a pin can be a wire at all: a kind, a role and a pin of a table in, yes or no out.
//!
//! Used only for proposals to a user who named a pin that does not exist. Which pins are offered,
//! and which unit serves them, is decided by crate `wiring`.

use sensedsl_board::signal::{CanLine, Function, I2cLine, SpiLine, UartLine};
use sensedsl_board::table::Pin;

use crate::kind::{KindName, Role};

/// Whether the wire needs any of the pin's usages.
pub(crate) fn serves(kind: KindName, role: Role, pin: &Pin) -> bool {
    let is_any = matches!(role, Role::Cs | Role::Trigger) || kind == KindName::Digital;
    is_any || pin.usages.iter().any(|usage| is_of(kind, role, usage.signal.function()))
}

fn is_of(kind: KindName, role: Role, function: &Function) -> bool {
    match function {
        Function::Adc { .. } => kind == KindName::Analog,
        Function::Dac { .. } => kind == KindName::Dac,
        Function::Timer { line, .. } => {
            let captures = matches!(kind, KindName::Icu | KindName::Encoder);
            let is_put_out = line.is_output() || !line.is_input();
            (captures && line.is_input()) || (kind == KindName::Pwm && is_put_out)
        }
        Function::I2c { line, .. } => match line {
            I2cLine::Scl => role == Role::Scl,
            I2cLine::Sda => role == Role::Sda,
        },
        Function::Uart { line, .. } => match line {
            UartLine::Tx => kind == KindName::Uart && role == Role::Tx,
            UartLine::Rx => kind == KindName::Uart && role == Role::Rx,
        },
        Function::Spi { line, .. } => match line {
            SpiLine::Sck => role == Role::Sck,
            SpiLine::Miso => role == Role::Miso,
            SpiLine::Mosi => role == Role::Mosi,
            SpiLine::Nss => false,
        },
        Function::Can { line, .. } => match line {
            CanLine::Tx => kind == KindName::Can && role == Role::Tx,
            CanLine::Rx => kind == KindName::Can && role == Role::Rx,
        },
        Function::Other => false,
    }
}
