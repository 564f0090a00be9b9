//! Who gets which values: a text in TOML in, settings for sinks and names of devices out.
//!
//! `spec.rs` has what there is, `reader.rs` reads and tells each mistake with its place, `address.rs` reads addresses,
//! `sample.rs` prints a complete file, `example.rs` its messages. `message.rs` has the messages that several devices go out in, `units.rs` converts
//! what they measure.

mod address;
mod example;
mod message;
mod reader;
mod sample;
mod spec;
mod units;

use std::collections::BTreeMap;

pub use address::{Address, AddressError, listening, remote};
pub use message::{Field, MESSAGES, Message, MessageSpec, Part, Takes};
pub use reader::{read, without_sink};
pub use sample::sample;
pub use spec::{BOARD_KEYS, DEVICE_KEYS, Key, MESSAGE_KEYS, ROS_DISTROS, SINKS, Sort, Spec, find};

/// A value of a key.
#[derive(Clone, Debug, PartialEq)]
pub enum Setting {
    /// A text, a word, or an address.
    Text(String),
    /// Several texts.
    Texts(Vec<String>),
    /// `true` or `false`.
    Flag(bool),
    /// A number.
    Number(f64),
    /// Nothing was said, and there is no usual value.
    Unset,
}

/// What a sink is told of itself: a value for each of its keys.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The sink.
    pub spec: &'static Spec,
    values: BTreeMap<&'static str, Setting>,
}

impl Settings {
    /// The usual ones.
    #[must_use]
    pub fn usual(spec: &'static Spec) -> Self {
        let values = spec.keys.iter().map(|key| (key.name, usual(key.sort))).collect();
        Self { spec, values }
    }

    /// Sets a key.
    pub fn set(&mut self, key: &'static str, value: Setting) {
        self.values.insert(key, value);
    }

    /// The value of a key.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<&Setting> {
        self.values.get(key)
    }

    /// A text; empty if there is none.
    #[must_use]
    pub fn text(&self, key: &str) -> &str {
        match self.values.get(key) {
            Some(Setting::Text(text)) => text,
            _ => "",
        }
    }

    /// Several texts.
    #[must_use]
    pub fn texts(&self, key: &str) -> &[String] {
        match self.values.get(key) {
            Some(Setting::Texts(texts)) => texts,
            _ => &[],
        }
    }

    /// Whether something is so.
    #[must_use]
    pub fn flag(&self, key: &str) -> bool {
        self.values.get(key) == Some(&Setting::Flag(true))
    }

    /// A number, where there is one.
    #[must_use]
    pub fn number(&self, key: &str) -> Option<f64> {
        match self.values.get(key) {
            Some(Setting::Number(number)) => Some(*number),
            _ => None,
        }
    }

    /// A whole number.
    #[must_use]
    pub fn whole(&self, key: &str) -> u32 {
        #[expect(clippy::cast_possible_truncation, reason = "read as a whole number of that size")]
        #[expect(clippy::cast_sign_loss, reason = "read as a whole number of that size")]
        self.number(key).map_or(0, |number| number as u32)
    }
}

/// What counts where nothing is said.
fn usual(sort: Sort) -> Setting {
    match sort {
        Sort::Text(text) | Sort::Remote(text) | Sort::Listen(text) => Setting::Text(text.into()),
        Sort::Word(words) => Setting::Text((*words.first().unwrap_or(&"")).to_owned()),
        Sort::Texts => Setting::Texts(Vec::new()),
        Sort::Flag(flag) => Setting::Flag(flag),
        Sort::Whole(usual, ..) => Setting::Number(usual.into()),
        Sort::Positive(rate) => rate.map_or(Setting::Unset, Setting::Number),
    }
}

/// What is said of a board or a device.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Named {
    /// Its name for other programs.
    pub topic: Option<String>,
    /// Its coordinate frame.
    pub frame: Option<String>,
    /// At most so many values a second.
    pub rate_hz: Option<f64>,
    /// The unit in which it goes out.
    pub unit: Option<String>,
    /// What its shown value is multiplied with.
    pub factor: Option<f64>,
    /// Whether it stays here.
    pub is_left_out: bool,
}

/// A configuration.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Config {
    /// The sinks.
    pub sinks: Vec<Settings>,
    /// What is said of boards.
    pub boards: BTreeMap<String, Named>,
    /// What is said of devices, by board and name.
    pub devices: BTreeMap<(String, String), Named>,
    /// Messages that several devices go out in, for programs that have such.
    pub messages: Vec<Message>,
}

impl Config {
    /// Adds a sink with its usual settings but one; a sink that is there already keeps its others.
    pub fn add(&mut self, spec: &'static Spec, key: &'static str, value: Option<Setting>) {
        let place = self.sinks.iter().position(|one| one.spec.name == spec.name);
        let place = place.unwrap_or_else(|| {
            self.sinks.push(Settings::usual(spec));
            self.sinks.len() - 1
        });
        if let (Some(settings), Some(value)) = (self.sinks.get_mut(place), value) {
            settings.set(key, value);
        }
    }
}
