//! The search for neat answers against an oracle that tries all of them, on random problems with
//! random contacts.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "only tests")]

use crate::brute::{on_equal_boards, problem, with_equal_bundles};
use crate::support::{brute, generate};
use proptest::prelude::*;
use sensedsl_solve::neat::{Contact, Layout, Neat, Neatness, neaten};
use sensedsl_solve::problem::{PinId, Problem};
use sensedsl_solve::{Answer, Cancel, Choice, Objective, Options, Outcome, check, solve};
use std::collections::{BTreeMap, BTreeSet};

/// Parts of one to three devices, and pins with up to two contacts on three sides.
fn layouts() -> impl Strategy<Value = (Vec<bool>, Vec<Vec<Contact>>)> {
    let contact = (0..3u32, 0..5u32).prop_map(|(side, index)| Contact { side, index });
    let contacts = prop::collection::vec(prop::collection::vec(contact, 0..3), 6..13);
    (prop::collection::vec(any::<bool>(), 4), contacts)
}

fn layout(problem: &Problem, (begins, contacts): &(Vec<bool>, Vec<Vec<Contact>>)) -> Layout {
    let mut part = 0;
    let parts = begins.iter().map(|begins| {
        part += u32::from(*begins);
        part
    });
    Layout {
        parts: parts.take(problem.devices.len()).collect(),
        contacts: contacts.iter().cycle().take(problem.pins.len()).cloned().collect(),
    }
}

/// How neat choices are, by the definition: all contacts of all pins are tried.
fn measured(problem: &Problem, layout: &Layout, choices: &[Choice]) -> Neatness {
    let mut parts: BTreeMap<u32, BTreeSet<PinId>> = BTreeMap::new();
    for ((device, choice), part) in problem.devices.iter().zip(choices).zip(&layout.parts) {
        let roles = &device.alternatives[choice.alternative].roles;
        let wires = roles.iter().zip(&choice.candidates);
        parts.entry(*part).or_default().extend(wires.map(|(r, c)| r.candidates[*c].pin));
    }
    let mut sum = Neatness::default();
    for pins in parts.values() {
        let mut ways: Vec<Vec<Contact>> = vec![Vec::new()];
        for pin in pins {
            let contacts = &layout.contacts[pin.0 as usize];
            if !contacts.is_empty() {
                let longer = |way: &Vec<Contact>, contact: &Contact| {
                    way.iter().copied().chain([*contact]).collect()
                };
                ways = ways
                    .iter()
                    .flat_map(|way| contacts.iter().map(move |contact| longer(way, contact)))
                    .collect();
            }
        }
        let least = ways.iter().map(|way| neatness_of(way)).min().unwrap_or_default();
        (sum.sides, sum.span) = (sum.sides + least.sides, sum.span + least.span);
    }
    sum
}

fn neatness_of(contacts: &[Contact]) -> Neatness {
    let sides: BTreeSet<u32> = contacts.iter().map(|contact| contact.side).collect();
    let span = |side: &u32| {
        let on = contacts.iter().filter(|contact| contact.side == *side);
        let on: Vec<u32> = on.map(|contact| contact.index).collect();
        on.iter().max().unwrap() - on.iter().min().unwrap()
    };
    Neatness { sides: sides.len() as u32, span: sides.iter().map(span).sum() }
}

/// Whether an answer may be taken in place of the best one.
fn may_replace(best: Objective, one: Objective, rise: u32) -> bool {
    (one.moved, one.violated, one.shared) == (best.moved, best.violated, best.shared)
        && one.cost <= best.cost + rise
        && one.spares <= best.spares
}

fn best(problem: &Problem) -> Option<Answer> {
    match solve(problem, &Options::default()) {
        Ok(Outcome::Solved(answer)) => Some(answer),
        _ => None,
    }
}

/// What must hold for a problem; returns whether the neatness is proved.
fn compare(problem: &Problem, layout: &Layout, rise: u32) -> Result<bool, TestCaseError> {
    let Some(best) = best(problem) else { return Ok(true) };
    let neat = neaten(problem, layout, &best, rise, Cancel::NEVER).unwrap();
    prop_assert_eq!(check(problem, &neat.answer), Ok(()));
    prop_assert!(may_replace(best.objective, neat.answer.objective, rise));
    prop_assert_eq!(neat.neatness, measured(problem, layout, &neat.answer.choices));
    prop_assert_eq!(neat.neatness, layout.neatness(problem, &neat.answer));
    let all = brute::all(problem);
    let allowed = all.iter().filter(|one| may_replace(best.objective, one.objective, rise));
    let least = allowed.map(|one| measured(problem, layout, &one.choices())).min().unwrap();
    prop_assert!(neat.neatness >= least);
    if neat.is_proved {
        prop_assert_eq!(neat.neatness, least);
    }
    if measured(problem, layout, &best.choices) == least && rise == 0 {
        prop_assert_eq!(&neat.answer, &best, "the first of the best is as neat");
    }
    let again = neaten(problem, layout, &best, rise, Cancel::NEVER).unwrap();
    prop_assert_eq!(&neat, &again);
    Ok(neat.is_proved)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn proved_answers_are_the_neatest(problem in problem(), places in layouts(), rise in 0..4u32) {
        prop_assume!(brute::combinations(&problem) < 10_000.0);
        let is_proved = compare(&problem, &layout(&problem, &places), rise)?;
        // So few devices never take all steps; alike bundles and boards may, and where wirings may cost more.
        prop_assert!(is_proved || rise > 0, "not proved");
    }

    #[test]
    fn equal_bundles_are_as_neat_as_can_be(problem in with_equal_bundles(), places in layouts()) {
        prop_assume!(brute::combinations(&problem) < 3_000.0);
        let _ = compare(&problem, &layout(&problem, &places), 0)?;
    }

    #[test]
    fn equal_boards_may_have_different_contacts(problem in on_equal_boards(), places in layouts()) {
        prop_assume!(brute::combinations(&problem) < 2_000.0);
        let _ = compare(&problem, &layout(&problem, &places), 0)?;
    }
}

/// A problem as large as a robot, with a pin at one or two contacts of double-row connectors.
fn robot(seed: u64) -> (Problem, Layout) {
    let table = generate::table(seed, 80);
    let problem = generate::problem(seed, &[(&table, false)], 24, generate::Mix::General, true);
    let problem = problem.problem;
    let contacts = (0..problem.pins.len() as u32).map(|pin| {
        let own = Contact { side: pin / 20, index: pin % 20 / 2 };
        let other = Contact { side: 10 + pin / 7, index: pin % 7 };
        if pin % 3 == 0 { vec![own, other] } else { vec![own] }
    });
    let layout = Layout {
        parts: (0..problem.devices.len() as u32).map(|device| device / 2).collect(),
        contacts: contacts.collect(),
    };
    (problem, layout)
}

#[test]
fn the_effort_is_bounded_by_steps() {
    let mut solved = 0;
    for seed in 0..6 {
        let (problem, layout) = robot(seed);
        let Some(best) = best(&problem) else { continue };
        let Neat { neatness, steps, .. } =
            neaten(&problem, &layout, &best, 0, Cancel::NEVER).unwrap();
        assert!(neatness <= layout.neatness(&problem, &best), "{seed}");
        assert!(steps <= 7_000, "{seed}: {steps}");
        solved += 1;
    }
    assert!(solved > 0);
}

#[test]
fn without_contacts_the_best_answer_stays() {
    for seed in 0..3 {
        let (problem, layout) = robot(seed);
        let Some(best) = best(&problem) else { continue };
        let none = Layout { contacts: vec![Vec::new(); problem.pins.len()], ..layout };
        let neat = neaten(&problem, &none, &best, 5, Cancel::NEVER).unwrap();
        assert_eq!((neat.answer, neat.is_proved, neat.steps), (best, true, 0));
        assert_eq!(neat.neatness, Neatness::default());
    }
}
