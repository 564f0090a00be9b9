//! Analog inputs: a channel of the converter for each, whose conversions may fail.

use sensedsl_board::pin::PinName;

use crate::context::{Context, Wired};

/// The type of an input, and what it is made of.
pub(crate) fn input(context: &Context<'_>, pin: &PinName) -> (String, String) {
    let pin = context.pin(pin);
    (
        "hal::adc::Channel<'static>".to_owned(),
        format!("hal::adc::Channel::new_pin(p.{pin}, Pull::None)"),
    )
}

/// All inputs one right after the other, as often as there are samples.
pub(crate) fn rows(wired: &Wired<'_>) -> String {
    let names: Vec<String> = (0..wired.wires.len()).map(|at| format!("s{at}")).collect();
    let mut text = format!(
        "        let mut is_whole = true;\n        for [{}] in samples.as_chunks_mut().0 {{\n",
        names.join(", ")
    );
    for (name, wire) in names.iter().zip(&wired.wires) {
        text.push_str(&format!(
            "            is_whole &= rt::converter::read(&mut adc, &mut {}, {name}).await;\n",
            wire.ident
        ));
    }
    text + "        }\n"
}

/// Tells a value, or that a conversion failed.
pub(crate) fn tell(constant: &str, tell: &str) -> String {
    format!(
        "        if is_whole {{\n            {tell}\n        }} else {{\n            \
         BOARD.report(None, tables::{constant}, Outcome::Invalid, &mut []);\n        }}\n"
    )
}
