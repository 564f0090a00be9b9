//! The lines of the table: one part of the hardware each, with what it does.

use sensedsl_model::design::DeviceIndex;

use crate::{MILLISECOND_NS, SECOND_NS};

/// A kind of part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// An analog-digital converter.
    Converter,
    /// A bus: I2C, SPI or CAN.
    Bus,
    /// A serial port of a device.
    Port,
    /// A timer that puts out pulses.
    Output,
    /// The link to the host.
    Link,
    /// Interrupts of captures and edges.
    Interrupts,
    /// What a thread asks of the processor.
    Thread,
    /// The processor as a whole.
    Processor,
}

impl Part {
    /// The word of the table and of JSON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Converter => "adc",
            Self::Bus => "bus",
            Self::Port => "port",
            Self::Output => "pwm",
            Self::Link => "link",
            Self::Interrupts => "irq",
            Self::Thread => "thread",
            Self::Processor => "core",
        }
    }
}

/// What devices have in common that one thread serves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cycle {
    /// Cycle time.
    pub delay_ms: u32,
    /// Priority relative to `NORMALPRIO`.
    pub prio: i8,
    /// When the first cycle begins, after the start of the board.
    pub start_ms: u32,
}

impl Cycle {
    /// What a thread is called: `ADC1 60 ms +2`, with its start where that is not at once.
    #[must_use]
    pub fn title(self, unit: &str) -> String {
        let delay_ms = self.delay_ms;
        self.named(&format!("{unit} {delay_ms} ms"))
    }

    /// A name with what tells it from others of the same cycle time.
    pub(crate) fn named(self, name: &str) -> String {
        let Self { prio, start_ms, .. } = self;
        let prio = if prio == 0 { String::new() } else { format!(" {prio:+}") };
        let start = if start_ms == 0 { String::new() } else { format!(" @{start_ms}") };
        format!("{name}{prio}{start}")
    }
}

/// So many of something in a second.
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

    /// What is counted, in a few letters.
    #[must_use]
    pub const fn short_unit(self) -> &'static str {
        match self {
            Self::Conversions(_) => "conv",
            Self::Bytes(_) => "B",
            Self::Interrupts(_) => "irq",
            Self::Instructions(_) => "ins",
        }
    }

    /// What is counted.
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

/// One line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// What kind of part.
    pub part: Part,
    /// `ADC1`, `I2C3`, `reporter`.
    pub name: String,
    /// The devices it serves.
    pub devices: Vec<DeviceIndex>,
    /// How often, where it is done in cycles.
    pub cycle: Option<Cycle>,
    /// The exact clock, where the part has one and it is known.
    pub clock_hz: Option<u32>,
    /// How long one cycle takes at most.
    pub cycle_ns: Option<u64>,
    /// What is done in a second.
    pub a_second: Option<Count>,
    /// How much of a second the part is busy, where it is known; may be more than a second.
    pub busy_ns: Option<u64>,
    /// The shortest cycle time that can be kept beside the others.
    pub shortest_ms: Option<u32>,
}

impl Row {
    /// Whether something is done in a second, known or not.
    #[must_use]
    pub const fn has_count(&self) -> bool {
        !matches!(self.part, Part::Output | Part::Processor)
    }

    /// Whether the part can be busy, known or not.
    #[must_use]
    pub const fn has_share(&self) -> bool {
        !matches!(self.part, Part::Output | Part::Interrupts)
    }

    /// A line of which nothing is known yet.
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
        }
    }
}

/// Time of so many clocks, rounded up.
pub(crate) fn clocks_ns(clocks: u64, hz: u32) -> u64 {
    clocks.saturating_mul(SECOND_NS).div_ceil(u64::from(hz).max(1))
}

/// What is done once in so many milliseconds, in a second.
pub(crate) fn per_second(once: u64, every_ms: u32) -> u64 {
    once.saturating_mul(1_000).div_ceil(u64::from(every_ms).max(1))
}

/// Gives each class of one unit the shortest cycle time that it can keep beside the others. `own_ns` is what its
/// thread needs for a cycle from beginning to end.
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
