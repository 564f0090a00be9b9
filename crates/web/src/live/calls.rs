//! The calls of a simulated board: in JSON in, answers in JSON out. A page's own module takes them beside others; a
//! server takes them alone, for a board that runs beside programs of its computer.

use serde::Deserialize;
use serde_json::{Value, json};

use super::{Around, Live, Outside, Wanted};
use crate::request::Request;

/// A call. `of` is what [`ask`](crate::ask) takes.
#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum BoardCall {
    /// Starts a board, or another one in its place.
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
    /// Of a real board as well.
    Set {
        device: String,
        value: String,
    },
}

/// What all calls have.
#[derive(Deserialize)]
struct Head {
    #[serde(rename = "do")]
    what: String,
}

impl BoardCall {
    /// Whether a call is one of these, whatever else is wrong with it.
    pub(crate) fn is_one(call: &str) -> bool {
        let head = serde_json::from_str::<Head>(call);
        head.is_ok_and(|head| matches!(head.what.as_str(), "robot" | "run" | "steer" | "set"))
    }

    /// The answer to a call; one that is not understood is told why.
    pub(crate) fn answer(
        call: &str,
        live: &mut Option<Live>,
        outside: Option<&dyn Outside>,
    ) -> Value {
        match serde_json::from_str(call) {
            Ok(Self::Robot { of, name, world }) => {
                // Its programs end before others begin.
                *live = None;
                let (name, around) = (name.as_deref(), Around::World(world.as_deref()));
                let (told, started) = Live::start(&Wanted { of: &of, name, around, outside });
                *live = started;
                told
            }
            Ok(Self::Run { until_ms }) => with(live, |live| live.run(until_ms)),
            Ok(Self::Steer { device, element, shown }) => {
                with(live, |live| live.steer(&device, element, shown))
            }
            Ok(Self::Set { device, value }) => with(live, |live| live.set(&device, &value)),
            Err(why) => json!({ "error": why.to_string() }),
        }
    }
}

/// What a board makes of a call, or that there is none.
pub(crate) fn with(live: &mut Option<Live>, then: impl FnOnce(&mut Live) -> Value) -> Value {
    let nothing = || json!({ "error": "no board is running or connected" });
    live.as_mut().map_or_else(nothing, then)
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
        BoardCall::answer(call, &mut self.live, Some(&*self.outside)).to_string()
    }
}
