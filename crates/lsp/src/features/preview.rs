//! The picture of the wiring, for a view beside the text: a request that is this server's own.
//!
//! The picture is of the newest wiring. `is_current` tells whether it is of the text that is open now: while one types, or
//! while there is no wiring, the last good one stays.

use std::rc::Rc;

use sensedsl_report::{json, svg};
use sensedsl_syntax::ast::{self, AstNode as _};
use sensedsl_wiring::Solved;
use serde_json::{Value, json};

use crate::context::Context;

/// The picture, what it shows as `solve --format json` prints it, and where each part stands in the file.
pub(crate) fn wiring(cx: &Context<'_>) -> Value {
    let newest = cx.analysis.known();
    let shown = cx.wired.as_ref().and_then(|wired| wired.wired());
    let is_same =
        newest.as_ref().zip(cx.wired.as_ref()).is_some_and(|(one, other)| Rc::ptr_eq(one, other));
    let answer = newest.as_ref().and_then(|wired| {
        let design = wired.answer.design.as_deref()?;
        match wired.answer.solved.as_ref()? {
            Solved::Wired(wiring) => Some(json::wired(design, wiring)),
            Solved::Infeasible(conflict) => Some(json::infeasible(design, conflict)),
            Solved::Failed(_) => None,
        }
    });
    json!({
        "svg": shown.map(|(design, wiring)| svg::svg(design, wiring)),
        "is_current": is_same && shown.is_some(),
        "answer": answer,
        "parts": parts(cx),
    })
}

/// The names of the parts of the file, with the range of each.
fn parts(cx: &Context<'_>) -> Vec<Value> {
    let part = |node: sensedsl_syntax::SyntaxNode| {
        let range = node.text_range();
        let name = ast::Device::cast(node.clone()).map(|device| device.name());
        let name = name.or_else(|| ast::Chip::cast(node).map(|chip| chip.name()))??;
        Some(json!({
            "name": name.text(),
            "range": cx.range_of(range),
            "selection_range": cx.range_of(name.range()),
        }))
    };
    cx.root().descendants().filter_map(part).collect()
}
