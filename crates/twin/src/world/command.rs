//! The values that a world has the host set, and their times: `[[command]]`.

use sensedsl_diagnostics::codes::{
    e0540_world_unreadable as unreadable, e0541_world_unknown as unknown,
    e0542_world_value as value,
};
use sensedsl_diagnostics::{Diagnostic, Span, nearest};
use sensedsl_model::design::{Device, DeviceIndex};
use sensedsl_model::given::{self, EnteredValue, EntryError};
use sensedsl_wire::{Direction, Scalar};
use toml::Spanned;
use toml::de::DeValue;

use super::entry::{duration, number};
use super::file::{Reader, short};
use crate::commands::Command;
use crate::truth::{scalar, scale_of};

type Value<'i> = Spanned<DeValue<'i>>;

impl<'a> Reader<'a> {
    pub(super) fn commands(&mut self, list: &Value<'_>) {
        let Some(all) = list.get_ref().as_array() else {
            let (span, wanted) = (self.span(list), "a block of its own");
            self.reported.push(unreadable::wrong_sort(span, "`command`", wanted, "[[command]]"));
            return;
        };
        for one in all {
            match self.command(one) {
                Ok(command) => self.world.commands.push(command),
                Err(reported) => self.reported.push(*reported),
            }
        }
    }

    fn command(&self, one: &Value<'_>) -> Result<Command, Box<Diagnostic>> {
        let span = self.span(one);
        let Some(table) = one.get_ref().as_table() else {
            return Err(unreadable::wrong_sort(span, "a command", "a table", "[[command]]").into());
        };
        for key in table.keys() {
            let (all, word) = (["device", "at", "value"], key.get_ref().as_ref());
            if !all.contains(&word) {
                let (at, near) = (self.span(key), nearest(word, all));
                let list = "`device`, `at` and `value`";
                return Err(unknown::unknown_word(at, word, "a command", near, list).into());
            }
        }
        let missing = |needs, example| unreadable::missing(span, "a command", needs, example);
        let device = table.get("device").ok_or_else(|| missing("device", "device = \"Servo\""))?;
        let at = table.get("at").ok_or_else(|| missing("at", "at = \"3 s\""))?;
        let wanted = table.get("value").ok_or_else(|| missing("value", "value = 50"))?;
        let name = device.get_ref().as_str().unwrap_or_default();
        let (index, device) = self.actuator(self.span(device), name)?;
        let at_ns = duration(self.file, at)?;
        Ok(Command { device: index, at_ns, value: self.elements(device, wanted)? })
    }

    /// The actuator of that name on the board.
    fn actuator(
        &self,
        span: Span,
        name: &str,
    ) -> Result<(DeviceIndex, &'a Device), Box<Diagnostic>> {
        let design = self.scene.design;
        let here = self.scene.devices.iter().filter_map(|at| Some((*at, design.device(*at)?)));
        let here = here.filter(|(_, one)| one.direction == Direction::Actuator);
        let all: Vec<(DeviceIndex, &Device)> = here.collect();
        let found = all.iter().find(|(_, one)| one.name.value == name);
        found.copied().ok_or_else(|| {
            let names: Vec<&str> = all.iter().map(|(_, one)| one.name.value.as_str()).collect();
            let near = nearest(name, names.iter().copied());
            unknown::unknown_actuator(span, name, near, &names).into()
        })
    }

    /// The scalars on the wire for a value as a host shows it: one for all elements, or one for
    /// each.
    fn elements(
        &self,
        device: &Device,
        wanted: &Value<'_>,
    ) -> Result<Vec<Scalar>, Box<Diagnostic>> {
        let count = device.value.value.count();
        let name = &device.name.value;
        match wanted.get_ref().as_array() {
            None => Ok(vec![self.element(device, wanted)?; count]),
            Some(list) if list.len() == count => {
                list.iter().map(|one| self.element(device, one)).collect()
            }
            Some(list) => {
                Err(value::wrong_count(self.span(wanted), name, list.len(), count).into())
            }
        }
    }

    fn element(&self, device: &Device, wanted: &Value<'_>) -> Result<Scalar, Box<Diagnostic>> {
        let span = self.span(wanted);
        let (scale, of) = (scale_of(&device.shown), device.value.value.scalar);
        let name = &device.name.value;
        let read = match wanted.get_ref().as_str() {
            Some(text) => given::value(text, device),
            None => number(wanted.get_ref()).map(EnteredValue::Shown).ok_or(EntryError::NoNumber),
        };
        let (raw, words) = match read {
            Ok(EnteredValue::Shown(shown)) => (scale.raw(shown), short(shown)),
            Ok(EnteredValue::Code(code)) => (code, format!("raw {}", short(code))),
            Err(EntryError::ValueMismatch(why, help)) => {
                return Err(value::does_not_fit(span, name, &why, &help).into());
            }
            Err(EntryError::NoNumber) => {
                let what = format!("what `{name}` is set to");
                let wanted = "a number, a text with a unit, `true` or `false`";
                return Err(unreadable::wrong_sort(span, &what, wanted, "value = 50").into());
            }
        };
        #[expect(clippy::cast_precision_loss, reason = "the ends of 64 bits are rounded")]
        let held = of.integer_range().map(|(least, most)| (least as f64, most as f64));
        if let Some((least, most)) = held
            && !(least - 0.5..=most + 0.5).contains(&raw)
        {
            let [one, other] = [least, most].map(|end| scale.shown(end));
            let range = format!("{} to {}", short(one.min(other)), short(one.max(other)));
            return Err(value::out_of_range(span, name, &words, &range).into());
        }
        Ok(scalar(of, raw))
    }
}
