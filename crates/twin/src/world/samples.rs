//! Samples of a quantity in a CSV file: a line of names, then lines with a time in seconds and numbers.

use sensedsl_diagnostics::codes::e0545_world_samples as report;
use sensedsl_diagnostics::{Diagnostic, Span, nearest};

use crate::arith::nanoseconds;

/// The points of a column. `at` is the place where the world names the file.
pub(super) fn read(
    samples: &dyn Fn(&str) -> Result<String, String>,
    file: &str,
    column: &str,
    at: Span,
) -> Result<Vec<(u64, f64)>, Box<Diagnostic>> {
    let text = samples(file).map_err(|why| report::unread(at, file, &why))?;
    let mut lines = text.lines().enumerate().filter(|(_, line)| {
        let line = line.trim();
        !line.is_empty() && !line.starts_with('#')
    });
    let (_, head) = lines.next().ok_or_else(|| report::unread(at, file, "it is empty"))?;
    let names: Vec<&str> = head.split([',', ';']).map(cell).collect();
    let place = names.iter().skip(1).position(|name| *name == column).ok_or_else(|| {
        let others = names.iter().skip(1).copied();
        let list: Vec<String> = others.clone().map(|name| format!("`{name}`")).collect();
        report::no_column(at, column, nearest(column, others), &list.join(", "))
    })?;
    let mut points = Vec::new();
    for (number, line) in lines {
        let bad = |why: &str| report::bad_line(at, file, number + 1, why);
        let cells: Vec<&str> = line.split([',', ';']).map(cell).collect();
        let seconds = cells.first().and_then(|cell| cell.parse::<f64>().ok());
        let seconds = seconds.filter(|one| one.is_finite() && *one >= 0.0);
        let seconds = seconds.ok_or_else(|| bad("the first column is not a time in seconds"))?;
        // An empty cell is not a point.
        let Some(text) = cells.get(place + 1).filter(|cell| !cell.is_empty()) else { continue };
        let value = text.parse::<f64>().ok().filter(|one| one.is_finite());
        let value = value.ok_or_else(|| bad(&format!("`{text}` is not a number")))?;
        let time = nanoseconds(seconds * 1e9);
        if points.last().is_some_and(|(before, _)| *before >= time) {
            return Err(bad("the time runs backwards").into());
        }
        points.push((time, value));
    }
    if points.is_empty() {
        return Err(report::unread(at, file, "the column has no number").into());
    }
    Ok(points)
}

fn cell(text: &str) -> &str {
    text.trim().trim_matches('"')
}
