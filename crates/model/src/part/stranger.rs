//! Properties that their owner does not have: a name, the owner and its kinds in; a report out that names the property
//! that was meant, or the kinds that have it.

use sensedsl_diagnostics::codes::{e0201_unknown_property, e0213_property_of_other_kind};
use sensedsl_diagnostics::{Diagnostic, Span, nearest};

use crate::kind::{KindName, Role};
use crate::part::coding::{CODING, FILTER, PROTOCOL};
use crate::part::properties::{COMMON_PROPERTIES, PRESENTATION};

/// Words that people write for properties, each with what is meant: the first of these that the owner has.
const OTHER_WORDS: &[(&str, &[&str])] = &[
    ("accel", &["acceleration"]),
    ("addr", &["address"]),
    ("alias", &["aliases"]),
    ("baud_rate", &["baud", "bitrate"]),
    ("baudrate", &["baud", "bitrate"]),
    ("bit_order", &["order"]),
    ("bit_rate", &["bitrate", "baud"]),
    ("bps", &["baud", "bitrate"]),
    ("byte_order", &["order"]),
    ("byteorder", &["order"]),
    ("can_id", &["frame"]),
    ("chip_id", &["identity"]),
    ("config", &["init"]),
    ("configuration", &["init"]),
    ("data_bits", &["frame"]),
    ("datasheet", &["sheet"]),
    ("default", &["initial"]),
    ("description", &["about"]),
    ("device_address", &["address"]),
    ("direction", &["dir"]),
    ("echo", &["pin"]),
    ("en", &["enable"]),
    ("endian", &["order"]),
    ("endianness", &["order"]),
    ("factor", &["scale"]),
    ("fail_safe", &["failsafe"]),
    ("footer", &["end"]),
    ("freq", &["frequency", "speed", "clock"]),
    ("frequency", &["speed", "clock"]),
    ("gain", &["scale"]),
    ("gpio", &["pin"]),
    ("i2c_address", &["address"]),
    ("interval", &["delay"]),
    ("inverted", &["invert", "active"]),
    ("kind", &["type"]),
    ("logic_level", &["level"]),
    ("lsb", &["scale"]),
    ("max_clock", &["clock_max", "speed_max", "clock", "speed"]),
    ("max_frequency", &["speed_max", "clock_max", "speed", "clock"]),
    ("max_speed", &["speed_max", "speed", "clock"]),
    ("multiplier", &["scale"]),
    ("name", &["label"]),
    ("notes", &["note"]),
    ("parity", &["frame"]),
    ("period", &["delay"]),
    ("pinout", &["connector"]),
    ("port", &["pin"]),
    ("preamble", &["start"]),
    ("priority", &["prio"]),
    ("pull_up", &["pull"]),
    ("pullup", &["pull"]),
    ("pwm_frequency", &["frequency"]),
    ("rate", &["delay"]),
    ("reg", &["register"]),
    ("setup", &["init"]),
    ("size", &["length"]),
    ("spi_mode", &["mode"]),
    ("stop_bits", &["frame"]),
    ("sync", &["start"]),
    ("terminator", &["end"]),
    ("trailer", &["end"]),
    ("trig", &["trigger"]),
    ("vcc", &["supply"]),
    ("vdd", &["supply"]),
    ("voltage", &["supply", "level"]),
    ("who_am_i", &["identity"]),
    ("whoami", &["identity"]),
];

/// Whether a property of a protocol or a coding means something for values of a kind.
pub(crate) fn is_for(name: &str, kind: KindName) -> bool {
    use KindName::{Analog, Can, I2c, OneWire, Pwm, Spi, Uart};
    let all: &[KindName] = match name {
        "init" => &[I2c, Spi, Uart, OneWire],
        "init_checksum" | "sentence" | "field" | "separator" | "decimals" => &[Uart],
        "identity" | "identity_mask" | "register_size" | "burst" | "calibration" | "crc" => {
            &[I2c, Spi]
        }
        "read_mask" | "exchange" => &[Spi],
        "compensate" | "parameters" | "output" => &[I2c, Spi, Analog],
        "bits" | "signed" | "elements" | "packed" | "byte" | "format" => {
            &[I2c, Spi, Uart, OneWire, Can]
        }
        "drive" => &[Pwm],
        _ => return true,
    };
    all.contains(&kind)
}

/// The known property that a name means: what people call so, or the nearest in letters.
pub(crate) fn meant<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let known: Vec<&str> = known.collect();
    called(name, &known).or_else(|| nearest(name, known))
}

/// The known property that people call so.
fn called<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let plain = name.to_lowercase();
    let (_, words) = OTHER_WORDS.iter().find(|(word, _)| *word == plain)?;
    words.iter().find_map(|word| known.iter().find(|one| *one == word)).copied()
}

/// A property that a device has not.
pub(crate) fn of_device(name: &str, at: Span, kind: KindName) -> Diagnostic {
    let common = COMMON_PROPERTIES.iter().chain(PRESENTATION).chain(FILTER).chain(CODING);
    let known: Vec<&str> = kind.spec().properties.iter().chain(common).copied().collect();
    report((name, at), &kind.with_article(), &[kind], &known)
}

/// A property that an owner with values of some kinds has not; `known`: those that it has.
pub(crate) fn report(
    (name, at): (&str, Span),
    owner: &str,
    kinds: &[KindName],
    known: &[&str],
) -> Diagnostic {
    let others: Vec<&str> = KindName::ALL
        .into_iter()
        .filter(|other| !kinds.contains(other) && has(*other, name))
        .map(KindName::name)
        .collect();
    let called = called(name, known);
    if called.is_some() || others.is_empty() {
        let meant = called.or_else(|| nearest(name, known.iter().copied()));
        return e0201_unknown_property::unknown_property(at, name, owner, meant);
    }
    // A user who fixes `pin` for a kind with several wires means one of these.
    let is_wire =
        |word: &&str| name == "pin" && Role::ALL.iter().any(|role| role.property() == *word);
    let own = kinds.iter().flat_map(|kind| kind.spec().properties).copied();
    let instead: Vec<&str> = own.filter(is_wire).collect();
    let report = e0213_property_of_other_kind::property_of_other_kind;
    report(at, name, owner, &others.join(", "), &instead)
}

/// Whether a property means something for values of a kind.
fn has(kind: KindName, name: &str) -> bool {
    let is_shared = PROTOCOL.contains(&name) || CODING.contains(&name);
    kind.spec().properties.contains(&name) || is_shared && is_for(name, kind)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::part::chip::{CHIP, OF_DEVICE};
    use crate::part::properties::ABOUT_PART;

    #[test]
    fn other_words_are_in_order_and_mean_properties() {
        let of_kinds = KindName::ALL.into_iter().flat_map(|kind| kind.spec().properties);
        let shared = [COMMON_PROPERTIES, PRESENTATION, FILTER, CODING, PROTOCOL, ABOUT_PART];
        let known: Vec<&str> = of_kinds
            .chain(shared.into_iter().flatten())
            .chain(CHIP)
            .chain(OF_DEVICE)
            .copied()
            .collect();
        assert!(OTHER_WORDS.is_sorted_by_key(|(word, _)| *word));
        for (word, all) in OTHER_WORDS {
            for meant in *all {
                let is_wire = Role::ALL.iter().any(|role| role.property() == *meant);
                let is_library = ["acceleration", "dir"].contains(meant);
                assert!(known.contains(meant) || is_wire || is_library, "{word}: {meant}");
            }
        }
    }

    #[test]
    fn what_others_call_it_is_understood() {
        let i2c = || ["address", "speed", "order", "speed_max"].into_iter();
        assert_eq!(meant("endian", i2c()), Some("order"));
        assert_eq!(meant("Endianness", i2c()), Some("order"));
        assert_eq!(meant("max_speed", i2c()), Some("speed_max"));
        assert_eq!(meant("frequency", i2c()), Some("speed"));
        assert_eq!(meant("adress", i2c()), Some("address"));
        assert_eq!(meant("baudrate", i2c()), None);
    }
}
