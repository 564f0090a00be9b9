//! The groups of a profile file and the units in them.
//!
//! A rule is a text in which `{name}` stands for the unit's name, `{n}` for the number in it and
//! `{channel}` for the number of an output. What a unit states itself comes before the rule.

use serde::Deserialize;

use super::rates::{Cycles, Dividers};
use super::types::{
    Adc, Adcs, Dac, DacOutput, Dacs, DmaRequest, Exception, I2cs, Stream, StreamId, Timer,
    TimerDriver, Unit, Usb, Vbus, pin, pins,
};
use crate::pin::PinName;

/// An entry of a file: it has a name, and is for all lines with a unit of that name or for some.
pub(crate) trait Entry {
    fn name(&self) -> &str;
    fn lines(&self) -> &[String];
    /// The streams that can serve its requests.
    fn streams(&self) -> Vec<&Streams>;
    /// The multiplexers through which it has its streams.
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
    /// All of a multiplexer.
    Behind(String),
    /// These, best first.
    Each(Vec<Stream>),
}

/// Streams, and how the system's source names one.
pub(crate) type Served = (Vec<Stream>, StreamId);

fn apply(rule: &str, name: &str) -> String {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let number = name.strip_prefix(stem).unwrap_or_default();
    rule.replace("{name}", name).replace("{n}", number)
}

/// How drivers and their switches are named.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DriverRule {
    driver: String,
    switch: String,
}

impl DriverRule {
    fn timer(&self, name: &str, channels: Vec<u8>, complementary: Vec<u8>) -> Option<TimerDriver> {
        (!channels.is_empty()).then(|| TimerDriver {
            driver: apply(&self.driver, name),
            switch: apply(&self.switch, name),
            channels,
            complementary,
        })
    }
}

/// `[timers]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimerGroup {
    pub(crate) rules: TimerRules,
    pub(crate) units: Vec<TimerEntry>,
    pub(crate) source: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TimerRules {
    icu: DriverRule,
    pwm: DriverRule,
}

#[derive(Debug, Deserialize)]
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
}

impl TimerEntry {
    pub(crate) fn timer(self, rules: &TimerRules) -> Timer {
        Timer {
            icu: rules.icu.timer(&self.name, self.icu, Vec::new()),
            pwm: rules.pwm.timer(&self.name, self.pwm, self.complementary),
            name: self.name,
            bits: self.bits,
            clock: self.clock,
            alternate: self.alternate,
            encoder: self.encoder,
        }
    }
}

/// `[adcs]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AdcGroup {
    pub(crate) rules: AdcRules,
    pub(crate) facts: Adcs,
    pub(crate) units: Vec<AdcEntry>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AdcRules {
    driver: String,
    switch: String,
    /// The option that names the stream; none where the driver decides.
    dma: Option<String>,
    /// First and last input that can be a pin.
    inputs: [u8; 2],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AdcEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    driver: Option<String>,
    switch: Option<String>,
    option: Option<String>,
    inputs: Option<[u8; 2]>,
    dma: Option<Streams>,
}

impl AdcEntry {
    pub(crate) fn adc(self, rules: &AdcRules, served: &impl Fn(Streams) -> Served) -> Adc {
        let [first, last] = self.inputs.unwrap_or(rules.inputs);
        let option = self.option.or_else(|| rules.dma.clone());
        Adc {
            driver: apply(&self.driver.unwrap_or_else(|| rules.driver.clone()), &self.name),
            switch: apply(&self.switch.unwrap_or_else(|| rules.switch.clone()), &self.name),
            inputs: (first..=last).collect(),
            dma: request(self.name.clone(), &self.name, option.as_deref(), self.dma, served)
                .into_iter()
                .collect(),
            name: self.name,
        }
    }
}

/// A request, where a unit has streams. Without an option the driver always takes the first.
fn request(
    request: String,
    unit: &str,
    option: Option<&str>,
    streams: Option<Streams>,
    served: &impl Fn(Streams) -> Served,
) -> Option<DmaRequest> {
    let (streams, id) = served(streams?);
    let option = option.map(|option| apply(option, unit));
    Some(DmaRequest { name: request, option, streams, id })
}

/// `[i2cs]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct I2cGroup {
    pub(crate) rules: UnitRules,
    pub(crate) facts: I2cs,
    pub(crate) units: Vec<UnitEntry>,
}

/// `[spis]`, `[cans]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BusGroup {
    pub(crate) rules: UnitRules,
    pub(crate) dividers: Option<Dividers>,
    pub(crate) units: Vec<UnitEntry>,
    pub(crate) source: String,
}

/// `[serials]`
pub(crate) type SerialGroup = BusGroup;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnitRules {
    driver: String,
    switch: String,
    /// The macro of the clock.
    clock: Option<String>,
    /// Options that name streams; none where the driver always takes the first.
    rx: Option<String>,
    tx: Option<String>,
    /// The option of a unit that has one stream for both.
    dma: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnitEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    driver: Option<String>,
    switch: Option<String>,
    clock: Option<String>,
    alternate: Option<u8>,
    #[serde(default)]
    exceptions: Vec<Exception>,
    rx: Option<Streams>,
    tx: Option<Streams>,
    dma: Option<Streams>,
    rx_option: Option<String>,
    tx_option: Option<String>,
    #[serde(default)]
    needs: Vec<String>,
}

impl UnitEntry {
    pub(crate) fn unit(self, rules: &UnitRules, served: &impl Fn(Streams) -> Served) -> Unit {
        let name = &self.name;
        let rule = |own: Option<String>, rule: &str| apply(&own.unwrap_or(rule.to_owned()), name);
        let rx_option = self.rx_option.as_deref().or(rules.rx.as_deref());
        let tx_option = self.tx_option.as_deref().or(rules.tx.as_deref());
        let requests = [
            request(format!("{name}_RX"), name, rx_option, self.rx, served),
            request(format!("{name}_TX"), name, tx_option, self.tx, served),
            request(name.clone(), name, rules.dma.as_deref(), self.dma, served),
        ];
        Unit {
            driver: rule(self.driver, &rules.driver),
            switch: rule(self.switch, &rules.switch),
            clock: self.clock.or_else(|| rules.clock.clone()).map(|clock| apply(&clock, name)),
            alternate: self.alternate,
            exceptions: self.exceptions,
            dma: requests.into_iter().flatten().collect(),
            needs: self.needs,
            name: self.name,
        }
    }
}

/// `[dacs]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DacGroup {
    pub(crate) rules: DacRules,
    pub(crate) facts: Dacs,
    pub(crate) units: Vec<DacEntry>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DacRules {
    switch: String,
}

/// A converter with the driver objects of its outputs, from the first on.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DacEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    drivers: Vec<String>,
}

impl DacEntry {
    pub(crate) fn dac(self, rules: &DacRules) -> Dac {
        let outputs = self.drivers.into_iter().zip(1_u8..).map(|(driver, channel)| DacOutput {
            channel,
            driver,
            switch: apply(&rules.switch, &self.name).replace("{channel}", &channel.to_string()),
        });
        Dac { outputs: outputs.collect(), name: self.name }
    }
}

/// `[usbs]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UsbGroup {
    pub(crate) units: Vec<UsbEntry>,
    pub(crate) source: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UsbEntry {
    name: String,
    #[serde(default)]
    lines: Vec<String>,
    version: String,
    driver: String,
    switch: String,
    alternate: Option<u8>,
    #[serde(deserialize_with = "pins")]
    pins: Vec<PinName>,
    #[serde(default)]
    needs: Vec<String>,
    vbus: Option<VbusEntry>,
    #[serde(default)]
    excludes: Vec<String>,
    endpoints: u8,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct VbusEntry {
    #[serde(deserialize_with = "pin")]
    pin: PinName,
    without: String,
}

impl UsbEntry {
    pub(crate) fn usb(self, source: &str) -> Usb {
        Usb {
            name: self.name,
            version: self.version,
            driver: self.driver,
            switch: self.switch,
            alternate: self.alternate,
            pins: self.pins,
            needs: self.needs,
            vbus: self.vbus.map(|vbus| Vbus { pin: vbus.pin, without: vbus.without }),
            excludes: self.excludes,
            endpoints: self.endpoints,
            source: source.to_owned(),
        }
    }
}

/// What a sampling time is written as: `1.5` or `3`.
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
    AdcEntry: [dma];
    UnitEntry: [rx, tx, dma];
    DacEntry: [];
    UsbEntry: [];
}
