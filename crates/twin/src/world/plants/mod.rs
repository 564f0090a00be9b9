//! The plants of a world: tables `[plants.NAME]` in, what they are out, with a course for each sensor that they feed.
//!
//! The first mistake of each plant is reported with its place. A sensor that several plants, or a plant and a line of
//! `[devices]`, would measure is a mistake.

mod devices;
mod on_wheels;
mod simple;
mod table;

use std::collections::BTreeMap;

use sensedsl_diagnostics::codes::{
    e0540_world_unreadable as unreadable, e0541_world_unknown as unknown,
    e0570_measured_twice::measured_twice,
};
use sensedsl_diagnostics::{Diagnostic, Span, nearest};
use sensedsl_model::design::DeviceIndex;
use toml::Spanned;
use toml::de::DeValue;

use super::file::{Reader, key};
use super::{Shape, Signal};
use crate::plants::{Plant, What};
use crate::range::shown_range;
use table::Keys;

type Failed = Box<Diagnostic>;

/// The words of `kind`.
const KINDS: [&str; 7] =
    ["motor", "servo", "differential_drive", "heater", "battery", "balancer", "process"];

/// Who measures each element of a sensor, and where that stands.
type Claims = BTreeMap<(DeviceIndex, usize), (String, Span)>;

/// What is known while plants are read.
#[derive(Default)]
struct Known {
    plants: Vec<Plant>,
    claims: Claims,
}

impl Known {
    /// The names of all motors so far.
    fn motors(&self) -> impl Iterator<Item = &str> {
        let motors = self.plants.iter().filter(|one| matches!(one.what, What::Motor(_)));
        motors.map(|one| one.name.as_str())
    }
}

impl Reader<'_> {
    /// Reads all plants. Motors come first and batteries last, as others name them or are named by them.
    pub(super) fn plants(&mut self, value: &Spanned<DeValue<'_>>) {
        let Some(table) = value.get_ref().as_table() else {
            let (span, wanted) = (self.span(value), "a table for each plant");
            let example = "[plants.Robot]";
            self.reported.push(unreadable::wrong_sort(span, "`plants`", wanted, example));
            return;
        };
        let mut known = Known::default();
        let mut all = Vec::new();
        for (name, value) in table {
            match self.kind(name.get_ref(), value) {
                Ok(kind) => all.push((kind, name.get_ref().to_string(), value)),
                Err(reported) => self.reported.push(*reported),
            }
        }
        let turn = |kind: &str| match kind {
            "motor" => 0,
            "battery" => 2,
            _ => 1,
        };
        all.sort_by_key(|(kind, ..)| turn(kind));
        for (kind, name, value) in all {
            let Some(table) = value.get_ref().as_table() else { continue };
            let mut keys = Keys::new(self, &name, table, self.span(value), &mut known);
            let read = keys.plant(kind);
            match read {
                Ok(what) => known.plants.push(Plant { name, what }),
                Err(reported) => self.reported.push(*reported),
            }
        }
        self.follow(&known);
        self.world.plants = known.plants;
    }

    /// The kind of a plant.
    fn kind(&self, name: &str, value: &Spanned<DeValue<'_>>) -> Result<&'static str, Failed> {
        let what = format!("`{name}`");
        let span = self.span(value);
        let example = "kind = \"motor\"";
        let Some(table) = value.get_ref().as_table() else {
            let header = format!("[plants.{name}]");
            return Err(unreadable::wrong_sort(span, &what, "a table", &header).into());
        };
        let word =
            table.get("kind").ok_or_else(|| unreadable::missing(span, &what, "kind", example))?;
        let text = word.get_ref().as_str().unwrap_or_default();
        KINDS.into_iter().find(|kind| *kind == text).ok_or_else(|| {
            let (span, near) = (self.span(word), nearest(text, KINDS));
            unknown::unknown_word(span, text, "a plant", near, &KINDS.join(", ")).into()
        })
    }

    /// Gives the sensors that plants feed their courses. What no plant feeds of an array stays at 0.
    fn follow(&mut self, known: &Known) {
        for ((device, _), (plant, span)) in &known.claims {
            let is_here = self.world.signals.contains_key(device);
            if let Some(one) = self.scene.design.device(*device).filter(|_| is_here) {
                let other = "a line under `[devices]`";
                let name = &one.name.value;
                self.reported.push(measured_twice(*span, name, other));
                let _ = plant;
            }
        }
        let feeds = known.plants.iter().flat_map(Plant::feeds);
        let seed = self.scene.seed.or(self.world.seed).unwrap_or(0);
        for feed in feeds {
            let Some(device) = self.scene.design.device(feed.device) else { continue };
            let count = device.value.value.count();
            let rest = shown_range(device).map_or(0.0, |(low, high)| 0.0_f64.max(low).min(high));
            let rest = || (0..count).map(|_| Signal::of(Shape::Constant(rest))).collect();
            let signals = self.world.signals.entry(feed.device).or_insert_with(rest);
            let element = u64::try_from(feed.element).unwrap_or(u64::MAX);
            if let Some(signal) = signals.get_mut(feed.element) {
                let (shape, noise) = (Shape::Followed(feed.course.clone()), feed.noise);
                *signal = Signal { shape, noise, key: key(seed, feed.device, element) };
            }
        }
    }
}
