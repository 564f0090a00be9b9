//! Quick fixes: the ways out of diagnostics that are edits.

use std::collections::BTreeSet;
use std::ops::Range as Bytes;

use sensedsl_diagnostics::{Code, Diagnostic, Fix};

use super::changes::Changes;
use super::offer::{FIX_ALL, QUICK_FIX, action, capital, touches, wired};
use crate::context::Context;
use crate::features::diagnostics::Places;
use crate::protocol::CodeAction;

/// The ways out of the diagnostics in a range; where a code has several in the file, also all of them at once.
pub(super) fn at(cx: &Context<'_>, range: &Bytes<usize>) -> Vec<CodeAction> {
    let places = Places::new(&cx.analysis, cx.documents);
    let all = diagnostics(cx);
    let here = all.iter().filter(|one| touches(&one.primary.span.range(), range));
    let here: Vec<&Diagnostic> = here.collect();
    let mut actions = Vec::new();
    for one in &here {
        let told = places.told(one).map(|(_, told)| told);
        for fix in &one.fixes {
            let changes = Changes::of_fix(fix);
            let action = action(cx, capital(&fix.title), QUICK_FIX, &changes);
            actions.extend(action.map(|action| CodeAction {
                diagnostics: told.clone().into_iter().collect(),
                is_preferred: one.fixes.len() == 1,
                ..action
            }));
        }
    }
    let codes: BTreeSet<Code> = here.iter().map(|one| one.code).collect();
    actions.extend(codes.into_iter().filter_map(|code| of_code(cx, &all, code)));
    actions
}

/// All at once: each that is the only way out of its diagnostic, and that takes nothing away.
pub(super) fn all(cx: &Context<'_>) -> Option<CodeAction> {
    let all = diagnostics(cx);
    let only = all
        .iter()
        .filter_map(only)
        .filter(|fix| fix.edits.iter().all(|edit| !edit.text.trim().is_empty()));
    let mut changes = Changes::default();
    let fixed = only.filter(|fix| changes.add_fix(fix)).count();
    let changes = if fixed > 1 { changes.sound(cx).map(|_| changes) } else { Some(changes) };
    action(cx, "Fix everything that has one way out".to_owned(), FIX_ALL, &changes?)
}

/// All diagnostics of a code at once, if there are several.
fn of_code(cx: &Context<'_>, all: &[Diagnostic], code: Code) -> Option<CodeAction> {
    let fixes = all.iter().filter(|one| one.code == code).filter_map(only);
    let mut changes = Changes::default();
    let count = fixes.filter(|fix| changes.add_fix(fix)).count();
    if count < 2 {
        return None;
    }
    // Each is a way out by itself: together they may be none, as where two devices would get the same identifier.
    let of_text = |all: &[Diagnostic]| all.iter().filter(|one| one.code == code).count();
    let before = of_text(cx.analysis.snapshot.diagnostics());
    let after = of_text(changes.sound(cx)?.diagnostics());
    if before > 0 && after > before.saturating_sub(count) {
        return None;
    }
    let title = format!("Fix all {count} of {code} in the file");
    action(cx, title, QUICK_FIX, &changes)
}

fn only(one: &Diagnostic) -> Option<&Fix> {
    match one.fixes.as_slice() {
        [only] => Some(only),
        _ => None,
    }
}

/// What is wrong in the file.
fn diagnostics(cx: &Context<'_>) -> Vec<Diagnostic> {
    let of_wiring = wired(cx).map(|wired| wired.diagnostics.clone());
    let mut all = of_wiring.unwrap_or_else(|| cx.analysis.snapshot.diagnostics().to_vec());
    all.retain(|one| one.primary.span.file == cx.file);
    all
}
