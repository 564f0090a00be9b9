//! The conversion group of one unit and cycle, and the contents of its registers.

use std::ops::RangeInclusive;

use sensedsl_board::profile::Cycles;
use sensedsl_board::signal::UnitName;
use sensedsl_timing::depth;

use sensedsl_firmware_c::DmaBuffer;
use sensedsl_job::Cycle;

/// One conversion group.
#[derive(Clone, Debug)]
pub(super) struct Group {
    pub(super) unit: UnitName,
    /// The driver object.
    pub(super) driver: String,
    pub(super) cycle: Cycle,
    /// The kind of DMA that fills its buffer.
    pub(super) buffer: DmaBuffer,
    /// The inputs in the order of conversion, which is by channel.
    pub(super) inputs: Vec<Input>,
    pub(super) timeout_ms: u64,
}

/// One column of a conversion group's samples.
#[derive(Clone, Debug)]
pub(super) struct Input {
    /// Device, pin and signal, for a comment.
    pub(super) place: String,
    /// The devices whose values are made of it, as indices.
    pub(super) fields: Vec<usize>,
    /// The element of an array that it is.
    pub(super) element: u16,
    /// The number of conversions that are averaged.
    pub(super) samples: u16,
    pub(super) channel: u8,
    /// The sampling time.
    pub(super) cycles: Cycles,
}

impl Group {
    /// The prefix of the names of its tables.
    pub(super) fn ident(&self) -> String {
        self.cycle.ident(self.unit.as_str())
    }

    /// The title, for a comment.
    pub(super) fn title(&self) -> String {
        self.cycle.title(self.unit.as_str())
    }

    /// The inputs for a comment, one per line.
    pub(super) fn places(&self) -> String {
        let places: Vec<&str> = self.inputs.iter().map(|one| one.place.as_str()).collect();
        places.join(",\n * ")
    }

    /// The number of rows of samples: the most that any input averages, made even.
    pub(super) fn depth(&self) -> u16 {
        depth(self.inputs.iter().map(|one| one.samples))
    }

    /// The sampling times of the inputs in a range of channels: `ADC_SMPR2_SMP_AN8(ADC_SAMPLE_84)`.
    pub(super) fn sampling(&self, rule: &str, channels: RangeInclusive<u8>) -> Vec<String> {
        let own = self.inputs.iter().filter(|one| channels.contains(&one.channel));
        let term = |one: &Input| {
            let cycles = macro_cycles(one.cycles);
            rule.replace("{channel}", &one.channel.to_string()).replace("{cycles}", &cycles)
        };
        own.map(term).collect()
    }

    /// The positions of the sequence, from 1, that a register contains: `ADC_SQR3_SQ1_N(ADC_CHANNEL_IN8)`.
    pub(super) fn sequence(&self, register: &str, places: RangeInclusive<usize>) -> Vec<String> {
        let own = self.inputs.iter().enumerate().map(|(column, one)| (column + 1, one));
        let own = own.filter(|(place, _)| places.contains(place));
        let term = |(place, one): (usize, &Input)| {
            format!("ADC_{register}_SQ{place}_N(ADC_CHANNEL_IN{})", one.channel)
        };
        own.map(term).collect()
    }

    /// The rule applied to each channel: `ADC_SELMASK_IN8`.
    pub(super) fn channels(&self, rule: &str) -> Vec<String> {
        let term = |one: &Input| rule.replace("{channel}", &one.channel.to_string());
        self.inputs.iter().map(term).collect()
    }

    /// The longest sampling time of its inputs.
    pub(super) fn longest(&self) -> Option<Cycles> {
        self.inputs.iter().map(|one| one.cycles).max()
    }

    /// The shortest sampling time of its inputs.
    pub(super) fn shortest(&self) -> Option<Cycles> {
        self.inputs.iter().map(|one| one.cycles).min()
    }
}

/// A sampling time as the driver's macros spell it: `55P5` for 55.5.
pub(super) fn macro_cycles(cycles: Cycles) -> String {
    cycles.to_string().replace('.', "P")
}

/// The value of a struct member: macros or-ed together, one per line; `0U` if there are none.
pub(super) fn member(terms: &[String]) -> String {
    sum(terms, " |\n             ")
}

/// The value of an element of an array member: macros or-ed together, one per line.
pub(super) fn element(terms: &[String]) -> String {
    sum(terms, " |\n            ")
}

fn sum(terms: &[String], between: &str) -> String {
    if terms.is_empty() { "0U".to_owned() } else { terms.join(between) }
}
