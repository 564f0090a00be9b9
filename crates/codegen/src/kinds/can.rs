//! CAN buses: the values that come in, and the frames that go out.

use std::collections::BTreeMap;

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0501_no_generator, e0506_hardware_limit};
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use crate::job::{BoardJob, Cycle, JobConnection, JobDevice};
use crate::part::ValuePlan;

/// The greatest identifier of eleven bits; a greater one has 29.
pub const STANDARD_MAX: u32 = 0x7FF;

/// Banks of filters that each bus of a bxCAN controller has, for two identifiers each.
pub const BANKS: usize = 14;

/// Filters of an FDCAN controller for identifiers of eleven bits and of 29, for two identifiers each.
const STANDARD_FILTERS: usize = 28;
const EXTENDED_FILTERS: usize = 8;

/// Bytes of a frame.
const FRAME_BYTES: u16 = 8;

/// A bus with what goes over it.
#[derive(Clone, Debug)]
pub struct Bus<'a> {
    /// What the profile calls the unit.
    pub unit: &'a str,
    /// Bits per second.
    pub bitrate_hz: u32,
    /// That of its fastest device, with the highest priority of any.
    pub cycle: Cycle,
    /// One of its wires: all have the pads of the bus.
    pub first: &'a JobConnection<'a>,
    /// All of them, the first among them.
    pub wires: Vec<&'a JobConnection<'a>>,
    /// What comes in.
    pub values: Vec<Value<'a>>,
    /// What goes out.
    pub frames: Vec<Frame<'a>>,
}

/// A value in a frame.
#[derive(Clone, Debug)]
pub struct Value<'a> {
    /// The index of its device in the job.
    pub index: usize,
    /// The device.
    pub device: &'a JobDevice<'a>,
    /// That of the frame.
    pub identifier: u32,
    /// Where it begins in the frame.
    pub byte: u8,
    /// How it is coded.
    pub how: ValuePlan,
    /// One behind its last byte.
    end: u16,
}

/// A frame that is sent.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// Its identifier.
    pub identifier: u32,
    /// Its length.
    pub bytes: u16,
    /// What is in it.
    pub values: Vec<Value<'a>>,
}

/// The buses of connections, in the natural order; a value that fits no frame is told.
pub fn buses<'a>(
    job: &'a BoardJob<'a>,
    connections: impl Iterator<Item = &'a JobConnection<'a>>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Bus<'a>> {
    let mut buses: BTreeMap<UnitName, Bus<'a>> = BTreeMap::new();
    for wire in connections {
        let (Some(unit), Some(can)) = (wire.unit, wire.connection.kind.can()) else { continue };
        // Tables may call the only one `CAN`.
        let facts = job.profile.and_then(|profile| profile.unit(unit));
        let bus = buses.entry(UnitName::new(unit)).or_insert_with(|| Bus {
            unit: facts.map_or(unit, |facts| &facts.name),
            bitrate_hz: can.bitrate_hz,
            cycle: wire.cycle,
            first: wire,
            wires: Vec::new(),
            values: Vec::new(),
            frames: Vec::new(),
        });
        bus.cycle.delay_ms = bus.cycle.delay_ms.min(wire.cycle.delay_ms);
        bus.cycle.prio = bus.cycle.prio.max(wire.cycle.prio);
        bus.wires.push(wire);
        for index in &wire.devices {
            let Some(device) = job.devices.get(*index) else { continue };
            if let Some(value) = Value::new(*index, device, diagnostics) {
                bus.add(value);
            }
        }
    }
    buses.into_values().collect()
}

impl<'a> Bus<'a> {
    fn add(&mut self, value: Value<'a>) {
        if value.device.device.direction == Direction::Sensor {
            self.values.push(value);
        } else if let Some(frame) =
            self.frames.iter_mut().find(|frame| frame.identifier == value.identifier)
        {
            frame.bytes = frame.bytes.max(value.end);
            frame.values.push(value);
        } else {
            let (identifier, bytes) = (value.identifier, value.end);
            self.frames.push(Frame { identifier, bytes, values: vec![value] });
        }
    }

    /// The identifiers that filters of a bxCAN controller let through; none where they are more than the filters hold.
    #[must_use]
    pub fn wanted(&self) -> Option<Vec<u32>> {
        let wanted = self.identifiers();
        (wanted.len() <= 2 * BANKS).then_some(wanted)
    }

    /// The identifiers that filters of an FDCAN controller let through; none where they are more than the filters hold.
    #[must_use]
    pub fn wanted_in_memory(&self) -> Option<Vec<u32>> {
        let wanted = self.identifiers();
        let extended = wanted.iter().filter(|one| **one > STANDARD_MAX).count();
        let standard = wanted.len() - extended;
        (standard <= 2 * STANDARD_FILTERS && extended <= 2 * EXTENDED_FILTERS).then_some(wanted)
    }

    /// The identifiers of what comes in, each once.
    fn identifiers(&self) -> Vec<u32> {
        let mut wanted: Vec<u32> = self.values.iter().map(|one| one.identifier).collect();
        wanted.sort_unstable();
        wanted.dedup();
        wanted
    }
}

impl<'a> Value<'a> {
    /// The value of a device; one that cannot be sent is told.
    fn new(
        index: usize,
        device: &'a JobDevice<'a>,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let name = &device.device.name;
        let coded = device.device.kind.can().zip(Words::of(device.device));
        let Some((can, words)) = coded else {
            let what = "values without a coding";
            let report = e0501_no_generator::not_made_yet(name.span, &name.value, what);
            diagnostics.push(report);
            return None;
        };
        let end = u16::from(can.byte).saturating_add(words.wire_bytes());
        if end > FRAME_BYTES {
            let message =
                format!("{} ends {end} bytes into its frame, which has {FRAME_BYTES}", name.value);
            let help = "let it begin earlier (`byte`), or take a smaller type";
            diagnostics.push(e0506_hardware_limit::hardware_limit(name.span, &message, help));
            return None;
        }
        let (identifier, byte) = (can.frame_id, can.byte);
        Some(Self { index, device, identifier, byte, how: ValuePlan::new(&words), end })
    }

    /// Whether the identifier has 29 bits.
    #[must_use]
    pub fn is_extended(&self) -> bool {
        self.identifier > STANDARD_MAX
    }
}

impl Frame<'_> {
    /// Whether the identifier has 29 bits.
    #[must_use]
    pub fn is_extended(&self) -> bool {
        self.identifier > STANDARD_MAX
    }
}
