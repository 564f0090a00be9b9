//! Findings in words.

use super::findings::{DeviceFindings, Finding, MS};
use crate::bench::seconds;

impl DeviceFindings {
    /// The worst finding about the device; empty if there is none.
    #[must_use]
    pub fn words(&self) -> String {
        let Some(worst) = &self.worst else { return String::new() };
        let at = format!("{:.3} s", seconds(worst.at_ns));
        let unit = if self.quantity.is_empty() { "" } else { " " };
        let shown = |number: f64| format!("{}{unit}{}", short(number), self.quantity);
        match &worst.finding {
            Finding::Value { expected: (from, to), got, .. } => {
                format!("at {at} it was {} and not {} to {}", shown(*got), short(*from), short(*to))
            }
            Finding::Silence(silent) => format!("nothing for {silent:.1} s until {at}"),
            Finding::Pace { expected_ns, got_ns } => {
                format!("it reports every {} and not every {}", time(*got_ns), span(*expected_ns))
            }
            Finding::Late { most_ns, got_ns } => format!(
                "it is reported {} after it has changed on average, and not {} at most",
                time(*got_ns),
                time(*most_ns)
            ),
            Finding::Unseen { count, lasting_ns } => format!(
                "it has changed {count} times for a little longer than its {}, and never told it",
                time(*lasting_ns)
            ),
            Finding::Again(after_ns) => format!(
                "at {at} it was reported again after {}, though it had not changed",
                time(*after_ns)
            ),
            Finding::Invalid(got) => {
                format!("at {at} it reported {}, which is `invalid`", shown(*got))
            }
            Finding::Unchanged { got, before } => format!(
                "at {at} it reported {} after {}, which is less than `change`",
                shown(*got),
                shown(*before)
            ),
            Finding::Transfer(what) => what.clone(),
            Finding::Health(what) => format!("the board says of it at {at}: {what}"),
        }
    }
}

fn span((least_ns, most_ns): (u64, u64)) -> String {
    if least_ns == most_ns || least_ns == 0 {
        time(most_ns)
    } else {
        format!("{} to {}", time(least_ns), time(most_ns))
    }
}

fn time(ns: u64) -> String {
    if ns >= 10_000 * MS {
        return format!("{} s", short(seconds(ns)));
    }
    let ms = crate::arith::number(ns) / crate::arith::number(MS);
    if ms < 100.0 {
        format!("{} ms", short((ms * 10.0).round() / 10.0))
    } else {
        format!("{ms:.0} ms")
    }
}

/// A number with at most four decimals.
fn short(number: f64) -> String {
    let text = format!("{number:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
