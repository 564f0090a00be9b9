//! A generated design goes all the way: resolved, checked, solved, proved, reported, generated for
//! all hosts, laid out and generated again. Everything that must hold of any input is asserted.

use std::sync::atomic::{AtomicU32, Ordering};

use sensedsl_certify::Subject;
use sensedsl_diagnostics::{Diagnostic, Severity, SourceMap, render};
use sensedsl_export::{alloy, prolog};
use sensedsl_files::FileSet;
use sensedsl_generate::Selection;
use sensedsl_model::design::Design;
use sensedsl_model::{Request, Resolved, apply_allows, resolve, sort};
use sensedsl_proof::Verified;
use sensedsl_report::{csv, human, json, sheet, svg};
use sensedsl_session::{self as session, Goal, On, Workspace};
use sensedsl_wiring::assignment::{Assignment, BoardAssignment};
use sensedsl_wiring::{Cancel, Keep, Search, Solved, Wiring};

use crate::design::{self, Input};
use crate::draw::Draw;
use crate::reached::{Stage, count};

/// Questions of the search after which it is told to stop: the bound is a count and no time, so
/// that an input does the same everywhere.
const STEPS_MAX: u32 = 20_000;
/// The same where a certificate is wanted: each step of its search is a long one.
const STEPS_PROOF_MAX: u32 = 4_000;

/// What is done with an input besides the plain way. Each costs as much as that, a proof ten times
/// as much: it is asked for least, because `certificate` is a target of its own.
#[derive(Clone, Copy, Debug)]
struct Ask {
    proof: bool,
    keep: bool,
    again: bool,
    any: bool,
}

/// The body of the target.
///
/// # Panics
/// Where something does not hold.
pub fn run(bytes: &[u8]) {
    count(Stage::Run);
    let mut draw = Draw::new(bytes);
    let ask = Ask {
        proof: draw.chance(16),
        keep: draw.chance(32),
        again: draw.chance(48),
        any: draw.chance(24),
    };
    let input = design::draw(&mut draw);
    pipeline(&input, ask);
}

/// The `.sense` text that is made of the bytes, and its tables: to look at a finding.
#[must_use]
pub fn shown(bytes: &[u8]) -> String {
    let mut draw = Draw::new(bytes);
    for _ in 0..4 {
        draw.byte();
    }
    let input = design::draw(&mut draw);
    let mut shown = format!("// --board {:?} --target {:?}\n", input.board, input.target);
    for (path, text) in [("robot.sense", &input.text)]
        .into_iter()
        .chain(input.files.iter().map(|(path, text)| (path.as_str(), text)))
    {
        shown.push_str(&format!("// ---- {path}\n{text}"));
    }
    shown
}

fn pipeline(input: &Input, ask: Ask) {
    let resolved = resolved(input, &input.text);
    let Some(design) = &resolved.design else {
        reported(resolved.diagnostics, &resolved.sources);
        in_part(input);
        laid_out(input, None);
        return;
    };
    count(Stage::Resolved);
    let mut diagnostics = resolved.diagnostics;
    let steps = AtomicU32::new(0);
    let most = if ask.proof { STEPS_PROOF_MAX } else { STEPS_MAX };
    let stop = || stop_after(&steps, most);
    let wiring = Wiring::within(design, None, Cancel::when(&stop));
    diagnostics.extend(wiring.check());
    let mut files = None;
    if !has_errors(&diagnostics) {
        count(Stage::Solved);
        match solve(&wiring, ask) {
            Solved::Wired(assignment) => {
                count(Stage::Wired);
                diagnostics.extend(wiring.warnings(&assignment));
                reports(design, &assignment);
                files = generate(design, &assignment, &mut diagnostics);
                if ask.keep {
                    keep(design, &assignment, &mut diagnostics);
                }
            }
            Solved::Infeasible(conflict) => {
                diagnostics.push(conflict.diagnostic(design));
                let _ = json::infeasible(design, &conflict);
            }
            Solved::Failed(failure) => diagnostics.push(*failure),
        }
        let program = prolog(wiring.problem(), &wiring.labels());
        assert!(program.ends_with('\n') && !program.contains('\0'));
        if ask.proof {
            modelled(&wiring);
        }
    }
    apply_allows(design, &mut diagnostics);
    sort(&mut diagnostics);
    reported(diagnostics, &resolved.sources);
    if ask.again && !ask.any {
        laid_out(input, files.as_ref());
    }
}

/// What is sound of a design with mistakes is wired, and the mistakes are said all the same.
fn in_part(input: &Input) {
    let mut workspace = Workspace::default();
    workspace.open("robot.sense", input.text.as_str());
    let on = On { board: input.board, target: input.target };
    let snapshot = workspace.snapshot("robot.sense", on, input);
    let steps = AtomicU32::new(0);
    let stop = || stop_after(&steps, STEPS_MAX);
    let cancel = Cancel::when(&stop);
    let answer = snapshot.solve(&session::Ask {
        goal: Goal::Any,
        partly: true,
        cancel,
        ..session::Ask::default()
    });
    assert!(has_errors(&answer.diagnostics), "a mistake is gone");
    if let Some((design, wiring)) = answer.wired() {
        let count = |boards: &[BoardAssignment]| -> usize {
            boards.iter().map(|board| board.devices.len()).sum()
        };
        assert_eq!(count(&wiring.boards), design.devices.len());
        reports(design, wiring);
    }
    reported(answer.diagnostics, snapshot.sources());
}

fn resolved(input: &Input, text: &str) -> Resolved {
    let request = Request { path: "robot.sense", text, board: input.board, target: input.target };
    resolve(&request, input)
}

fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|one| one.severity == Severity::Error)
}

/// A stop after so many questions.
fn stop_after(steps: &AtomicU32, most: u32) -> bool {
    steps.fetch_add(1, Ordering::Relaxed) >= most
}

/// Nothing stands outside of the comments of an Alloy model but what it is written with.
fn modelled(wiring: &Wiring<'_>) {
    let Ok(posed) = wiring.posed() else { return };
    let model = alloy(&posed.problem, &posed.labels, &posed.outcome);
    let code = model.lines().map(|line| line.split("//").next().unwrap_or_default());
    let plain = |c: char| c.is_ascii_alphanumeric() || "_ +#&,{}()[]:=<".contains(c);
    assert!(code.flat_map(str::chars).all(plain), "{model}");
}

fn solve(wiring: &Wiring<'_>, ask: Ask) -> Solved {
    if !ask.proof {
        return wiring.solve(&Search { any: ask.any, rise: 0 });
    }
    let proved = wiring.solve_with_proof(&Subject::default());
    let Some(Ok(text)) = &proved.certificate else { return proved.solved };
    let read = sensedsl_proof::read(text).expect("a certificate is read again");
    let verified = sensedsl_proof::verify(&read).expect("a certificate proves its claim");
    match (&proved.solved, verified) {
        (Solved::Wired(wiring), Verified::Best(best)) => {
            assert!(wiring.bound.is_none(), "proved and not sure");
            let claimed = (wiring.moved, wiring.violated, wiring.shared, wiring.cost);
            assert_eq!(claimed, (best.moved, best.violated, best.shared, best.cost));
        }
        (Solved::Infeasible(_), Verified::NoWiring) => {}
        (solved, verified) => panic!("{solved:?}, but {verified:?}"),
    }
    count(Stage::Certified);
    proved.solved
}

fn reports(design: &Design, assignment: &Assignment) {
    let _ = human::human(design, assignment, false);
    let _ = csv::csv(design, assignment);
    let _ = sheet::markdown::markdown(design, assignment);
    let picture = svg::svg(design, assignment);
    let parsed = roxmltree::Document::parse(&picture);
    assert!(parsed.is_ok(), "{parsed:?}\n{picture}");
    let answer = format!("{:#}", json::wired(design, assignment));
    let answer: serde_json::Value = serde_json::from_str(&answer).expect("JSON");
    assert!(json::keep(&answer).is_some(), "the answer cannot be kept");
}

fn generate(
    design: &Design,
    assignment: &Assignment,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<FileSet> {
    count(Stage::Generate);
    let made = sensedsl_generate::project("robot", design, assignment, &Selection::ALL);
    if !made.files.is_empty() {
        checked(&made.files);
    }
    if made.gaps.is_empty() {
        count(Stage::Files);
        return Some(made.files);
    }
    assert!(has_errors(&made.gaps), "no firmware, and no reason");
    let is_firmware = |path: &str| path.starts_with("firmware/");
    assert!(!made.files.iter().any(|(path, _)| is_firmware(path)), "a part of the firmware");
    diagnostics.extend(made.gaps);
    None
}

/// Paths stay inside the folder and can be written on any system; JSON and SVG parse; text is text.
fn checked(files: &FileSet) {
    assert!(!files.is_empty());
    for (path, entry) in files.iter() {
        let text = std::str::from_utf8(&entry.bytes).expect("generated files are text");
        for part in path.split('/') {
            let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
            assert!(part.chars().all(plain), "{path}");
            // Cargo reads its configuration there and nowhere else.
            let is_hidden = part.starts_with('.') && part != ".cargo";
            assert!(!part.is_empty() && !is_hidden && !part.ends_with('.'), "{path}");
        }
        let turns = |c: char| matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        let odd = |c: &char| turns(*c) || c.is_control() && !matches!(*c, '\n' | '\t');
        assert_eq!(text.chars().find(odd), None, "{path}");
        if path.ends_with(".json") {
            serde_json::from_str::<serde_json::Value>(text).expect("JSON");
        }
    }
}

/// A wiring that is kept moves nothing and costs the same.
fn keep(design: &Design, assignment: &Assignment, diagnostics: &mut Vec<Diagnostic>) {
    let before: Option<Keep> = json::keep(&json::wired(design, assignment));
    let steps = AtomicU32::new(0);
    let stop = || stop_after(&steps, STEPS_MAX);
    let wiring = Wiring::within(design, before.as_ref(), Cancel::when(&stop));
    match wiring.solve(&Search::default()) {
        Solved::Wired(again) if again.bound.is_none() => {
            assert_eq!(again.moved, 0, "what is kept has moved");
        }
        Solved::Wired(_) => {}
        Solved::Infeasible(_) => panic!("what was wired has no wiring"),
        Solved::Failed(failure) => diagnostics.push(*failure),
    }
}

/// Every place is in its text, edits as well; every form can be rendered; the solver never fails
/// its own check.
fn reported(mut diagnostics: Vec<Diagnostic>, sources: &SourceMap) {
    for one in &diagnostics {
        assert_ne!(one.code.name(), "E0402", "{}", one.message);
        let edits = one.fixes.iter().flat_map(|fix| &fix.edits).map(|edit| edit.span);
        let labels = one.labels.iter().map(|label| label.span);
        for span in edits.chain(labels).chain([one.primary.span]) {
            let inside = sources.text(span.file).get(span.range());
            assert!(inside.is_some(), "{span:?} of {} is no place in the text", one.code);
        }
        assert!(!one.message.is_empty());
    }
    diagnostics.truncate(8);
    let _ = render::human(&diagnostics, sources, true);
    let _ = render::github(&diagnostics, sources);
    for text in [render::json(&diagnostics, sources), render::sarif(&diagnostics, sources, "0")] {
        serde_json::from_str::<serde_json::Value>(&text).expect("JSON");
    }
}

/// The canonical layout is stable, and the same files come out of it.
fn laid_out(input: &Input, files: Option<&FileSet>) {
    let Ok(formatted) = sensedsl_syntax::format(&input.text) else { return };
    assert_eq!(sensedsl_syntax::format(&formatted).as_deref(), Ok(formatted.as_str()));
    let Some(files) = files else { return };
    let resolved = resolved(input, &formatted);
    let design = resolved.design.expect("a file that is laid out still resolves");
    let steps = AtomicU32::new(0);
    let stop = || stop_after(&steps, STEPS_MAX);
    let wiring = Wiring::within(&design, None, Cancel::when(&stop));
    let Solved::Wired(again) = wiring.solve(&Search::default()) else {
        panic!("a file that is laid out has no wiring");
    };
    let again = sensedsl_generate::project("robot", &design, &again, &Selection::ALL);
    for ((path, one), (_, two)) in files.iter().zip(again.files.iter()) {
        assert!(one == two, "{path} differs once the file is laid out");
    }
    assert_eq!((&again.files, again.gaps.as_slice()), (files, [].as_slice()));
}
