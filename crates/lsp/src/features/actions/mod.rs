//! Code actions: a range of a file in, the changes that are offered there out.
//!
//! A way out of a diagnostic is the diagnostic's own (`fixes.rs`); what helps a design without a wiring is tried before
//! it is offered (`repairs.rs`). The others write down what the tool has found (`pins.rs`, `ids.rs`), or say the same in
//! another way (`chips.rs`, `drivers.rs`).

mod changes;
mod chips;
mod drivers;
mod fixes;
mod ids;
mod offer;
mod pins;
mod placed;
mod repairs;

pub(super) use placed::placed;

use std::ops::Range as Bytes;

use self::offer::{EXTRACT, FIX_ALL, QUICK_FIX, REWRITE};
use crate::context::Context;
use crate::protocol::{CodeAction, CodeActionContext};

/// The kinds of actions, for the client.
pub(super) const KINDS: [&str; 4] = [QUICK_FIX, REWRITE, EXTRACT, FIX_ALL];

/// What is offered in a range.
pub(super) fn offered(
    cx: &Context<'_>,
    range: &Bytes<usize>,
    context: &CodeActionContext,
) -> Vec<CodeAction> {
    let wants = |kind: &str| {
        context.only.as_ref().is_none_or(|only| only.iter().any(|one| covers(one, kind)))
    };
    let mut actions = Vec::new();
    if wants(QUICK_FIX) {
        actions.extend(fixes::at(cx, range));
        actions.extend(repairs::at(cx, range));
    }
    if wants(FIX_ALL) {
        actions.extend(fixes::all(cx));
    }
    if wants(REWRITE) {
        actions.extend(pins::at(cx, range));
        actions.extend(ids::at(cx, range));
        actions.extend(chips::at(cx, range));
    }
    if wants(EXTRACT) {
        actions.extend(drivers::at(cx, range));
    }
    actions
}

/// Whether a kind that a client asks for has another one below it.
fn covers(asked: &str, kind: &str) -> bool {
    kind.strip_prefix(asked)
        .is_some_and(|rest| asked.is_empty() || rest.is_empty() || rest.starts_with('.'))
}
