//! CAN buses with the values received, the frames sent, and the hardware filters.

use std::collections::BTreeMap;

use askama::Template;
use sensedsl_board::signal::UnitName;
use sensedsl_diagnostics::Diagnostic;
use sensedsl_model::kind::KindName;

use crate::context::{Context, Drive};
use crate::names::Setting;
use crate::section::{Apply, Counter, Failsafe, Section, Size, Work};
use crate::stacks::Depth;
use sensedsl_files::block;
use sensedsl_job::kinds::can::{self, BANKS, Identifier};
use sensedsl_job::snake;

/// The stack depth of its thread.
const DEPTH: Depth = Depth { plain: [416, 268], filtered: [496, 352] };

#[derive(Template)]
#[template(path = "can/frames.c.txt", escape = "none")]
struct Tables<'a> {
    s: &'a Buses<'a>,
}

struct Buses<'a> {
    buses: Vec<Bus<'a>>,
    /// The filter banks: number, and two identifiers as the registers hold them.
    filters: Vec<(usize, String, String)>,
}

/// A bus.
struct Bus<'a> {
    ident: String,
    driver: String,
    clock: String,
    id: u8,
    of: can::Bus<'a>,
}

pub(super) fn plan(context: &Context<'_>, diagnostics: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    for pad in context.connections(KindName::Can).flat_map(|wired| &wired.pads) {
        section.pads.extend(context.alternate_pad(pad, Drive::Plain, diagnostics));
    }
    let buses = can::buses(context.job, context.connections(KindName::Can), diagnostics);
    let buses = buses.into_iter().filter_map(|one| Bus::new(context, one));
    let mut all = Buses { filters: Vec::new(), buses: buses.collect() };
    all.filters = filters(context, &all.buses);
    if let Some(first) = all.buses.first() {
        section.switch = Some(Setting::new("HAL_USE_CAN", "TRUE"));
        section.hal = vec![
            Setting::new("CAN_USE_SLEEP_MODE", "FALSE"),
            Setting::new("CAN_ENFORCE_USE_CALLBACKS", "FALSE"),
        ];
        section.mcu.extend(context.names.group_options(first.of.unit));
    }
    if !all.filters.is_empty() {
        let count = all.filters.len();
        section
            .starts
            .push(format!("canSTM32SetFilters(&CAND1, {BANKS}U, {count}U, can_filters);"));
    }
    for bus in &all.buses {
        section.units.insert(UnitName::new(bus.of.unit));
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

/// Filter banks in list mode, with two identifiers each, if the hardware has them and they suffice; otherwise the
/// runtime checks every frame, which it does after the filters as well.
fn filters(context: &Context<'_>, buses: &[Bus<'_>]) -> Vec<(usize, String, String)> {
    let mut filters = Vec::new();
    if context.names.drivers.can != "CANv1" {
        return filters;
    }
    for bus in buses {
        let first = match bus.of.unit {
            "CAN1" => 0,
            "CAN2" => BANKS,
            _ => return Vec::new(),
        };
        let Some(wanted) = bus.of.wanted() else { return Vec::new() };
        for (index, pair) in wanted.chunks(2).enumerate() {
            // If their number is odd, the last one is entered twice.
            if let [one, .., two] | [one @ two] = pair {
                filters.push((first + index, register(*one), register(*two)));
            }
        }
    }
    filters
}

/// An identifier as a filter register holds it.
fn register((identifier, is_extended): Identifier) -> String {
    if is_extended {
        format!("({identifier:#X}U << 3) | 4U")
    } else {
        format!("{identifier:#X}U << 21")
    }
}

impl<'a> Bus<'a> {
    fn new(context: &Context<'_>, of: can::Bus<'a>) -> Option<Self> {
        Some(Self {
            ident: snake(of.unit),
            driver: context.names.driver(of.unit)?,
            clock: context.profile.unit(of.unit)?.clock.clone()?,
            id: context.id_of(of.first),
            of,
        })
    }

    fn add_to(&self, section: &mut Section) {
        let Self { ident, clock, of, .. } = self;
        section.starts.push(format!("up_can_start(&{ident}_bus);"));
        if self.repeats() {
            section
                .failsafes
                .push(Failsafe { field: None, line: format!("up_can_hush(&{ident}_bus);") });
        }
        if !of.frames.is_empty() {
            section.polls.push(format!("up_can_send(&{ident}_bus);"));
        }
        let sent = of.frames.iter().enumerate();
        let sent = sent.flat_map(|(at, frame)| frame.values.iter().map(move |value| (at, value)));
        // A value that is in several frames is set in all of them.
        let mut lines: BTreeMap<usize, Apply> = BTreeMap::new();
        for (index, (at, value)) in sent.enumerate() {
            let line = format!("up_can_set(&{ident}_frames[{at}], &{ident}_sent[{index}], value);");
            let apply = lines.entry(value.index).or_insert_with(|| Apply {
                field: value.device.name().to_owned(),
                line: String::new(),
            });
            let between = if apply.line.is_empty() { "" } else { "\n      " };
            apply.line = format!("{}{between}{line}", apply.line);
        }
        section.applies.extend(lines.into_values());
        section.clocks.insert(clock.clone());
        section.counters.push(Counter {
            title: format!("{} was off the bus", of.unit),
            variable: format!("{ident}_state.bus_offs"),
        });
        section.work.push(Work {
            unit: of.unit.to_owned(),
            cycle: of.cycle,
            function: "up_can_cycle",
            table: format!("{ident}_bus"),
            device: self.id,
            depth: DEPTH,
        });
    }

    /// The number of 64-bit words that hold the largest value received.
    fn value_words(&self) -> usize {
        let bytes = self.of.values.iter().map(|one| one.device.device.value.value.size_bytes());
        bytes.map(|bytes| bytes.div_ceil(8)).max().unwrap_or(0).max(1)
    }

    /// Whether bits of frames select what else is in them.
    fn selects(&self) -> bool {
        self.of.frames.iter().any(|frame| frame.start != 0)
    }

    /// Whether frames are repeated.
    fn repeats(&self) -> bool {
        self.of.frames.iter().any(|frame| frame.resend_ms > 0)
    }

    /// The number of values in all frames that are sent.
    fn sent_count(&self) -> usize {
        self.of.frames.iter().map(|frame| frame.values.len()).sum()
    }
}
