//! What peripherals can do in hardware, where pins and signals do not tell.
//!
//! An MCU comes in, the abilities of its family go out. All facts are data of `silicon/`; this
//! module only finds and serves them.

use std::sync::OnceLock;

use serde::Deserialize;

use crate::mcu;

/// The files of `silicon/`.
const FILES: &[&str] =
    &[include_str!("../../../silicon/atmega.toml"), include_str!("../../../silicon/rp2.toml")];

/// What is known of a family.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Silicon {
    /// Starts of part numbers.
    pub parts: Vec<String>,
    /// Its timers.
    pub timers: Timers,
}

/// What timers can do, where it differs from most.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timers {
    /// Counting and timing edges.
    pub capture: Option<Ability>,
    /// Decoding quadrature.
    pub encoder: Option<Ability>,
}

/// Which channels can do something.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ability {
    /// Those that can; none where the silicon cannot at all.
    pub channels: Vec<u8>,
    /// Why the others cannot, as a half sentence.
    pub because: String,
    /// Where it was read.
    pub source: String,
}

/// What is known of an MCU beyond what most can do.
#[must_use]
pub fn of(mcu: &str) -> Option<&'static Silicon> {
    let name = mcu::normalise(mcu);
    let covers = |silicon: &&Silicon| silicon.parts.iter().any(|part| name.starts_with(part));
    all().iter().find(covers)
}

/// All families; a damaged file, which tests rule out, is none.
fn all() -> &'static [Silicon] {
    static ALL: OnceLock<Vec<Silicon>> = OnceLock::new();
    ALL.get_or_init(|| FILES.iter().filter_map(|text| toml::from_str(text).ok()).collect())
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "a test of files reads files")]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn every_file_is_embedded_and_sound() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../silicon");
        let mut count = 0;
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            count += 1;
            let text = std::fs::read_to_string(&path).unwrap();
            let silicon: Silicon = toml::from_str(&text).unwrap();
            assert!(FILES.contains(&text.as_str()), "{} is not embedded", path.display());
            assert!(!silicon.parts.is_empty());
            for ability in [silicon.timers.capture, silicon.timers.encoder].iter().flatten() {
                assert!(!ability.because.is_empty() && !ability.source.is_empty());
            }
        }
        assert_eq!((count, all().len()), (FILES.len(), FILES.len()));
    }

    #[test]
    fn families_are_found_by_their_parts() {
        let encoder = |mcu| of(mcu)?.timers.encoder.as_ref();
        let capture = |mcu| Some(of(mcu)?.timers.capture.as_ref()?.channels.as_slice());
        assert!(encoder("rp2040").is_some_and(|ability| ability.channels.is_empty()));
        assert_eq!(capture("RP2350B"), Some(&[2][..]));
        assert_eq!(capture("ATmega328P-PU"), Some(&[][..]));
        assert_eq!(of("STM32F407VGT6"), None);
    }
}
