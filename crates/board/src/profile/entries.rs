//! The groups of a profile file and the units in them.
//!
//! A unit's own statement overrides the rule of its group.

use serde::Deserialize;

use super::rates::{Cycles, Dividers};
use super::types::{
    Adc, Adcs, Dac, DacOutput, Dacs, DmaRequest, Exception, I2cs, Pio, Stream, Timer, TimerUse,
    Unit, Usb, optional_pin, pins,
};
use crate::pin::PinName;

/// A named entry of a file. It applies to all lines that have a unit with that name, or only to
/// some.
pub(crate) trait Entry {
    fn name(&self) -> &str;
    fn lines(&self) -> &[String];
    /// The streams that can serve the entry's requests.
    fn streams(&self) -> Vec<&Streams>;
    /// The multiplexers that connect it to its streams.
    fn multiplexers(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for streams in self.streams() {
            if let Streams::Behind(name) = streams {
                names.push(name.as_str());
            }
        }
        names
    }
}

/// The streams that can serve a request.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[serde(untagged)]
pub(crate) enum Streams {
    /// All streams behind a multiplexer.
    Behind(String),
    /// These streams, best first.
    Each(Vec<Stream>),
}

/// `[timers]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimerGroup {
    pub(crate) units: Vec<TimerEntry>,
    /// The timers whose interrupts the system does not serve.
    #[serde(default)]
    pub(crate) without_interrupt: Vec<String>,
    pub(crate) source: String,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimerEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    bits: u8,
    clock: String,
    alternate: Option<u8>,
    #[serde(default)]
    icu: Vec<u8>,
    #[serde(default)]
    pwm: Vec<u8>,
    #[serde(default)]
    complementary: Vec<u8>,
    #[serde(default)]
    encoder: bool,
    #[serde(default)]
    gate: bool,
    slowest_hz: Option<u32>,
}

impl TimerEntry {
    pub(crate) fn timer(self, without_interrupt: &[String]) -> Timer {
        let usable = |channels: Vec<u8>, complementary| {
            (!channels.is_empty()).then_some(TimerUse { channels, complementary })
        };
        Timer {
            icu: usable(self.icu, Vec::new()),
            pwm: usable(self.pwm, self.complementary),
            interrupt: !without_interrupt.contains(&self.name),
            name: self.name,
            bits: self.bits,
            clock: self.clock,
            alternate: self.alternate,
            encoder: self.encoder,
            gate: self.gate,
            slowest_hz: self.slowest_hz,
        }
    }
}

/// `[pios]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PioGroup {
    machines: u8,
    clock: String,
    pins_end: u8,
    pub(crate) units: Vec<PioEntry>,
    pub(crate) source: String,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PioEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
}

impl PioGroup {
    /// A unit of the group.
    pub(crate) fn pio(&self, unit: &PioEntry) -> Pio {
        let Self { machines, clock, pins_end, .. } = self;
        let (name, clock) = (unit.name.clone(), clock.clone());
        Pio { name, machines: *machines, clock, pins_end: *pins_end }
    }
}

/// `[adcs]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AdcGroup {
    pub(crate) rules: AdcRules,
    pub(crate) facts: Adcs,
    pub(crate) units: Vec<AdcEntry>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AdcRules {
    /// The first and the last input that can be a pin.
    inputs: [u8; 2],
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AdcEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    inputs: Option<[u8; 2]>,
    dma: Option<Streams>,
}

impl AdcEntry {
    pub(crate) fn adc(self, rules: &AdcRules, served: &impl Fn(Streams) -> Vec<Stream>) -> Adc {
        let [first, last] = self.inputs.unwrap_or(rules.inputs);
        Adc {
            inputs: (first..=last).collect(),
            dma: request(self.name.clone(), self.dma, served).into_iter().collect(),
            name: self.name,
        }
    }
}

/// A request, if the unit has streams.
fn request(
    name: String,
    streams: Option<Streams>,
    served: &impl Fn(Streams) -> Vec<Stream>,
) -> Option<DmaRequest> {
    Some(DmaRequest { name, streams: served(streams?) })
}

/// `[i2cs]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct I2cGroup {
    #[serde(default)]
    pub(crate) rules: UnitRules,
    pub(crate) facts: I2cs,
    pub(crate) units: Vec<UnitEntry>,
}

/// `[spis]`, `[cans]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BusGroup {
    #[serde(default)]
    pub(crate) rules: UnitRules,
    pub(crate) dividers: Option<Dividers>,
    pub(crate) units: Vec<UnitEntry>,
    pub(crate) source: String,
}

/// `[serials]`
pub(crate) type SerialGroup = BusGroup;

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnitRules {
    /// The clock.
    clock: Option<String>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnitEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    clock: Option<String>,
    alternate: Option<u8>,
    #[serde(default)]
    exceptions: Vec<Exception>,
    rx: Option<Streams>,
    tx: Option<Streams>,
    dma: Option<Streams>,
}

impl UnitEntry {
    pub(crate) fn unit(self, rules: &UnitRules, served: &impl Fn(Streams) -> Vec<Stream>) -> Unit {
        let name = &self.name;
        let requests = [
            request(format!("{name}_RX"), self.rx, served),
            request(format!("{name}_TX"), self.tx, served),
            request(name.clone(), self.dma, served),
        ];
        Unit {
            clock: self.clock.or_else(|| rules.clock.clone()),
            alternate: self.alternate,
            exceptions: self.exceptions,
            dma: requests.into_iter().flatten().collect(),
            name: self.name,
        }
    }
}

/// `[dacs]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DacGroup {
    pub(crate) facts: Dacs,
    pub(crate) units: Vec<DacEntry>,
}

/// A converter, with the number of its outputs.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DacEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    outputs: u8,
}

impl DacEntry {
    pub(crate) fn dac(self) -> Dac {
        let outputs = (1..=self.outputs).map(|channel| DacOutput { channel });
        Dac { outputs: outputs.collect(), name: self.name }
    }
}

/// `[usbs]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UsbGroup {
    pub(crate) units: Vec<UsbEntry>,
    pub(crate) source: String,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UsbEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    alternate: Option<u8>,
    #[serde(deserialize_with = "pins")]
    pins: Vec<PinName>,
    #[serde(default, deserialize_with = "optional_pin")]
    vbus: Option<PinName>,
    #[serde(default)]
    excludes: Vec<String>,
    endpoints: u8,
}

impl UsbEntry {
    pub(crate) fn usb(self, source: &str) -> Usb {
        Usb {
            name: self.name,
            alternate: self.alternate,
            pins: self.pins,
            vbus: self.vbus,
            excludes: self.excludes,
            endpoints: self.endpoints,
            source: source.to_owned(),
        }
    }
}

/// A sampling time as it is written: `1.5` or `3`.
impl<'de> Deserialize<'de> for Cycles {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Whole(u32),
            Broken(f64),
        }
        let halves = match Written::deserialize(deserializer)? {
            Written::Whole(cycles) => Self::new(cycles),
            Written::Broken(cycles) => {
                let whole = (0..=2_000_u32).find(|whole| f64::from(*whole) + 0.5 == cycles);
                let whole = whole.ok_or_else(|| {
                    serde::de::Error::custom(format!("{cycles} is no sampling time"))
                })?;
                Self::and_a_half(whole)
            }
        };
        Ok(halves)
    }
}

macro_rules! entries {
    ($($entry:ty: [$($streams:ident),*];)*) => {
        $(impl Entry for $entry {
            fn name(&self) -> &str {
                &self.name
            }
            fn lines(&self) -> &[String] {
                &self.lines
            }
            fn streams(&self) -> Vec<&Streams> {
                Vec::new().into_iter()$(.chain(&self.$streams))*.collect()
            }
        })*
    };
}
entries! {
    TimerEntry: [];
    PioEntry: [];
    AdcEntry: [dma];
    UnitEntry: [rx, tx, dma];
    DacEntry: [];
    UsbEntry: [];
}
