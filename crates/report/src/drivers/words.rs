//! Facts in words: numbers, units, wires, and text in lines of limited length.

use sensedsl_model::facts::{ConnectionFacts, PartFacts, ValueFacts};
use sensedsl_model::kind::digital::Pull;
use sensedsl_model::kind::onewire::OneWireProtocol;
use sensedsl_model::kind::uart::Parity;
use sensedsl_model::kind::{Interface, Kind};
use sensedsl_model::written::{shown_mv, shown_ohm};
use sensedsl_wire::Direction;

/// A field's name as a title: `radio_control` as `Radio control`.
pub(super) fn field(name: &str) -> String {
    let name = name.replace('_', " ");
    let mut letters = name.chars();
    let first = letters.next().map(|letter| letter.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}

/// The text in lines of at most `letters` characters, each after its indentation.
pub(super) fn wrapped(text: &str, letters: usize, first: &str, others: &str) -> String {
    let mut out = String::new();
    let mut line = first.to_owned();
    let mut is_empty = true;
    for word in text.split_whitespace() {
        if !is_empty && line.chars().count() + 1 + word.chars().count() > letters {
            out.push_str(line.trim_end());
            out.push('\n');
            others.clone_into(&mut line);
            is_empty = true;
        }
        if !is_empty {
            line.push(' ');
        }
        line.push_str(word);
        is_empty = false;
    }
    out.push_str(line.trim_end());
    out.push('\n');
    out
}

/// A number with at most `count` significant digits.
pub(super) fn digits(number: f64, count: usize) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    #[expect(clippy::cast_possible_truncation, reason = "the logarithm of an f64 is below 309")]
    let magnitude = number.abs().log10().floor() as i64;
    let behind = i64::try_from(count).unwrap_or(4) - 1 - magnitude;
    let text = format!("{number:.*}", usize::try_from(behind.max(0)).unwrap_or(0));
    if text.contains('.') {
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    text
}

/// A factor, as a fraction of one if that is shorter.
fn factor(scale: f64) -> String {
    const SHORT: usize = 7;
    let plain = format!("{scale}");
    if plain.len() <= SHORT {
        return plain;
    }
    let inverse = 1.0 / scale;
    let whole = inverse.round();
    let is_fraction = whole.abs() > 1.0 && (inverse - whole).abs() <= 1e-9 * whole.abs();
    if is_fraction { format!("1/{whole}") } else { digits(scale, 6) }
}

/// How a host computes the shown value from the one on the wire; empty if they are the same.
pub(super) fn scale(value: &ValueFacts) -> String {
    let mut words = Vec::new();
    if let Some(scale) = value.shown.scale {
        words.push(factor(scale));
    }
    if let Some(offset) = value.shown.offset.filter(|offset| *offset != 0.0) {
        let sign = if offset < 0.0 { "-" } else { "+" };
        words.push(format!("{sign} {}", digits(offset.abs(), 6)));
    }
    if !value.shown.curve.is_empty() {
        words.push("then a curve".to_owned());
    }
    words.join(" ").replace(" then", ", then")
}

/// The unit of a value.
pub(super) fn unit(value: &ValueFacts) -> &str {
    value.shown.quantity.as_deref().unwrap_or_default()
}

/// The range of the value.
pub(super) fn range(value: &ValueFacts) -> String {
    let Some((least, most)) = value.range() else { return String::new() };
    format!("{} to {}", digits(least, 4), digits(most, 4))
}

/// The raw values that mean that nothing was measured.
pub(super) fn invalid(value: &ValueFacts) -> String {
    let one = |(first, last): &(f64, f64)| {
        if first == last { format!("{first}") } else { format!("{first} to {last}") }
    };
    value.filter.invalid.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// The name of a value; `value` for the only value of a part if it has no name.
pub(super) fn name(value: &ValueFacts) -> &str {
    value.name.as_deref().unwrap_or("value")
}

/// The part's kinds.
pub(super) fn kinds(part: &PartFacts) -> String {
    part.kinds.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(" ")
}

/// The names of its values.
pub(super) fn values(part: &PartFacts) -> String {
    match part.values.as_slice() {
        [only] if only.name.is_none() => match only.direction {
            Direction::Sensor => format!("a sensor{}", in_unit(unit(only))),
            Direction::Actuator => "an actuator".to_owned(),
        },
        values => values.iter().map(name).collect::<Vec<_>>().join(", "),
    }
}

fn in_unit(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(", in {unit}") }
}

/// A supply voltage, or its range.
pub(super) fn supply(part: &PartFacts) -> Option<String> {
    let (least, most) = part.supply_mv?;
    let least_shown = shown_mv(least);
    Some(if least == most { least_shown } else { format!("{least_shown} to {}", shown_mv(most)) })
}

/// The voltages of its wires: one for all, or those that differ by connection.
pub(super) fn levels(part: &PartFacts) -> Option<String> {
    let level = |one: &ConnectionFacts| {
        let level = one.level?;
        let divider = level.divider.map_or(String::new(), |[upper, lower]| {
            let left = shown_mv(level.at_pin_mv());
            let (upper, lower) = (shown_ohm(upper), shown_ohm(lower));
            format!(", {left} behind {upper} to the pin and {lower} to ground")
        });
        Some(format!("{}{divider}", shown_mv(level.mv)))
    };
    let mut all: Vec<String> = part.connections.iter().filter_map(level).collect();
    all.dedup();
    if all.is_empty() { None } else { Some(all.join("; ")) }
}

/// The addresses; the default address first.
pub(super) fn addresses(part: &PartFacts) -> Option<String> {
    let shown = |one: &u8| format!("0x{one:02X}");
    let list = part.addresses.iter().filter(|one| part.address != Some(**one));
    let others = runs(&list.copied().collect::<Vec<_>>());
    match (part.address, others.is_empty()) {
        (None, true) => None,
        (None, false) if part.addresses.len() == 1 => {
            Some(format!("{others}; a design has to say it"))
        }
        (None, false) => Some(format!("{others}; a design has to say which")),
        (Some(own), true) => Some(shown(&own)),
        (Some(own), false) => {
            Some(format!("{} unless a design says another: {others}", shown(&own)))
        }
    }
}

/// Addresses; of four or more in a row, only the first and the last.
fn runs(addresses: &[u8]) -> String {
    let follows = |one: &u8, next: &u8| one.checked_add(1) == Some(*next);
    let runs = addresses.chunk_by(follows).map(|run| match run {
        [first, _, _, .., last] => format!("0x{first:02X} to 0x{last:02X}"),
        few => few.iter().map(|one| format!("0x{one:02X}")).collect::<Vec<_>>().join(", "),
    });
    runs.collect::<Vec<_>>().join(", ")
}

/// The means by which the part can be told from others.
pub(super) fn identity(part: &PartFacts) -> Option<String> {
    let identity = part.protocol.as_ref()?.identity.as_ref()?;
    let bytes = |bytes: &[u8]| {
        bytes.iter().map(|byte| format!("0x{byte:02X}")).collect::<Vec<_>>().join(" ")
    };
    let mask = if identity.mask.is_empty() {
        String::new()
    } else {
        format!(" (of the bits {})", bytes(&identity.mask))
    };
    let register = identity.register;
    Some(format!("{}{mask} in register 0x{register:02X}", bytes(&identity.expected)))
}

/// A frequency as people write it.
fn hertz(hz: u32) -> String {
    match hz {
        hz if hz >= 1_000_000 && hz % 100_000 == 0 => {
            format!("{} MHz", f64::from(hz) / 1_000_000.0)
        }
        hz if hz >= 1_000 && hz % 100 == 0 => format!("{} kHz", f64::from(hz) / 1_000.0),
        hz => format!("{hz} Hz"),
    }
}

/// The settings that the board makes for a connection.
pub(super) fn settings(kind: &Kind) -> String {
    let words: Vec<String> = match kind.interface() {
        Interface::I2c(i2c) => vec![hertz(i2c.speed_hz)],
        // The clock is the one that its pulses need.
        Interface::Spi(spi) if spi.encoding.windows().is_some() => {
            vec![format!("pulses of {}", spi.encoding.name())]
        }
        Interface::Spi(spi) => vec![hertz(spi.clock_hz), format!("mode {}", spi.mode)],
        Interface::OneWire(own) => match own.protocol {
            OneWireProtocol::W1 => vec!["1-Wire".to_owned()],
            OneWireProtocol::Dht => vec![format!("asked by a low pulse of {} us", own.pulse_us)],
        },
        Interface::Uart(uart) => {
            let parity = match uart.parity {
                Parity::None => 'N',
                Parity::Even => 'E',
                Parity::Odd => 'O',
            };
            let frame = format!("{}{parity}{}", uart.data_bits, uart.stop_bits);
            vec![format!("{} bit/s", uart.baud), frame]
        }
        Interface::Pwm(pwm) => {
            let pulses = match (pwm.min_us, pwm.max_us) {
                (None, None) => None,
                (min, Some(max)) => Some(format!("pulses of {} to {max} us", min.unwrap_or(0))),
                (Some(min), None) => Some(format!("pulses from {min} us")),
            };
            std::iter::once(hertz(pwm.frequency_hz)).chain(pulses).collect()
        }
        Interface::Icu(icu) => {
            let pulse = icu.pulse_us.map(|us| format!("asked by a pulse of {us} us"));
            std::iter::once(format!("mode {}", icu.mode.name())).chain(pulse).collect()
        }
        Interface::Encoder(encoder) => {
            encoder.counts.map(|counts| format!("{counts} counts a turn")).into_iter().collect()
        }
        Interface::Digital(digital) => {
            let pull = match digital.pull {
                Pull::None => None,
                Pull::Up => Some("resistor of the MCU to the supply"),
                Pull::Down => Some("resistor of the MCU to ground"),
            };
            let active = if digital.active_low { "on when low" } else { "on when high" };
            pull.into_iter().chain([active]).map(str::to_owned).collect()
        }
        Interface::Stepper(motor) => vec![
            format!("up to {} steps/s", motor.speed),
            format!("{} steps/s^2", motor.acceleration),
            format!("pulses {} us", motor.pulse_us),
        ],
        Interface::Code(own) => vec![format!("{} at the start", own.default)],
        Interface::Analog(_) | Interface::Dac(_) | Interface::Can(_) => Vec::new(),
    };
    words.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let shown = [1.999_94, -250.0, 0.000_061_035, 65_535.0, 0.0, 35.996].map(|n| digits(n, 4));
        assert_eq!(shown, ["2", "-250", "0.00006104", "65535", "0", "36"]);
        assert_eq!(
            [1.0 / 16_384.0, 0.01, 1.0 / 3.0, 0.087_890_625].map(factor),
            ["1/16384", "0.01", "1/3", "0.0878906"]
        );
    }

    #[test]
    fn runs_of_addresses_are_short() {
        assert_eq!(runs(&[0x1D, 0x53]), "0x1D, 0x53");
        assert_eq!(runs(&[0x41, 0x42, 0x43, 0x44, 0x70]), "0x41 to 0x44, 0x70");
    }

    #[test]
    fn long_text_is_wrapped() {
        let text = wrapped("one two three four", 11, "- ", "  ");
        assert_eq!(text, "- one two\n  three\n  four\n");
        assert_eq!(wrapped("", 11, "  ", ""), "\n");
    }
}
