//! The rows of the table: one for each part of the hardware, with its load.

use sensedsl_model::design::DeviceIndex;

use crate::units::{MILLISECOND_NS, SECOND_NS};

/// A kind of hardware part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// An analog-digital converter.
    Converter,
    /// A bus: I2C, SPI or CAN.
    Bus,
    /// A wire that both ends pull low, whose bits the processor makes.
    Wire,
    /// A serial port of a device.
    Port,
    /// A timer that outputs pulses.
    Output,
    /// The link to the host.
    Link,
    /// The interrupts of captures and edges.
    Interrupts,
    /// A thread on the processor.
    Thread,
    /// The processor as a whole.
    Processor,
}

impl Part {
    /// The word in the table and in JSON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Converter => "adc",
            Self::Bus => "bus",
            Self::Wire => "wire",
            Self::Port => "port",
            Self::Output => "pwm",
            Self::Link => "link",
            Self::Interrupts => "irq",
            Self::Thread => "thread",
            Self::Processor => "core",
        }
    }
}

/// What devices served by one thread have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cycle {
    /// The cycle time.
    pub delay_ms: u32,
    /// The priority relative to `NORMALPRIO`.
    pub prio: i8,
    /// The start of the first cycle, in milliseconds after the board's start.
    pub start_ms: u32,
}

impl Cycle {
    /// The name of a thread: `ADC1 60 ms +2`, with its start if that is not 0.
    #[must_use]
    pub fn title(self, unit: &str) -> String {
        let delay_ms = self.delay_ms;
        self.named(&format!("{unit} {delay_ms} ms"))
    }

    /// A name with what distinguishes it from others with the same cycle time.
    pub(crate) fn named(self, name: &str) -> String {
        let Self { prio, start_ms, .. } = self;
        let prio = if prio == 0 { String::new() } else { format!(" {prio:+}") };
        let start = if start_ms == 0 { String::new() } else { format!(" @{start_ms}") };
        format!("{name}{prio}{start}")
    }
}

/// A count of something per second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Conversions of a converter.
    Conversions(u64),
    /// Bytes on a bus or a link.
    Bytes(u64),
    /// Interrupts.
    Interrupts(u64),
    /// Instructions of the processor.
    Instructions(u64),
}

impl Count {
    /// The number.
    #[must_use]
    pub const fn number(self) -> u64 {
        match self {
            Self::Conversions(n) | Self::Bytes(n) | Self::Interrupts(n) | Self::Instructions(n) => {
                n
            }
        }
    }

    /// The unit of the count, in a few letters.
    #[must_use]
    pub const fn short_unit(self) -> &'static str {
        match self {
            Self::Conversions(_) => "conv",
            Self::Bytes(_) => "B",
            Self::Interrupts(_) => "irq",
            Self::Instructions(_) => "ins",
        }
    }

    /// The unit of the count.
    #[must_use]
    pub const fn unit(self) -> &'static str {
        match self {
            Self::Conversions(_) => "conversions",
            Self::Bytes(_) => "bytes",
            Self::Interrupts(_) => "interrupts",
            Self::Instructions(_) => "instructions",
        }
    }
}

/// A row of the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// The kind of part.
    pub part: Part,
    /// The name: `ADC1`, `I2C3`, `reporter`.
    pub name: String,
    /// The devices that it serves.
    pub devices: Vec<DeviceIndex>,
    /// How often it works, if it works in cycles.
    pub cycle: Option<Cycle>,
    /// The exact clock, if the part has one and it is known.
    pub clock_hz: Option<u32>,
    /// The longest duration of one cycle.
    pub cycle_ns: Option<u64>,
    /// The work per second.
    pub a_second: Option<Count>,
    /// The busy time per second, if known; may be more than a second.
    pub busy_ns: Option<u64>,
    /// The shortest possible cycle time, given the others.
    pub shortest_ms: Option<u32>,
    /// The longest time for which it keeps interrupts off, if it does.
    pub locked_ns: Option<u64>,
}

impl Row {
    /// Whether the part has a count per second, known or not.
    #[must_use]
    pub const fn has_count(&self) -> bool {
        !matches!(self.part, Part::Output | Part::Processor)
    }

    /// Whether the part has a busy time, known or not.
    #[must_use]
    pub const fn has_share(&self) -> bool {
        !matches!(self.part, Part::Output | Part::Interrupts)
    }

    /// A row with nothing known yet.
    pub(crate) fn new(part: Part, name: impl Into<String>, mut devices: Vec<DeviceIndex>) -> Self {
        // An array has several elements.
        devices.dedup();
        Self {
            part,
            name: name.into(),
            devices,
            cycle: None,
            clock_hz: None,
            cycle_ns: None,
            a_second: None,
            busy_ns: None,
            shortest_ms: None,
            locked_ns: None,
        }
    }
}

/// The duration of this many clocks, rounded up.
pub(crate) fn clocks_ns(clocks: u64, hz: u32) -> u64 {
    clocks.saturating_mul(SECOND_NS).div_ceil(u64::from(hz).max(1))
}

/// The amount per second of work that is done once in this many milliseconds.
pub(crate) fn per_second(once: u64, every_ms: u32) -> u64 {
    once.saturating_mul(1_000).div_ceil(u64::from(every_ms).max(1))
}

/// Sets the shortest cycle time that each class of a unit can keep, given the others. `own_ns` is
/// the time that its thread needs for a cycle from beginning to end.
pub(crate) fn shortest(rows: &mut [Row], own_ns: &[u64]) {
    let all_ns = rows.iter().filter_map(|row| row.busy_ns).fold(0_u64, u64::saturating_add);
    for (row, own_ns) in rows.iter_mut().zip(own_ns) {
        let (Some(cycle_ns), Some(busy_ns)) = (row.cycle_ns, row.busy_ns) else { continue };
        let free_ns = SECOND_NS.saturating_sub(all_ns.saturating_sub(busy_ns));
        if free_ns == 0 {
            continue;
        }
        let shared_ns = u128::from(cycle_ns) * u128::from(SECOND_NS) / u128::from(free_ns);
        let shared_ns = u64::try_from(shared_ns).unwrap_or(u64::MAX);
        let ms = shared_ns.max(*own_ns).div_ceil(MILLISECOND_NS).max(1);
        row.shortest_ms = u32::try_from(ms).ok();
    }
}
