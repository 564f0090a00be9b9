//! Under which name, how often and in which unit each device goes out.
//!
//! In: boards and what a configuration says of them. Out: a [`Plan`] that all sinks share, with a route for each device.

use std::time::Duration;

use sensedsl_host::{Board, Device};
use sensedsl_wire::{Direction, Scalar, ScalarType};
use serde_json::{Map, Number, Value};

use crate::config::{Config, Message, Part};
use crate::event::Values;

/// From this rate on all values pass: several that come at once are not too many for it.
const ALL_HZ: f64 = 100_000.0;

/// How one device goes out.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    /// Its name for other programs: words with `/` between them.
    pub topic: String,
    /// The name of its place, for programs that have coordinate frames.
    pub frame: String,
    /// The least time between two of its values; none for all of them.
    pub period: Option<Duration>,
    /// What its shown number is multiplied with.
    pub factor: f64,
    /// The unit of what comes of it.
    pub unit: Option<String>,
    /// Whether it stays here.
    pub is_left_out: bool,
    /// Whether a message needs it, although it may stay here itself.
    pub is_in_message: bool,
}

/// How one board goes out.
#[derive(Clone, Debug, PartialEq)]
pub struct BoardPlan {
    /// The board.
    pub board: Board,
    /// Its name for other programs.
    pub topic: String,
    /// A route for each device.
    pub routes: Vec<Route>,
}

/// How all boards go out, in the order in which they are watched.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// The boards.
    pub boards: Vec<BoardPlan>,
    /// Messages that several devices go out in.
    pub messages: Vec<Composed>,
}

/// A message that several devices go out in.
#[derive(Clone, Debug, PartialEq)]
pub struct Composed {
    /// What it is made of.
    pub message: Message,
    /// The board and the device of each of its parts, by their places.
    pub sources: Vec<(usize, usize)>,
}

/// A device with all that is known of it.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// The place of its board.
    pub board: usize,
    /// Its place among the board's devices.
    pub index: usize,
    /// The board.
    pub on: &'a BoardPlan,
    /// The device.
    pub device: &'a Device,
    /// How it goes out.
    pub route: &'a Route,
}

impl Plan {
    /// How boards go out to a sink that takes at most so many values a second of each device.
    #[must_use]
    pub fn new<'b>(
        boards: impl IntoIterator<Item = &'b Board>,
        config: &Config,
        rate_hz: Option<f64>,
    ) -> Self {
        let boards = boards.into_iter().map(|board| {
            let of_board = config.boards.get(&board.name).cloned().unwrap_or_default();
            let topic = of_board.topic.clone().unwrap_or_else(|| board.name.clone());
            let frame = of_board.frame.clone().unwrap_or_else(|| topic.replace('/', "_"));
            let routes = board.devices.iter().map(|device| {
                let key = (board.name.clone(), device.name.clone());
                let own = config.devices.get(&key).cloned().unwrap_or_default();
                let rates = [own.rate_hz, of_board.rate_hz, rate_hz];
                let rate_hz = rates.into_iter().flatten().reduce(f64::min);
                let rate_hz = rate_hz.filter(|rate_hz| *rate_hz < ALL_HZ);
                Route {
                    topic: own.topic.unwrap_or_else(|| format!("{topic}/{}", device.name)),
                    frame: own.frame.unwrap_or_else(|| frame.clone()),
                    period: rate_hz.map(|rate_hz| Duration::from_secs_f64(1.0 / rate_hz)),
                    factor: own.factor.unwrap_or(1.0),
                    unit: own.unit.or_else(|| device.quantity.clone()),
                    is_left_out: own.is_left_out || of_board.is_left_out,
                    is_in_message: false,
                }
            });
            BoardPlan { board: board.clone(), topic: topic.clone(), routes: routes.collect() }
        });
        Self { boards: boards.collect(), messages: Vec::new() }
    }

    /// The same with the messages of a configuration, for a sink that has such. A message of boards that are not
    /// watched never comes about, and is left out.
    #[must_use]
    pub fn with_messages(mut self, config: &Config) -> Self {
        for message in &config.messages {
            let place = |part: &Part| {
                let board = self.boards.iter().position(|on| on.board.name == part.board)?;
                let devices = &self.boards.get(board)?.board.devices;
                Some((board, devices.iter().position(|device| device.name == part.device)?))
            };
            let sources: Option<Vec<(usize, usize)>> = message.parts.iter().map(place).collect();
            let Some(sources) = sources else { continue };
            for (board, index) in &sources {
                let on = self.boards.get_mut(*board);
                if let Some(route) = on.and_then(|on| on.routes.get_mut(*index)) {
                    route.is_in_message = true;
                }
            }
            self.messages.push(Composed { message: message.clone(), sources });
        }
        self
    }

    /// A board.
    #[must_use]
    pub fn board(&self, board: usize) -> Option<&BoardPlan> {
        self.boards.get(board)
    }

    /// A device that goes out.
    #[must_use]
    pub fn place(&self, board: usize, index: usize) -> Option<Place<'_>> {
        self.any_place(board, index).filter(|place| !place.route.is_left_out)
    }

    /// A device, whether it goes out or stays here.
    #[must_use]
    pub fn any_place(&self, board: usize, index: usize) -> Option<Place<'_>> {
        let on = self.boards.get(board)?;
        let (device, route) = (on.board.devices.get(index)?, on.routes.get(index)?);
        Some(Place { board, index, on, device, route })
    }

    /// All devices that go out.
    pub fn places(&self) -> impl Iterator<Item = Place<'_>> {
        let boards = self.boards.iter().enumerate();
        boards.flat_map(move |(board, on)| {
            (0..on.routes.len()).filter_map(move |index| self.place(board, index))
        })
    }

    /// The devices of a report that go out, with their raw values.
    pub fn of<'a>(&'a self, values: &'a Values) -> impl Iterator<Item = (Place<'a>, &'a [Scalar])> {
        let all = values.values.iter();
        all.filter_map(|(index, raw)| Some((self.place(values.board, *index)?, raw.as_slice())))
    }

    /// The actuator with that topic.
    #[must_use]
    pub fn actuator(&self, topic: &str) -> Option<Place<'_>> {
        self.places().find(|one| one.is_actuator() && one.route.topic == topic)
    }
}

impl Place<'_> {
    /// Whether it is set, and not measured.
    #[must_use]
    pub fn is_actuator(&self) -> bool {
        self.device.direction == Direction::Actuator
    }

    /// Whether its elements are true or false.
    #[must_use]
    pub fn is_bool(&self) -> bool {
        self.device.value.scalar == ScalarType::Bool
    }

    /// The number of an element that goes out; a `bool` is 0 or 1.
    #[must_use]
    pub fn number(&self, raw: Scalar) -> f64 {
        self.scaled(self.device.shown(raw))
    }

    /// A shown number, such as a limit, as it goes out.
    #[must_use]
    pub fn scaled(&self, shown: f64) -> f64 {
        // What is not scaled stays exactly what people see.
        if self.route.factor == 1.0 { shown } else { tidy(shown * self.route.factor) }
    }

    /// The shown value in JSON: a list for an array, `true` or `false` for a `bool`, null for what is no number.
    #[must_use]
    pub fn json(&self, raw: &[Scalar]) -> Value {
        self.one_or_all(raw.iter().map(|one| match one {
            Scalar::Bool(flag) => Value::Bool(*flag),
            Scalar::Unsigned(_) | Scalar::Signed(_) | Scalar::Float32(_) | Scalar::Float64(_) => {
                real(self.number(*one))
            }
        }))
    }

    /// The raw value in JSON.
    #[must_use]
    pub fn raw_json(&self, raw: &[Scalar]) -> Value {
        self.one_or_all(raw.iter().map(|one| match *one {
            Scalar::Bool(flag) => Value::Bool(flag),
            Scalar::Unsigned(number) => number.into(),
            Scalar::Signed(number) => number.into(),
            Scalar::Float32(number) => real(number.into()),
            Scalar::Float64(number) => real(number),
        }))
    }

    fn one_or_all(&self, mut all: impl Iterator<Item = Value>) -> Value {
        match self.device.value.length {
            None => all.next().unwrap_or_default(),
            Some(_) => all.collect(),
        }
    }
}

/// Seconds since 1970, to the microsecond.
#[must_use]
pub fn seconds(since_1970: Duration) -> f64 {
    (since_1970.as_secs_f64() * 1e6).round() / 1e6
}

/// A number in JSON; null for what JSON has no number for.
fn real(number: f64) -> Value {
    Number::from_f64(number).map_or(Value::Null, Value::Number)
}

/// What a factor leaves of a number that was written with few digits: `0.0841` for `8.41 * 0.01`.
fn tidy(number: f64) -> f64 {
    format!("{number:.14e}").parse().unwrap_or(number)
}

/// Puts a value into an object below the words of its topic: `Rover/Light` is `Light` in `Rover`.
pub fn nest(object: &mut Map<String, Value>, topic: &str, value: Value) {
    match topic.split_once('/') {
        None => {
            object.insert(topic.to_owned(), value);
        }
        Some((word, rest)) => {
            let inner = object.entry(word).or_insert_with(|| Value::Object(Map::new()));
            if let Value::Object(inner) = inner {
                nest(inner, rest, value);
            }
        }
    }
}
