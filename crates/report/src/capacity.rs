//! What can still be added to each board, as a table and for scripts.

use sensedsl_model::design::Design;
use sensedsl_wiring::{Capacity, Found};
use serde_json::{Value, json};

use crate::columns::table;

/// The number of blockers named in one line.
const NAMED_MAX: usize = 8;

fn board_name<'a>(design: &'a Design, one: &Capacity) -> &'a str {
    design.board(one.board).map_or("", |board| board.name.value.as_str())
}

/// The numbers, as `sensedsl capacity --format json` prints them.
#[must_use]
pub fn value(design: &Design, found: &Found<Capacity>) -> Value {
    let list: Vec<Value> = found.all.iter().map(|one| of_kind(design, one)).collect();
    json!({ "version": 1, "complete": found.complete, "capacity": list })
}

fn of_kind(design: &Design, one: &Capacity) -> Value {
    json!({
        "board": board_name(design, one),
        "kind": one.kind.name(),
        "more": one.more,
        "blocked_by": one.blocked_by,
    })
}

/// The numbers as a table.
#[must_use]
pub fn human(design: &Design, found: &Found<Capacity>) -> String {
    let rows: Vec<[String; 4]> = found
        .all
        .iter()
        .map(|one| {
            let mut blockers: Vec<&str> =
                one.blocked_by.iter().take(NAMED_MAX).map(String::as_str).collect();
            if one.blocked_by.len() > NAMED_MAX {
                blockers.push("…");
            }
            [
                board_name(design, one).to_owned(),
                one.kind.name().to_owned(),
                one.more.to_string(),
                blockers.join(" "),
            ]
        })
        .collect();
    table(["Board", "Kind", ">More", "Next one lacks"], &rows)
}
