//! Fixes made exact: edits of statements and blocks in, edits of the text out.
//!
//! A diagnostic that says "remove the line" knows where the line begins, but not where it ends; the tree does. Fixes of
//! texts that are not files, such as the drivers that are built in, are dropped: nobody can apply them.

use sensedsl_diagnostics::{Diagnostic, Edit, FileId, Scope, SourceMap, Span};
use sensedsl_syntax::{Parse, SyntaxKind, SyntaxNode, edit};

use crate::spanned::span;

/// Makes the fixes of diagnostics exact. `files` are the files that were read, `trees` those in the language,
/// `sources` their texts.
pub fn settle_fixes(
    diagnostics: &mut [Diagnostic],
    files: &[FileId],
    trees: &[(FileId, Parse)],
    sources: &SourceMap,
) {
    for diagnostic in diagnostics {
        diagnostic.fixes.retain_mut(|fix| {
            fix.edits.iter_mut().all(|edit| {
                files.contains(&edit.span.file)
                    && exact(edit, trees, sources).map(|exact| *edit = exact).is_some()
            })
        });
    }
}

fn exact(wanted: &Edit, trees: &[(FileId, Parse)], sources: &SourceMap) -> Option<Edit> {
    let file = wanted.span.file;
    let text = |range: std::ops::Range<usize>, text: String| {
        Some(Edit { span: Span::new(file, range), text, scope: Scope::Text })
    };
    if wanted.scope == Scope::Text {
        return Some(wanted.clone());
    }
    let root = trees.iter().find(|(of, _)| *of == file)?.1.syntax();
    let token = edit::token_at(&root, wanted.span.start)?;
    match wanted.scope {
        Scope::Text => None,
        Scope::Block => {
            let mut around = token.parent()?.ancestors();
            let block = around.find(|node| has(node, SyntaxKind::LBrace))?;
            let (range, new) = edit::added(&block, &wanted.text)?;
            text(range, new)
        }
        Scope::Statement if wanted.text.is_empty() => {
            let (range, new) = edit::without(sources.text(file), &token)?;
            text(range, new)
        }
        Scope::Statement => {
            let statement = edit::statement(&token)?;
            let is_ended = has(&statement, SyntaxKind::Semicolon);
            let new = wanted.text.trim_end_matches(|one| one == ';' && !is_ended);
            text(span(file, statement.text_range()).range(), new.to_owned())
        }
    }
}

fn has(node: &SyntaxNode, kind: SyntaxKind) -> bool {
    node.children_with_tokens().any(|one| one.kind() == kind)
}
