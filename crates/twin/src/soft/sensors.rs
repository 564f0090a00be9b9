//! Converters, captures, contacts and encoders: the measurements of the MCU's own peripherals.

use sense_rt::{
    Capture, CaptureConfig, CaptureMode, Captured, Contact, ContactConfig, ContactReport, Edge,
    Elements, Formula, Item, Outcome, Repeat, Train, TrainConfig, store_count, store_mean,
    store_signed,
};
use sensedsl_job::{BoardJob, Cycle, JobDevice};
use sensedsl_model::design::ConnectionIndex;
use sensedsl_model::kind::Role;
use sensedsl_model::kind::digital::{self, Pull};
use sensedsl_model::kind::icu::{self, Mode};
use sensedsl_wire::{Direction, ScalarType};

use super::core::{Core, begins, wrapped};
use crate::arith::rounded;
use crate::bench::{Bench, converted};
use crate::tables;

/// The interval at which an unchanged count is reported again.
const REPEAT_MS: u32 = 1_000;
/// The time without edges after which frequency and duty are 0.
const SILENT_MS: u32 = 1_000;
/// The shortest gap and the shortest pulse of a model receiver's train.
const TRAIN_GAP_US: u64 = 2_700;
const TRAIN_MIN_US: u64 = 500;
/// The interval at which counters are read.
const LOOK_MS: u64 = 10;

/// The sensors of the board, with their places in the schema.
fn devices<'a>(job: &'a BoardJob<'a>) -> impl Iterator<Item = (usize, &'a JobDevice<'a>, Item)> {
    let items = tables::schema(job).items;
    let all = job.devices.iter().zip(items).enumerate();
    let sensors = all.filter(|(_, (one, _))| one.device.direction == Direction::Sensor);
    sensors.map(|(index, (one, item))| (index, one, *item))
}

/// The connections that carry the elements of a device.
fn wires(one: &JobDevice<'_>) -> Vec<ConnectionIndex> {
    one.device.connections.clone()
}

/// The bytes of an element.
fn element<'a>(value: &'a mut [u8], item: &Item, index: usize) -> &'a mut [u8] {
    let size = item.scalar.bytes();
    value.get_mut(index * size..(index + 1) * size).unwrap_or_default()
}

/// An analog device.
#[derive(Clone)]
pub(super) struct Converter {
    index: usize,
    item: Item,
    cycle: Cycle,
    inputs: Vec<ConnectionIndex>,
    samples: usize,
    formula: Option<(Formula, Vec<i32>, usize)>,
}

pub(super) fn converters(job: &BoardJob<'_>) -> Vec<Converter> {
    let all = devices(job).filter_map(|(index, one, item)| {
        let own = one.device.kind.analog()?;
        let chip = job.design.part(one.device.part).and_then(|part| part.chip.as_ref());
        let formula = chip.and_then(|chip| {
            let output = usize::from(one.device.coding.output?.number);
            Some((tables::formula(chip.formula?), chip.parameters.clone(), output))
        });
        let samples = usize::from(own.samples.max(1));
        Some(Converter { index, item, cycle: one.cycle, inputs: wires(one), samples, formula })
    });
    all.collect()
}

impl Converter {
    pub(super) fn step(&mut self, core: &mut Core, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        if !begins(since_ms, self.cycle) {
            return;
        }
        let mut value = vec![0; self.item.bytes()];
        for (place, input) in self.inputs.iter().enumerate() {
            let level = rounded(converted(bench.millivolts_at(*input, now_ns)));
            let level = u16::try_from(level).unwrap_or(0);
            let target = element(&mut value, &self.item, place);
            let Some((formula, parameters, output)) = &self.formula else {
                store_mean(self.item.scalar, &vec![level; self.samples], 1, target);
                continue;
            };
            let outputs = formula.compute(&[], parameters, &level.to_be_bytes());
            let Some(result) = outputs.as_ref().and_then(|all| all.get(*output)) else {
                core.record(self.index, Outcome::Invalid, &mut []);
                return;
            };
            store_signed(self.item.scalar, *result, target);
        }
        core.record(self.index, Outcome::Fresh, &mut value);
    }
}

/// The edges on one wire, in order.
#[derive(Clone, Debug)]
struct Edges {
    connection: ConnectionIndex,
    role: Role,
    /// The time up to which all edges were taken.
    seen_ns: u64,
    next: Option<(u64, bool)>,
    is_known: bool,
}

impl Edges {
    const fn new(connection: ConnectionIndex, role: Role) -> Self {
        Self { connection, role, seen_ns: 0, next: None, is_known: false }
    }

    /// The next edge, if it is not later than now.
    fn next(&mut self, bench: &mut Bench, now_ns: u64) -> Option<(u64, bool)> {
        if !self.is_known {
            self.next = bench.next_edge_at(self.connection, self.role, self.seen_ns);
            self.is_known = self.next.is_some();
        }
        match self.next {
            Some((at, level)) if at <= now_ns => {
                self.seen_ns = at;
                self.is_known = false;
                Some((at, level))
            }
            Some(_) => None,
            None => {
                self.seen_ns = now_ns;
                None
            }
        }
    }

    /// Drops the edges that came before the board was up.
    fn begin(&mut self, now_ns: u64) {
        if self.seen_ns == 0 {
            self.seen_ns = now_ns.saturating_sub(1_000_000);
        }
    }
}

/// Captures of one device, with a wire for each element.
#[derive(Clone)]
pub(super) struct Captures {
    index: usize,
    item: Item,
    cycle: Cycle,
    mode: Mode,
    tick_hz: u32,
    is_falling: bool,
    is_both: bool,
    /// The wait after a trigger pulse.
    wait_ms: Option<u64>,
    wires: Vec<Wire>,
    elements: Elements,
    value: Vec<u8>,
    seen_trains: u32,
}

#[derive(Clone)]
struct Wire {
    edges: Edges,
    captured: Captured,
    capture: Capture,
    train: Train,
    began_ns: Option<u64>,
}

pub(super) fn captures(job: &BoardJob<'_>) -> Vec<Captures> {
    let all = devices(job).filter_map(|(index, one, item)| {
        let own = one.device.kind.icu()?;
        let wire = |connection: ConnectionIndex| Wire {
            edges: Edges::new(connection, Role::In),
            captured: Captured::NEW,
            capture: Capture::NEW,
            train: Train::NEW,
            began_ns: None,
        };
        let wait_ms = u64::from(own.wait_us).div_ceil(1_000).max(1);
        Some(Captures {
            index,
            item,
            cycle: one.cycle,
            mode: own.mode,
            tick_hz: own.tick_hz,
            is_falling: own.edge == icu::Edge::Falling,
            is_both: own.edge == icu::Edge::Both,
            wait_ms: own.pulse_us.map(|_| wait_ms),
            wires: wires(one).into_iter().map(wire).collect(),
            elements: Elements::NEW,
            value: vec![0; item.bytes()],
            seen_trains: 0,
        })
    });
    all.collect()
}

impl Captures {
    pub(super) fn step(&mut self, core: &mut Core, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        self.trigger(bench, since_ms, now_ns);
        let config = self.train_config();
        for wire in &mut self.wires {
            wire.edges.begin(now_ns);
            while let Some((at, level)) = wire.edges.next(bench, now_ns) {
                let is_active = level != self.is_falling;
                if self.mode == Mode::Ppm {
                    if is_active {
                        wire.train.on_edge(&config, ticks(self.tick_hz, at));
                    }
                } else {
                    wire.edge(self.tick_hz, at, is_active, self.is_both);
                }
            }
        }
        if self.mode == Mode::Ppm {
            self.tell_train(core, &config);
        } else {
            self.record(core, since_ms);
        }
    }

    /// With trigger pulses, the elements measure one after another.
    fn trigger(&mut self, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        let Some(wait_ms) = self.wait_ms else { return };
        let count = u64::try_from(self.wires.len()).unwrap_or(1);
        let delay_ms = u32::try_from(count * wait_ms).unwrap_or(u32::MAX).max(self.cycle.delay_ms);
        for (place, wire) in (0_u64..).zip(&self.wires) {
            let start_ms = u64::from(self.cycle.start_ms) + place * wait_ms;
            let start_ms = u32::try_from(start_ms).unwrap_or(u32::MAX);
            if begins(since_ms, Cycle { delay_ms, start_ms, ..self.cycle }) {
                let connection = wire.edges.connection;
                bench.drive_at(connection, Role::Trigger, Some(true), now_ns);
                bench.drive_at(connection, Role::Trigger, Some(false), now_ns);
            }
        }
    }

    fn record(&mut self, core: &mut Core, since_ms: u64) {
        let config = CaptureConfig {
            mode: match self.mode {
                Mode::Width => CaptureMode::Width,
                Mode::Period => CaptureMode::Period,
                Mode::Frequency => CaptureMode::Frequency,
                Mode::Duty => CaptureMode::Duty,
                Mode::Count | Mode::Ppm => CaptureMode::Count,
            },
            tick_hz: self.tick_hz,
            silent_ms: SILENT_MS,
        };
        // The reporter reads captures in its cycles.
        if !since_ms.is_multiple_of(LOOK_MS) {
            return;
        }
        for (place, wire) in self.wires.iter_mut().enumerate() {
            let (raw, now_ms) = (wire.captured, wrapped(since_ms));
            let target = element(&mut self.value, &self.item, place);
            if wire.capture.read(&config, &raw, false, now_ms, self.item.scalar, target) {
                self.elements.note(place);
            }
        }
        let is_complete = matches!(self.mode, Mode::Width | Mode::Period);
        if self.elements.are_due(self.wires.len(), is_complete) {
            core.record(self.index, Outcome::Fresh, &mut self.value.clone());
        }
    }

    fn train_config(&self) -> TrainConfig {
        let of_us = |us: u64| u32::try_from(us * u64::from(self.tick_hz) / 1_000_000).unwrap_or(0);
        TrainConfig {
            tick_hz: self.tick_hz,
            gap_ticks: of_us(TRAIN_GAP_US),
            min_ticks: of_us(TRAIN_MIN_US),
        }
    }

    fn tell_train(&mut self, core: &mut Core, config: &TrainConfig) {
        let Some(wire) = self.wires.first() else { return };
        let mut value = vec![0; self.item.bytes()];
        let outcome = wire.train.read(config, &mut self.seen_trains, &self.item, &mut value);
        core.record(self.index, outcome, &mut value);
    }
}

impl Wire {
    fn edge(&mut self, tick_hz: u32, at: u64, is_active: bool, is_both: bool) {
        match (is_active, self.began_ns) {
            (true, began) => {
                // A period counts its own edge.
                match began {
                    Some(began) => self.captured.on_period(ticks(tick_hz, at - began)),
                    None => self.captured.on_edge(),
                }
                self.began_ns = Some(at);
            }
            (false, Some(began)) => self.captured.on_width(ticks(tick_hz, at - began), is_both),
            (false, None) if is_both => self.captured.on_edge(),
            (false, None) => {}
        }
    }
}

/// A time in ticks of a timer, which wraps.
fn ticks(tick_hz: u32, time_ns: u64) -> u32 {
    let ticks = u128::from(time_ns) * u128::from(tick_hz) / 1_000_000_000;
    u32::try_from(ticks & u128::from(u32::MAX)).unwrap_or(0)
}

/// Contacts of one device, with a wire for each element.
#[derive(Clone)]
pub(super) struct Contacts {
    index: usize,
    item: Item,
    cycle: Cycle,
    config: ContactConfig,
    has_edge: bool,
    is_count: bool,
    is_active_low: bool,
    at_rest: bool,
    wires: Vec<(Edges, Contact, ContactReport)>,
    reported: Vec<u32>,
}

pub(super) fn contacts(job: &BoardJob<'_>) -> Vec<Contacts> {
    let all = devices(job).filter_map(|(index, one, item)| {
        let own = one.device.kind.digital()?;
        let wire =
            |connection| (Edges::new(connection, Role::In), Contact::NEW, ContactReport::default());
        let edge = match own.edge {
            Some(digital::Edge::Rising) => Edge::Rising,
            Some(digital::Edge::Falling) => Edge::Falling,
            Some(digital::Edge::Both) | None => Edge::Both,
        };
        let is_bool = one.device.value.value.scalar == ScalarType::Bool;
        Some(Contacts {
            index,
            item,
            cycle: one.cycle,
            config: ContactConfig { lasting: own.debounce_us, edge },
            has_edge: own.edge.is_some(),
            is_count: own.edge.is_some() && !is_bool,
            is_active_low: own.active_low,
            at_rest: own.pull == Pull::Up,
            wires: wires(one).into_iter().map(wire).collect(),
            reported: Vec::new(),
        })
    });
    all.collect()
}

impl Contacts {
    pub(super) fn step(&mut self, core: &mut Core, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        let now_us = wrapped(now_ns / 1_000);
        let mut has_news = false;
        for (edges, contact, reported) in &mut self.wires {
            edges.begin(now_ns);
            while let Some((at, level)) = edges.next(bench, now_ns) {
                if self.has_edge && interrupts(&self.config, level) {
                    contact.on_edge(&self.config, level, wrapped(at / 1_000));
                }
            }
            let level = bench.level_at(edges.connection, Role::In, now_ns).unwrap_or(self.at_rest);
            if self.has_edge {
                contact.look(&self.config, level, now_us);
                has_news |= reported.record(&self.config, contact).is_some();
            } else {
                contact.sample(&self.config, level, now_us);
            }
        }
        if self.is_count {
            let counts: Vec<u32> =
                self.wires.iter().map(|(_, contact, _)| contact.edges()).collect();
            has_news = counts != self.reported;
            self.reported = counts;
        }
        if !has_news && !begins(since_ms, self.cycle) {
            return;
        }
        let mut value = vec![0; self.item.bytes()];
        for (place, (_, contact, _)) in self.wires.iter().enumerate() {
            let target = element(&mut value, &self.item, place);
            let is_on = contact.level() != self.is_active_low;
            let raw = if self.is_count { i64::from(contact.edges()) } else { i64::from(is_on) };
            store_count(self.item.scalar, raw, target);
        }
        core.record(self.index, Outcome::Fresh, &mut value);
    }
}

/// Whether an edge interrupts: without a debounce time only edges that count do, with one both do.
fn interrupts(config: &ContactConfig, level: bool) -> bool {
    config.lasting > 0
        || match config.edge {
            Edge::Both => true,
            Edge::Rising => level,
            Edge::Falling => !level,
        }
}

/// Encoders of one device, with two wires for each element.
#[derive(Clone)]
pub(super) struct Encoders {
    index: usize,
    item: Item,
    wheels: Vec<Wheel>,
    repeat: Repeat,
    reported: Vec<i32>,
}

#[derive(Clone)]
struct Wheel {
    a: Edges,
    b: Edges,
    levels: Option<(bool, bool)>,
    count: i32,
}

pub(super) fn encoders(job: &BoardJob<'_>) -> Vec<Encoders> {
    let all = devices(job).filter_map(|(index, one, item)| {
        one.device.kind.encoder()?;
        let wheel = |connection| Wheel {
            a: Edges::new(connection, Role::A),
            b: Edges::new(connection, Role::B),
            levels: None,
            count: 0,
        };
        let wheels = wires(one).into_iter().map(wheel).collect();
        Some(Encoders { index, item, wheels, repeat: Repeat::NEW, reported: Vec::new() })
    });
    all.collect()
}

impl Encoders {
    pub(super) fn step(&mut self, core: &mut Core, bench: &mut Bench, since_ms: u64, now_ns: u64) {
        for wheel in &mut self.wheels {
            wheel.step(bench, now_ns);
        }
        if !since_ms.is_multiple_of(LOOK_MS) {
            return;
        }
        let counts: Vec<i32> = self.wheels.iter().map(|wheel| wheel.count).collect();
        if !self.repeat.is_due(counts != self.reported, REPEAT_MS, wrapped(since_ms)) {
            return;
        }
        let mut value = vec![0; self.item.bytes()];
        for (place, count) in counts.iter().enumerate() {
            let target = element(&mut value, &self.item, place);
            store_count(self.item.scalar, i64::from(*count), target);
        }
        self.reported = counts;
        core.record(self.index, Outcome::Fresh, &mut value);
    }
}

impl Wheel {
    /// Counts as a timer in encoder mode does: up if A leads B.
    fn step(&mut self, bench: &mut Bench, now_ns: u64) {
        self.a.begin(now_ns);
        self.b.begin(now_ns);
        let connection = self.a.connection;
        let mut read = |role| bench.level_at(connection, role, now_ns).unwrap_or(false);
        let Some((mut a, mut b)) = self.levels else {
            // A timer does not know the levels from before it started to count.
            self.levels = Some((read(Role::A), read(Role::B)));
            (self.a.seen_ns, self.b.seen_ns) = (now_ns, now_ns);
            return;
        };
        let (mut of_a, mut of_b) = (self.a.next(bench, now_ns), self.b.next(bench, now_ns));
        loop {
            let before = place(a, b);
            match (of_a, of_b) {
                (Some((at, level)), other) if other.is_none_or(|(later, _)| at <= later) => {
                    a = level;
                    of_a = self.a.next(bench, now_ns);
                }
                (_, Some((_, level))) => {
                    b = level;
                    of_b = self.b.next(bench, now_ns);
                }
                (_, None) => break,
            }
            self.count = self.count.wrapping_add(match (place(a, b) + 4 - before) % 4 {
                1 => 1,
                3 => -1,
                _ => 0,
            });
        }
        self.levels = Some((a, b));
    }
}

/// The place of two levels in the order that they have when a wheel turns forwards.
const fn place(a: bool, b: bool) -> u8 {
    match (a, b) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    }
}
