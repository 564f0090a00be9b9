//! The judge's verdict on actuators: a table, and the first failure.

use anyhow::Result;
use sensedsl_diagnostics::codes::e0552_command_not_done as not_done;
use sensedsl_twin::bench::seconds;
use sensedsl_twin::commands::{ActuatorFindings, WireMismatch};

use super::simulation::Simulation;
use sensedsl_report::columns::table;

/// Prints the findings; returns false if there was a failure.
pub(super) fn verdict(scenery: &Simulation<'_>, tried: &[ActuatorFindings]) -> Result<bool> {
    if tried.is_empty() {
        return Ok(true);
    }
    let rows: Vec<[String; 5]> = tried.iter().map(cells).collect();
    let heads = ["Output", ">Set", ">Looked at", ">Excused", ">Wrong"];
    let mut text = format!("\n{}", table(heads, &rows));
    let mut mismatch = Vec::new();
    for one in tried {
        let failure = one.first.as_ref().map(|first| (not_done::CODE.name(), words(first)));
        scenery.case(&one.name, failure);
        if let Some(first) = &one.first {
            text.push_str(&format!("  {}\n", words(first)));
            mismatch.push((one, first));
        }
    }
    scenery.terminal.result(&text)?;
    if let Some(left) = left(tried) {
        scenery.terminal.aside(&left)?;
    }
    // A failure of an actuator that the host sets is more telling than one of a constant level.
    let worst = mismatch.iter().find(|(one, _)| one.is_set).or(mismatch.first());
    let Some((one, first)) = worst else {
        let commands: u64 = tried.iter().map(|one| one.commands).sum();
        let looks: u64 = tried.iter().map(|one| one.looks).sum();
        let what = format!(
            "\n{commands} commands: all {looks} looks at outputs found what the design says\n"
        );
        scenery.terminal.note(&what)?;
        return Ok(true);
    };
    let wrong = tried.iter().map(|one| one.wrong).sum();
    let looks = tried.iter().map(|one| one.looks).sum();
    let what = words(first);
    scenery.say(if one.is_set {
        not_done::not_done(scenery.at, &one.name, &what, wrong, looks)
    } else {
        not_done::not_there(scenery.at, &what)
    })?;
    Ok(false)
}

fn cells(one: &ActuatorFindings) -> [String; 5] {
    let set = if one.is_set { one.commands.to_string() } else { "-".to_owned() };
    let [looks, excused, wrong] = [one.looks, one.excused, one.wrong].map(|one| one.to_string());
    [one.name.clone(), set, looks, excused, wrong]
}

/// A failure in words.
fn words(one: &WireMismatch) -> String {
    let WireMismatch { at_ns, wire, after, expected, got, .. } = one;
    format!("{wire}: at {:.3} s, {after}: {got} and not {expected}", seconds(*at_ns))
}

/// The values that there was no time for.
fn left(tried: &[ActuatorFindings]) -> Option<String> {
    let short: Vec<&ActuatorFindings> = tried.iter().filter(|one| one.left > 0).collect();
    let left: u64 = short.iter().map(|one| one.left).sum();
    let names: Vec<&str> = short.iter().take(4).map(|one| one.name.as_str()).collect();
    let more =
        if short.len() > 4 { format!(" and {} more", short.len() - 4) } else { String::new() };
    let mut all = Vec::new();
    if left > 0 {
        all.push(format!("{left} values of {}{more}", names.join(", ")));
    }
    if tried.iter().any(|one| one.is_set && one.is_silence_left) {
        all.push("the host's silence".to_owned());
    }
    let all = all.join(" and ");
    (!all.is_empty())
        .then(|| format!("no time was left for {all}: make the run longer with `--seconds`"))
}
