//! A board that runs beside programs of the computer that serves a page: calls in JSON in, answers in JSON out, both as
//! of a page's own module.

use serde::Deserialize;
use serde_json::{Value, json};

use super::{Around, Live, Outside, Wanted};
use crate::request::Request;

/// A call. `of` is what [`ask`](crate::ask) takes.
#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
enum Call {
    /// Starts the board, or another one in its place.
    Robot {
        of: Request,
        #[serde(default)]
        name: Option<String>,
        /// Which of the files is its world.
        #[serde(default)]
        world: Option<String>,
    },
    Run {
        until_ms: f64,
    },
    Steer {
        device: String,
        element: usize,
        shown: Option<f64>,
    },
    Set {
        device: String,
        value: String,
    },
}

/// A simulated board that is served.
pub struct ServedBoard {
    live: Option<Live>,
    outside: Box<dyn Outside>,
}

impl ServedBoard {
    /// None yet; its code and the programs of its world come from outside.
    #[must_use]
    pub fn beside(outside: Box<dyn Outside>) -> Self {
        Self { live: None, outside }
    }

    /// Answers a call. The answer to one that is not understood has `error`, which gives the reason.
    #[must_use]
    pub fn call(&mut self, call: &str) -> String {
        let answer = match serde_json::from_str::<Call>(call) {
            Ok(call) => self.answer(call),
            Err(why) => json!({ "error": why.to_string() }),
        };
        answer.to_string()
    }

    fn answer(&mut self, call: Call) -> Value {
        match call {
            Call::Robot { of, name, world } => self.start(&of, name.as_deref(), world.as_deref()),
            Call::Run { until_ms } => self.with(|live| live.run(until_ms)),
            Call::Steer { device, element, shown } => {
                self.with(|live| live.steer(&device, element, shown))
            }
            Call::Set { device, value } => self.with(|live| live.set(&device, &value)),
        }
    }

    fn start(&mut self, of: &Request, name: Option<&str>, world: Option<&str>) -> Value {
        // Its programs end before others begin.
        self.live = None;
        let (around, outside) = (Around::World(world), Some(&*self.outside));
        let (told, live) = Live::start(&Wanted { of, name, around, outside });
        self.live = live;
        told
    }

    fn with(&mut self, then: impl FnOnce(&mut Live) -> Value) -> Value {
        let nothing = || json!({ "error": "no board is running" });
        self.live.as_mut().map_or_else(nothing, then)
    }
}
