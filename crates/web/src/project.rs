//! All files that `sensedsl generate` writes.

use std::collections::BTreeMap;

use sensedsl_diagnostics::render;
use sensedsl_generate::host::{HOSTS, find};
use sensedsl_generate::{Selection, project};
use sensedsl_job::host::Host;
use sensedsl_model::{drop_allowed, sort};
use sensedsl_session::{Ask, has_errors};
use serde_json::{Value, json};

use crate::request::Request;

/// The files by path; `null` if there are errors.
pub(crate) fn files(of: &Request, hosts: Option<&[String]>, without: &[String]) -> Value {
    let wanted = match chosen(hosts, without) {
        Ok(wanted) => wanted,
        Err(unknown) => return json!({ "error": format!("there is no host {unknown}") }),
    };
    let snapshot = of.snapshot();
    let answer = snapshot.solve(&Ask::default());
    let mut diagnostics = answer.diagnostics.clone();
    let files = answer.wired().and_then(|(design, wiring)| {
        let is_firmware = !without.iter().any(|one| one == "firmware");
        let selection = Selection { firmware: is_firmware, hosts: &wanted };
        let mut made = project(of.design_name(), design, wiring, &selection);
        if made.gaps.is_empty() {
            return Some(made.files);
        }
        drop_allowed(design, &mut made.gaps);
        diagnostics.append(&mut made.gaps);
        sort(&mut diagnostics);
        None
    });
    let files = files.filter(|_| !has_errors(&diagnostics));
    let files = files.map(|all| {
        let all = all.iter().map(|(path, entry)| {
            (path.to_owned(), String::from_utf8_lossy(&entry.bytes).into_owned())
        });
        all.collect::<BTreeMap<String, String>>()
    });
    let shown = |one| render::json_value(one, snapshot.sources());
    let diagnostics: Vec<Value> = diagnostics.iter().map(shown).collect();
    json!({ "diagnostics": diagnostics, "files": files })
}

/// The hosts of those names; all if none are named.
fn chosen<'a>(
    names: Option<&'a [String]>,
    without: &[String],
) -> Result<Vec<&'static dyn Host>, &'a str> {
    if without.iter().any(|one| one == "host") {
        return Ok(Vec::new());
    }
    let Some(names) = names else { return Ok(HOSTS.to_vec()) };
    names.iter().map(|name| find(name).ok_or(name.as_str())).collect()
}
