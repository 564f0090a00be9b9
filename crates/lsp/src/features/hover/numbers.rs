//! Numbers: the same in other units, and of an address the form that goes over the bus.

use sensedsl_syntax::SyntaxNode;
use sensedsl_syntax::ast::{self, AstNode as _, Magnitude};

use crate::context::Context;

pub(crate) fn number(cx: &Context<'_>, node: &SyntaxNode) -> Option<String> {
    let number = node.ancestors().find_map(ast::Number::cast)?;
    let property = node.ancestors().find_map(ast::Property::cast)?.name()?;
    match (number.magnitude()?, number.unit()) {
        (Magnitude::Integer(address), None) if property.text() == "address" => {
            Some(of_address(address))
        }
        (Magnitude::Integer(whole), None) if property.text() == "id" => {
            Some(format!("identifier on the wire, {whole} = 0x{whole:02X}"))
        }
        (Magnitude::Integer(whole), None) if whole > 9 => {
            Some(format!("{whole} = 0x{whole:X} = 0b{whole:b}"))
        }
        (_, Some(unit)) => {
            let factor = match unit.name() {
                "us" => ("s", 1e-6),
                "ms" => ("s", 1e-3),
                "kHz" => ("Hz", 1e3),
                "MHz" => ("Hz", 1e6),
                "mV" => ("V", 1e-3),
                "kOhm" => ("Ohm", 1e3),
                "mA" => ("A", 1e-3),
                "mm" => ("m", 1e-3),
                "cm" => ("m", 1e-2),
                "Hz" => return period(cx, &number),
                _ => return None,
            };
            let (base, factor) = factor;
            let shown = sensedsl_model::written::rounded(value(&number)? * factor);
            Some(format!("= {shown} {base}"))
        }
        _ => None,
    }
}

/// How long one turn of a frequency lasts.
fn period(_: &Context<'_>, number: &ast::Number) -> Option<String> {
    let hz = value(number).filter(|hz| *hz > 0.0)?;
    Some(format!("= one every {} ms", sensedsl_model::written::rounded(1e3 / hz)))
}

fn value(number: &ast::Number) -> Option<f64> {
    match number.magnitude()? {
        #[expect(clippy::cast_precision_loss, reason = "shown with six digits")]
        Magnitude::Integer(whole) => Some(whole as f64),
        Magnitude::Float(value) => Some(value),
    }
}

fn of_address(written: u64) -> String {
    if written < 0x80 {
        return format!(
            "7-bit I2C address 0x{written:02X}; on the bus 0x{:02X} to write, 0x{:02X} to read",
            written * 2,
            written * 2 + 1
        );
    }
    format!("8-bit I2C address, the write address; in 7-bit form 0x{:02X}", written / 2)
}
