//! Buses with the values that come in, the frames that go out, and the filters of the hardware.

use std::collections::BTreeMap;

use askama::Template;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_diagnostics::codes::e0506_hardware_limit;
use sensedsl_model::kind::can::Can;
use sensedsl_model::kind::{Kind, KindName};
use sensedsl_model::words::Words;
use sensedsl_wire::Direction;

use crate::firmware::chibios::context::{Context, Drive};
use crate::firmware::chibios::names::Setting;
use crate::firmware::chibios::section::{Apply, Counter, Section, Size, Work};
use crate::firmware::chibios::stacks::Depth;
use crate::job::{Cycle, JobConnection, JobDevice};
use crate::part::ValuePlan;
use crate::print::{block, snake};

/// How deep its thread gets.
const DEPTH: Depth = Depth { plain: [416, 268], filtered: [496, 352] };

#[derive(Template)]
#[template(path = "firmware/chibios/can/frames.c.txt", escape = "none")]
struct Tables<'a> {
    s: &'a Buses,
}

#[derive(Default)]
struct Buses {
    buses: Vec<Bus>,
    /// Banks of the hardware: number, and two identifiers as its registers have them.
    filters: Vec<(usize, String, String)>,
}

/// A bus.
struct Bus {
    ident: String,
    unit: String,
    driver: String,
    clock: String,
    bitrate_hz: u32,
    /// For people.
    places: Vec<String>,
    cycle: Cycle,
    id: u8,
    values: Vec<Value>,
    frames: Vec<Frame>,
}

/// A value in a frame.
struct Value {
    field: String,
    ident: String,
    identifier: u32,
    byte: u8,
    /// One behind its last byte.
    end: u16,
    cycle_ms: u32,
    /// Bytes of the value in memory.
    bytes: usize,
    how: ValuePlan,
}

/// A frame that is sent.
struct Frame {
    identifier: u32,
    bytes: u16,
    values: Vec<Value>,
}

/// The greatest identifier of eleven bits; a greater one has 29.
const STANDARD_MAX: u32 = 0x7FF;

/// Bytes of a frame.
const FRAME_BYTES: u16 = 8;

/// Banks that each of two buses has.
const BANKS: usize = 14;

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut buses: BTreeMap<UnitName, Bus> = BTreeMap::new();
    for wired in context.connections(KindName::Can) {
        let Some(unit) = wired.unit.map(UnitName::new) else { continue };
        for pad in &wired.pads {
            section.pads.extend(context.alternate_pad(pad, Drive::Plain, diagnostics));
        }
        if !buses.contains_key(&unit) {
            let Some(bus) = Bus::new(context, unit.as_str(), wired) else { continue };
            buses.insert(unit.clone(), bus);
        }
        let Some(bus) = buses.get_mut(&unit) else { continue };
        bus.cycle.delay_ms = bus.cycle.delay_ms.min(wired.cycle.delay_ms);
        bus.cycle.prio = bus.cycle.prio.max(wired.cycle.prio);
        bus.places.push(wired.place());
        for device in context.devices_of(wired) {
            bus.add(device, diagnostics);
        }
    }
    let mut all = Buses { filters: Vec::new(), buses: buses.into_values().collect() };
    all.filters = filters(context, &all.buses);
    if let Some(first) = all.buses.first() {
        section.switch = Some(Setting::new("HAL_USE_CAN", "TRUE"));
        section.hal = vec![
            Setting::new("CAN_USE_SLEEP_MODE", "FALSE"),
            Setting::new("CAN_ENFORCE_USE_CALLBACKS", "FALSE"),
        ];
        section.mcu.extend(context.names.group_options(&first.unit));
    }
    if !all.filters.is_empty() {
        let count = all.filters.len();
        section
            .starts
            .push(format!("canSTM32SetFilters(&CAND1, {BANKS}U, {count}U, can_filters);"));
    }
    for bus in &all.buses {
        section.units.insert(UnitName::new(&bus.unit));
        bus.add_to(&mut section);
    }
    section.sizes = vec![Size {
        comment: "CAN buses.",
        setting: Setting::new("UP_CAN_BUSES", &format!("{}U", all.buses.len().max(1))),
    }];
    if !all.buses.is_empty() {
        section.tables = block(&Tables { s: &all });
    }
    section
}

/// Lists of two identifiers each, where the hardware has them and they suffice; otherwise the runtime looks through all
/// frames, as it does behind the filters.
fn filters(context: &Context<'_>, buses: &[Bus]) -> Vec<(usize, String, String)> {
    let mut filters = Vec::new();
    if context.names.drivers.can != "CANv1" {
        return filters;
    }
    for bus in buses {
        let first = match bus.unit.as_str() {
            "CAN1" => 0,
            "CAN2" => BANKS,
            _ => return Vec::new(),
        };
        let mut wanted: Vec<u32> = bus.values.iter().map(|one| one.identifier).collect();
        wanted.sort_unstable();
        wanted.dedup();
        if wanted.len() > 2 * BANKS {
            return Vec::new();
        }
        for (index, pair) in wanted.chunks(2).enumerate() {
            let mut both = pair.iter().chain(pair.last()).map(|one| register(*one));
            let (Some(one), Some(two)) = (both.next(), both.next()) else { continue };
            filters.push((first + index, one, two));
        }
    }
    filters
}

/// An identifier as a filter's register has it.
fn register(identifier: u32) -> String {
    if identifier > STANDARD_MAX {
        format!("({identifier:#X}U << 3) | 4U")
    } else {
        format!("{identifier:#X}U << 21")
    }
}

impl Bus {
    fn new(context: &Context<'_>, unit: &str, wired: &JobConnection<'_>) -> Option<Self> {
        let bitrate_hz = match (&wired.connection.kind, context.device_of(wired)) {
            (Kind::Can(can), _) => can.bitrate_hz,
            (_, Some(one)) => one.device.kind.can()?.bitrate_hz,
            _ => return None,
        };
        // Tables may call the only one `CAN`.
        let facts = context.profile.unit(unit)?;
        Some(Self {
            ident: snake(&facts.name),
            driver: context.names.driver(&facts.name)?,
            unit: facts.name.clone(),
            clock: facts.clock.clone()?,
            bitrate_hz,
            places: Vec::new(),
            cycle: wired.cycle,
            id: context.id_of(wired),
            values: Vec::new(),
            frames: Vec::new(),
        })
    }

    /// A value that comes in or goes out.
    fn add(&mut self, one: &JobDevice<'_>, diagnostics: &mut Vec<Diagnostic>) {
        let Kind::Can(can) = &one.device.kind else { return };
        let Some(value) = Value::new(one, can) else { return };
        if value.end > FRAME_BYTES {
            let name = &one.device.name;
            let message = format!(
                "{} ends {} bytes into its frame, which has {FRAME_BYTES}",
                name.value, value.end
            );
            let help = "let it begin earlier (`byte`), or take a smaller type";
            diagnostics.push(e0506_hardware_limit::hardware_limit(name.span, &message, help));
            return;
        }
        if one.device.direction == Direction::Sensor {
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

    fn add_to(&self, section: &mut Section) {
        let Self { ident, clock, .. } = self;
        section.starts.push(format!("up_can_start(&{ident}_bus);"));
        if !self.frames.is_empty() {
            section.polls.push(format!("up_can_send(&{ident}_bus);"));
        }
        let sent = self.frames.iter().enumerate();
        let sent = sent.flat_map(|(at, frame)| frame.values.iter().map(move |value| (at, value)));
        section.applies.extend(sent.enumerate().map(|(index, (at, value))| Apply {
            field: value.field.clone(),
            line: format!("up_can_set(&{ident}_frames[{at}], &{ident}_sent[{index}], value);"),
        }));
        section.clocks.insert(clock.clone());
        section.counters.push(Counter {
            title: format!("{} was off the bus", self.unit),
            variable: format!("{ident}_state.bus_offs"),
        });
        section.work.push(Work {
            unit: self.unit.clone(),
            cycle: self.cycle,
            function: "up_can_cycle",
            table: format!("{ident}_bus"),
            device: self.id,
            depth: DEPTH,
        });
    }

    /// 64-bit words of the largest value that comes in.
    fn value_words(&self) -> usize {
        self.values.iter().map(|value| value.bytes.div_ceil(8)).max().unwrap_or(0).max(1)
    }

    /// The values of all frames that are sent.
    fn sent_count(&self) -> usize {
        self.frames.iter().map(|frame| frame.values.len()).sum()
    }
}

impl Value {
    fn new(one: &JobDevice<'_>, can: &Can) -> Option<Self> {
        let words = Words::of(one.device)?;
        Some(Self {
            field: one.device.name.value.clone(),
            ident: one.ident.clone(),
            identifier: can.frame_id,
            byte: can.byte,
            end: u16::from(can.byte).saturating_add(words.wire_bytes()),
            cycle_ms: one.cycle.delay_ms,
            bytes: one.device.value.value.size_bytes(),
            how: ValuePlan::new(&words),
        })
    }

    fn is_extended(&self) -> bool {
        self.identifier > STANDARD_MAX
    }
}

impl Frame {
    fn is_extended(&self) -> bool {
        self.identifier > STANDARD_MAX
    }
}
