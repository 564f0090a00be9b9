//! Rules: the statements `prefer`, `avoid`, `reserve`, `release` and `allow` in; wishes, what stays free, and the
//! diagnostics without those that are allowed out. Beside it are the rules that a design has to keep.

mod bounds;
pub(crate) mod checks;
pub(crate) mod names;
pub(crate) mod ranges;

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

use sensedsl_diagnostics::codes::{
    e0101_unexpected_token, e0110_misplaced_item, e0201_unknown_property, e0209_wrong_value,
    e0212_unknown_word, w0601_unused_property, w0604_unused_rule, w0615_no_firmware,
};
use sensedsl_diagnostics::{Code, Diagnostic, FileId, Severity, Span, nearest};
use sensedsl_syntax::TextRange;
use sensedsl_syntax::ast::{self, AstNode as _, Rule};

use crate::design::{Allow, Design, Device, PinRef, Preference, PreferenceSubject, Together};
use crate::fields::name_or_text;
use crate::kind::Role;
use crate::spanned::{Spanned, span};
use crate::value::Evaluator;
use crate::value::constants::Constants;

/// The properties that can be wished for, besides the pins of the roles.
const WISHES: [&str; 6] = ["pin", "unit", "side", "header", "together", "sequence"];

/// All properties that can be wished for.
pub(crate) fn wishes() -> impl Iterator<Item = &'static str> {
    let roles = Role::ALL.into_iter().map(Role::property);
    WISHES.into_iter().chain(roles.filter(|name| *name != "pin"))
}

/// The rules of a board.
#[derive(Debug, Default)]
pub(crate) struct BoardRules {
    pub(crate) wishes: Vec<Preference>,
    pub(crate) reserved: Vec<Spanned<String>>,
    pub(crate) released: Vec<Spanned<String>>,
    pub(crate) allows: Vec<Allow>,
}

/// Reads the rules of a board.
pub(crate) fn of_board(
    file: FileId,
    node: &ast::Board,
    (constants, diagnostics): (&Constants, &mut Vec<Diagnostic>),
) -> BoardRules {
    let mut rules = BoardRules::default();
    let scope = span(file, node.range());
    for rule in node.rules() {
        match rule {
            Rule::Prefer(rule) => {
                rules.wishes.extend(wish(file, true, rule.property(), (constants, diagnostics)));
            }
            Rule::Avoid(rule) => {
                rules.wishes.extend(wish(file, false, rule.property(), (constants, diagnostics)));
            }
            Rule::Reserve(rule) => rules.reserved.extend(names(file, rule.names())),
            Rule::Release(rule) => rules.released.extend(names(file, rule.names())),
            Rule::Allow(rule) => rules.allows.extend(allow(file, &rule, scope, diagnostics)),
        }
    }
    rules
}

/// Reads the rules of a device or a chip, whose block is `block`.
pub(crate) fn of_device(
    file: FileId,
    rules: impl Iterator<Item = Rule>,
    block: TextRange,
    (constants, diagnostics): (&Constants, &mut Vec<Diagnostic>),
) -> (Vec<Preference>, Vec<Allow>) {
    let (mut wishes, mut allows) = (Vec::new(), Vec::new());
    let scope = span(file, block);
    for rule in rules {
        match rule {
            Rule::Prefer(rule) => {
                wishes.extend(wish(file, true, rule.property(), (constants, diagnostics)));
            }
            Rule::Avoid(rule) => {
                wishes.extend(wish(file, false, rule.property(), (constants, diagnostics)));
            }
            Rule::Allow(rule) => allows.extend(allow(file, &rule, scope, diagnostics)),
            Rule::Reserve(_) | Rule::Release(_) => {
                let at = span(file, rule.range());
                let what = "`reserve` or `release` in a part";
                diagnostics.push(e0110_misplaced_item::misplaced_item(at, what, "into a board"));
            }
        }
    }
    (wishes, allows)
}

fn names(file: FileId, names: impl Iterator<Item = ast::Name>) -> Vec<Spanned<String>> {
    names
        .map(|name| Spanned { value: name.text().to_uppercase(), span: span(file, name.range()) })
        .collect()
}

fn wish(
    file: FileId,
    prefer: bool,
    property: Option<ast::Property>,
    (constants, diagnostics): (&Constants, &mut Vec<Diagnostic>),
) -> Option<Preference> {
    let property = property?;
    let (name, value) = (property.name()?, property.value()?);
    if wishes().all(|known| known != name.text()) {
        let word = if prefer { "`prefer`" } else { "`avoid`" };
        let meant = nearest(name.text(), wishes());
        diagnostics.push(e0201_unknown_property::unknown_property(
            span(file, name.range()),
            name.text(),
            word,
            meant,
        ));
        return None;
    }
    let at = span(file, property.range());
    let evaluated = Evaluator::new(file, constants, diagnostics).value(&value);
    let Some(text) = name_or_text(&evaluated) else {
        let place = span(file, value.range());
        let wrong = e0209_wrong_value::wrong_value(place, name.text(), "a name", "another value");
        diagnostics.push(wrong);
        return None;
    };
    let what = match name.text() {
        word @ ("together" | "sequence") => {
            of_array(file, prefer, word, &text, &value, diagnostics)?
        }
        "unit" => PreferenceSubject::Unit(text.to_uppercase()),
        "side" => PreferenceSubject::Side(text),
        "header" => PreferenceSubject::Header(text),
        property => PreferenceSubject::Pin(Role::from_property(property), PinRef::unbound(&text)),
    };
    Some(Preference { prefer, what, span: at })
}

/// Reads a wish for the elements of an array.
fn of_array(
    file: FileId,
    prefer: bool,
    word: &str,
    text: &str,
    value: &ast::Value,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<PreferenceSubject> {
    let at = span(file, value.range());
    if !prefer {
        let why = "it can be preferred, not avoided";
        diagnostics.push(w0604_unused_rule::unused_rule(at, &format!("avoid {word}"), why));
        return None;
    }
    let known: &[Together] = if word == "together" { &Together::ALL } else { &[Together::Header] };
    let words = || known.iter().map(|one| one.name());
    let Some(found) = known.iter().find(|one| one.name() == text) else {
        let all: Vec<&str> = words().collect();
        let meant = nearest(text, words());
        let unknown = e0212_unknown_word::unknown_word;
        diagnostics.push(unknown(at, word, text, &all.join(", "), meant));
        return None;
    };
    Some(if word == "together" {
        PreferenceSubject::Together(*found)
    } else {
        PreferenceSubject::Sequence
    })
}

fn allow(
    file: FileId,
    rule: &ast::Allow,
    scope: Span,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Allow> {
    let (code, reason) = (rule.code()?, rule.reason()?);
    let at = span(file, code.range());
    let Some(known) = Code::find(code.text()) else {
        let found = format!("`{}`", code.text());
        diagnostics.push(e0101_unexpected_token::unexpected_token(
            at,
            "the code of a warning such as W0602",
            &found,
        ));
        return None;
    };
    Some(Allow { code: known, reason: reason.value(), span: span(file, rule.range()), scope })
}

/// Removes the warnings and hints that are allowed, and reports an `allow` that allowed nothing.
/// Needs all diagnostics of a run, including those of later stages.
pub fn apply_allows(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    let allows = allows(design);
    let used = drop_covered(&allows, diagnostics);
    // What only `check` foresees is reported after this: what has no firmware, and parameters that are not kept.
    let stored = |device: &Device| device.kind.code().is_some_and(|code| code.is_stored);
    let stored: Vec<Span> =
        design.devices.iter().filter(|one| stored(one)).map(|one| one.name.span).collect();
    let is_due = |allow: &Allow| {
        let has = |at: &Span| {
            at.file == allow.scope.file && (allow.scope.start..allow.scope.end).contains(&at.start)
        };
        let is_of_stored = allow.code == w0601_unused_property::CODE && stored.iter().any(has);
        allow.code != w0615_no_firmware::CODE && !is_of_stored
    };
    let unused = allows.iter().enumerate().filter(|(index, _)| !used.contains(index));
    let unused = unused.filter(|(_, allow)| is_due(allow));
    diagnostics.extend(unused.map(|(_, allow)| {
        let rule = format!("allow {}", allow.code);
        let why = "nothing of the kind would be said here";
        w0604_unused_rule::unused_rule(allow.span, &rule, why)
    }));
}

/// Removes the allowed diagnostics from those that come after [`apply_allows`].
pub fn drop_allowed(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    drop_covered(&allows(design), diagnostics);
}

fn allows(design: &Design) -> Vec<&Allow> {
    let of_boards = design.boards.iter().flat_map(|board| &board.allows);
    let of_parts = design.parts.iter().flat_map(|part| &part.allows);
    of_boards.chain(of_parts).collect()
}

/// Removes what is allowed, and returns the indices of the rules that allowed it.
fn drop_covered(allows: &[&Allow], diagnostics: &mut Vec<Diagnostic>) -> BTreeSet<usize> {
    let covered = covered(allows, diagnostics);
    let mut at = 0..;
    diagnostics.retain(|_| at.next().is_none_or(|at| !covered.contains_key(&at)));
    covered.into_values().collect()
}

/// Maps each allowed diagnostic to the first rule that allows it, both by index.
///
/// Walks rules and diagnostics in the order of their places, so that large numbers of both take O(n
/// log n).
fn covered(allows: &[&Allow], diagnostics: &[Diagnostic]) -> BTreeMap<usize, usize> {
    let mut rules: Vec<(usize, &Allow)> = allows.iter().copied().enumerate().collect();
    rules.sort_by_key(|(_, allow)| (allow.code, allow.scope.file, allow.scope.start));
    let can_be_allowed = |(_, one): &(usize, &Diagnostic)| one.severity != Severity::Error;
    let mut warnings: Vec<_> = diagnostics.iter().enumerate().filter(can_be_allowed).collect();
    let place = |one: &Diagnostic| (one.code, one.primary.span.file, one.primary.span.start);
    warnings.sort_by_key(|(_, one)| place(one));
    let mut rules = rules.into_iter().peekable();
    // The scopes that have begun, with the first rule on top.
    let mut open = BinaryHeap::new();
    let mut found = BTreeMap::new();
    for (at, warning) in warnings {
        let (code, file, start) = place(warning);
        let begun = |(_, allow): &(usize, &Allow)| {
            (allow.code, allow.scope.file, allow.scope.start) <= (code, file, start)
        };
        while let Some((index, Allow { code, scope, .. })) = rules.next_if(begun) {
            open.push(Reverse((index, *code, scope.file, scope.end)));
        }
        // A rule that has ended here, or is about something else, cannot apply to any later
        // warning.
        while let Some(Reverse((index, of, within, end))) = open.peek().copied() {
            if (of, within) == (code, file) && start <= end {
                found.insert(at, index);
                break;
            }
            open.pop();
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use sensedsl_diagnostics::SourceMap;

    fn covers(allow: &Allow, one: &Diagnostic) -> bool {
        let (scope, place) = (allow.scope, one.primary.span);
        let within = (scope.start..=scope.end).contains(&place.start);
        one.severity != Severity::Error
            && (allow.code, scope.file) == (one.code, place.file)
            && within
    }

    proptest! {
        #[test]
        fn the_first_rule_that_covers_a_warning_allows_it(
            rules in prop::collection::vec((0..3_usize, 0..2_usize, 0..9_usize, 0..6_usize), 0..12),
            places in prop::collection::vec((0..3_usize, 0..2_usize, 0..12_usize), 0..12),
        ) {
            let mut sources = SourceMap::default();
            let files = [sources.add("a", ""), sources.add("b", "")];
            let codes = ["W0602", "W0604", "E0201"].map(|code| Code::find(code).unwrap());
            let rule = |(code, file, start, length): (usize, usize, usize, usize)| {
                let scope = Span::new(files[file], start..start + length);
                Allow { code: codes[code], reason: String::new(), span: scope, scope }
            };
            let warning = |(code, file, start): (usize, usize, usize)| {
                Diagnostic::new(codes[code], Span::new(files[file], start..start), String::new())
            };
            let rules: Vec<Allow> = rules.into_iter().map(rule).collect();
            let warnings: Vec<Diagnostic> = places.into_iter().map(warning).collect();
            let by_definition = warnings.iter().enumerate().filter_map(|(at, one)| {
                Some((at, rules.iter().position(|allow| covers(allow, one))?))
            });
            let rules: Vec<&Allow> = rules.iter().collect();
            prop_assert_eq!(covered(&rules, &warnings), by_definition.collect());
        }
    }
}
