//! The tool as one function: a request in JSON in, an answer in JSON out.
//!
//! The request has `path`, the requested file, and `files`, the texts of that file and of all files
//! that it uses, by path; `board` and `target` are those of the command line. The answer has
//!
//! - `diagnostics`, as `sensedsl check --format json` prints them;
//! - `answer`, as `sensedsl solve --format json` prints it; null if there is none;
//! - `svg`, the picture of the wiring; null if there is none;
//! - `left_out`, the names of the boards and devices in error; everything else was wired.
//!
//! [`Studio`] is everything else that a page needs: reports, files, palettes, and a board that runs. [`Editor`] is the
//! language server.
//!
//! A page runs this as WebAssembly (crate `wasm`), in a worker that it can terminate if it takes
//! too long.
//!
//! # Example
//!
//! ```
//! use sensedsl_web::ask;
//! use serde_json::{Value, json};
//!
//! let text = "board Rover on STM32F4DiscoveryBoard {
//!     sensor Light returns uint16 { id = 1; type = analog; }
//! }";
//! let request = json!({ "path": "rover.sense", "files": { "rover.sense": text } });
//! let answer: Value = serde_json::from_str(&ask(&request.to_string())).unwrap();
//! assert_eq!(answer["diagnostics"], json!([]));
//! assert_eq!(answer["answer"]["status"], "optimal");
//! assert_eq!(answer["answer"]["boards"][0]["devices"][0]["name"], "Light");
//! ```

mod editor;
mod library;
mod live;
mod project;
mod reports;
mod request;
mod studio;

pub use editor::Editor;
pub use live::{Outside, ServedBoard};
pub use studio::Studio;

use sensedsl_diagnostics::render;
use sensedsl_generate::target;
use sensedsl_report::{json, svg};
use sensedsl_session::{Answer, Ask};
use sensedsl_wiring::Solved;
use serde_json::{Value, json};

use crate::request::Request;

/// Answers a request. The answer to a request that is not understood has `error`, which gives the
/// reason.
#[must_use]
pub fn ask(request: &str) -> String {
    match serde_json::from_str::<Request>(request) {
        Ok(request) => render::json_text(&answer(&request)),
        Err(why) => render::json_text(&json!({ "error": why.to_string() })),
    }
}

fn answer(request: &Request) -> Value {
    let snapshot = request.snapshot();
    let answer = snapshot.solve(&Ask { partly: true, ..Ask::default() });
    let mut diagnostics = answer.diagnostics.clone();
    if let Some((design, wiring)) = answer.wired().filter(|_| answer.left_out.is_empty()) {
        target::foresee(design, wiring, &mut diagnostics);
    }
    let diagnostics: Vec<Value> =
        diagnostics.iter().map(|one| render::json_value(one, snapshot.sources())).collect();
    let left_out: Vec<&str> = answer.left_out.iter().map(|one| one.value.as_str()).collect();
    json!({
        "diagnostics": diagnostics,
        "answer": solved(&answer),
        "svg": answer.wired().map(|(design, wiring)| svg::svg(design, wiring)),
        "left_out": left_out,
    })
}

fn solved(answer: &Answer<'_>) -> Option<Value> {
    match (answer.design.as_deref()?, answer.solved.as_ref()?) {
        (design, Solved::Wired(wiring)) => Some(json::wired(design, wiring)),
        (design, Solved::Infeasible(conflict)) => Some(json::infeasible(design, conflict)),
        (_, Solved::Failed(_)) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(request: &Value) -> Value {
        serde_json::from_str(&ask(&request.to_string())).unwrap()
    }

    #[test]
    fn a_design_is_wired_and_drawn() {
        let text = "use \"legs.sense\";\nboard B on STM32F4DiscoveryBoard {}";
        let legs = "sensor Leg returns uint16 { id = 1; type = analog; }";
        let files = json!({ "a.sense": text, "legs.sense": legs });
        let found = asked(&json!({ "path": "a.sense", "files": files }));
        assert_eq!(found["answer"]["status"], "optimal");
        assert_eq!(found["answer"]["boards"][0]["devices"][0]["name"], "Leg");
        assert!(found["svg"].as_str().unwrap().starts_with("<svg"));
        assert_eq!((&found["diagnostics"], &found["left_out"]), (&json!([]), &json!([])));
    }

    /// A page reports what `generate` will refuse, as `check` does, with the default target if none
    /// is named.
    #[test]
    fn what_has_no_firmware_is_foreseen() {
        let text = "board Robot on XIAO_NRF52840 { chip Motors { driver = tb6612fng; \
            actuator SpeedA accepts int16 {} actuator SpeedB accepts int16 {} } }";
        let mut request = json!({ "path": "a.sense", "files": { "a.sense": text } });
        let found = asked(&request);
        let gap = &found["diagnostics"][0];
        assert_eq!(gap["code"], "W0615", "{found:#}");
        assert!(gap["message"].as_str().unwrap().starts_with("target embassy: "), "{gap:#}");
        assert_eq!(found["answer"]["status"], "optimal");
        request["target"] = json!("none");
        assert_eq!(asked(&request)["diagnostics"], json!([]));
    }

    /// A parameter that is to be kept over a reset is only as good as the system that keeps it.
    #[test]
    fn what_is_not_kept_is_said() {
        let text = |allow: &str| {
            format!(
                "board Robot on NUCLEO_F446RE {{ actuator Gain accepts float32 {{ type = code; \
                 default = 1; store = true; {allow} }} }}"
            )
        };
        let found = |text: &str, target: &str| {
            let files = json!({ "a.sense": text });
            asked(&json!({ "path": "a.sense", "files": files, "target": target }))
        };
        assert_eq!(found(&text(""), "chibios")["diagnostics"], json!([]));
        let told = found(&text(""), "embassy");
        let one = &told["diagnostics"][0];
        assert_eq!((&one["code"], &one["severity"]), (&json!("W0601"), &json!("warning")));
        assert!(one["message"].as_str().unwrap().contains("`store` of `Gain`"), "{one:#}");
        let known = text("allow W0601 \"the host sets it\";");
        assert_eq!(found(&known, "embassy")["diagnostics"], json!([]));
    }

    #[test]
    fn what_cannot_be_answered_is_said() {
        let missing = asked(&json!({ "path": "a.sense" }));
        assert_eq!(missing["diagnostics"][0]["code"], "E0111");
        assert_eq!((&missing["answer"], &missing["svg"]), (&Value::Null, &Value::Null));
        assert!(asked(&json!({ "pfad": 1 }))["error"].as_str().unwrap().contains("pfad"));
        assert!(asked(&json!(1))["error"].is_string());
    }
}
