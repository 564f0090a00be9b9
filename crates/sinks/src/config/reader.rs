//! The reader of a configuration: TOML in, settings and mistakes with their places out.

mod messages;

use std::collections::BTreeMap;

use sensedsl_diagnostics::codes::{
    e0560_sinks_unreadable as unreadable, e0561_sinks_unknown as unknown,
    e0562_sinks_address as wrong_address, e0563_sink_not_built, e0564_sinks_same_topic as topics,
};
use sensedsl_diagnostics::{Diagnostic, FileId, Span, nearest};
use sensedsl_host::{Board, Device};
use sensedsl_limits::CONFIG_TABLES_MAX;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{
    BOARD_KEYS, Config, DEVICE_KEYS, Key, Named, SINKS, Setting, Settings, Sort, listening, remote,
};
use crate::plan::Plan;

/// The most characters of a text: topics and names are shorter.
const TEXT_CHARS_MAX: usize = 200;
/// The most names that a message lists.
const LISTED_MAX: usize = 12;

type Value<'i> = Spanned<DeValue<'i>>;

/// Reads a configuration for the boards of a design.
#[must_use]
pub fn read(file: FileId, text: &str, boards: &[Board]) -> (Config, Vec<Diagnostic>) {
    let start = Span::new(file, 0..0);
    let mut reader = Reader {
        file,
        boards,
        config: Config::default(),
        reported: Vec::new(),
        places: BTreeMap::new(),
    };
    let tables = text.bytes().filter(|byte| matches!(byte, b'[' | b'{' | b'.')).count();
    if tables > CONFIG_TABLES_MAX {
        let wanted = format!("a text with at most {CONFIG_TABLES_MAX} tables and lists");
        let why = unreadable::wrong_value(start, "configuration", &wanted, "[mqtt]");
        return (reader.config, vec![why]);
    }
    match DeTable::parse(text) {
        Ok(table) => reader.tables(table.get_ref()),
        Err(error) => {
            let range = error.span().unwrap_or(0..0);
            let range = range.start.min(text.len())..range.end.min(text.len());
            let span = Span::new(file, range);
            reader.reported.push(unreadable::not_toml(span, error.message()));
        }
    }
    if reader.reported.is_empty() {
        reader.clashes(start);
    }
    (reader.config, reader.reported)
}

/// What is wrong with a configuration that names no program.
pub fn without_sink(file: FileId) -> Diagnostic {
    let all: Vec<String> = SINKS.iter().map(|spec| format!("`[{}]`", spec.name)).collect();
    unreadable::no_sink(Span::new(file, 0..0), &all.join(", "))
}

struct Reader<'a> {
    file: FileId,
    boards: &'a [Board],
    config: Config,
    reported: Vec<Diagnostic>,
    /// Where the topic of a device or board stands.
    places: BTreeMap<(String, String), Span>,
}

impl<'a> Reader<'a> {
    fn span<T>(&self, of: &Spanned<T>) -> Span {
        Span::new(self.file, of.span())
    }

    fn tables(&mut self, table: &DeTable<'_>) {
        for (key, value) in table {
            let (name, at) = (key.get_ref().as_ref(), self.span(key));
            if name == "messages" {
                // What is said of devices counts for them, so they come last.
                continue;
            }
            if name == "boards" {
                self.named(value, "boards", Self::board);
            } else if name == "devices" {
                self.named(value, "devices", Self::device);
            } else if let Some(spec) = SINKS.iter().find(|spec| spec.name == name) {
                if !spec.is_built {
                    let why = e0563_sink_not_built::not_built(at, spec.name, spec.name);
                    self.reported.push(why);
                    continue;
                }
                let mut settings = Settings::usual(spec);
                let place = format!("`[{name}]`");
                for (key, setting) in self.keys(&place, value, spec.keys) {
                    settings.set(key.name, setting);
                }
                self.config.sinks.push(settings);
            } else {
                let mut all: Vec<&str> = SINKS.iter().map(|spec| spec.name).collect();
                all.extend(["boards", "devices", "messages"]);
                let near = nearest(name, all.iter().copied());
                let place = "a configuration";
                let why = unreadable::unknown_key(at, name, place, near, &all.join(", "));
                self.reported.push(why);
            }
        }
        if let Some(value) = table.get("messages") {
            self.named(value, "messages", Self::message);
        }
    }

    fn named(
        &mut self,
        value: &Value<'_>,
        name: &str,
        mut read: impl FnMut(&mut Self, (Span, &str), &Value<'_>),
    ) {
        let Some(table) = value.get_ref().as_table() else {
            let at = self.span(value);
            let example = match name {
                "boards" => "[boards.Rover]",
                "devices" => "[devices.\"Rover/Light\"]",
                _ => "[messages.pad]",
            };
            self.reported.push(unreadable::wrong_value(at, name, "tables", example));
            return;
        };
        for (key, value) in table {
            read(self, (self.span(key), key.get_ref()), value);
        }
    }

    fn board(&mut self, (at, name): (Span, &str), value: &Value<'_>) {
        let names = || self.boards.iter().map(|board| board.name.as_str());
        if !names().any(|one| one == name) {
            let why = unknown_name(at, "board", name, &names().collect::<Vec<_>>());
            return self.reported.push(why);
        }
        let place = format!("`[boards.{name}]`");
        let keys = self.keys(&place, value, BOARD_KEYS);
        let mut named = Named::default();
        for (key, setting) in keys {
            fill(&mut named, key.name, setting);
        }
        self.topic(value, (name.to_owned(), String::new()), named.topic.as_deref());
        self.config.boards.insert(name.to_owned(), named);
    }

    fn device(&mut self, (at, name): (Span, &str), value: &Value<'_>) {
        let Some((board, device)) = self.found(name) else {
            let why = self.no_device(at, name);
            return self.reported.push(why);
        };
        let place = format!("`[devices.\"{name}\"]`");
        let keys = self.keys(&place, value, DEVICE_KEYS);
        let mut named = Named::default();
        for (key, setting) in keys {
            fill(&mut named, key.name, setting);
        }
        if let (Some(unit), None) = (&named.unit, named.factor) {
            match device.factor(unit) {
                Ok(factor) => named.factor = Some(1.0 / factor),
                Err(_) => {
                    let at = entry(value, "unit").map_or(at, |unit| self.span(unit));
                    let quantity = device.quantity.as_deref();
                    self.reported.push(unreadable::wrong_unit(at, unit, name, quantity));
                }
            }
        }
        let key = (board.name.clone(), device.name.clone());
        self.topic(value, key.clone(), named.topic.as_deref());
        self.config.devices.insert(key, named);
    }

    /// That there is no such device.
    fn no_device(&self, at: Span, name: &str) -> Diagnostic {
        let of = |board: &'a Board| {
            board.devices.iter().map(|device| format!("{}/{}", board.name, device.name))
        };
        let all: Vec<String> = self.boards.iter().flat_map(of).collect();
        let all: Vec<&str> = all.iter().map(String::as_str).collect();
        unknown_name(at, "device", name, &all)
    }

    /// The device of a name with its board, or with a name that only one board has.
    fn found(&self, name: &str) -> Option<(&'a Board, &'a Device)> {
        let boards: &'a [Board] = self.boards;
        let on = |board: &'a Board, name: &str| {
            board.devices.iter().find(|device| device.name == name).map(|device| (board, device))
        };
        if let Some((board, name)) = name.split_once('/') {
            return boards.iter().find(|one| one.name == board).and_then(|board| on(board, name));
        }
        let mut all = boards.iter().filter_map(|board| on(board, name));
        all.next().filter(|_| all.next().is_none())
    }

    /// Checks a topic, and keeps its place.
    fn topic(&mut self, table: &Value<'_>, key: (String, String), topic: Option<&str>) {
        let (Some(topic), Some(value)) = (topic, entry(table, "topic")) else { return };
        let at = self.span(value);
        self.places.insert(key, at);
        if !is_topic(topic) {
            self.reported.push(topics::not_a_topic(at, topic));
        }
    }

    /// The settings of a table.
    fn keys(
        &mut self,
        place: &str,
        table: &Value<'_>,
        keys: &'static [Key],
    ) -> Vec<(&'static Key, Setting)> {
        let Some(table) = table.get_ref().as_table() else {
            let at = self.span(table);
            self.reported.push(unreadable::wrong_value(
                at,
                place,
                "a table",
                place.trim_matches('`'),
            ));
            return Vec::new();
        };
        let mut found = Vec::new();
        for (name, value) in table {
            let word = name.get_ref().as_ref();
            let Some(key) = keys.iter().find(|key| key.name == word) else {
                let all: Vec<&str> = keys.iter().map(|key| key.name).collect();
                let near = nearest(word, all.iter().copied());
                let at = self.span(name);
                self.reported.push(unreadable::unknown_key(at, word, place, near, &all.join(", ")));
                continue;
            };
            match setting(self.span(value), key, value.get_ref()) {
                Ok(setting) => found.push((key, setting)),
                Err(why) => self.reported.push(*why),
            }
        }
        found
    }

    /// Two devices, or a device and a message, with one topic.
    fn clashes(&mut self, start: Span) {
        let plan = Plan::new(self.boards, &self.config, None);
        let messages = self.config.messages.iter().map(|message| {
            let key = (String::new(), message.topic.clone());
            (message.topic.as_str(), format!("messages.{}", message.topic), key)
        });
        let mut seen: BTreeMap<&str, String> = BTreeMap::new();
        let boards = plan.boards.iter().filter(|on| on.routes.iter().any(|one| !one.is_left_out));
        let boards = boards.map(|on| {
            let key = (on.board.name.clone(), String::new());
            (on.topic.as_str(), on.board.name.clone(), key)
        });
        let devices = plan.places().map(|place| {
            let (board, device) = (&place.on.board.name, &place.device.name);
            let key = (board.clone(), device.clone());
            (place.route.topic.as_str(), format!("{board}/{device}"), key)
        });
        for (topic, name, key) in boards.chain(devices).chain(messages) {
            match seen.get(topic) {
                None => {
                    seen.insert(topic, name);
                }
                Some(other) => {
                    let at = self.places.get(&key).copied().unwrap_or(start);
                    self.reported.push(topics::same_topic(at, topic, other, &name));
                }
            }
        }
    }
}

/// Whether a text is words with `/` between them, as all programs take them.
fn is_topic(text: &str) -> bool {
    text.split('/').all(|word| {
        let is_letter = |c: char| c.is_ascii_alphanumeric() || c == '_';
        word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && word.chars().all(is_letter)
    })
}

fn entry<'t, 'i>(table: &'t Value<'i>, key: &str) -> Option<&'t Value<'i>> {
    table.get_ref().as_table()?.get(key)
}

fn unknown_name(at: Span, sort: &str, name: &str, all: &[&str]) -> Diagnostic {
    let near = nearest(name, all.iter().copied());
    let listed: Vec<String> = all.iter().take(LISTED_MAX).map(|name| format!("`{name}`")).collect();
    unknown::unknown_name(at, sort, name, near, &listed.join(", "))
}

fn fill(named: &mut Named, key: &str, setting: Setting) {
    match (key, setting) {
        ("topic", Setting::Text(text)) if !text.is_empty() => named.topic = Some(text),
        ("frame", Setting::Text(text)) if !text.is_empty() => named.frame = Some(text),
        ("unit", Setting::Text(text)) if !text.is_empty() => named.unit = Some(text),
        ("rate_hz", Setting::Number(number)) => named.rate_hz = Some(number),
        ("scale", Setting::Number(number)) => named.factor = Some(number),
        ("leave_out", Setting::Flag(flag)) => named.is_left_out = flag,
        _ => {}
    }
}

/// The value of a key, or what is wrong with it.
fn setting(at: Span, key: &Key, value: &DeValue<'_>) -> Result<Setting, Box<Diagnostic>> {
    let wrong = |wanted: &str, example: &str| {
        let example = format!("{} = {example}", key.name);
        Box::new(unreadable::wrong_value(at, key.name, wanted, &example))
    };
    match key.sort {
        Sort::Text(_) => {
            let text = text(value)
                .ok_or_else(|| wrong("a short text without control characters", "\"name\""))?;
            Ok(Setting::Text(text))
        }
        Sort::Word(words) => {
            let list =
                words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(" or ");
            let example = format!("\"{}\"", words.first().unwrap_or(&""));
            let word = text(value).filter(|word| words.contains(&word.as_str()));
            Ok(Setting::Text(word.ok_or_else(|| wrong(&list, &example))?))
        }
        Sort::Texts => {
            let all = value
                .as_array()
                .and_then(|all| all.iter().map(|one| text(one.get_ref())).collect());
            Ok(Setting::Texts(all.ok_or_else(|| wrong("a list of short texts", "[\"text\"]"))?))
        }
        Sort::Flag(usual) => {
            let flag = value
                .as_bool()
                .ok_or_else(|| wrong("`true` or `false`", if usual { "false" } else { "true" }))?;
            Ok(Setting::Flag(flag))
        }
        Sort::Whole(usual, least, most) => {
            let number = number(value).filter(|number| {
                number.fract() == 0.0 && (f64::from(least)..=f64::from(most)).contains(number)
            });
            let wanted = format!("a whole number from {least} to {most}");
            Ok(Setting::Number(number.ok_or_else(|| wrong(&wanted, &usual.to_string()))?))
        }
        Sort::Positive(_) => {
            let number = number(value).filter(|number| (1e-9..=1e9).contains(number));
            Ok(Setting::Number(number.ok_or_else(|| wrong("a number above 0", "10"))?))
        }
        Sort::Remote(example) | Sort::Listen(example) => {
            let text = text(value).ok_or_else(|| wrong("an address", &format!("\"{example}\"")))?;
            checked(at, key.sort, &text)?;
            Ok(Setting::Text(text))
        }
    }
}

/// Checks an address.
///
/// # Errors
/// Fails with E0562 if the text is not an address of that sort.
pub(super) fn checked(at: Span, sort: Sort, text: &str) -> Result<(), Box<Diagnostic>> {
    let (why, example) = match sort {
        Sort::Remote(example) => (remote(text, None).err(), example),
        Sort::Listen(example) => (listening(text).err(), example),
        Sort::Text(_)
        | Sort::Word(_)
        | Sort::Texts
        | Sort::Flag(_)
        | Sort::Whole(..)
        | Sort::Positive(_) => (None, ""),
    };
    match why {
        None => Ok(()),
        Some(why) => {
            Err(Box::new(wrong_address::not_an_address(at, text, &why.to_string(), example)))
        }
    }
}

fn text(value: &DeValue<'_>) -> Option<String> {
    let text = value.as_str()?;
    let is_short = text.chars().count() <= TEXT_CHARS_MAX;
    (is_short && !text.chars().any(char::is_control)).then(|| text.to_owned())
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    let text = match value {
        DeValue::Integer(number) if number.radix() == 10 => number.as_str(),
        DeValue::Float(number) => number.as_str(),
        DeValue::Integer(_)
        | DeValue::String(_)
        | DeValue::Boolean(_)
        | DeValue::Datetime(_)
        | DeValue::Array(_)
        | DeValue::Table(_) => return None,
    };
    text.replace('_', "").parse().ok().filter(|number: &f64| number.is_finite())
}
