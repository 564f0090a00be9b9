//! Changes of files that belong together: edits in, an edit of the workspace out, or the design as it would be after
//! them.

use std::collections::BTreeMap;

use sensedsl_diagnostics::{FileId, Fix, Severity, Span};
use sensedsl_model::{FileRequest, Files, ReadError};
use sensedsl_session::{On, Snapshot, Workspace};
use sensedsl_syntax::{SyntaxNode, SyntaxToken};

use crate::context::{Context, bytes};
use crate::edits::{self, Edit};
use crate::place::Lines;
use crate::protocol::{TextEdit, WorkspaceEdit};

/// Edits of files that do not overlap.
#[derive(Clone, Debug, Default)]
pub(super) struct Changes {
    files: BTreeMap<FileId, Vec<Edit>>,
}

impl Changes {
    pub(super) fn of(file: FileId, edit: Edit) -> Self {
        let mut changes = Self::default();
        changes.add(file, edit);
        changes
    }

    /// The changes of a way out.
    pub(super) fn of_fix(fix: &Fix) -> Self {
        let mut changes = Self::default();
        changes.add_fix(fix);
        changes
    }

    /// Adds an edit, unless another one is in the same place; whether it was added.
    pub(super) fn add(&mut self, file: FileId, edit: Edit) -> bool {
        let edits = self.files.entry(file).or_default();
        if edits.contains(&edit) {
            return true;
        }
        let (start, end) = (edit.0.start, edit.0.end);
        let overlaps = |one: &Edit| start < one.0.end && one.0.start < end || start == one.0.start;
        let is_free = !edits.iter().any(overlaps);
        if is_free {
            edits.push(edit);
        }
        is_free
    }

    /// Adds all edits of a way out, or none.
    pub(super) fn add_fix(&mut self, fix: &Fix) -> bool {
        let mut with = self.clone();
        let mut edits = fix.edits.iter();
        let is_free =
            edits.all(|one| with.add(one.span.file, (one.span.range(), one.text.clone())));
        if is_free {
            *self = with;
        }
        is_free
    }

    /// For the client; none if nothing changes.
    pub(super) fn edit(&self, cx: &Context<'_>) -> Option<WorkspaceEdit> {
        let sources = cx.analysis.snapshot.sources();
        let mut changes: BTreeMap<String, Vec<TextEdit>> = BTreeMap::new();
        for (file, edits) in &self.files {
            let text = sources.text(*file);
            let lines = Lines::new(text, cx.documents.encoding);
            let changed = edits.iter().filter(|(range, new)| text.get(range.clone()) != Some(new));
            let shown = changed.map(|(range, new)| TextEdit {
                range: lines.range(text, range.clone()),
                new_text: new.clone(),
            });
            let shown: Vec<TextEdit> = shown.collect();
            if !shown.is_empty() {
                changes.insert(cx.documents.uri(sources.name(*file)), shown);
            }
        }
        (!changes.is_empty()).then_some(WorkspaceEdit { changes })
    }

    /// The design after the changes.
    pub(super) fn snapshot(&self, cx: &Context<'_>) -> Option<Snapshot> {
        let before = &cx.analysis.snapshot;
        let sources = before.sources();
        let mut workspace = Workspace::default();
        for (file, edits) in &self.files {
            workspace.open(sources.name(*file), edits::applied(sources.text(*file), edits.clone()));
        }
        let root = sources.name(*before.files().first()?);
        Some(workspace.snapshot(root, On::default(), &Read(before)))
    }

    /// The design after the changes, if that brings no mistake.
    pub(super) fn sound(&self, cx: &Context<'_>) -> Option<Snapshot> {
        let after = self.snapshot(cx)?;
        let errors = |snapshot: &Snapshot| {
            let all = snapshot.diagnostics().iter();
            all.filter(|one| one.severity == Severity::Error).count()
        };
        (errors(&after) <= errors(&cx.analysis.snapshot)).then_some(after)
    }
}

/// The files that a snapshot was made of.
struct Read<'a>(&'a Snapshot);

impl Files for Read<'_> {
    fn read(&self, wanted: &FileRequest<'_>) -> Result<String, ReadError> {
        let sources = self.0.sources();
        let found = self.0.files().iter().find(|file| sources.name(**file) == wanted.path);
        found.map(|file| sources.text(*file).to_owned()).ok_or(ReadError::Missing)
    }
}

/// The token at a place of any file that was read.
pub(super) fn token(cx: &Context<'_>, span: Span) -> Option<SyntaxToken> {
    let root = cx.analysis.tree(span.file)?.syntax();
    edits::token_at(&root, span.start)
}

/// The node that is exactly a span.
pub(super) fn node(cx: &Context<'_>, span: Span) -> Option<SyntaxNode> {
    let mut around = token(cx, span)?.parent()?.ancestors();
    around.find(|node| bytes(node.text_range()) == span.range())
}
