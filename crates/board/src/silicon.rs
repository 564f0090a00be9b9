//! What peripherals can do in hardware and which pins the MCU needs for itself, where pins and
//! signals do not show it.
//!
//! An MCU goes in, the facts of its family come out. All facts are data in `silicon/`; this module
//! only finds and returns them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use serde::Deserialize;

use crate::mcu;
use crate::pin::PinName;
use crate::registry::FILES;

/// The facts of an MCU family.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Silicon {
    /// Part-number prefixes.
    pub parts: Vec<String>,
    /// What its timers can do.
    #[serde(default)]
    pub timers: Timers,
    /// Pins that the MCU needs for itself.
    #[serde(default)]
    pub pins: Vec<Needed>,
    /// Pins that are converter inputs and nothing else.
    #[serde(default)]
    pub analog: Vec<Pads>,
    /// Pins that cannot put anything out.
    #[serde(default)]
    pub inputs: Vec<Pads>,
    /// The voltages that its pins tolerate.
    #[serde(default)]
    pub volts: Vec<Volts>,
    /// Serial ports that lack something that most have.
    #[serde(default)]
    pub serials: Vec<Serials>,
    /// Names that files may use for a unit, each with the data sheet's name; `#` stands for a
    /// number.
    #[serde(default)]
    pub units: BTreeMap<String, String>,
}

/// Pins of some MCUs in a family that lack a circuit.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pads {
    /// Part-number prefixes.
    pub parts: Vec<String>,
    /// The pins.
    pub names: Vec<String>,
    /// The source.
    pub source: String,
}

/// What the serial ports of some MCUs in a family lack.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Serials {
    /// Part-number prefixes.
    pub parts: Vec<String>,
    /// The inversion of wires to low at rest, if they lack it; it has no channels.
    pub invert: Option<Ability>,
    /// Both directions on the wire of TX, if they lack it; it has no channels.
    pub half: Option<Ability>,
}

/// The voltages that the pins of some MCUs in a family tolerate.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Volts {
    /// Part-number prefixes.
    pub parts: Vec<String>,
    /// The usual supply, which is the full scale of the converters, in millivolts.
    pub supply_mv: u32,
    /// The voltage that an input tolerates at that supply, in millivolts; none if not known.
    pub stands_mv: Option<u32>,
    /// Pins that tolerate only the supply plus 0.3 V.
    #[serde(default)]
    pub except: Vec<String>,
    /// The pins that tolerate it, if this is not known for all others.
    pub only: Option<Vec<String>>,
    /// The source.
    pub source: String,
}

/// Pins that some MCUs in a family need for themselves.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Needed {
    /// What the pins are needed for.
    pub role: PinRole,
    /// Part-number prefixes.
    pub parts: Vec<String>,
    /// The pins.
    pub names: Vec<String>,
    /// The source.
    pub source: String,
}

/// What an MCU needs a pin for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PinRole {
    /// A debugger uses it.
    Debug,
    /// It resets the MCU, as delivered.
    Reset,
    /// It is read when the MCU starts, and selects what is started.
    Boot,
    /// A crystal is connected to it, if one is fitted.
    Oscillator,
    /// The memory with the program is connected to it.
    Memory,
}

impl PinRole {
    /// What needs the pin, for people.
    #[must_use]
    pub const fn describe(self) -> &'static str {
        match self {
            Self::Debug => "the debugger",
            Self::Reset => "the reset input",
            Self::Boot => "BOOT, which the MCU reads at reset",
            Self::Oscillator => "the oscillator",
            Self::Memory => "the flash memory or RAM in its package or module",
        }
    }
}

/// What timers can do, where that differs from most.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timers {
    /// The ability to count and time edges.
    pub capture: Option<Ability>,
    /// The ability to decode quadrature.
    pub encoder: Option<Ability>,
    /// Whether devices share its timers also where no system that could drive them is known: outputs of one
    /// have one frequency, and captures and encoders take one whole.
    #[serde(default)]
    pub are_shared: bool,
}

/// The channels that have an ability.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ability {
    /// The channels that have it; empty if the silicon does not have it at all.
    pub channels: Vec<u8>,
    /// Starts of the names of the units that have it; empty if all have it.
    #[serde(default)]
    pub units: Vec<String>,
    /// The reason why the others do not, as a clause.
    pub because: String,
    /// The source.
    pub source: String,
}

impl Ability {
    /// Whether a channel of a unit has it.
    #[must_use]
    pub fn is_of(&self, unit: &str, channel: u8) -> bool {
        let is_unit =
            self.units.is_empty() || self.units.iter().any(|start| unit.starts_with(start));
        is_unit && self.channels.contains(&channel)
    }
}

/// The facts of an MCU, beyond what most MCUs can do.
#[must_use]
pub fn of(mcu: &str) -> Option<&'static Silicon> {
    let name = mcu::normalise(mcu);
    all().iter().find(|silicon| covers(&silicon.parts, &name))
}

/// The pins that an MCU needs for itself, each with its role.
#[must_use]
pub fn pin_roles(mcu: &str) -> BTreeMap<PinName, PinRole> {
    let name = mcu::normalise(mcu);
    let needed = of(mcu).into_iter().flat_map(|silicon| &silicon.pins);
    let of_part = needed.filter(|needed| covers(&needed.parts, &name));
    let pins = |needed: &'static Needed| {
        let names = needed.names.iter().filter_map(|name| PinName::parse(name));
        names.map(|name| (name, needed.role))
    };
    of_part.flat_map(pins).collect()
}

/// The pins of an MCU that are converter inputs and nothing else.
#[must_use]
pub fn analog_only(mcu: &str) -> BTreeSet<PinName> {
    of(mcu).map(|silicon| pads(&silicon.analog, mcu)).unwrap_or_default()
}

/// The pins of an MCU that cannot put anything out.
#[must_use]
pub fn input_only(mcu: &str) -> BTreeSet<PinName> {
    of(mcu).map(|silicon| pads(&silicon.inputs, mcu)).unwrap_or_default()
}

fn pads(all: &[Pads], mcu: &str) -> BTreeSet<PinName> {
    let name = mcu::normalise(mcu);
    let of_part = all.iter().filter(|pads| covers(&pads.parts, &name));
    of_part.flat_map(|pads| &pads.names).filter_map(|name| PinName::parse(name)).collect()
}

/// Why the serial ports of an MCU cannot invert their wires; none if they can, or if it is not
/// known.
#[must_use]
pub fn inversion(mcu: &str) -> Option<&'static Ability> {
    lack(mcu, |serials| serials.invert.as_ref())
}

/// Why the serial ports of an MCU cannot have both directions on one wire; none if they can, or if
/// it is not known.
#[must_use]
pub fn one_wire(mcu: &str) -> Option<&'static Ability> {
    lack(mcu, |serials| serials.half.as_ref())
}

fn lack(mcu: &str, of: fn(&Serials) -> Option<&Ability>) -> Option<&'static Ability> {
    let name = mcu::normalise(mcu);
    let all = silicon_serials(mcu)?.iter().filter(|serials| covers(&serials.parts, &name));
    all.filter_map(of).next()
}

fn silicon_serials(mcu: &str) -> Option<&'static [Serials]> {
    Some(&of(mcu)?.serials)
}

/// The voltages that the pins of an MCU tolerate: the first entry that covers the part.
#[must_use]
pub fn volts(mcu: &str) -> Option<&'static Volts> {
    let name = mcu::normalise(mcu);
    of(mcu)?.volts.iter().find(|volts| covers(&volts.parts, &name))
}

impl Silicon {
    /// Whether two names mean the same unit: they are equal, or one is the family's and the other
    /// one that files may use.
    #[must_use]
    pub fn same_unit(&self, one: &str, other: &str) -> bool {
        one == other
            || self.units.iter().any(|(used, own)| {
                let means = |a: &str, b: &str| renamed(a, used, own).is_some_and(|name| name == b);
                means(one, other) || means(other, one)
            })
    }
}

/// The name that results from changing one pattern to another: `TIM4` with `TIM#` and `PWM#`
/// becomes `PWM4`.
fn renamed(name: &str, from: &str, to: &str) -> Option<String> {
    let Some(stem) = from.strip_suffix('#') else {
        return (name == from).then(|| to.to_owned());
    };
    let number = name.strip_prefix(stem)?;
    let is_number = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
    is_number.then(|| to.replace('#', number))
}

impl Volts {
    /// The voltage that a pin tolerates as an input, in millivolts; none if not known.
    #[must_use]
    pub fn stands_mv(&self, pin: &PinName) -> Option<u32> {
        let has =
            |names: &[String]| names.iter().any(|name| PinName::parse(name).as_ref() == Some(pin));
        if has(&self.except) {
            return Some(self.supply_mv + 300);
        }
        self.stands_mv.filter(|_| self.only.as_ref().is_none_or(|only| has(only)))
    }
}

/// Whether the name starts with one of the parts, or is one that ends with `$`.
fn covers(parts: &[String], name: &str) -> bool {
    parts.iter().any(|part| match part.strip_suffix('$') {
        Some(whole) => name == whole,
        None => name.starts_with(part),
    })
}

/// All families; a damaged file, which tests rule out, is skipped.
fn all() -> &'static [Silicon] {
    static ALL: OnceLock<Vec<Silicon>> = OnceLock::new();
    let read = |(_, text): (&str, &str)| toml::from_str(text).ok();
    ALL.get_or_init(|| FILES.folder("silicon").filter_map(read).collect())
}

#[cfg(test)]
#[expect(clippy::disallowed_methods, reason = "a test of files reads files")]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn every_file_is_embedded_and_sound() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("silicon");
        let mut count = 0;
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|extension| extension != "toml") {
                continue;
            }
            count += 1;
            let text = std::fs::read_to_string(&path).unwrap();
            let silicon: Silicon = toml::from_str(&text).unwrap();
            let is_embedded = FILES.folder("silicon").any(|(_, known)| known == text);
            assert!(is_embedded, "{} is not embedded", path.display());
            assert!(!silicon.parts.is_empty());
            for ability in [silicon.timers.capture, silicon.timers.encoder].iter().flatten() {
                assert!(!ability.because.is_empty() && !ability.source.is_empty());
            }
            for analog in silicon.analog.iter().chain(&silicon.inputs) {
                assert!(!analog.parts.is_empty() && !analog.source.is_empty(), "{analog:?}");
                assert!(analog.names.iter().all(|name| PinName::parse(name).is_some()));
            }
            for (used, own) in &silicon.units {
                assert_eq!(used.ends_with('#'), own.ends_with('#'), "{used}");
            }
            for volts in &silicon.volts {
                assert!(!volts.parts.is_empty() && !volts.source.is_empty(), "{volts:?}");
                let only = volts.only.iter().flatten();
                let mut named = volts.except.iter().chain(only);
                assert!(named.all(|name| PinName::parse(name).is_some()), "{volts:?}");
            }
            for needed in &silicon.pins {
                assert!(!needed.parts.is_empty() && !needed.source.is_empty(), "{needed:?}");
                assert!(needed.names.iter().all(|name| PinName::parse(name).is_some()));
                let inside = |part: &String| covers(&silicon.parts, part.trim_end_matches('$'));
                assert!(needed.parts.iter().all(inside), "{needed:?}");
            }
        }
        let embedded = FILES.folder("silicon").count();
        assert_eq!((count, all().len()), (embedded, embedded));
    }

    #[test]
    fn families_are_found_by_their_parts() {
        let encoder = |mcu| of(mcu)?.timers.encoder.as_ref();
        let capture = |mcu| Some(of(mcu)?.timers.capture.as_ref()?.channels.as_slice());
        assert!(encoder("rp2040").is_some_and(|ability| ability.channels.is_empty()));
        assert_eq!(capture("RP2350B"), Some(&[2][..]));
        assert_eq!(capture("ATmega328P-PU"), Some(&[1][..]));
        assert_eq!(encoder("STM32F407VGT6"), None);
        assert_eq!(of("MSP430G2553"), None);
    }

    #[test]
    fn units_have_the_names_of_the_data_sheet_and_those_of_files() {
        let same = |mcu, one, other| of(mcu).is_some_and(|silicon| silicon.same_unit(one, other));
        assert!(same("RP2040", "TIM4", "PWM4") && same("RP2350A", "PWM11", "TIM11"));
        assert!(same("RP2040", "I2C0", "I2C0"));
        assert!(!same("RP2040", "TIM4", "PWM5") && !same("RP2040", "TIM", "PWM"));
        assert!(same("ATMEGA328P-PU", "TIM1", "TC1") && same("ATMEGA2560", "TIMER5", "TC5"));
        assert!(same("ATMEGA328P-PU", "I2C0", "TWI") && same("ATMEGA328P-PU", "SPI0", "SPI"));
        assert!(same("ATMEGA328PB-AU", "I2C1", "TWI1"));
        assert!(!same("STM32F407VGT6", "TIM4", "PWM4"));
    }

    #[test]
    fn analog_pads_have_no_digital_circuit() {
        let pads =
            |mcu| analog_only(mcu).into_iter().map(|pin| pin.to_string()).collect::<Vec<_>>();
        assert_eq!(pads("ATMEGA328P-AU"), ["ADC6", "ADC7"]);
        assert_eq!(pads("ATMEGA2560-16AU"), [""; 0]);
    }

    #[test]
    fn pins_stand_what_their_parts_say() {
        let stands = |mcu, pin| volts(mcu)?.stands_mv(&PinName::parse(pin)?);
        assert_eq!(stands("STM32F407VGT6", "PB4"), Some(5_500));
        assert_eq!(stands("STM32F407VGT6", "PA4"), Some(3_600));
        assert_eq!(stands("STM32F103C8T6", "PB5"), Some(3_600));
        assert_eq!(stands("RP2040", "GP2"), Some(3_600));
        assert_eq!(stands("RP2350A", "GP2"), Some(5_500));
        assert_eq!(stands("ATMEGA328P-PU", "PB0"), Some(5_500));
        assert_eq!(stands("STM32G071RBT6", "PB4"), None);
        assert_eq!(volts("STM32G071RBT6").map(|volts| volts.supply_mv), Some(3_300));
        assert_eq!(volts("MSP430G2553"), None);
    }

    /// One pin of each sort in the data sheets' tables: FT, TT or TC, and unknown.
    #[test]
    fn pins_of_stm32_families_stand_what_the_data_sheets_say() {
        let stands = |mcu, pin| volts(mcu)?.stands_mv(&PinName::parse(pin)?);
        let sorts = [
            ("STM32F030R8T6", "PA8 PB10 PC6 PF0", "PA0 PB1 PC5 PC13", ""),
            ("STM32F072RBT6", "PA15 PB2", "PA7 PC0 PC15", ""),
            ("STM32F042K6T6", "", "", "PA8 PA0"),
            ("STM32F103ZET6", "PF5 PF11 PG0", "PF6 PF10 PB5 PD1", ""),
            ("STM32F207ZGT6", "PA6 PF0", "PA4 PA5", ""),
            ("STM32F303VCT6", "PA8 PB9 PD0 PE0", "PA4 PB10 PD8 PE7 PC13", "PF11"),
            ("STM32F429ZIT6", "PA0 PB5", "PA4 PA5", ""),
            ("STM32F446RET6", "PC0", "PA5", ""),
            ("STM32F412ZGT6", "", "", "PA0 PC6"),
            ("STM32F746ZGT6", "PA0 PI1", "PA4", ""),
            ("STM32F723ZET6", "", "", "PB14"),
            ("STM32G474RET6", "PC6 PB9 PA11", "PA0 PB10 PB15", "PA2 PA8 PB4 PD2"),
            ("STM32G431KBT6", "", "", "PB9"),
            ("STM32H743ZIT6", "PB6 PD0", "PA4 PA7 PC4 PE7", "PD12"),
            ("STM32H523RET6", "PC0 PB6", "PA4 PA5", "PB13 PE0"),
            ("STM32L476RGT6", "PA0 PC3 PB8", "PA3 PA4 PA5 PB0", ""),
            ("STM32L496ZGT6", "PG7", "PB0", ""),
            ("STM32L432KCT6", "", "", "PA0"),
            ("STM32U5A5ZJT6Q", "PA0 PC6", "PA3 PA11 PB0", "PB15"),
            ("STM32WB55RGV6", "", "", "PA0"),
        ];
        for (mcu, tolerant, not, unknown) in sorts {
            for (pins, expected) in [(tolerant, Some(5_500)), (not, Some(3_600)), (unknown, None)] {
                for pin in pins.split_whitespace() {
                    assert_eq!(stands(mcu, pin), expected, "{pin} of {mcu}");
                }
            }
        }
    }

    #[test]
    fn pins_are_needed_by_their_parts() {
        let pins = |mcu| {
            let roles = pin_roles(mcu).into_iter().filter(|(_, role)| *role != PinRole::Oscillator);
            roles.map(|(pin, role)| format!("{pin} {role:?}")).collect::<Vec<_>>().join(", ")
        };
        let crystals = |mcu| {
            let roles = pin_roles(mcu).into_iter().filter(|(_, role)| *role == PinRole::Oscillator);
            roles.map(|(pin, _)| pin.to_string()).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(pins("STM32F407VGT6"), "PA13 Debug, PA14 Debug, PB2 Boot");
        assert_eq!(pins("stm32g431kb"), "PA13 Debug, PA14 Debug, PB8 Boot, PG10 Reset");
        assert_eq!(pins("STM32L432KC"), "PA13 Debug, PA14 Debug, PH3 Boot");
        assert_eq!(pins("ATmega328P-PU"), "PC6 Reset");
        assert_eq!(pins("RP2040"), "");
        assert_eq!(crystals("STM32F407VGT6"), "PC14 PC15 PH0 PH1");
        assert_eq!(crystals("STM32F103C8T6"), "PC14 PC15 PD0 PD1");
        assert_eq!(crystals("STM32F103VET6"), "PC14 PC15");
        assert_eq!(crystals("ATMEGA328P-PU"), "PB6 PB7");
    }
}
