//! Everything that a page needs beside an answer: calls in JSON, each with `do`, and answers in JSON.

use serde::Deserialize;
use serde_json::{Value, json};

use crate::live::{Around, BoardCall, Live, Wanted, with};
use crate::request::Request;
use crate::{editor, library, project, reports};

/// A page's call, beside those of a simulated board. `of` is what [`ask`](crate::ask) takes.
#[derive(Debug, Deserialize)]
#[serde(tag = "do", rename_all = "snake_case", deny_unknown_fields)]
enum Call {
    /// All files that `generate` writes; with all hosts if none are named.
    Project {
        of: Request,
        #[serde(default)]
        hosts: Option<Vec<String>>,
        #[serde(default)]
        without: Vec<String>,
    },
    Report {
        of: Request,
        report: reports::Kind,
    },
    Why {
        of: Request,
        name: String,
    },
    Diff {
        of: Request,
        old: Value,
    },
    Places {
        of: Request,
        name: String,
    },
    Pin {
        of: Request,
        name: String,
        wire: String,
        pin: String,
    },
    Boards,
    Parts,
    BoardSvg {
        name: String,
    },
    /// The host of a real board takes the place of the board that was there.
    Host {
        of: Request,
        #[serde(default)]
        name: Option<String>,
    },
    Opened {
        now_ms: f64,
    },
}

/// Answers a page's calls; holds the board that it runs or talks to.
#[derive(Default)]
pub struct Studio {
    live: Option<Live>,
}

impl Studio {
    /// Answers a call, in JSON. The answer to a call that is not understood has `error`, which gives the reason.
    #[must_use]
    pub fn call(&mut self, call: &str) -> String {
        if BoardCall::is_one(call) {
            return BoardCall::answer(call, &mut self.live, None).to_string();
        }
        let answer = match serde_json::from_str::<Call>(call) {
            Ok(call) => self.answer(call),
            Err(why) => json!({ "error": why.to_string() }),
        };
        answer.to_string()
    }

    /// Takes bytes of a real board, and tells what its host has seen, in JSON. To be called without bytes as well, at
    /// least twenty times a second: what does not come is noticed then.
    #[must_use]
    pub fn feed(&mut self, bytes: &[u8], now_ms: f64) -> String {
        with(&mut self.live, |live| live.feed(bytes, now_ms)).to_string()
    }

    /// The bytes that a real board must get now.
    #[must_use]
    pub fn due(&mut self, now_ms: f64) -> Vec<u8> {
        self.live.as_mut().map(|live| live.due(now_ms)).unwrap_or_default()
    }

    fn answer(&mut self, call: Call) -> Value {
        match call {
            Call::Project { of, hosts, without } => project::files(&of, hosts.as_deref(), &without),
            Call::Report { of, report } => reports::report(&of, report),
            Call::Why { of, name } => reports::why(&of, &name),
            Call::Diff { of, old } => reports::changes(&of, &old),
            Call::Places { of, name } => reports::places(&of, &name),
            Call::Pin { of, name, wire, pin } => editor::pinned(&of, &name, &wire, &pin),
            Call::Boards => library::boards(),
            Call::Parts => library::parts(),
            Call::BoardSvg { name } => json!(library::picture(&name)),
            Call::Host { of, name } => {
                let (name, around) = (name.as_deref(), Around::Nothing);
                let (told, live) = Live::start(&Wanted { of: &of, name, around, outside: None });
                self.live = live;
                told
            }
            Call::Opened { now_ms } => with(&mut self.live, |live| {
                live.opened(now_ms);
                Value::Null
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "board Rover on STM32F4DiscoveryBoard {
    sensor Light returns uint16 { id = 1; type = analog; scale = 0.5; quantity = lx; delay = 100; }
    actuator Servo accepts uint16 { id = 2; type = pwm; frequency = 50; }
}
";

    fn called(studio: &mut Studio, call: &Value) -> Value {
        serde_json::from_str(&studio.call(&call.to_string())).unwrap()
    }

    fn of(text: &str) -> Value {
        json!({ "path": "rover.sense", "files": { "rover.sense": text } })
    }

    #[test]
    fn a_value_follows_what_holds_it_and_an_actuator_what_sets_it() {
        let mut studio = Studio::default();
        let told = called(&mut studio, &json!({ "do": "robot", "of": of(TEXT) }));
        assert_eq!(told["robot"]["board"], "Rover", "{told:#}");
        assert_eq!(told["robot"]["devices"][0]["slider"]["min"], 0.0, "{told:#}");
        let steer = json!({ "do": "steer", "device": "Light", "element": 0, "shown": 1_000.0 });
        assert_eq!(called(&mut studio, &steer), Value::Null);
        let set = json!({ "do": "set", "device": "Servo", "value": "1500" });
        called(&mut studio, &json!({ "do": "run", "until_ms": 500 }));
        assert_eq!(called(&mut studio, &set)["error"], Value::Null);
        let wrong = json!({ "do": "set", "device": "Servo", "value": "fast" });
        assert_eq!(called(&mut studio, &wrong)["error"], "`fast` is not a valid value");
        let seen = called(&mut studio, &json!({ "do": "run", "until_ms": 1_000 }));
        assert_eq!(seen["state"], "matched");
        let last = seen["values"].as_array().unwrap().last().unwrap();
        assert_eq!((&last[1], &last[2][0]), (&json!(0), &json!(1_000.0)));
        assert_eq!(seen["outputs"], json!([[1, [1_500.0], "3000 us of 20000 us"]]));
    }

    /// Nothing is believed of a real board that has not said who it is.
    #[test]
    fn the_host_of_a_real_board_asks_who_is_there() {
        let mut studio = Studio::default();
        called(&mut studio, &json!({ "do": "host", "of": of(TEXT) }));
        called(&mut studio, &json!({ "do": "opened", "now_ms": 0 }));
        assert!(studio.due(1.0).starts_with(b"1:"));
        let seen: Value = serde_json::from_str(&studio.feed(b"noise", 1.0)).unwrap();
        assert_eq!((&seen["state"], &seen["values"]), (&json!("asking"), &json!([])));
        assert!(called(&mut studio, &json!({ "do": "run", "until_ms": 1 }))["error"].is_string());
    }

    /// A page is told what only a program of its computer could do.
    #[test]
    fn a_program_of_the_world_is_named() {
        let world = "[plants.Sun]\nkind = 'process'\ncommand = ['python3', 'sun.py']\n\
            step = '1 ms'\nsensors = ['Light']\n";
        let files = json!({ "rover.sense": TEXT, "sun.toml": world });
        let of = json!({ "path": "rover.sense", "files": files });
        let mut studio = Studio::default();
        let told = called(&mut studio, &json!({ "do": "robot", "of": of, "world": "sun.toml" }));
        assert_eq!(told["robot"]["board"], "Rover", "{told:#}");
        let seen = called(&mut studio, &json!({ "do": "run", "until_ms": 20 }));
        let note = &seen["notes"][0];
        assert!(note["text"].as_str().unwrap().starts_with("Sun: a page runs no"), "{seen:#}");
    }

    #[test]
    fn a_wire_is_put_on_the_pin_that_somebody_chose() {
        let mut studio = Studio::default();
        let places = json!({ "do": "places", "of": of(TEXT), "name": "Light" });
        let places = called(&mut studio, &places);
        let mut all = places["places"].as_array().unwrap().iter();
        let other = all.find(|one| one["possible"] == true && one["chosen"] == false).unwrap();
        let call = |text: &str, pin: &Value| {
            let wire = &other["wire"];
            json!({ "do": "pin", "of": of(text), "name": "Light", "wire": wire, "pin": pin })
        };
        let first = called(&mut studio, &call(TEXT, &other["pin"]));
        let text = first["files"]["rover.sense"].as_str().unwrap();
        assert!(text.contains(&format!("pin = {};", other["pin"].as_str().unwrap())), "{text}");
        let again = called(&mut studio, &call(text, &json!("PC1")));
        let text = again["files"]["rover.sense"].as_str().unwrap();
        assert!(text.contains("pin = PC1;") && text.matches("pin =").count() == 1, "{text}");
        let none = called(&mut studio, &call(TEXT, &json!("PZ9")));
        let why = none["error"].as_str().unwrap();
        assert!(why.contains("PZ9 cannot be `in` of Light: "), "{none}");
    }

    #[test]
    fn the_project_has_the_files_of_generate_and_its_errors() {
        let mut studio = Studio::default();
        let call = |text: &str| json!({ "do": "project", "of": of(text), "hosts": ["python"] });
        let made = called(&mut studio, &call(TEXT));
        assert!(made["files"]["firmware/Rover/Makefile"].is_string());
        assert!(made["files"]["host/cpp/README.md"].is_null());
        let wrong = called(&mut studio, &call("board"));
        let severity = &wrong["diagnostics"][0]["severity"];
        assert_eq!((&wrong["files"], severity), (&Value::Null, &json!("error")));
        assert!(called(&mut studio, &json!({ "do": "nothing" }))["error"].is_string());
    }
}
