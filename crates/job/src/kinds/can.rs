//! CAN buses: the values that are received and the frames that are sent.

use std::collections::BTreeMap;

use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::{e0501_no_generator, e0506_hardware_limit};
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use crate::part::ValuePlan;
use crate::{BoardJob, Cycle, JobConnection, JobDevice};

/// Filter banks per bus of a bxCAN controller, each for two identifiers.
pub const BANKS: usize = 14;

/// Filters of an FDCAN controller for 11-bit and for 29-bit identifiers, each for two identifiers.
const STANDARD_FILTERS: usize = 28;
const EXTENDED_FILTERS: usize = 8;

/// Bytes of a frame.
const FRAME_BYTES: u16 = 8;

pub use sensedsl_model::kind::can::STANDARD_MAX;

/// An identifier, and whether it has 29 bits.
pub type Identifier = (u32, bool);

/// A bus with its values and frames.
#[derive(Clone, Debug)]
pub struct Bus<'a> {
    /// The profile's name of the unit.
    pub unit: &'a str,
    /// Bits per second.
    pub bitrate_hz: u32,
    /// The cycle of its fastest device, with the highest priority of all its devices.
    pub cycle: Cycle,
    /// One of its connections: all of them have the pads of the bus.
    pub first: &'a JobConnection<'a>,
    /// All its connections, including the first.
    pub wires: Vec<&'a JobConnection<'a>>,
    /// The values that are received.
    pub values: Vec<Value<'a>>,
    /// The frames that are sent.
    pub frames: Vec<Frame<'a>>,
}

/// A value in a frame. The bits of a frame are numbered as in an integer whose lowest byte is byte 0 of the frame.
#[derive(Clone, Debug)]
pub struct Value<'a> {
    /// The index of its device in the job.
    pub index: usize,
    /// The device.
    pub device: &'a JobDevice<'a>,
    /// The identifier of the frame.
    pub identifier: u32,
    /// True if the identifier has 29 bits.
    pub is_extended: bool,
    /// The byte of the frame at which the value begins.
    pub byte: u8,
    /// The coding of the value.
    pub how: ValuePlan,
    /// The value's bits in the frame.
    bits: u64,
    /// The same bits; 0 if the value has its bytes to itself.
    pub mask: u64,
    /// Mask and value of the bits that select the value: it is in the frame only if they match.
    pub select: Option<(u64, u64)>,
    /// True if setting the value does not send the frame: another frame that contains it is sent.
    pub is_quiet: bool,
    /// The time after which its frame is repeated; 0: never.
    resend_ms: u32,
    /// The offset after the value's last byte, or the frame's length if that is known and larger.
    end: u16,
}

/// A frame that is sent.
#[derive(Clone, Debug)]
pub struct Frame<'a> {
    /// The identifier.
    pub identifier: u32,
    /// True if the identifier has 29 bits.
    pub is_extended: bool,
    /// The length.
    pub bytes: u16,
    /// The time after which a command's frame is repeated; 0: never.
    pub resend_ms: u32,
    /// The content before any value is set: the bits that select the frame.
    pub start: u64,
    /// The values in the frame.
    pub values: Vec<Value<'a>>,
}

/// The buses of the connections, in natural order; a value that does not fit its frame is reported.
pub fn buses<'a>(
    job: &'a BoardJob<'a>,
    connections: impl Iterator<Item = &'a JobConnection<'a>>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Bus<'a>> {
    let mut buses: BTreeMap<UnitName, Bus<'a>> = BTreeMap::new();
    let mut sent: BTreeMap<UnitName, Vec<Value<'a>>> = BTreeMap::new();
    for wire in connections {
        let (Some(unit), Some(can)) = (wire.unit, wire.connection.kind.can()) else { continue };
        // A board table may call the only unit `CAN`.
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
            match Value::new(*index, device, diagnostics) {
                Some(value) if device.device.direction == Direction::Sensor => {
                    bus.values.push(value);
                }
                Some(value) => sent.entry(UnitName::new(unit)).or_default().push(value),
                None => {}
            }
        }
    }
    for (unit, values) in sent {
        if let Some(bus) = buses.get_mut(&unit) {
            bus.frames = frames(&values);
        }
    }
    buses.into_values().collect()
}

/// The repetition intervals of the frames that are repeated.
pub fn repeats_ms<'a>(job: &'a BoardJob<'a>) -> impl Iterator<Item = u32> + 'a {
    job.devices.iter().map(|one| one.device.kind.resend_ms()).filter(|resend_ms| *resend_ms > 0)
}

/// The frames of the values that are sent, in the order of the values: all values of an identifier go together. Where a
/// value selects the others, each selection is a frame of its own, which also contains the values common to all of
/// them.
fn frames<'a>(values: &[Value<'a>]) -> Vec<Frame<'a>> {
    let mut frames: Vec<Frame<'a>> = Vec::new();
    for one in values {
        if frames.iter().any(|frame| frame.identifier() == one.identifier()) {
            continue;
        }
        let own = || values.iter().filter(|value| value.identifier() == one.identifier());
        let bytes = own().map(|value| value.end).max().unwrap_or(0);
        let mut selections: Vec<(u64, u64)> = own().filter_map(|value| value.select).collect();
        selections.sort_unstable();
        selections.dedup();
        let frame = |select: Option<(u64, u64)>| {
            let is_in = |value: &&Value<'a>| value.select == select;
            let is_shared = |value: &&Value<'a>| {
                let (mask, _) = select.unwrap_or_default();
                select.is_some() && value.select.is_none() && value.bits & mask == 0
            };
            let quiet = |value: &Value<'a>| Value { is_quiet: true, ..value.clone() };
            let values = own().filter(is_in).cloned();
            let values: Vec<Value<'a>> = values.chain(own().filter(is_shared).map(quiet)).collect();
            let repeats = values.iter().filter(|value| !value.is_quiet && value.resend_ms > 0);
            Frame {
                identifier: one.identifier,
                is_extended: one.is_extended,
                bytes,
                resend_ms: repeats.map(|value| value.resend_ms).min().unwrap_or(0),
                start: select.map_or(0, |(_, bits)| bits),
                values,
            }
        };
        let all = std::iter::once(None).chain(selections.into_iter().map(Some)).map(frame);
        frames.extend(all.filter(|frame| !frame.values.is_empty()));
    }
    frames
}

impl<'a> Bus<'a> {
    /// The identifiers that the filters of a bxCAN controller let through; `None` if they exceed the filters.
    #[must_use]
    pub fn wanted(&self) -> Option<Vec<Identifier>> {
        let wanted = self.identifiers();
        (wanted.len() <= 2 * BANKS).then_some(wanted)
    }

    /// The identifiers that the filters of an FDCAN controller let through; `None` if they exceed the filters.
    #[must_use]
    pub fn wanted_in_memory(&self) -> Option<Vec<Identifier>> {
        let wanted = self.identifiers();
        let extended = wanted.iter().filter(|(_, is_extended)| *is_extended).count();
        let standard = wanted.len() - extended;
        (standard <= 2 * STANDARD_FILTERS && extended <= 2 * EXTENDED_FILTERS).then_some(wanted)
    }

    /// The identifiers of the values that are received, each once.
    fn identifiers(&self) -> Vec<Identifier> {
        let mut wanted: Vec<Identifier> = self.values.iter().map(Value::identifier).collect();
        wanted.sort_unstable();
        wanted.dedup();
        wanted
    }
}

impl<'a> Value<'a> {
    /// The value of a device; one that cannot be sent is reported.
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
        let mask = words.in_frame(can.byte);
        let whole = (u16::from(can.byte)..end).fold(0, |all, byte| all | 0xFF << (8 * byte));
        Some(Self {
            index,
            device,
            identifier: can.frame_id,
            is_extended: can.is_extended,
            byte: can.byte,
            how: ValuePlan::new(&words),
            bits: mask,
            mask: if mask == whole { 0 } else { mask },
            select: can.select(),
            is_quiet: false,
            resend_ms: can.resend_ms,
            end: can.length.map_or(end, |length| end.max(length.into())),
        })
    }

    /// The identifier of the frame, and whether it has 29 bits.
    #[must_use]
    pub fn identifier(&self) -> Identifier {
        (self.identifier, self.is_extended)
    }
}

impl Frame<'_> {
    /// Whether the identifier has 29 bits.
    #[must_use]
    pub fn is_extended(&self) -> bool {
        self.is_extended
    }

    /// The identifier, and whether it has 29 bits.
    #[must_use]
    pub fn identifier(&self) -> Identifier {
        (self.identifier, self.is_extended)
    }

    /// The content before any value is set.
    #[must_use]
    pub fn start_bytes(&self) -> [u8; 8] {
        self.start.to_le_bytes()
    }
}
