//! Blocks that stand in for the code of controllers: tables `[controllers.NAME.DEVICE]` in, a PID for each element of what
//! the controller sets out.
//!
//! The first mistake of each block is reported with its place.

use sensedsl_diagnostics::codes::{
    e0540_world_unreadable as unreadable, e0541_world_unknown as unknown,
    e0542_world_value as value,
};
use sensedsl_diagnostics::{Diagnostic, Span, nearest};
use sensedsl_model::design::{Controller, Device, DeviceIndex};
use sensedsl_model::{Expression, Like, expression, reach, unit_of_device};
use toml::Spanned;
use toml::de::{DeArray, DeFloat, DeInteger, DeTable, DeValue};

use super::file::Reader;
use super::pid::{Pid, StandIn};
use crate::truth::scale_of;

/// The keys of a block.
const KEYS: [&str; 8] = ["setpoint", "measured", "kp", "ki", "kd", "feedforward", "min", "max"];

type Value<'i> = Spanned<DeValue<'i>>;
type Failed = Box<Diagnostic>;

impl Reader<'_> {
    /// Reads all blocks.
    pub(super) fn stand_ins(&mut self, all: &Value<'_>) {
        let Some(table) = all.get_ref().as_table() else {
            let (wanted, example) = ("a table for each controller", "[controllers.Follow.Left]");
            let report = unreadable::wrong_sort(self.span(all), "`controllers`", wanted, example);
            self.reported.push(report);
            return;
        };
        for (key, given) in table {
            if let Err(report) = self.stand_in(self.span(key), key.get_ref(), given) {
                self.reported.push(*report);
            }
        }
    }

    fn stand_in(&mut self, at: Span, name: &str, given: &Value<'_>) -> Result<(), Failed> {
        let design = self.scene.design;
        let here =
            design.controllers.iter().filter_map(|one| Some((design.device(one.device)?, one)));
        let here: Vec<_> =
            here.filter(|(_, one)| self.scene.devices.contains(&one.device)).collect();
        let Some((_, controller)) = here.iter().find(|(device, _)| device.name.value == name)
        else {
            let names: Vec<&str> =
                here.iter().map(|(device, _)| device.name.value.as_str()).collect();
            let (near, all) = (nearest(name, names.iter().copied()), names.join(", "));
            let all = if all.is_empty() { "none: the board has no controllers" } else { &all };
            return Err(unknown::unknown_word(at, name, "`[controllers]`", near, all).into());
        };
        let Some(table) = given.get_ref().as_table() else {
            let (what, header) = (format!("`{name}`"), format!("[controllers.{name}.OUTPUT]"));
            return Err(
                unreadable::wrong_sort(at, &what, "a table for each output", &header).into()
            );
        };
        let mut loops = Vec::new();
        for (key, given) in table {
            let (span, word) = (self.span(key), key.get_ref().as_ref());
            let sets = controller
                .sets
                .iter()
                .filter_map(|one| Some((one.value, design.device(one.value)?)));
            let sets: Vec<(DeviceIndex, &Device)> = sets.collect();
            let Some((index, device)) = sets.iter().find(|(_, one)| one.name.value == word) else {
                let names: Vec<&str> =
                    sets.iter().map(|(_, one)| one.name.value.as_str()).collect();
                let (near, all) = (nearest(word, names.iter().copied()), names.join(", "));
                let place = format!("what {name} sets");
                return Err(unknown::unknown_word(span, word, &place, near, &all).into());
            };
            for (element, block) in elements(span, device, given)?.into_iter().enumerate() {
                loops.push(Block { reader: self, controller, name }.pid(
                    (*index, device),
                    element,
                    block,
                )?);
            }
        }
        self.world.stand_ins.push(StandIn { controller: controller.device, loops });
        Ok(())
    }
}

/// The blocks of a device: one, or one for each element.
fn elements<'v, 'i>(
    at: Span,
    device: &Device,
    given: &'v Value<'i>,
) -> Result<Vec<&'v DeTable<'i>>, Failed> {
    let (name, count) = (&device.name.value, device.value.value.count());
    let value = given.get_ref();
    let one = value.as_table().map(|table| vec![table]);
    let each = |all: &'v DeArray<'i>| all.iter().map(|one| one.get_ref().as_table()).collect();
    let blocks: Option<Vec<&DeTable<'_>>> = one.or_else(|| value.as_array().and_then(each));
    let Some(blocks) = blocks else {
        let example =
            format!("{name} = {{ measured = \"Speed\", setpoint = \"Wanted\", kp = 0.5 }}");
        return Err(unreadable::wrong_sort(at, &format!("`{name}`"), "a table", &example).into());
    };
    if blocks.len() == count {
        Ok(blocks)
    } else {
        Err(value::wrong_count(at, name, blocks.len(), count).into())
    }
}

/// Where blocks of a controller are read.
struct Block<'r, 'a> {
    reader: &'r Reader<'a>,
    controller: &'r Controller,
    name: &'r str,
}

impl Block<'_, '_> {
    fn pid(
        &self,
        (index, device): (DeviceIndex, &Device),
        element: usize,
        table: &DeTable<'_>,
    ) -> Result<Pid, Failed> {
        for key in table.keys() {
            let word = key.get_ref().as_ref();
            if !KEYS.contains(&word) {
                let (at, near) = (self.reader.span(key), nearest(word, KEYS));
                let place = format!("a block of {}", self.name);
                return Err(unknown::unknown_word(at, word, &place, near, &KEYS.join(", ")).into());
            }
        }
        let measured = self.expression(table, "measured", Like::Any)?;
        let error = match measured {
            Some(measured) => {
                let zero = Like::Expression(&measured);
                let setpoint = self.expression(table, "setpoint", zero)?;
                let setpoint = setpoint.ok_or_else(|| {
                    let at = self.at(table, "measured");
                    unreadable::missing(at, "`measured`", "setpoint", "setpoint = \"0\"")
                })?;
                Some((measured, setpoint))
            }
            None => None,
        };
        let feedforward = self.expression(table, "feedforward", Like::Device(index))?;
        if error.is_none()
            && let Some(key) =
                ["setpoint", "kp", "ki", "kd"].into_iter().find(|key| table.contains_key(*key))
        {
            let (at, what) = (self.at(table, key), format!("`{key}`"));
            return Err(
                unreadable::missing(at, &what, "measured", "measured = \"Distance\"").into()
            );
        }
        let gain = |key| self.number(table, key).map(|found| found.unwrap_or(0.0));
        // People read an output of pulses in percent, hosts in hundredths of that.
        let share = if unit_of_device(index, device).is_of_ten_thousand { 100.0 } else { 1.0 };
        let scale = scale_of(&device.shown);
        let ends = reach::raw(device).map(|(one, other)| (scale.shown(one), scale.shown(other)));
        let (one, other) = ends.unwrap_or((f64::MIN, f64::MAX));
        let (least, most) = (one.min(other) / share, one.max(other) / share);
        let min = self.number(table, "min")?.map_or(least, |min| min.max(least));
        let max = self.number(table, "max")?.map_or(most, |max| max.min(most));
        if min > max {
            let (at, why) =
                (self.at(table, "max"), "`min` is above it, or it is below what the device takes");
            return Err(value::does_not_fit(at, "max", why, "write the greater number here").into());
        }
        let (kp, ki, kd) = (gain("kp")?, gain("ki")?, gain("kd")?);
        Ok(Pid { device: index, element, error, kp, ki, kd, feedforward, range: (min, max) })
    }

    fn at(&self, table: &DeTable<'_>, key: &str) -> Span {
        let whole = || Span::new(self.reader.file, 0..0);
        table.get(key).map_or_else(whole, |found| self.reader.span(found))
    }

    fn number(&self, table: &DeTable<'_>, key: &str) -> Result<Option<f64>, Failed> {
        let Some(found) = table.get(key) else { return Ok(None) };
        match written(found).and_then(|text| text.parse::<f64>().ok()).filter(|one| one.is_finite())
        {
            Some(number) => Ok(Some(number)),
            None => {
                let (at, what) = (self.reader.span(found), format!("`{key}`"));
                let example = format!("{key} = 0.5");
                Err(unreadable::wrong_sort(at, &what, "a number", &example).into())
            }
        }
    }

    /// An expression over what the controller reads.
    fn expression(
        &self,
        table: &DeTable<'_>,
        key: &'static str,
        like: Like<'_>,
    ) -> Result<Option<Expression>, Failed> {
        let Some(found) = table.get(key) else { return Ok(None) };
        let at = self.reader.span(found);
        let Some(text) = written(found) else {
            let (what, example) = (format!("`{key}`"), format!("{key} = \"Left - Right\""));
            return Err(unreadable::wrong_sort(at, &what, "a text or a number", &example).into());
        };
        let start = usize::try_from(at.start).unwrap_or(0);
        // Behind the mark that begins a text.
        let start = if found.get_ref().is_str() { start + 1 } else { start };
        let (design, mut wrong) = (self.reader.scene.design, Vec::new());
        let read = expression(design, (self.reader.file, start), text, like, &mut wrong);
        let Some(read) = read else {
            let unclear =
                || unreadable::unclear(at, &format!("`{key}`"), "this is not understood", "0");
            return Err(wrong.into_iter().next().unwrap_or_else(unclear).into());
        };
        let is_read =
            |device: DeviceIndex| self.controller.reads.iter().any(|one| one.value == device);
        match read.signals.iter().find(|one| !is_read(one.device)) {
            None => Ok(Some(read)),
            Some(signal) => {
                let why = format!("{} does not read `{}`", self.name, signal.name);
                let help = format!("add it to `reads` of {}, as its code would need it", self.name);
                Err(value::does_not_fit(at, key, &why, &help).into())
            }
        }
    }
}

/// A text, or a number as it is written.
fn written<'v>(of: &'v Value<'_>) -> Option<&'v str> {
    let value = of.get_ref();
    let number =
        || value.as_integer().map(DeInteger::as_str).or(value.as_float().map(DeFloat::as_str));
    value.as_str().or_else(number)
}
