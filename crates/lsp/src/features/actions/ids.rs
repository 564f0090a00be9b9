//! Identifiers: those that the tool has counted, written into the file, so that they stay when devices are added.

use std::ops::Range as Bytes;

use sensedsl_model::blocks_without_ids;

use super::changes::Changes;
use super::offer::{REWRITE, action, part_at, touches};
use crate::context::{Context, bytes};
use crate::edits::begun;
use crate::protocol::CodeAction;

pub(super) fn at(cx: &Context<'_>, range: &Bytes<usize>) -> Option<CodeAction> {
    let design = cx.analysis.snapshot.sound()?.design;
    // The numbers are counted over all files, in the order of the one that uses the others.
    if design.file != cx.file {
        return None;
    }
    let missing = blocks_without_ids(design, &cx.ast());
    let is_in_part = part_at(cx, range).is_some();
    if is_in_part && !missing.iter().any(|(block, _)| touches(&bytes(block.text_range()), range)) {
        return None;
    }
    let mut changes = Changes::default();
    for (block, id) in missing {
        changes.add(cx.file, begun(&block, &format!("id = {id};"))?);
    }
    changes.sound(cx)?;
    action(cx, "Write identifiers".to_owned(), REWRITE, &changes)
}
