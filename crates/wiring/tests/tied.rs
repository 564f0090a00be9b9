//! Arrays, chips and the ties between their wires: every question to a wiring, compared with a
//! search that tries every way there is.
#![allow(missing_docs, reason = "tests need none")]
#![allow(dead_code, unreachable_pub, reason = "the support code serves several programs")]
#![cfg(test)]
#![allow(
    clippy::disallowed_methods,
    clippy::wildcard_enum_match_arm,
    reason = "only tests, which ask the environment how much is wanted"
)]

mod support {
    pub(crate) mod meaning;
    pub(crate) mod tied;
}

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_certify::Subject;
use sensedsl_diagnostics::Severity;
use sensedsl_model::design::Design;
use sensedsl_proof::Verified;
use sensedsl_wiring::assignment::Assignment;
use sensedsl_wiring::{Keep, NoWiring, Proved, Repair, Search, Solved, Wiring};
use support::meaning::{Found, all, combinations};
use support::tied::{Case, Kind, Text, case, sound};

/// Number of cases that are tried: fewer in a quick run.
fn cases() -> u64 {
    if std::env::var("SENSEDSL_THOROUGH").is_ok() { 300 } else { 6 }
}

/// The most combinations that one case may have.
const MOST: f64 = 40_000.0;

/// Board, pin and signal of each wire.
type Wires = Vec<(usize, String, String)>;

fn reported(case: &Case, found: &Found) -> Wires {
    let one = |wire: &support::meaning::Wire| {
        let row = &case.boards[wire.board][wire.pin];
        let signal = wire.usage.map_or("GPIO", |usage| row.usages[usage].as_str());
        (wire.board, row.name.clone(), signal.to_owned())
    };
    found.wires.iter().flatten().map(one).collect()
}

fn wires(design: &Design, assignment: &Assignment) -> Wires {
    let mut all = Vec::new();
    for on in &assignment.boards {
        let board = design.board(on.board).unwrap();
        for connection in &on.connections {
            for wire in &connection.wires {
                let pin = wire.pin(board).unwrap().name.to_string();
                all.push((connection.connection, (on.board.0, pin, wire.signal(board).to_owned())));
            }
        }
    }
    all.sort_by_key(|(connection, _)| *connection);
    all.into_iter().map(|(_, wire)| wire).collect()
}

fn objective(assignment: &Assignment) -> [u32; 3] {
    [assignment.violated, assignment.shared, assignment.cost]
}

fn wired(solved: Solved, what: &dyn Fn() -> String) -> Assignment {
    match solved {
        Solved::Wired(wiring) => *wiring,
        other => panic!("{other:?}\n{}", what()),
    }
}

#[derive(Default)]
struct Seen {
    tried: usize,
    wired: usize,
    conflicts: usize,
    hopeless: usize,
    repairs: usize,
    unproved: usize,
}

fn compare(seed: u64, seen: &mut Seen) {
    let mut case = case(seed);
    sound(&mut case);
    if case.parts.is_empty() || combinations(&case) > MOST {
        return;
    }
    let text = Text::of(&case);
    let what = || format!("seed {seed}\n{}", text.all());
    let Some(design) = text.design() else { return };
    let chosen = vec![true; case.parts.len()];
    let found = all(&case, &chosen);
    let wiring = Wiring::new(&design, None);
    seen.tried += 1;
    let errors = wiring.check();
    let errors: Vec<_> = errors.iter().filter(|one| one.severity == Severity::Error).collect();
    if !errors.is_empty() {
        assert!(found.is_empty(), "{errors:?} where there is a wiring\n{}", what());
        seen.hopeless += 1;
        return;
    }
    assert_eq!(wiring.count().unwrap().to_string(), found.len().to_string(), "{}", what());
    match wiring.solve(&Search::default()) {
        Solved::Wired(best) => {
            seen.wired += 1;
            has_best(&case, &found, &design, &best, &what);
        }
        Solved::Infeasible(conflict) => {
            assert!(found.is_empty(), "no wiring found where there is one\n{}", what());
            seen.conflicts += 1;
            minimal(&case, &conflict, &what);
            seen.repairs += true_repairs(&case, &conflict, &what);
        }
        Solved::Failed(diagnostic) => panic!("{diagnostic:?}\n{}", what()),
    }
    seen.unproved += usize::from(!proved(&wiring, found.first(), &what));
}

fn has_best(
    case: &Case,
    found: &[Found],
    design: &Design,
    best: &Assignment,
    what: &dyn Fn() -> String,
) {
    let first = found.first().unwrap_or_else(|| panic!("a wiring where there is none\n{}", what()));
    assert_eq!(objective(best), first.objective[..3], "{}", what());
    neatest(case, found, design, best, what);
    sampled_together(case, design, best, what);
    let wiring = Wiring::new(design, None);
    let any = wired(wiring.solve(&Search { any: true, rise: 0 }), what);
    let any = wires(design, &any);
    assert!(found.iter().any(|one| reported(case, one) == any), "{}", what());
    let listed: Vec<Assignment> = wiring.enumerate().map(|one| wired(one, what)).collect();
    let ours: Vec<_> = listed.iter().map(|one| (objective(one), wires(design, one))).collect();
    let distinct: BTreeSet<&Wires> = ours.iter().map(|(_, wires)| wires).collect();
    assert_eq!(distinct.len(), ours.len(), "a wiring twice\n{}", what());
    let theirs: Vec<_> = found
        .iter()
        .map(|one| ([one.objective[0], one.objective[1], one.objective[2]], reported(case, one)))
        .collect();
    assert_eq!(ours, theirs, "{}", what());
    kept(case, found, design, what);
}

/// Checks that none of the best is neater, and that the first of them stays if none is.
fn neatest(
    case: &Case,
    found: &[Found],
    design: &Design,
    best: &Assignment,
    what: &dyn Fn() -> String,
) {
    let ours = wires(design, best);
    let first = &found[0];
    let equal: Vec<_> = found.iter().take_while(|one| one.objective == first.objective).collect();
    let this = equal.iter().find(|one| reported(case, one) == ours);
    let this = this.unwrap_or_else(|| panic!("none of the best\n{}", what()));
    let stated = (best.neatness.sides, best.neatness.span);
    assert_eq!(neatness(case, this), stated, "{}", what());
    assert!(best.neatness.is_proved, "so few wirings can be tried\n{}", what());
    let least = equal.iter().map(|one| neatness(case, one)).min();
    assert_eq!(Some(stated), least, "{}", what());
    if neatness(case, first) == stated {
        assert_eq!(ours, reported(case, first), "{}", what());
    }
}

/// Sides of connectors and span along them, by the page of the language.
fn neatness(case: &Case, found: &Found) -> (u32, u32) {
    let (mut sides, mut span) = (0, 0);
    let mut connections = found.wires.iter();
    for part in &case.parts {
        let mut used: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        for wire in connections.by_ref().take(part.connections.len()).flatten() {
            let row = &case.boards[wire.board][wire.pin];
            if let Some((header, position)) = row.place {
                used.entry((wire.board, header, row.side)).or_default().push(position);
            }
        }
        sides += used.len() as u32;
        for positions in used.values() {
            span += (positions.iter().max().unwrap() - positions.iter().min().unwrap()) as u32;
        }
    }
    (sides, span)
}

/// Checks that an array that is wanted on one converter is on one.
fn sampled_together(case: &Case, design: &Design, best: &Assignment, what: &dyn Fn() -> String) {
    for (index, part) in case.parts.iter().enumerate() {
        let is_analog = part.connections.iter().all(|(kind, _)| *kind == Kind::Analog);
        if !is_analog || !part.rules.contains(&support::tied::Rule::TogetherUnit) {
            continue;
        }
        let on = best.boards.iter().flat_map(|on| &on.connections);
        let of_part = on.filter(|one| design.connection(one.connection).unwrap().part.0 == index);
        let units: BTreeSet<_> = of_part.map(|one| one.unit.clone()).collect();
        assert_eq!(units.len(), 1, "{units:?}\n{}", what());
    }
}

/// Checks that as few wires are moved as possible.
fn kept(case: &Case, found: &[Found], design: &Design, what: &dyn Fn() -> String) {
    let Some(last) = found.last() else { return };
    let mut keep = Keep::default();
    let before = reported(case, last);
    let mut at = 0;
    for connection in &design.connections {
        let device = &design.device(connection.device).unwrap().name.value;
        for role in connection.kind.roles(connection.direction) {
            let (board, pin, _) = &before[at];
            let board = &design.boards[*board].name.value;
            keep.add(device, &connection.wire_name(role), board, pin);
            at += 1;
        }
    }
    let best = wired(Wiring::new(design, Some(&keep)).solve(&Search::default()), what);
    assert_eq!(best.moved, 0, "{}", what());
    let pins =
        |wires: Wires| -> Vec<_> { wires.into_iter().map(|(at, pin, _)| (at, pin)).collect() };
    assert_eq!(pins(wires(design, &best)), pins(before), "{}", what());
}

/// Checks that without any one of the parts the others can be wired.
fn minimal(case: &Case, conflict: &NoWiring, what: &dyn Fn() -> String) {
    assert!(conflict.minimal && conflict.explained, "{}", what());
    let mut chosen = vec![false; case.parts.len()];
    conflict.parts.iter().for_each(|part| chosen[part.0] = true);
    assert!(all(case, &chosen).is_empty(), "{:?} is no conflict\n{}", conflict.parts, what());
    for part in &conflict.parts {
        chosen[part.0] = false;
        let needed = !all(case, &chosen).is_empty();
        assert!(needed, "{part:?} of {:?} is not needed\n{}", conflict.parts, what());
        chosen[part.0] = true;
    }
}

/// Checks that every reported repair helps, at the reported cost, and that no repair that helps is
/// left out.
fn true_repairs(case: &Case, conflict: &NoWiring, what: &dyn Fn() -> String) -> usize {
    let everything = vec![true; case.parts.len()];
    let output = |wanted: &Repair| {
        conflict.repairs.iter().find(|one| one.repair == *wanted).map(|one| one.cost)
    };
    let cost = |case: &Case, chosen: &[bool]| all(case, chosen).first().map(|one| one.objective[2]);
    for part in &conflict.parts {
        let mut chosen = everything.clone();
        chosen[part.0] = false;
        assert_eq!(output(&Repair::Drop(*part)), cost(case, &chosen), "drop {part:?}\n{}", what());
        let mut freed = case.clone();
        let own = &mut freed.parts[part.0];
        let fixed = !own.rules.is_empty() || own.connections.iter().any(|(_, pin)| pin.is_some());
        own.rules.clear();
        own.connections.iter_mut().for_each(|(_, pin)| *pin = None);
        if fixed && combinations(&freed) <= 4.0 * MOST {
            let cost = cost(&freed, &everything);
            assert_eq!(output(&Repair::Free(*part)), cost, "free {part:?}\n{}", what());
        }
        for board in 0..case.boards.len() {
            let mut moved = case.clone();
            let own = &mut moved.parts[part.0];
            if own.board.is_none_or(|own| own == board)
                || own.connections.iter().any(|(_, pin)| pin.is_some())
            {
                continue;
            }
            own.board = Some(board);
            let to = sensedsl_model::design::BoardIndex(board);
            // The order of the parts does not matter to the cost.
            let cost = cost(&moved, &everything);
            assert_eq!(output(&Repair::Move(*part, to)), cost, "move {part:?}\n{}", what());
        }
    }
    conflict.repairs.len()
}

/// Checks that the certificate proves the best wiring, or that there is none; false if the report
/// is that no certificate was found.
fn proved(wiring: &Wiring<'_>, best: Option<&Found>, what: &dyn Fn() -> String) -> bool {
    let Proved { certificate, .. } = wiring.solve_with_proof(&Subject::default());
    let certificate = certificate.unwrap_or_else(|| panic!("no certificate\n{}", what()));
    let text = match certificate {
        Ok(text) => text,
        Err(why) => {
            assert_eq!(why.code.name(), "E0403", "{}", what());
            return false;
        }
    };
    let verified = sensedsl_proof::verify(&sensedsl_proof::read(&text).unwrap()).unwrap();
    match (verified, best) {
        (Verified::Best(proved), Some(best)) => {
            let ours = [proved.violated, proved.shared, proved.cost, proved.spares];
            assert_eq!(ours, best.objective, "{}", what());
        }
        (Verified::NoWiring, None) => {}
        (verified, _) => panic!("{verified}\n{}", what()),
    }
    true
}

#[test]
fn agrees_with_every_way_there_is() {
    let mut seen = Seen::default();
    for seed in 0..cases() {
        compare(seed, &mut seen);
    }
    let Seen { tried, wired, conflicts, hopeless, repairs, unproved } = seen;
    let counts = format!(
        "{tried} tried, {wired} wired, {conflicts} conflicts, {hopeless} hopeless, \
         {repairs} repairs, {unproved} unproved"
    );
    assert!(wired > tried / 3 && conflicts > tried / 20 && repairs > 0, "{counts}");
    assert!(unproved <= tried / 50, "{counts}");
}
