//! The keys of a plant's table, one by one; keys that nobody has asked for are unknown.

use std::cell::RefCell;

use sensedsl_diagnostics::codes::{
    e0540_world_unreadable as unreadable, e0541_world_unknown as unknown, e0542_world_value,
    e0543_world_time as time,
};
use sensedsl_diagnostics::{Span, nearest};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::super::entry::{duration, number};
use super::super::file::Reader;
use super::super::units::{Sort, of_sort, read};
use super::{Failed, Known};
use crate::plants::What;

pub(super) type Value<'i> = Spanned<DeValue<'i>>;

/// The table of a plant, or one within it.
pub(super) struct Keys<'a, 'i> {
    pub(super) reader: &'a Reader<'a>,
    /// What it is of, for people: the plant's name.
    pub(super) name: &'a str,
    table: &'a DeTable<'i>,
    pub(super) span: Span,
    pub(super) known: &'a mut Known,
    /// The keys that were asked for.
    asked: RefCell<Vec<&'static str>>,
}

impl<'a, 'i> Keys<'a, 'i> {
    pub(super) fn new(
        reader: &'a Reader<'_>,
        name: &'a str,
        table: &'a DeTable<'i>,
        span: Span,
        known: &'a mut Known,
    ) -> Self {
        Self { reader, name, table, span, known, asked: RefCell::default() }
    }

    /// A table within this one.
    pub(super) fn within<'b>(&'b mut self, value: &'b Value<'i>) -> Option<Keys<'b, 'i>> {
        let table = value.get_ref().as_table()?;
        let span = self.reader.span(value);
        Some(Keys::new(self.reader, self.name, table, span, self.known))
    }

    /// The plant of a kind.
    pub(super) fn plant(&mut self, kind: &str) -> Result<What, Failed> {
        let _ = self.get("kind");
        let what = match kind {
            "motor" => What::Motor(self.motor()?),
            "servo" => What::Servo(self.servo()?),
            "heater" => What::Heater(self.heater()?),
            "battery" => What::Battery(self.battery()?),
            "process" => What::Process(self.process()?),
            "balancer" => What::Balancer(self.balancer()?.into()),
            _ => What::Robot(self.robot()?.into()),
        };
        self.finish(&format!("a plant of the kind `{kind}`"))?;
        Ok(what)
    }

    /// The value of a key.
    pub(super) fn get(&self, key: &'static str) -> Option<&'a Value<'i>> {
        self.asked.borrow_mut().push(key);
        self.table.get(key)
    }

    pub(super) fn span_of(&self, value: &Value<'_>) -> Span {
        self.reader.span(value)
    }

    /// Reports the first key that was not asked for.
    pub(super) fn finish(&self, place: &str) -> Result<(), Failed> {
        let asked = self.asked.borrow();
        let known = |word: &str| asked.contains(&word);
        let Some(key) = self.table.keys().find(|key| !known(key.get_ref())) else { return Ok(()) };
        let (word, span) = (key.get_ref().as_ref(), self.reader.span(key));
        let near = nearest(word, asked.iter().copied());
        Err(unknown::unknown_word(span, word, place, near, &asked.join(", ")).into())
    }

    pub(super) fn missing(&self, key: &str, example: &str) -> Failed {
        unreadable::missing(self.span, &format!("`{}`", self.name), key, example).into()
    }

    /// A quantity of a sort, in the plants' own unit.
    pub(super) fn quantity(
        &self,
        key: &'static str,
        sort: Sort,
        usual: f64,
    ) -> Result<f64, Failed> {
        self.get(key).map_or(Ok(usual), |value| self.amount(key, value, sort))
    }

    /// A quantity above 0.
    pub(super) fn positive(
        &self,
        key: &'static str,
        sort: Sort,
        usual: f64,
    ) -> Result<f64, Failed> {
        let amount = self.quantity(key, sort, usual)?;
        if amount > 0.0 {
            return Ok(amount);
        }
        let span = self.get(key).map_or(self.span, |value| self.span_of(value));
        let (_, example) = sort.words();
        let help = format!("write for example `{key} = \"{example}\"`");
        Err(e0542_world_value::does_not_fit(span, key, "it must be above 0", &help).into())
    }

    /// A share from 0 to 1.
    pub(super) fn share(&self, key: &'static str, usual: f64) -> Result<f64, Failed> {
        let share = self.quantity(key, Sort::Share, usual)?;
        if (0.0..=1.0).contains(&share) {
            return Ok(share);
        }
        let span = self.get(key).map_or(self.span, |value| self.span_of(value));
        let help = format!("write for example `{key} = \"5 %\"`");
        Err(e0542_world_value::does_not_fit(span, key, "it goes from 0 to 100 %", &help).into())
    }

    /// A value as a quantity of a sort.
    pub(super) fn amount(&self, key: &str, value: &Value<'_>, sort: Sort) -> Result<f64, Failed> {
        let text = value.get_ref().as_str();
        let found = match (text, sort) {
            (Some(text), _) => read(text, sort),
            (None, Sort::Share) => number(value.get_ref()),
            (None, _) => None,
        };
        found.ok_or_else(|| {
            let (what, example) = sort.words();
            let units = of_sort(sort);
            let why = format!("it must be {what}, in {units}");
            let help = format!("write for example `{key} = \"{example}\"`");
            e0542_world_value::does_not_fit(self.span_of(value), key, &why, &help).into()
        })
    }

    /// A time in seconds, which may be written as in the rest of a world.
    pub(super) fn seconds(&self, key: &'static str, usual: f64) -> Result<f64, Failed> {
        let Some(value) = self.get(key) else { return Ok(usual) };
        Ok(crate::arith::number(duration(self.reader.file, value)?) / 1e9)
    }

    /// A time above 0, in nanoseconds.
    pub(super) fn time_ns(&self, key: &'static str, usual: u64) -> Result<u64, Failed> {
        let Some(value) = self.get(key) else { return Ok(usual) };
        match duration(self.reader.file, value)? {
            0 => Err(time::not_a_time(self.span_of(value), "0").into()),
            time => Ok(time),
        }
    }

    pub(super) fn flag(&self, key: &'static str) -> Result<bool, Failed> {
        let Some(value) = self.get(key) else { return Ok(false) };
        let example = format!("{key} = true");
        value.get_ref().as_bool().ok_or_else(|| {
            let (span, what) = (self.span_of(value), format!("`{key}`"));
            unreadable::wrong_sort(span, &what, "`true` or `false`", &example).into()
        })
    }

    /// A plain number, as a device shows it.
    pub(super) fn plain(&self, key: &'static str) -> Result<Option<f64>, Failed> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let example = format!("{key} = 300");
        number(value.get_ref()).map(Some).ok_or_else(|| {
            let (span, what) = (self.span_of(value), format!("`{key}`"));
            unreadable::wrong_sort(span, &what, "a number", &example).into()
        })
    }

    /// A text.
    pub(super) fn text(
        &self,
        key: &'static str,
        example: &str,
    ) -> Result<Option<(&'a str, Span)>, Failed> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let span = self.span_of(value);
        let text = value.get_ref().as_str().map(|text| (text, span));
        text.map(Some).ok_or_else(|| {
            unreadable::wrong_sort(span, &format!("`{key}`"), "a name", example).into()
        })
    }

    /// Two values of a list.
    pub(super) fn pair(
        &self,
        key: &'static str,
        example: &str,
    ) -> Result<Option<[&'a Value<'i>; 2]>, Failed> {
        let Some(value) = self.get(key) else { return Ok(None) };
        let list = value.get_ref().as_array().map(|list| &**list);
        if let Some([one, other]) = list {
            return Ok(Some([one, other]));
        }
        let span = self.span_of(value);
        Err(unreadable::wrong_sort(span, &format!("`{key}`"), "a list of two", example).into())
    }

    /// A list, or a single value as a list of one.
    pub(super) fn list(&self, key: &'static str) -> Vec<&'a Value<'i>> {
        match self.get(key) {
            None => Vec::new(),
            Some(value) => match value.get_ref().as_array() {
                Some(list) => list.iter().collect(),
                None => vec![value],
            },
        }
    }
}
