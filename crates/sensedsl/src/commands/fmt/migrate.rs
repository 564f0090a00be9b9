//! Migration of older files. In: the text of a file. Out: the text that means the same today.
//!
//! A bare number for a device with `scale`, `offset` or `curve` used to be its code; today it is the value that is
//! shown, and a code has `raw` before it.

use std::ops::Range;
use std::path::Path;

use sensedsl_diagnostics::codes::e0234_value_does_not_fit;
use sensedsl_session::Snapshot;

use super::snapshot;
use crate::cli::FmtArgs;

/// More than the passes that a file needs: one for codes that are not shown values, one for all others.
const PASSES: usize = 4;

/// The text with `raw` before the numbers that were codes; the snapshot if a text has other errors.
pub(super) fn migrated(path: &Path, text: &str, args: &FmtArgs) -> Result<String, Box<Snapshot>> {
    let mut text = text.to_owned();
    for _ in 0..PASSES {
        let now = snapshot(path, &text, &args.reach);
        let refused = refused(&now, &text);
        if !refused.is_empty() {
            text = with_raw(&text, refused);
            continue;
        }
        let Some(design) = now.design() else { return Err(Box::new(now)) };
        let bare = design.devices.iter().filter_map(|device| device.shown.bare.as_ref());
        let of_file = bare.filter(|bare| bare.span.file == design.file);
        let codes = of_file.map(|bare| (bare.span.range(), format!("raw {}", bare.number)));
        return Ok(with_raw(&text, codes.collect()));
    }
    Ok(text)
}

/// The numbers without a unit that are not valid as shown values: they can only be codes.
fn refused(now: &Snapshot, text: &str) -> Vec<(Range<usize>, String)> {
    let file = now.trees().first().map(|(file, _)| *file);
    let wrong = now.diagnostics().iter().filter(|one| {
        one.code == e0234_value_does_not_fit::CODE && Some(one.primary.span.file) == file
    });
    let numbers = wrong.filter_map(|one| {
        let range = one.primary.span.range();
        let written = text.get(range.clone())?;
        let is_bare = !written.contains('%') && written.replace('_', "").parse::<f64>().is_ok();
        is_bare.then(|| (range, format!("raw {written}")))
    });
    numbers.collect()
}

fn with_raw(text: &str, mut places: Vec<(Range<usize>, String)>) -> String {
    places.sort_by_key(|(range, _)| std::cmp::Reverse(range.start));
    places.dedup();
    let mut text = text.to_owned();
    for (range, written) in places {
        text.replace_range(range, &written);
    }
    text
}
