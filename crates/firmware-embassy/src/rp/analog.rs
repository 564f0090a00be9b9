//! Analog inputs: a channel of the converter for each, whose conversions may fail.

use sensedsl_board::pin::PinName;

use crate::analog::{each_sample, sample_names};
use crate::context::{Context, Wired};
use sensedsl_job::JobConnection;

/// The type of an input, and what it is made of.
pub(crate) fn input(context: &Context<'_>, pin: &PinName) -> (String, String) {
    let pin = context.pin(pin);
    (
        "hal::adc::Channel<'static>".to_owned(),
        format!("hal::adc::Channel::new_pin(p.{pin}, Pull::None)"),
    )
}

/// All inputs one right after the other, as often as there are samples.
pub(crate) fn rows(wired: &Wired<'_>) -> Vec<String> {
    let names = sample_names(wired);
    let read = |(name, wire): (&String, &&JobConnection<'_>)| {
        format!("is_whole &= rt::converter::read(&mut adc, &mut {}, {name}).await;", wire.ident)
    };
    let reads: Vec<String> = names.iter().zip(&wired.wires).map(read).collect();
    vec!["let mut is_whole = true;".to_owned(), each_sample(&names, &reads)]
}

/// Reports a value, or that a conversion failed.
pub(crate) fn tell(constant: &str, tell: &str) -> String {
    format!(
        "if is_whole {{ {tell} }} else {{ BOARD.report(None, tables::{constant}, Outcome::Invalid, &mut []); }}"
    )
}
