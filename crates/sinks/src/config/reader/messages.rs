//! The tables `[messages.TOPIC]`: devices that go out together, in; messages with a way to each of their numbers, out.

use sensedsl_diagnostics::codes::{
    e0560_sinks_unreadable as unreadable, e0564_sinks_same_topic as topics,
};
use sensedsl_diagnostics::{Span, nearest};
use sensedsl_host::{Board, Device};
use sensedsl_wire::ScalarType;
use toml::de::DeTable;

use super::{Reader, Value, is_topic, setting};
use crate::config::message::{Field, MESSAGES, Message, MessageSpec, Part, Takes};
use crate::config::spec::Key;
use crate::config::units::{Conversion, convert};
use crate::config::{MESSAGE_KEYS, Setting};

/// As many numbers as a vector has.
const VECTOR: usize = 3;

impl<'a> Reader<'a> {
    /// One message.
    pub(super) fn message(&mut self, (at, topic): (Span, &str), value: &Value<'_>) {
        let before = self.reported.len();
        let place = format!("`[messages.{topic}]`");
        let Some(table) = value.get_ref().as_table() else {
            let example = format!("[messages.{topic}]");
            let why = unreadable::wrong_value(at, &place, "a table", &example);
            return self.reported.push(why);
        };
        if !is_topic(topic) {
            self.reported.push(topics::not_a_topic(at, topic));
        }
        let Some(spec) = self.message_type((at, &place), table) else { return };
        let (topic, parts) = (topic.to_owned(), Vec::new());
        let mut message = Message { topic, spec, frame: None, names: Vec::new(), parts };
        // The first device decides when it goes out, so the order of the file counts.
        let mut entries: Vec<_> = table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        for (key, value) in entries {
            let (name, key_at) = (key.get_ref().as_ref(), self.span(key));
            if let Some(field) = spec.fields.iter().find(|field| field.name == name) {
                self.field(field, value, &mut message);
            } else if let Some(key) = keys(spec).find(|key| key.name == name) {
                match setting(self.span(value), key, value.get_ref()) {
                    Ok(Setting::Texts(names)) => message.names = names,
                    Ok(Setting::Text(frame)) if key.name == "frame" => {
                        message.frame = Some(frame).filter(|frame| !frame.is_empty());
                    }
                    Ok(_) => {}
                    Err(why) => self.reported.push(*why),
                }
            } else {
                let all: Vec<&str> = all_keys(spec).collect();
                let near = nearest(name, all.iter().copied());
                let place = format!("the `{}` of {place}", spec.name);
                let all = all.join(", ");
                self.reported.push(unreadable::unknown_key(key_at, name, &place, near, &all));
            }
        }
        if self.reported.len() == before {
            self.whole(at, &place, message);
        }
    }

    /// The type of a message, which must be there.
    fn message_type(
        &mut self,
        (at, place): (Span, &str),
        table: &DeTable<'_>,
    ) -> Option<&'static MessageSpec> {
        let all: Vec<&str> = MESSAGES.iter().map(|spec| spec.name).collect();
        let Some(value) = table.get("type") else {
            self.reported.push(unreadable::no_type(at, place, &all.join(", ")));
            return None;
        };
        let name = value.get_ref().as_str().unwrap_or_default();
        let name = name.strip_prefix("sensor_msgs/").unwrap_or(name);
        let name = name.strip_prefix("msg/").unwrap_or(name);
        let found = MESSAGES.iter().find(|spec| spec.name == name);
        if found.is_none() {
            let near = nearest(name, all.iter().copied());
            let why = unreadable::unknown_type(self.span(value), name, near, &all.join(", "));
            self.reported.push(why);
        }
        found
    }

    /// What is missing in a message that is right as far as it goes.
    fn whole(&mut self, at: Span, place: &str, message: Message) {
        let count = |name: &str| message.parts.iter().filter(|part| part.field == name).count();
        let spec = message.spec;
        let missing = spec.fields.iter().find(|field| field.is_needed && count(field.name) == 0);
        if let Some(field) = missing {
            return self.reported.push(unreadable::lacks(at, place, field.name));
        }
        if message.parts.is_empty() {
            let fields: Vec<&str> = spec.fields.iter().map(|field| field.name).collect();
            return self.reported.push(unreadable::lacks(at, place, &fields.join("` or `")));
        }
        let joints = count("position");
        let names = message.names.len();
        for (name, found) in
            [("velocity", count("velocity")), ("effort", count("effort")), ("names", names)]
        {
            if joints > 0 && found > 0 && found != joints {
                let why = unreadable::other_count(at, (name, found), ("position", joints));
                return self.reported.push(why);
            }
        }
        self.places.insert((String::new(), message.topic.clone()), at);
        self.config.messages.push(message);
    }

    /// The parts of one field.
    fn field(&mut self, field: &'static Field, value: &Value<'_>, message: &mut Message) {
        let list = value.get_ref().as_array();
        let is_vector = field.takes == Takes::Vector;
        let entries: Option<Vec<&Value<'_>>> = match (field.takes, list) {
            (Takes::Number | Takes::State, None) => Some(vec![value]),
            (Takes::Numbers | Takes::Flags, Some(all)) => Some(all.iter().collect()),
            (Takes::Vector, Some(all)) if all.len() == VECTOR => Some(all.iter().collect()),
            (Takes::Vector, None) => Some(vec![value]),
            (Takes::Number | Takes::State | Takes::Numbers | Takes::Flags | Takes::Vector, _) => {
                None
            }
        };
        let Some(entries) = entries else {
            let (wanted, example) = match field.takes {
                Takes::Number | Takes::State => ("the name of a device", "\"Rover/Light\""),
                Takes::Numbers | Takes::Flags => ("a list of devices", "[\"Rover/Left\"]"),
                Takes::Vector => {
                    ("an array of three numbers, or a list of three devices", "\"Rover/Shake\"")
                }
            };
            let example = format!("{} = {example}", field.name);
            let at = self.span(value);
            return self.reported.push(unreadable::wrong_value(at, field.name, wanted, &example));
        };
        let takes_array = is_vector && list.is_none();
        for entry in entries {
            let at = self.span(entry);
            let Some(name) = entry.get_ref().as_str() else {
                let example = format!("\"{}\"", self.example());
                let wanted = "made of names of devices";
                let why = unreadable::wrong_value(at, field.name, wanted, &example);
                self.reported.push(why);
                continue;
            };
            if let Some((board, device, elements)) = self.elements(at, name, takes_array)
                && let Some(way) = self.way(at, field, (name, board, device))
            {
                message.parts.extend(elements.map(|element| Part {
                    field: field.name,
                    board: board.name.clone(),
                    device: device.name.clone(),
                    element,
                    factor: way.factor,
                    offset: way.offset,
                }));
            }
        }
    }

    /// The device of an entry, `Look/Shake` or `Look/Shake[0]`, and which of its numbers are meant.
    fn elements(
        &mut self,
        at: Span,
        entry: &str,
        takes_array: bool,
    ) -> Option<(&'a Board, &'a Device, std::ops::Range<usize>)> {
        let indexed = entry.strip_suffix(']').and_then(|entry| entry.split_once('['));
        let (name, index) = indexed.map_or((entry, None), |(name, index)| (name, Some(index)));
        let Some((board, device)) = self.found(name) else {
            let why = self.no_device(at, name);
            self.reported.push(why);
            return None;
        };
        let count = device.value.count();
        let is_array = device.value.length.is_some();
        let elements = match index.map(str::parse::<usize>) {
            None if takes_array => (is_array && count == VECTOR).then_some(0..VECTOR),
            None => (!is_array).then_some(0..1),
            Some(Ok(index)) if !takes_array && is_array && index < count => Some(index..index + 1),
            Some(_) => None,
        };
        if elements.is_none() {
            let length = device.value.length.map(usize::from);
            let why = unreadable::wrong_element(at, entry, name, length, takes_array);
            self.reported.push(why);
        }
        Some((board, device, elements?))
    }

    /// What is done to a device's numbers for a field.
    fn way(
        &mut self,
        at: Span,
        field: &Field,
        (name, board, device): (&str, &Board, &Device),
    ) -> Option<Conversion> {
        let is_flag = device.value.scalar == ScalarType::Bool;
        let is_right = match field.takes {
            Takes::Flags => is_flag,
            Takes::State => true,
            Takes::Number | Takes::Numbers | Takes::Vector => !is_flag,
        };
        if !is_right {
            self.reported.push(unreadable::wrong_sort(at, name, field.name, is_flag));
            return None;
        }
        if field.units.is_empty() {
            return Some(Conversion { factor: 1.0, offset: 0.0 });
        }
        let key = (board.name.clone(), device.name.clone());
        let own = self.config.devices.get(&key).and_then(|named| named.unit.as_deref());
        let unit = own.or(device.quantity.as_deref());
        let found = field.units.iter().find_map(|wanted| convert(device, unit, wanted));
        if found.is_none() {
            let wanted = field.units.join(" or ");
            self.reported.push(unreadable::other_unit(at, (field.name, &wanted), name, unit));
        }
        found
    }

    fn example(&self) -> String {
        let named = self.boards.iter().find_map(|board| {
            let device = board.devices.first()?;
            Some(format!("{}/{}", board.name, device.name))
        });
        named.unwrap_or_else(|| "Rover/Light".to_owned())
    }
}

/// The keys of a type that are no fields.
fn keys(spec: &MessageSpec) -> impl Iterator<Item = &'static Key> {
    let has_names = spec.name == "JointState";
    MESSAGE_KEYS.iter().filter(move |key| key.name != "names" || has_names)
}

fn all_keys(spec: &MessageSpec) -> impl Iterator<Item = &'static str> {
    spec.fields.iter().map(|field| field.name).chain(keys(spec).map(|key| key.name))
}
