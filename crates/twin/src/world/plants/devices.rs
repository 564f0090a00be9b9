//! The devices of a plant: the actuators that drive it, and the sensors that it feeds.

use std::f64::consts::TAU;

use sensedsl_diagnostics::codes::e0570_measured_twice::measured_twice;
use sensedsl_diagnostics::codes::e0571_not_for_this_plant::does_not_fit;
use sensedsl_diagnostics::codes::{
    e0540_world_unreadable as unreadable, e0541_world_unknown as unknown,
};
use sensedsl_diagnostics::{Span, nearest};
use sensedsl_model::design::{Device, DeviceIndex};
use sensedsl_model::kind::Interface;
use sensedsl_model::kind::icu::Mode;
use sensedsl_wire::{Direction, ScalarType};

use super::super::Course;
use super::super::file::is_turning;
use super::super::units::{Sort, unit};
use super::Failed;
use super::table::{Keys, Value};
use crate::plants::{Feed, Shows, Source, Vector};
use crate::range::{is_counter, shown_range};
use crate::truth::scale_of;

/// The code of the longest pulse, and that of a converter's reference voltage.
const FULL_LEVEL: f64 = 10_000.0;
const FULL_CODE: f64 = 4_095.0;
/// How long sound takes for a metre there and back.
const ECHO_US_A_METRE: f64 = 5_800.0;

/// A device of the board, with the place of an element if one is named.
struct Named<'d> {
    index: DeviceIndex,
    device: &'d Device,
    element: Option<usize>,
    span: Span,
}

impl<'d> Named<'d> {
    fn count(&self) -> usize {
        self.device.value.value.count()
    }

    fn name(&self) -> &'d str {
        &self.device.name.value
    }

    /// The element that is meant; `None` for one of several.
    fn one(&self) -> Option<usize> {
        self.element.or_else(|| (self.count() == 1).then_some(0))
    }
}

/// How a sensor is named: by a text, or in a table with what else is to be said.
#[derive(Clone, Copy, Debug, Default)]
struct Said {
    counts: Option<f64>,
    is_reversed: bool,
    noise: f64,
    /// What a part adds that is not quite right, as it is shown.
    bias: f64,
    points: Option<[(f64, f64); 2]>,
}

impl<'a, 'i> Keys<'a, 'i> {
    /// The device in a text such as `Line[3]`.
    fn device(&self, text: &str, span: Span, wanted: Direction) -> Result<Named<'a>, Failed> {
        let (name, place) = match text.strip_suffix(']').and_then(|text| text.split_once('[')) {
            Some((name, place)) => (name.trim(), Some(place.trim())),
            None => (text.trim(), None),
        };
        let scene = self.reader.scene;
        let here = scene.devices.iter().filter_map(|at| Some((*at, scene.design.device(*at)?)));
        let here = here.filter(|(_, one)| one.direction == wanted);
        let all: Vec<(DeviceIndex, &Device)> = here.collect();
        let Some((index, device)) = all.iter().find(|(_, one)| one.name.value == name).copied()
        else {
            let names: Vec<&str> = all.iter().map(|(_, one)| one.name.value.as_str()).collect();
            let near = nearest(name, names.iter().copied());
            return Err(match wanted {
                Direction::Actuator => unknown::unknown_actuator(span, name, near, &names).into(),
                Direction::Sensor => {
                    let list: Vec<String> =
                        names.iter().take(12).map(|name| format!("`{name}`")).collect();
                    unknown::unknown_device(span, name, near, &list.join(", ")).into()
                }
            });
        };
        let count = device.value.value.count();
        let element = place.map(|place| place.parse::<usize>().ok().filter(|one| *one < count));
        if let Some(None) = element {
            let why = format!("`{name}` has {count} elements, and `{text}` is not one of them");
            let help = format!("write a place from 0 to {}", count.saturating_sub(1));
            return Err(does_not_fit(span, &why, &help).into());
        }
        Ok(Named { index, device, element: element.flatten(), span })
    }

    /// The actuator of a key, which must be given.
    pub(super) fn source(&self, key: &'static str) -> Result<Source, Failed> {
        let example = format!("{key} = \"Left\"");
        let Some((text, span)) = self.text(key, &example)? else {
            return Err(self.missing(key, &example));
        };
        self.source_of(text, span)
    }

    /// The actuator that a text names.
    pub(super) fn source_of(&self, text: &str, span: Span) -> Result<Source, Failed> {
        let named = self.device(text, span, Direction::Actuator)?;
        let name = named.name();
        let Some(element) = named.one() else {
            let why = format!("`{name}` has {} elements, and one of them is meant", named.count());
            return Err(does_not_fit(span, &why, &format!("write `{name}[0]`")).into());
        };
        if named.device.kind.stepper().is_some() {
            let why =
                format!("`{name}` is a stepper motor, which is where its steps have moved it");
            let help = "take the plant out: a sensor of the motor's position follows by itself";
            return Err(does_not_fit(span, &why, help).into());
        }
        let full = match self.plain("full")? {
            Some(full) if full != 0.0 => full,
            Some(_) | None => full_of(named.device).ok_or_else(|| {
                let why = format!("`{name}` does not say how much full drive is");
                does_not_fit(span, &why, "add what it shows at full drive: `full = 100`")
            })?,
        };
        Ok(Source { device: named.index, element, full })
    }

    /// The actuator that a text names, for whoever needs the device.
    pub(super) fn actuator(
        &self,
        text: &str,
        span: Span,
    ) -> Result<(DeviceIndex, &'a Device), Failed> {
        let named = self.device(text, span, Direction::Actuator)?;
        Ok((named.index, named.device))
    }

    /// The device of a source.
    pub(super) fn device_of(&self, source: &Source) -> Option<&'a Device> {
        self.reader.scene.design.device(source.device)
    }

    /// The sensor of a key, one element; `None` if the key is not there.
    pub(super) fn feed(
        &mut self,
        key: &'static str,
        sort: Sort,
        bounds: Option<(f64, f64)>,
    ) -> Result<Option<Feed>, Failed> {
        let Some(value) = self.get(key) else { return Ok(None) };
        self.feed_of(value, sort, bounds).map(Some)
    }

    /// The sensor that a value names, one element.
    pub(super) fn feed_of(
        &mut self,
        value: &Value<'i>,
        sort: Sort,
        bounds: Option<(f64, f64)>,
    ) -> Result<Feed, Failed> {
        let (named, said) = self.sensor(value)?;
        let Some(element) = named.one() else {
            let (name, count) = (named.name(), named.count());
            let why = format!("`{name}` has {count} elements, and one of them is meant");
            return Err(does_not_fit(named.span, &why, &format!("write `{name}[0]`")).into());
        };
        self.claim(&named, element, sort, bounds, said)
    }

    /// All elements of the sensor that a value names.
    pub(super) fn feeds_of(
        &mut self,
        value: &Value<'i>,
        sort: Sort,
        bounds: Option<(f64, f64)>,
    ) -> Result<Vec<Feed>, Failed> {
        let (named, said) = self.sensor(value)?;
        let elements = named.one().map_or(0..named.count(), |one| one..one + 1);
        elements.map(|element| self.claim(&named, element, sort, bounds, said)).collect()
    }

    /// The sensor of a key that measures along three axes; one of a single value measures along that one.
    pub(super) fn vector(
        &mut self,
        key: &'static str,
        sort: Sort,
        single: usize,
    ) -> Result<Vector, Failed> {
        let mut vector = [None, None, None];
        let Some(value) = self.get(key) else { return Ok(vector) };
        let feeds = self.feeds_of(value, sort, None)?;
        let count = feeds.len();
        if count != 1 && count < 3 {
            let why = format!("a sensor of {count} axes is not known here");
            let help =
                "name one with three elements (forwards, to the left, upwards), or one element";
            return Err(does_not_fit(self.span_of(value), &why, help).into());
        }
        for (place, feed) in feeds.into_iter().take(3).enumerate() {
            let place = if count == 1 { single } else { place };
            if let Some(axis) = vector.get_mut(place) {
                *axis = Some(feed);
            }
        }
        Ok(vector)
    }

    /// The sensor that a value names, and what else it says.
    fn sensor(&mut self, value: &Value<'i>) -> Result<(Named<'a>, Said), Failed> {
        let span = self.span_of(value);
        if let Some(text) = value.get_ref().as_str() {
            return Ok((self.device(text, span, Direction::Sensor)?, Said::default()));
        }
        let wanted = "the name of a sensor, or a table with it";
        let example = "{ sensor = \"Wheel\", counts = 1400 }";
        let Some(keys) = self.within(value) else {
            return Err(unreadable::wrong_sort(span, "this", wanted, example).into());
        };
        let Some((text, at)) = keys.text("sensor", "sensor = \"Wheel\"")? else {
            return Err(keys.missing("sensor", "sensor = \"Wheel\""));
        };
        let name = text.to_owned();
        let said = Said {
            counts: keys.plain("counts")?,
            is_reversed: keys.flag("reversed")?,
            noise: keys.plain("noise")?.unwrap_or(0.0).abs(),
            bias: keys.plain("bias")?.unwrap_or(0.0),
            points: keys.points()?,
        };
        keys.finish("a sensor of a plant")?;
        Ok((self.device(&name, at, Direction::Sensor)?, said))
    }

    /// Two quantities, each with what the sensor shows then.
    fn points(&self) -> Result<Option<[(f64, f64); 2]>, Failed> {
        let example = "points = [[\"-90 deg\", 300], [\"90 deg\", 3700]]";
        let Some(pair) = self.pair("points", example)? else { return Ok(None) };
        let wrong = |value: &Value<'_>| -> Failed {
            let wanted = "two quantities, each with what the sensor shows";
            unreadable::wrong_sort(self.span_of(value), "`points`", wanted, example).into()
        };
        let mut all = [(0.0, 0.0); 2];
        for (target, value) in all.iter_mut().zip(pair) {
            let list = value.get_ref().as_array().map(|list| &**list);
            let Some([quantity, shown]) = list else { return Err(wrong(value)) };
            let text = quantity.get_ref().as_str().unwrap_or_default();
            let sorts =
                [Sort::Angle, Sort::Temperature, Sort::Length, Sort::Voltage, Sort::Current];
            let sorts = sorts.into_iter().chain([Sort::Turning, Sort::Speed, Sort::Acceleration]);
            let quantity = sorts.into_iter().find_map(|sort| super::super::units::read(text, sort));
            let shown = super::super::entry::number(shown.get_ref());
            let both = quantity.zip(shown);
            *target = both.ok_or_else(|| wrong(value))?;
        }
        let [one, other] = all;
        if one.0 == other.0 {
            return Err(wrong(pair[1]));
        }
        Ok(Some(all))
    }

    /// Takes an element of a sensor for the plant.
    fn claim(
        &mut self,
        named: &Named<'_>,
        element: usize,
        sort: Sort,
        bounds: Option<(f64, f64)>,
        said: Said,
    ) -> Result<Feed, Failed> {
        let Named { index, device, span, .. } = *named;
        if let Some((other, _)) = self.known.claims.get(&(index, element)) {
            let other = format!("`{other}`");
            return Err(measured_twice(span, named.name(), &other).into());
        }
        let (factor, offset) = conversion(device, sort, said)
            .map_err(|(why, help)| Box::new(does_not_fit(span, &why, &help)))?;
        let sign = if said.is_reversed { -1.0 } else { 1.0 };
        let range = shown_range(device);
        let shows = Shows {
            factor: sign * factor,
            offset: offset + said.bias,
            range,
            is_counter: is_counter(&device.kind, device),
        };
        let ends = bounds.map(|(least, most)| {
            let [one, other] = [least, most].map(|end| shows.factor * end + shows.offset);
            let within = |end: f64| range.map_or(end, |(low, high)| end.max(low).min(high));
            (within(one.min(other)), within(one.max(other)))
        });
        let is_straight = device.value.value.scalar != ScalarType::Bool || is_turning(device);
        let course = Course::new(is_straight, ends.or_else(|| shown_range(device)));
        let claim = (self.name.to_owned(), span);
        self.known.claims.insert((index, element), claim);
        Ok(Feed { device: index, element, course, shows, noise: said.noise })
    }

    /// All elements of a sensor, which a program gives as they are shown.
    pub(super) fn shown_feeds(&mut self, value: &Value<'i>) -> Result<(String, Vec<Feed>), Failed> {
        let (named, said) = self.sensor(value)?;
        let name = named.name().to_owned();
        let elements = named.one().map_or(0..named.count(), |one| one..one + 1);
        let of = |element| self.claim(&named, element, Sort::Contact, None, said);
        Ok((name, elements.map(of).collect::<Result<_, _>>()?))
    }
}

/// What an actuator shows at full drive; `None` if nothing tells.
fn full_of(device: &Device) -> Option<f64> {
    let shown = &device.shown;
    if shown.quantity.as_deref().is_some_and(|name| matches!(name, "%" | "percent")) {
        return Some(100.0);
    }
    let ends = [shown.min, shown.max].into_iter().flatten().map(f64::abs);
    let most = ends.fold(0.0, f64::max);
    if most > 0.0 {
        return Some(most);
    }
    let scale = scale_of(shown);
    let code = match device.kind.interface() {
        Interface::Digital(_) => Some(1.0),
        Interface::Pwm(_) => Some(FULL_LEVEL),
        Interface::Dac(_) => Some(FULL_CODE),
        Interface::Analog(_)
        | Interface::I2c(_)
        | Interface::Icu(_)
        | Interface::Encoder(_)
        | Interface::Uart(_)
        | Interface::Spi(_)
        | Interface::OneWire(_)
        | Interface::Can(_)
        | Interface::Stepper(_)
        | Interface::Code(_) => (device.value.value.scalar == ScalarType::Bool).then_some(1.0),
    };
    code.map(|code| scale.shown(code)).filter(|full| *full != 0.0)
}

/// Factor and offset from what a plant gives to what a sensor shows; otherwise what is wrong, and what to write.
fn conversion(device: &Device, sort: Sort, said: Said) -> Result<(f64, f64), (String, String)> {
    let name = &device.name.value;
    if let Some([one, other]) = said.points {
        let factor = (other.1 - one.1) / (other.0 - one.0);
        return Ok((factor, one.1 - factor * one.0));
    }
    let scale = scale_of(&device.shown);
    let each = scale.shown(1.0) - scale.shown(0.0);
    if matches!(sort, Sort::Contact | Sort::Share) {
        return Ok((1.0, 0.0));
    }
    let quantity = device.shown.quantity.as_deref().filter(|name| *name != "counts");
    let is_rate =
        matches!(device.kind.interface(), Interface::Icu(own) if own.mode == Mode::Frequency);
    let counted = (sort == Sort::Angle && is_turning(device)) || (sort == Sort::Turning && is_rate);
    if counted {
        // An encoder that shows an angle has a scale for it: what counts is the code.
        let own = device.kind.encoder().and_then(|own| own.counts).map(f64::from);
        let shown = quantity.and_then(|name| unit(name, sort)).map(|(factor, _)| 1.0 / factor);
        if let Some(counts) = said.counts.or(own.filter(|_| shown.is_none())) {
            return Ok((counts / TAU * each, scale.shown(0.0)));
        }
        return shown.map(|factor| (factor, 0.0)).ok_or_else(|| {
            let why = format!("`{name}` does not say how many counts a turn has");
            (why, format!("write `{{ sensor = \"{name}\", counts = 1400 }}`"))
        });
    }
    let is_echo = device.kind.icu().is_some_and(|own| own.pulse_us.is_some());
    if sort == Sort::Length && quantity == Some("us") && is_echo {
        return Ok((ECHO_US_A_METRE, 0.0));
    }
    let (what, example) = sort.words();
    let Some(shown) = quantity else {
        let why = format!("`{name}` shows no unit, and the plant gives {what}");
        let help = format!(
            "say what it shows at two of them: `{{ sensor = \"{name}\", points = [[\"{example}\", 300], [..., 3700]] }}`"
        );
        return Err((why, help));
    };
    unit(shown, sort).map(|(factor, offset)| (1.0 / factor, -offset / factor)).ok_or_else(|| {
        let why = format!("`{name}` shows {shown}, and the plant gives {what}");
        (why, format!("name a sensor that shows {}", super::super::units::of_sort(sort)))
    })
}
