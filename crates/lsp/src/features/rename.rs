//! Renaming: a thing gets another name in all files of its design.
//!
//! A new name is refused if the design would have a new error with it. A device of a chip that shows the value of its
//! own name gets a `reading` that says which one it is, once one of the two is called otherwise.
#![expect(clippy::wildcard_enum_match_arm, reason = "most kinds mean nothing here")]

use std::collections::BTreeMap;

use sensedsl_diagnostics::{FileId, Severity};
use sensedsl_model::NoFiles;
use sensedsl_session::{On, Snapshot, Workspace};
use sensedsl_syntax::ast::{self, AstNode as _};

use crate::answer::Refusal;
use crate::context::{Context, bytes};
use crate::edits::{self, Edit};
use crate::library;
use crate::names::{Names, Thing, folded};
use crate::place::Lines;
use crate::protocol::{Range, TextEdit, WorkspaceEdit};

/// The range of the name at an offset.
///
/// # Errors
/// Nothing at the offset can be renamed.
pub(crate) fn prepared(cx: &Context<'_>, offset: usize) -> Result<Range, Refusal> {
    let names = Names::new(&cx.analysis.snapshot);
    let (at, _) = found(cx, &names, offset)?;
    Ok(cx.range(at))
}

/// The changes of all files for a new name.
///
/// # Errors
/// Nothing at the offset can be renamed, the new name is not a valid one, or the design would have a new error.
pub(crate) fn renamed(
    cx: &Context<'_>,
    offset: usize,
    new: &str,
) -> Result<WorkspaceEdit, Refusal> {
    let names = Names::new(&cx.analysis.snapshot);
    let (_, thing) = found(cx, &names, offset)?;
    if !is_name(new) {
        let why = format!(
            "`{new}` is not a valid name: use a letter, then letters, digits and `_`, at most 63 in all"
        );
        return Err(Refusal::Impossible(why));
    }
    let mut edits: BTreeMap<FileId, Vec<Edit>> = BTreeMap::new();
    for one in names.of(&thing) {
        edits.entry(one.span.file).or_default().push((one.span.range(), new.to_owned()));
    }
    for (file, edit) in implicit(cx, &thing, new) {
        edits.entry(file).or_default().push(edit);
    }
    judged(cx, &edits)?;
    let sources = cx.analysis.snapshot.sources();
    let changes = edits.into_iter().map(|(file, edits)| {
        let text = sources.text(file);
        let lines = Lines::new(text, cx.documents.encoding);
        let shown = edits
            .into_iter()
            .map(|(range, new_text)| TextEdit { range: lines.range(text, range), new_text });
        (cx.documents.uri(sources.name(file)), shown.collect())
    });
    Ok(WorkspaceEdit { changes: changes.collect() })
}

fn found(
    cx: &Context<'_>,
    names: &Names,
    offset: usize,
) -> Result<(std::ops::Range<usize>, Thing), Refusal> {
    let Some(at) = names.at(cx.file, offset) else {
        return Err(Refusal::Impossible("nothing here can be renamed".to_owned()));
    };
    let is_group = matches!(at.thing, Thing::Group(_));
    if !is_group && !names.of(&at.thing).any(|one| one.is_declaration) {
        let why = format!("the {} `{}` is built in", at.thing.what(), at.thing.name());
        return Err(Refusal::Impossible(why));
    }
    Ok((at.span.range(), at.thing.clone()))
}

fn is_name(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_alphabetic())
        && text.chars().all(|one| one.is_ascii_alphanumeric() || one == '_')
        && text.len() <= 63
}

/// The statements that say what a name alone said before.
fn implicit(cx: &Context<'_>, thing: &Thing, new: &str) -> Vec<(FileId, Edit)> {
    let (driver, value) = match thing {
        Thing::Part(name) => (None, name),
        Thing::DriverValue(driver, name) => (Some(driver), name),
        _ => return Vec::new(),
    };
    let mut found = Vec::new();
    for (file, tree) in cx.analysis.snapshot.trees() {
        let chips = tree.syntax().descendants().filter_map(ast::Chip::cast);
        for device in chips.flat_map(|chip| chip.devices().collect::<Vec<_>>()) {
            let is_called = device.name().is_some_and(|name| folded(name.text()) == folded(value));
            let mut properties = device.properties().filter_map(|one| one.name());
            let is_said = properties.any(|name| name.text() == "reading");
            if !is_called || is_said {
                continue;
            }
            let Some(of_chip) = shown_value(cx, *file, &device) else { continue };
            let reading = match driver {
                Some(driver) if of_chip.0 == *driver => new.to_owned(),
                Some(_) => continue,
                None => of_chip.1,
            };
            let edit = edits::added(device.syntax(), &format!("reading = {reading};"));
            found.extend(edit.map(|edit| (*file, edit)));
        }
    }
    found
}

/// The driver of a chip's device, and which of its values has the device's name.
fn shown_value(cx: &Context<'_>, file: FileId, device: &ast::Device) -> Option<(String, String)> {
    let design = cx.analysis.snapshot.sound()?.design;
    let at = device.name()?;
    let span = sensedsl_diagnostics::Span::new(file, bytes(at.range()));
    let of = design.devices.iter().find(|one| one.name.span == span)?;
    let driver = design.part(of.part)?.driver.clone()?;
    let trees = cx.analysis.snapshot.trees().iter();
    let mut own = trees.flat_map(|(_, tree)| tree.ast().drivers().collect::<Vec<_>>());
    let is_wanted = |name: &str| folded(name) == folded(at.text());
    if let Some(node) = own.find(|one| one.name().is_some_and(|name| name.text() == driver)) {
        let readings = node.readings().filter_map(|one| one.name());
        let mut all = readings.chain(node.commands().filter_map(|one| one.name()));
        let value = all.find(|name| is_wanted(name.text()))?;
        return Some((driver, value.text().to_owned()));
    }
    let part = library::part(&driver)?;
    let mut values = part.values.iter().filter_map(|value| value.name.as_deref());
    let value = values.find(|name| is_wanted(name))?;
    Some((driver, value.to_owned()))
}

/// Refuses changes after which the design has an error that it has not now.
fn judged(cx: &Context<'_>, edits: &BTreeMap<FileId, Vec<Edit>>) -> Result<(), Refusal> {
    let before = &cx.analysis.snapshot;
    let sources = before.sources();
    let mut workspace = Workspace::default();
    for file in before.files() {
        let text = sources.text(*file);
        let edits = edits.get(file).cloned().unwrap_or_default();
        workspace.open(sources.name(*file), edits::applied(text, edits));
    }
    let root = before.files().first().map_or("", |file| sources.name(*file));
    let after = workspace.snapshot(root, On::default(), &NoFiles);
    if errors(&after).count() <= errors(before).count() {
        return Ok(());
    }
    let known: Vec<&str> = errors(before).collect();
    let new = errors(&after).find(|one| !known.contains(one));
    Err(Refusal::Impossible(new.unwrap_or("the design would have a new error").to_owned()))
}

fn errors(snapshot: &Snapshot) -> impl Iterator<Item = &str> {
    let all = snapshot.diagnostics().iter();
    all.filter(|one| one.severity == Severity::Error).map(|one| one.message.as_str())
}
