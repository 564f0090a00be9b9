//! Inputs whose hardware keeps the times of edges: what the runtime makes of these, for HALs with such a driver.

use sensedsl_model::kind::icu::{Edge, Icu, Mode};

/// The runtime's word for edges.
pub(super) fn edges(edge: Edge) -> &'static str {
    match edge {
        Edge::Rising => "rt::capture::Edges::Rising",
        Edge::Falling => "rt::capture::Edges::Falling",
        Edge::Both => "rt::capture::Edges::Both",
    }
}

/// The edges that the driver must see.
pub(super) fn seen(icu: &Icu, is_train: bool) -> Edge {
    let needs_both = matches!(icu.mode, Mode::Width | Mode::Duty) && !is_train;
    if needs_both { Edge::Both } else { icu.edge }
}

/// What the task with the driver `timer` awaits.
pub(super) fn runs(icu: &Icu, statics: &str, is_train: bool) -> String {
    if is_train {
        return format!("rt::capture::train(timer, &{statics}_TRAIN, &{statics}_SEEN)");
    }
    match icu.mode {
        Mode::Width | Mode::Duty => {
            let is_high = icu.edge != Edge::Falling;
            format!("rt::capture::pulses(timer, {is_high}, &{statics}_SEEN)")
        }
        Mode::Period | Mode::Frequency | Mode::Count | Mode::Ppm => {
            format!("rt::capture::periods(timer, &{statics}_SEEN)")
        }
    }
}
