//! Conversion of a world's text to signals and faults. Every error is reported with its place.

use sensedsl_diagnostics::codes::{
    e0540_world_unreadable as unreadable, e0541_world_unknown as unknown,
    e0542_world_value as value, e0543_world_time as time, e0544_world_fault as fault_code,
    e0551_world_too_large, e0554_world_too_fast,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_limits::WORLD_TABLES_MAX;
use sensedsl_model::design::{Design, Device, DeviceIndex, Transport};
use sensedsl_wire::Direction;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::entry::{Entry, duration};
use super::fault::{Fault, FaultKind};
use super::{Shape, Signal, World};
use crate::arith::scrambled;
use crate::range::{edges_a_second_max, is_counter, shown_range};
use crate::truth::scale_of;

/// The most edges a second that are simulated.
const EDGES_A_SECOND_MAX: f64 = 1_000_000.0;
/// The shortest period that is simulated.
const PERIOD_NS_MIN: u64 = 10_000;

/// The context that a world is read in.
pub struct Scene<'a> {
    /// The design.
    pub design: &'a Design,
    /// The devices of the board that is simulated.
    pub devices: &'a [DeviceIndex],
    /// How the board talks to its host.
    pub transport: Transport,
    /// The seed of the random numbers if the text has none; it also overrides one in the text.
    pub seed: Option<u64>,
    /// Returns the text of a file beside the world, or the reason why it was not read.
    pub samples: &'a dyn Fn(&str) -> Result<String, String>,
}

/// Reads a world.
#[must_use]
pub fn read(file: FileId, text: &str, scene: &Scene<'_>) -> (World, Vec<Diagnostic>) {
    let mut reader = Reader { file, scene, reported: Vec::new(), world: World::default() };
    if let Some(at) = beyond(text) {
        let span = Span::new(file, at..at);
        reader.reported.push(e0551_world_too_large::too_large(span, WORLD_TABLES_MAX));
        return (reader.world, reader.reported);
    }
    match DeTable::parse(text) {
        Ok(table) => reader.read(table.get_ref()),
        Err(error) => {
            let range = error.span().unwrap_or(0..0);
            let span = Span::new(file, range.start.min(text.len())..range.end.min(text.len()));
            reader.reported.push(unreadable::not_toml(span, error.message()));
        }
    }
    reader.world.faults.sort_by_key(|one| one.at_ns);
    (reader.world, reader.reported)
}

/// The place at which a text exceeds the number of tables and lists that are read, each of which takes a hundred times
/// the memory of its text. A bracket in a string or a comment counts as well, and so does a dot in a table's header,
/// which makes another table.
fn beyond(text: &str) -> Option<usize> {
    let mut left = WORLD_TABLES_MAX;
    let mut is_key = true;
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'\n' => is_key = true,
            b'=' => is_key = false,
            _ => {}
        }
        if matches!(byte, b'[' | b'{') || (byte == b'.' && is_key) {
            left = match left.checked_sub(1) {
                Some(left) => left,
                None => return Some(at),
            };
        }
    }
    None
}

/// The reader of one text.
pub(super) struct Reader<'a> {
    pub(super) file: FileId,
    pub(super) scene: &'a Scene<'a>,
    pub(super) reported: Vec<Diagnostic>,
    pub(super) world: World,
}

type Table<'i> = DeTable<'i>;

impl<'a> Reader<'a> {
    pub(super) fn span<T>(&self, of: &Spanned<T>) -> Span {
        Span::new(self.file, of.span())
    }

    fn read(&mut self, table: &Table<'_>) {
        if let Some(seed) = table.get("seed") {
            match whole(seed.get_ref()) {
                Some(seed) => self.world.seed = Some(seed),
                None => {
                    let wanted = "a whole number from 0 on";
                    let reported =
                        unreadable::wrong_sort(self.span(seed), "`seed`", wanted, "seed = 7");
                    self.reported.push(reported);
                }
            }
        }
        for (key, value) in table {
            match key.get_ref().as_ref() {
                "seed" => {}
                "devices" => self.devices(value),
                "fault" => self.faults(value),
                "command" => self.commands(value),
                "plants" => {}
                "controllers" => self.stand_ins(value),
                other => {
                    let all = ["seed", "devices", "plants", "fault", "command", "controllers"];
                    let near = nearest(other, all);
                    let span = self.span(key);
                    let list = "`seed`, `[devices]`, `[plants.NAME]`, `[[fault]]`, `[[command]]` and \
                        `[controllers.NAME.DEVICE]`";
                    self.reported.push(unknown::unknown_word(span, other, "a world", near, list));
                }
            }
        }
        if let Some(plants) = table.get("plants") {
            self.plants(plants);
        }
    }

    fn devices(&mut self, value: &Spanned<DeValue<'_>>) {
        let Some(table) = value.get_ref().as_table() else {
            let example = "[devices]";
            let reported =
                unreadable::wrong_sort(self.span(value), "`devices`", "a table", example);
            self.reported.push(reported);
            return;
        };
        for (name, value) in table {
            let span = self.span(name);
            if let Some((index, device)) = self.sensor(span, name.get_ref()) {
                let signals = self.signals(index, device, value);
                self.world.signals.extend(signals.map(|signals| (index, signals)));
            }
        }
    }

    /// The sensor of that name on the board.
    fn sensor(&mut self, span: Span, name: &str) -> Option<(DeviceIndex, &'a Device)> {
        let scene: &'a Scene<'a> = self.scene;
        let design = scene.design;
        let all = (0..).map(DeviceIndex).zip(&design.devices);
        let Some((index, device)) = all.into_iter().find(|(_, one)| one.name.value == name) else {
            let here = scene.devices.iter().filter_map(|index| design.device(*index));
            let sensors = here.filter(|one| one.direction == Direction::Sensor);
            let names: Vec<&str> = sensors.map(|one| one.name.value.as_str()).collect();
            let list: Vec<String> = names.iter().take(12).map(|name| format!("`{name}`")).collect();
            let near = nearest(name, names.iter().copied());
            self.reported.push(unknown::unknown_device(span, name, near, &list.join(", ")));
            return None;
        };
        let why = if !scene.devices.contains(&index) {
            "is not on the simulated board"
        } else if device.direction == Direction::Actuator {
            "is an actuator: the host sets it, as `[[command]]` says"
        } else {
            return Some((index, device));
        };
        self.reported.push(unknown::not_simulated(span, name, why));
        None
    }

    /// The signal of each element of a sensor.
    fn signals(
        &mut self,
        index: DeviceIndex,
        device: &Device,
        value: &Spanned<DeValue<'_>>,
    ) -> Option<Vec<Signal>> {
        let (count, name) = (device.value.value.count(), device.name.value.clone());
        let entries: Vec<&Spanned<DeValue<'_>>> = match value.get_ref().as_array() {
            None => vec![value],
            Some(list) if list.len() == count => list.iter().collect(),
            Some(list) => {
                let span = self.span(value);
                self.reported.push(value::wrong_count(span, &name, list.len(), count));
                return None;
            }
        };
        let mut signals = Vec::new();
        for entry in entries {
            let span = self.span(entry);
            let read = Entry { file: self.file, samples: self.scene.samples, device };
            match read.signal(entry) {
                Ok(mut signal) => {
                    turns(device, &mut signal);
                    self.reported.extend(impossible(device, &signal, span));
                    signals.push(signal);
                }
                Err(reported) => {
                    self.reported.push(*reported);
                    return None;
                }
            }
        }
        if let [one] = signals.as_slice() {
            signals = vec![one.clone(); count];
        }
        let seed = self.scene.seed.or(self.world.seed).unwrap_or(0);
        for (element, signal) in (0..).zip(&mut signals) {
            signal.key = key(seed, index, element);
        }
        Some(signals)
    }

    fn faults(&mut self, value: &Spanned<DeValue<'_>>) {
        let Some(list) = value.get_ref().as_array() else {
            let wanted = "a block of its own";
            let reported = unreadable::wrong_sort(self.span(value), "`fault`", wanted, "[[fault]]");
            self.reported.push(reported);
            return;
        };
        for one in list {
            match self.fault(one) {
                Ok(fault) => self.world.faults.extend(fault),
                Err(reported) => self.reported.push(*reported),
            }
        }
    }

    fn fault(&mut self, value: &Spanned<DeValue<'_>>) -> Result<Option<Fault>, Box<Diagnostic>> {
        let span = self.span(value);
        let Some(table) = value.get_ref().as_table() else {
            return Err(unreadable::wrong_sort(span, "a fault", "a table", "[[fault]]").into());
        };
        for key in table.keys() {
            let (all, word) = (["kind", "device", "at", "for"], key.get_ref().as_ref());
            if !all.contains(&word) {
                let list = "`kind`, `device`, `at` and `for`";
                let (at, near) = (self.span(key), nearest(word, all));
                return Err(unknown::unknown_word(at, word, "a fault", near, list).into());
            }
        }
        let missing = |needs, example| unreadable::missing(span, "a fault", needs, example);
        let word = table.get("kind").ok_or_else(|| missing("kind", "kind = \"no_answer\""))?;
        let kind = self.fault_kind(word)?;
        let at = table.get("at").ok_or_else(|| missing("at", "at = \"3 s\""))?;
        let at_ns = duration(self.file, at)?;
        let lasts_ns = match table.get("for") {
            Some(lasts) => duration(self.file, lasts)?,
            None => kind.usual_ns().ok_or_else(|| missing("for", "for = \"500 ms\""))?,
        };
        let fault = Fault { kind, device: None, at_ns, until_ns: at_ns.saturating_add(lasts_ns) };
        let (spanned, device) = match table.get("device") {
            None if kind.is_of_board() => {
                if kind == FaultKind::Garbage && self.scene.transport == Transport::None {
                    return Err(fault_code::no_link(span, kind.name()).into());
                }
                return Ok(Some(fault));
            }
            None => return Err(missing("device", "device = \"USRear\"").into()),
            Some(device) if kind.is_of_board() => {
                return Err(fault_code::no_device(self.span(device), kind.name()).into());
            }
            Some(device) => (self.span(device), device.get_ref().as_str().unwrap_or_default()),
        };
        let Some((index, device)) = self.sensor(spanned, device) else { return Ok(None) };
        let on = device.kind.name();
        if kind.fits(&device.kind) {
            return Ok(Some(Fault { device: Some(index), ..fault }));
        }
        let name = &device.name.value;
        let why = fault_code::no_such_wire(spanned, kind.name(), name, on.name(), kind.needs());
        Err(why.into())
    }

    fn fault_kind(&self, word: &Spanned<DeValue<'_>>) -> Result<FaultKind, Box<Diagnostic>> {
        let (span, text) = (self.span(word), word.get_ref().as_str().unwrap_or_default());
        FaultKind::find(text).ok_or_else(|| {
            let all = FaultKind::ALL.map(FaultKind::name);
            unknown::unknown_word(span, text, "a fault", nearest(text, all), &all.join(", ")).into()
        })
    }
}

/// The seed of the random numbers for one quantity.
pub(crate) fn key(seed: u64, device: DeviceIndex, element: u64) -> u64 {
    let device = u64::try_from(device.0).unwrap_or(u64::MAX);
    scrambled(scrambled(seed ^ scrambled(device)) ^ element)
}

/// Makes the signal of an edge counter go straight from point to point and not jump: nothing turns that fast.
fn turns(device: &Device, signal: &mut Signal) {
    if let Shape::Points { is_straight, .. } = &mut signal.shape {
        *is_straight |= is_turning(device);
    }
}

pub(super) fn is_turning(device: &Device) -> bool {
    device.kind.encoder().is_some() || is_counter(&device.kind, device)
}

/// The reason why a device cannot follow a signal.
pub(super) fn impossible(device: &Device, signal: &Signal, span: Span) -> Option<Diagnostic> {
    let name = &device.name.value;
    if let Some(reported) = too_fast(device, signal, span) {
        return Some(reported);
    }
    if is_counter(&device.kind, device) && signal.falls() {
        return Some(value::falls(span, name));
    }
    if is_turning(device) && matches!(signal.shape, Shape::Square { .. }) {
        return Some(value::jumps(span, name));
    }
    let scale = scale_of(&device.shown);
    let each = scale.shown(1.0) - scale.shown(0.0);
    if let (Some(most), Some(wanted)) = (edges_a_second_max(device), signal.steepest())
        && wanted / each >= most
    {
        return Some(value::too_fast(span, name, &short(wanted / each), &short(most)));
    }
    let (least, greatest) = signal.bounds()?;
    let plain = Signal { noise: 0.0, ..signal.clone() };
    let (least, greatest) = plain.bounds().unwrap_or((least, greatest));
    let (low, high) = shown_range(device)?;
    let slack = scale.shown_step(scale.raw(low)).max(scale.shown_step(scale.raw(high))) / 2.0
        + (high - low).abs() * 1e-9;
    let wrong =
        [least, greatest].into_iter().find(|one| *one < low - slack || *one > high + slack)?;
    let unit = device.shown.quantity.as_deref().map(|unit| format!(" {unit}")).unwrap_or_default();
    let range = format!("{} to {}{unit}", short(low), short(high));
    Some(value::out_of_range(span, name, &short(wrong), &range))
}

/// The reason why a signal is too fast to simulate: each edge is a step of the simulation.
fn too_fast(device: &Device, signal: &Signal, span: Span) -> Option<Diagnostic> {
    let name = &device.name.value;
    let most = short(EDGES_A_SECOND_MAX);
    if let Some(period_ns) = signal.period_ns().filter(|period_ns| *period_ns < PERIOD_NS_MIN) {
        let wanted = short(1e9 / crate::arith::number(period_ns.max(1)));
        let what = format!("{wanted} changes a second");
        return Some(e0554_world_too_fast::too_fast(span, name, &what, "100000"));
    }
    let scale = scale_of(&device.shown);
    let each = (scale.shown(1.0) - scale.shown(0.0)).abs().max(f64::MIN_POSITIVE);
    let wanted = signal.fastest() / each;
    (is_turning(device) && wanted > EDGES_A_SECOND_MAX).then(|| {
        let what = format!("{} edges a second", short(wanted));
        e0554_world_too_fast::too_fast(span, name, &what, &most)
    })
}

/// A number for people, with up to six decimals.
pub(super) fn short(number: f64) -> String {
    let text = format!("{number:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// A whole number that is not negative.
fn whole(value: &DeValue<'_>) -> Option<u64> {
    let integer = value.as_integer()?;
    u64::from_str_radix(integer.as_str(), integer.radix()).ok()
}

/// Checks that the times of points rise.
pub(super) fn forwards(
    span: Span,
    times: impl IntoIterator<Item = u64>,
) -> Result<(), Box<Diagnostic>> {
    let mut before: Option<u64> = None;
    for at in times {
        if let Some(before) = before.filter(|before| at <= *before) {
            return Err(time::backwards(span, &seconds(at), &seconds(before)).into());
        }
        before = Some(at);
    }
    Ok(())
}

/// A time for people, in seconds.
fn seconds(at_ns: u64) -> String {
    format!("{} s", short(crate::arith::number(at_ns) / 1e9))
}
