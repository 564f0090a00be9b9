//! What all requests have: texts, and the file that is asked for.

use std::collections::BTreeMap;

use sensedsl_diagnostics::render;
use sensedsl_model::NoFiles;
use sensedsl_model::design::Design;
use sensedsl_session::{Answer, Ask, On, Snapshot, Workspace};
use sensedsl_wiring::assignment::Assignment;
use serde::Deserialize;
use serde_json::{Value, json};

/// A page's request.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Request {
    pub(crate) path: String,
    pub(crate) files: BTreeMap<String, String>,
    pub(crate) board: Option<String>,
    pub(crate) target: Option<String>,
}

impl Request {
    pub(crate) fn snapshot(&self) -> Snapshot {
        let mut workspace = Workspace::default();
        for (path, text) in &self.files {
            workspace.open(path, text.as_str());
        }
        let on = On { board: self.board.as_deref(), target: self.target.as_deref() };
        workspace.snapshot(&self.path, on, &NoFiles)
    }

    /// The name of the design for people: that of its file.
    pub(crate) fn design_name(&self) -> &str {
        let file = self.path.rsplit('/').next().unwrap_or_default();
        file.rsplit_once('.').map_or(file, |(stem, _)| stem)
    }

    /// What `then` makes of the wiring of a design without mistakes, under `name`, with the diagnostics.
    pub(crate) fn of_wiring(
        &self,
        name: &str,
        then: impl FnOnce(
            &Design,
            &Assignment,
            &mut Vec<sensedsl_diagnostics::Diagnostic>,
        ) -> Option<Value>,
    ) -> Value {
        let snapshot = self.snapshot();
        let Answer { mut diagnostics, design, solved, .. } = snapshot.solve(&Ask::default());
        let found = match (design, solved) {
            (Some(design), Some(sensedsl_wiring::Solved::Wired(wiring))) => {
                then(&design, &wiring, &mut diagnostics)
            }
            (_, _) => None,
        };
        let diagnostics: Vec<Value> =
            diagnostics.iter().map(|one| render::json_value(one, snapshot.sources())).collect();
        json!({ "diagnostics": diagnostics, name: found })
    }
}
