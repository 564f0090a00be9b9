//! Certificates of random problems: they are verified, and whatever still passes after a change is
//! true.
#![allow(missing_docs, reason = "tests need none")]
#![expect(clippy::disallowed_methods, reason = "a test asks the environment how much is wanted")]
#![allow(clippy::indexing_slicing, clippy::expect_used, clippy::panic, reason = "only tests")]

#[path = "../../solve/tests/support/mod.rs"]
mod support;

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_certify::{AlternativeLabels, Claim, Labels, Subject, certify, sha256};
use sensedsl_proof::format::{Alternative, Candidate, Certificate, Objective};
use sensedsl_proof::{Verified, read, verify};
use sensedsl_solve::problem::{Holder, Problem, RuleId};
use sensedsl_solve::{Cancel, Options, Outcome, solve_and_learn};
use serde_json::Value;
use support::generate::{self, Mix, Rng};

/// The subject of a problem made from one file whose name needs escapes.
fn subject() -> Subject {
    let file = ("a \"quoted\"\n\u{202e}.sense".to_owned(), sha256(b"text"));
    Subject { tool: "a test".to_owned(), files: vec![file], ..Subject::default() }
}

/// Names made only of numbers.
fn numbered(problem: &Problem) -> Labels {
    let list = |word: &str, count: usize| -> Vec<String> {
        (0..count).map(|number| format!("{word}{number}")).collect()
    };
    let alternatives = problem.devices.iter().map(|device| {
        let names = list("way", device.alternatives.len()).into_iter();
        let all = names.zip(&device.alternatives).map(|(name, alternative)| AlternativeLabels {
            name,
            roles: list("wire", alternative.roles.len()),
        });
        all.collect()
    });
    let all = || problem.devices.iter().flat_map(|device| &device.alternatives);
    let candidates = || all().flat_map(|one| &one.roles).flat_map(|role| &role.candidates);
    let signals = candidates().map(|one| (one.signal.0, format!("signal{}", one.signal.0)));
    let claims = all().flat_map(|one| &one.claims).chain(candidates().flat_map(|one| &one.claims));
    let holders = claims.map(|claim| claim.holder).chain(candidates().map(|one| one.holder));
    let groups = holders.map(|holder| match holder {
        Holder::Own => 0,
        Holder::Group(group) => group as usize + 1,
    });
    Labels {
        boards: list("board", problem.boards.len()),
        pins: list("pin", problem.pins.len()),
        devices: list("device", problem.devices.len()),
        alternatives: alternatives.collect(),
        signals: signals.collect(),
        resources: list("resource", problem.resources as usize),
        groups: list("group", groups.max().unwrap_or(0)),
        rules: list("rule", problem.rules as usize),
        dma: list("user", problem.dma.len()),
        streams: list("stream", problem.streams as usize),
    }
}

/// A random problem: one or two boards, the second perhaps a spare one, some rules, some wires
/// that were elsewhere before.
fn problem(seed: u64, pins: u64, devices: u64) -> Problem {
    let mut rng = Rng(seed);
    let boards = 1 + rng.below(2);
    let tables: Vec<String> =
        (0..boards).map(|board| generate::table(seed + 77 * board, pins)).collect();
    let spare = rng.below(2) == 0;
    let tables: Vec<(&str, bool)> =
        tables.iter().enumerate().map(|(at, table)| (table.as_str(), at > 0 && spare)).collect();
    let mix = [Mix::General, Mix::Dma, Mix::Timers][rng.below(3) as usize];
    let mut problem = generate::problem(seed, &tables, devices, mix, mix == Mix::Dma).problem;
    problem.rules = rng.below(4) as u32;
    let with_shared = rng.below(2) == 0;
    problem.pins.iter_mut().for_each(|pin| pin.shared = with_shared && rng.below(3) == 0);
    let (rules, keep) = (problem.rules, rng.below(3) == 0);
    let all = problem.devices.iter_mut().flat_map(|device| &mut device.alternatives);
    for candidate in all.flat_map(|one| &mut one.roles).flat_map(|role| &mut role.candidates) {
        // Devices that share a pin violate and move together, so this depends on the pin.
        let mut of_pin = Rng(seed ^ (u64::from(candidate.pin.0) << 8));
        if rules > 0 && of_pin.below(3) == 0 {
            candidate.violates = vec![RuleId(of_pin.below(u64::from(rules)) as u32)];
        }
        candidate.moved = keep && of_pin.below(2) == 0;
    }
    problem
}

/// The certificate of what the solver finds, with the objective of the wiring; `None` if no proof
/// is found.
fn certificate(problem: &Problem) -> Option<(String, Option<Objective>)> {
    let labels = numbered(problem);
    let (outcome, learned) =
        solve_and_learn(problem, &Options::default()).expect("a proper problem");
    match outcome {
        Outcome::Solved(answer) => {
            let claim = Claim::Best(&answer, &learned);
            let text = certify(problem, &labels, &subject(), claim, Cancel::NEVER).ok()?;
            let sensedsl_solve::Objective { moved, violated, shared, cost, spares } =
                answer.objective;
            Some((text, Some(Objective { moved, violated, shared, cost, spares })))
        }
        Outcome::Infeasible(conflict) => {
            let claim = Claim::NoWiring(&conflict.devices);
            Some((certify(problem, &labels, &subject(), claim, Cancel::NEVER).ok()?, None))
        }
        Outcome::Stopped { .. } => unreachable!("nobody stopped it"),
    }
}

/// Moved wires, rules violated, shared pins, cost, spare boards.
type Parts = (u32, u32, u32, u64, u32);

/// All wirings of a certificate's problem, tried one by one as long as there are not too many, and
/// the best objective.
struct Brute<'a> {
    certificate: &'a Certificate,
    left: u32,
    best: Option<Parts>,
}

/// What devices hold: by kind and name, the device and on whose behalf.
type Held<'a> = BTreeMap<(&'a str, &'a str), Vec<(&'a str, String)>>;

#[derive(Clone, Default)]
struct Used<'a> {
    held: Held<'a>,
    moved: BTreeSet<&'a str>,
    rules: BTreeSet<&'a str>,
    boards: BTreeSet<&'a str>,
    dma: BTreeSet<&'a str>,
}

impl<'a> Used<'a> {
    fn hold(&mut self, thing: (&'a str, &'a str), device: &'a str, behalf: String) -> bool {
        let holders = self.held.entry(thing).or_default();
        let fits = |(other, of): &(&str, String)| {
            *other == device || (*of == behalf && !behalf.starts_with("own"))
        };
        let fits = holders.iter().all(fits);
        holders.push((device, behalf));
        fits
    }

    fn take(&mut self, device: &'a str, way: &'a Alternative, wires: &[&'a Candidate]) -> bool {
        self.boards.insert(&way.board);
        self.dma.extend(way.dma.iter().map(String::as_str));
        self.rules.extend(way.violates.iter().map(String::as_str));
        let mut fits = true;
        let mut pins = BTreeSet::new();
        for wire in wires {
            fits &= pins.insert(&wire.pin);
            let behalf = format!("{} {}", wire.holder, wire.signal);
            let behalf = if wire.holder == "own" { "own".into() } else { behalf };
            fits &= self.hold(("pin", &wire.pin), device, behalf);
            self.rules.extend(wire.violates.iter().map(String::as_str));
            self.moved.extend(wire.moved.then_some(wire.pin.as_str()));
        }
        let claims = way.claims.iter().chain(wires.iter().flat_map(|wire| wire.claims.iter()));
        for (resource, holder) in claims {
            fits &= self.hold(("resource", resource), device, holder.clone());
        }
        fits
    }
}

impl<'a> Brute<'a> {
    fn best(certificate: &'a Certificate) -> Option<Option<Parts>> {
        let mut brute = Self { certificate, left: 30_000, best: None };
        brute.next(&certificate.problem.devices.keys().collect::<Vec<_>>(), &Used::default());
        (brute.left > 0).then_some(brute.best)
    }

    fn next(&mut self, devices: &[&'a String], used: &Used<'a>) {
        let problem = &self.certificate.problem;
        let Some((device, rest)) = devices.split_first() else {
            let requests = used.dma.iter().flat_map(|user| &problem.dma[*user]);
            let requests: Vec<Vec<&String>> = requests.map(|one| one.iter().collect()).collect();
            if support::brute::serve(&requests, &mut BTreeSet::new()) {
                let pins = used.held.keys().filter(|(kind, _)| *kind == "pin");
                let shared = pins.clone().filter(|(_, pin)| problem.shared.contains(*pin)).count();
                let cost = pins.map(|(_, pin)| u64::from(problem.pins[*pin])).sum();
                let spares = used.boards.iter().filter(|board| problem.boards[**board]).count();
                let (moved, violated) = (used.moved.len() as u32, used.rules.len() as u32);
                let objective = (moved, violated, shared as u32, cost, spares as u32);
                self.best = Some(self.best.map_or(objective, |best| best.min(objective)));
            }
            return;
        };
        for way in problem.devices[*device].values() {
            let mut wirings: Vec<Vec<&Candidate>> = vec![Vec::new()];
            for role in way.roles.values() {
                let longer = |wires: &Vec<&'a Candidate>| {
                    let wires = wires.clone();
                    let add = move |one| wires.iter().copied().chain([one]).collect();
                    role.values().map(add).collect::<Vec<Vec<_>>>()
                };
                wirings = wirings.iter().flat_map(longer).take(self.left as usize).collect();
            }
            for wires in wirings {
                self.left = self.left.saturating_sub(1);
                let mut used = used.clone();
                if self.left > 0 && used.take(device, way, &wires) {
                    self.next(rest, &used);
                }
            }
        }
    }
}

/// Changes one place of a text of JSON: a number, a flag or a name, or removes an entry.
fn mutate(value: &mut Value, rng: &mut Rng) {
    match value {
        Value::Object(map) if !map.is_empty() => {
            let at = rng.below(map.len() as u64) as usize;
            let key = map.keys().nth(at).cloned().expect("in range");
            if rng.below(12) == 0 {
                map.remove(&key);
            } else {
                mutate(&mut map[&key], rng);
            }
        }
        Value::Array(list) if !list.is_empty() => {
            let at = rng.below(list.len() as u64) as usize;
            if rng.below(12) == 0 {
                list.remove(at);
            } else {
                mutate(&mut list[at], rng);
            }
        }
        Value::Number(number) => {
            let old = number.as_u64().unwrap_or(0);
            let new = [old.saturating_sub(1), old + 1, 0, u64::from(u32::MAX), u64::MAX];
            *value = new[rng.below(5) as usize].into();
        }
        Value::Bool(flag) => *flag = !*flag,
        Value::String(text) => {
            let number = rng.below(9).to_string();
            *text = if rng.below(4) == 0 {
                "own".into()
            } else {
                format!("{}{number}", text.trim_end_matches(|c: char| c.is_ascii_digit()))
            };
        }
        Value::Null | Value::Object(_) | Value::Array(_) => *value = Value::from(1),
    }
}

#[test]
fn certificates_of_random_problems_are_verified() {
    for seed in 0..120 {
        let problem = problem(seed, 40 + 7 * (seed % 9), 1 + seed % 8);
        let (text, objective) = certificate(&problem).unwrap_or_else(|| panic!("seed {seed}"));
        let expected = objective.map_or(Verified::NoWiring, Verified::Best);
        assert_eq!(verify(&read(&text).expect("readable")), Ok(expected), "seed {seed}");
    }
}

/// The record of devices that float between a board and three equal spare ones.
fn floating(seed: u64) -> Option<Value> {
    let table = generate::table(seed, 16 + seed % 8);
    let on = |spare| (table.as_str(), spare);
    let tables = [on(false), on(true), on(true), on(true)];
    let problem = generate::problem(seed, &tables, 8 + seed % 9, Mix::General, false).problem;
    let (text, _) = certificate(&problem)?;
    serde_json::from_str(&text).expect("JSON")
}

/// The first swap of a record that moves at least this many of a kind.
fn swap_of(value: &Value, kind: &str, least: usize) -> Option<usize> {
    let moves = |swap: &Value| swap[kind].as_array().is_some_and(|row| row.len() >= least);
    value["search"]["swaps"].as_array()?.iter().position(moves)
}

fn holds(value: &Value) -> bool {
    read(&value.to_string()).is_ok_and(|certificate| verify(&certificate).is_ok())
}

/// Whether the certificate holds without the first pair of a swap.
fn holds_without(value: &Value, at: usize, kind: &str, length: usize) -> bool {
    let mut wrong = value.clone();
    wrong["search"]["swaps"][at][kind].as_array_mut().expect("a row").drain(..length);
    holds(&wrong)
}

#[test]
fn a_wrong_permutation_and_boards_that_differ_are_refused() {
    let found = (0..60).filter_map(floating);
    let found = found.filter_map(|value| Some((swap_of(&value, "boards", 2)?, value)));
    let found: Vec<(usize, Value)> = found.take(5).collect();
    assert!(!found.is_empty(), "no record swaps boards");
    for (at, value) in found {
        assert!(holds(&value));
        // Two pins of the swap each go where the other one should.
        let mut wrong = value.clone();
        let pins = wrong["search"]["swaps"][at]["pins"].as_array_mut().expect("a row");
        pins.swap(1, 3);
        assert!(!holds(&wrong), "a wrong permutation of pins passes");
        assert!(!holds_without(&value, at, "ways", 3), "an alternative that stays behind passes");
        // One of the boards is not a spare one.
        let mut wrong = value.clone();
        let board = value["search"]["swaps"][at]["boards"][1].as_u64().expect("a number");
        let boards = wrong["problem"]["boards"].as_object_mut().expect("boards");
        *boards.values_mut().nth(board as usize).expect("the board") = Value::Bool(false);
        assert!(!holds(&wrong), "boards that differ pass");
    }
}

/// Four pairs of devices that share a place of two pins each. Of the three cheap places, any two
/// exclude each other, which prices do not see; the last of the expensive ones violates a rule of
/// the pair.
fn pairs() -> Problem {
    use sensedsl_solve::problem as of;
    let claim = |resource, holder| of::Claim { resource: of::ResourceId(resource), holder };
    let way = |pair: u32, second: u32, place: u32| {
        let pin = 2 * place + second;
        let candidate = of::Candidate::new(of::PinId(pin), of::SignalId(pin));
        let mut claims = vec![claim(pair, Holder::Group(place))];
        if second == 0 && place < 3 {
            let others = [4 + place, 4 + (place + 1) % 3];
            claims.extend(others.map(|resource| claim(resource, Holder::Own)));
        }
        of::Alternative {
            board: of::BoardId(0),
            claims,
            violates: if place == 6 { vec![RuleId(pair)] } else { Vec::new() },
            dma: Vec::new(),
            roles: vec![of::Role { candidates: vec![candidate] }],
        }
    };
    let device = |pair, second| of::Device {
        alternatives: (0..7).map(|place| way(pair, second, place)).collect(),
    };
    let cost = |pin: u32| if pin < 6 { 1 } else { 5 };
    Problem {
        pins: (0..14)
            .map(|pin| of::Pin { board: of::BoardId(0), cost: cost(pin), shared: false })
            .collect(),
        boards: vec![of::Board { spare: false }],
        devices: (0..4).flat_map(|pair| [device(pair, 0), device(pair, 1)]).collect(),
        rules: 4,
        resources: 7,
        ..Problem::default()
    }
}

#[test]
fn pairs_of_devices_change_places_with_what_ties_them() {
    let (text, _) = certificate(&pairs()).expect("a record");
    let value: Value = serde_json::from_str(&text).expect("JSON");
    let at = swap_of(&value, "devices", 4).expect("a swap of pairs");
    assert!(holds(&value));
    for kind in ["devices", "resources", "rules"] {
        assert!(!holds_without(&value, at, kind, 2), "{kind} that stay behind pass");
    }
}

#[test]
fn wrong_multipliers_and_cases_left_out_are_refused() {
    let (mut emptied, mut shortened) = (0, 0);
    for seed in 0..40 {
        let problem = problem(seed, 40 + 7 * (seed % 9), 1 + seed % 8);
        let Some((text, _)) = certificate(&problem) else { continue };
        let value: Value = serde_json::from_str(&text).expect("JSON");
        let steps = value["search"]["steps"].as_array().expect("steps");
        for at in 0..steps.len().min(20) {
            let Some(by) = steps[at].get("closed") else { continue };
            let mut wrong = value.clone();
            // No prices at all.
            wrong["search"]["steps"][at]["closed"] = serde_json::json!({ "scale": by["scale"] });
            emptied += u32::from(!holds(&wrong));
        }
        let mut wrong = value.clone();
        wrong["search"]["steps"].as_array_mut().expect("steps").pop();
        assert!(!holds(&wrong), "seed {seed}: a case is left out");
        shortened += 1;
    }
    assert!(emptied > 5 && shortened > 30, "{emptied}, {shortened}");
}

#[test]
fn what_passes_after_a_change_is_true() {
    let (mut refused, mut true_all_the_same) = (0, 0);
    let seeds = if std::env::var("SENSEDSL_THOROUGH").is_ok() { 80 } else { 12 };
    for seed in 1000..1000 + seeds {
        let problem = problem(seed, 26, 1 + seed % 3);
        let Some((text, _)) = certificate(&problem) else { continue };
        let value: Value = serde_json::from_str(&text).expect("JSON");
        let mut rng = Rng(seed);
        for _ in 0..20 {
            let mut value = value.clone();
            // The proof and the answer are small compared with the problem.
            let part = ["problem", "answer", "search"][rng.below(3) as usize];
            mutate(&mut value[part], &mut rng);
            let Ok(certificate) = read(&value.to_string()) else { continue };
            let Ok(verified) = verify(&certificate) else {
                refused += 1;
                continue;
            };
            let Some(best) = Brute::best(&certificate) else { continue };
            let claimed = match verified {
                Verified::Best(Objective { moved, violated, shared, cost, spares }) => {
                    Some((moved, violated, shared, u64::from(cost), spares))
                }
                Verified::NoWiring => None,
            };
            assert_eq!(claimed, best, "seed {seed}: {value}");
            true_all_the_same += 1;
        }
    }
    let least = seeds * 5 / 4;
    assert!(refused > least && true_all_the_same > least, "{refused}, {true_all_the_same}");
}
