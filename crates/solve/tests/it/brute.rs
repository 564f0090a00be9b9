//! Random small problems against the oracle: objective, exact answer, order, count, conflicts.

use crate::support::brute::{self, Found};
use proptest::prelude::*;
use sensedsl_solve::problem::{
    Alternative, Board, BoardId, Candidate, Claim, Device, DmaRequest, DmaUser, DmaUserId, Holder,
    Pin, PinId, Problem, ResourceId, Role, RuleId, SignalId, StreamId,
};
use sensedsl_solve::{Cancel, Options, Outcome, check, count, enumerate, solve};

const RESOURCES: u32 = 6;
const RULES: u32 = 3;

fn holder() -> impl Strategy<Value = Holder> {
    prop_oneof![3 => Just(Holder::Own), 1 => (0..2u32).prop_map(Holder::Group)]
}

fn claims(most: usize) -> impl Strategy<Value = Vec<Claim>> {
    let claim = ((0..RESOURCES).prop_map(ResourceId), holder());
    prop::collection::vec(claim.prop_map(|(resource, holder)| Claim { resource, holder }), 0..=most)
}

fn violates() -> impl Strategy<Value = Vec<RuleId>> {
    prop_oneof![
        4 => Just(vec![]),
        1 => (0..RULES).prop_map(|r| vec![RuleId(r)]),
    ]
}

/// An unshared role, or a wire of a bus: one pin for all devices on it.
fn role(pins: u32, base: u32) -> impl Strategy<Value = Role> {
    let candidate = ((0..pins), 0..2u32, claims(1), violates(), prop::bool::weighted(0.2));
    // The wires of one bus may be in one row, and one of them may have two names.
    let wire = (0..2u32, any::<bool>(), prop::bool::weighted(0.3));
    let bus = prop_oneof![3 => Just(None), 2 => wire.prop_map(Some)];
    (prop::collection::vec((candidate, holder()), 1..4), bus, prop::bool::weighted(0.15)).prop_map(
        move |(list, bus, wild)| {
            let mut candidates: Vec<Candidate> = list
                .into_iter()
                .map(|((pin, signal, mut claims, violates, moved), holder)| {
                    let mut signal = signal;
                    let holder = match bus {
                        Some((wire, one_bus, names)) => {
                            let resource = ResourceId(RESOURCES + wire);
                            let name = if names { signal } else { 0 };
                            let holder = Holder::Group(base + pin + 100 * name);
                            claims.push(Claim { resource, holder });
                            signal = 2 + wire + 2 * name;
                            Holder::Group(if one_bus { 10 } else { 11 + wire })
                        }
                        None if wild => holder,
                        None => Holder::Own,
                    };
                    let pin = PinId(base + pin);
                    let signal = SignalId(signal);
                    Candidate { pin, holder, signal, claims, violates, moved }
                })
                .collect();
            candidates.sort_by_key(|c| (c.pin, c.signal));
            candidates.dedup_by_key(|c| (c.pin, c.signal));
            Role { candidates }
        },
    )
}

fn alternative(board: u32, pins: u32, wires: usize) -> impl Strategy<Value = Alternative> {
    let roles = prop::collection::vec(role(pins, board * pins), wires..=wires);
    let dma = prop_oneof![2 => Just(vec![]), 1 => (0..3u32).prop_map(|u| vec![DmaUserId(u)])];
    (roles, claims(2), violates(), dma).prop_map(move |(roles, claims, violates, dma)| {
        Alternative { board: BoardId(board), claims, violates, dma, roles }
    })
}

fn device(boards: u32, pins: u32) -> impl Strategy<Value = Device> {
    let choice =
        (0..boards, 1..3usize).prop_flat_map(move |(board, wires)| alternative(board, pins, wires));
    prop::collection::vec(choice, 1..4).prop_map(|mut alternatives| {
        // No answer may be reachable through two alternatives on one board.
        for (index, a) in alternatives.iter_mut().enumerate() {
            for c in a.roles.iter_mut().flat_map(|r| &mut r.candidates) {
                if c.holder == Holder::Own {
                    c.signal.0 = c.signal.0 * 4 + index as u32 + 10;
                }
            }
            for r in &mut a.roles {
                r.candidates.sort_by_key(|c| (c.pin, c.signal));
            }
        }
        Device { alternatives }
    })
}

/// A problem in which some devices occur several times.
pub(crate) fn problem() -> impl Strategy<Value = Problem> {
    let shape = (1..3u32, 3..6u32);
    let devices = move |(boards, pins): (u32, u32)| {
        let device = (device(boards, pins), 1..3usize);
        let pin = (0..4u32, prop::bool::weighted(0.3));
        let costs = prop::collection::vec(pin, (boards * pins) as usize);
        let spare = prop::collection::vec(prop::bool::weighted(0.4), boards as usize);
        let user = prop::collection::vec(prop::collection::btree_set(0..4u32, 1..3), 1..3);
        let dma = prop::collection::vec(user, 3);
        (prop::collection::vec(device, 1..4), costs, spare, dma, Just(pins))
    };
    shape.prop_flat_map(devices).prop_map(|(devices, costs, spare, dma, pins)| {
        let request = |s: std::collections::BTreeSet<u32>| DmaRequest {
            streams: s.into_iter().map(StreamId).collect(),
        };
        Problem {
            pins: (0..)
                .zip(costs)
                .map(|(i, (cost, shared)): (u32, (u32, bool))| Pin {
                    board: BoardId(i / pins),
                    cost,
                    shared,
                })
                .collect(),
            boards: spare.into_iter().map(|spare| Board { spare }).collect(),
            devices: devices.into_iter().flat_map(|(d, n)| vec![d; n]).take(4).collect(),
            dma: dma
                .into_iter()
                .map(|user| DmaUser { requests: user.into_iter().map(request).collect() })
                .collect(),
            rules: RULES,
            resources: RESOURCES + 2,
            streams: 4,
        }
    })
}

/// A problem for one board, on several equal boards: most devices may go to any of them.
pub(crate) fn on_equal_boards() -> impl Strategy<Value = Problem> {
    let device = (device(1, 4), 1..3usize, prop::option::weighted(0.25, 0..3u32));
    let devices = prop::collection::vec(device, 1..4);
    let costs = prop::collection::vec((0..3u32, prop::bool::weighted(0.2)), 4);
    let user = prop::collection::vec(prop::collection::btree_set(0..4u32, 1..3), 1..3);
    let spares =
        prop_oneof![2 => Just(0..0_u32), 1 => Just(1..3), 1 => Just(0..3), 1 => Just(2..3)];
    (devices, costs, prop::collection::vec(user, 3), 2..4u32, spares).prop_map(
        |(devices, costs, dma, boards, spares)| {
            let fitted = devices.into_iter().flat_map(|(device, times, board)| {
                let on = |b: &u32| board.is_none_or(|board| board.min(boards - 1) == *b);
                let alternatives = (0..boards).filter(on).flat_map(|b| {
                    device.alternatives.iter().map(move |alternative| copied(alternative, b))
                });
                vec![Device { alternatives: alternatives.collect() }; times]
            });
            let pin = |board| move |&(cost, shared)| Pin { board: BoardId(board), cost, shared };
            let request = |board: u32| {
                move |s: &std::collections::BTreeSet<u32>| DmaRequest {
                    streams: s.iter().map(|stream| StreamId(4 * board + stream)).collect(),
                }
            };
            let user = |board: u32| {
                move |user: &Vec<_>| DmaUser { requests: user.iter().map(request(board)).collect() }
            };
            Problem {
                pins: (0..boards).flat_map(|b| costs.iter().map(pin(b))).collect(),
                boards: (0..boards).map(|b| Board { spare: spares.contains(&b) }).collect(),
                devices: fitted.take(4).collect(),
                dma: (0..boards).flat_map(|b| dma.iter().map(user(b))).collect(),
                rules: RULES,
                resources: (RESOURCES + 2) * boards,
                streams: 4 * boards,
            }
        },
    )
}

/// The alternative of the first board, on another board that is equal to it.
fn copied(alternative: &Alternative, board: u32) -> Alternative {
    let mut copy = alternative.clone();
    copy.board = BoardId(board);
    let move_claims = |claims: &mut Vec<Claim>| {
        claims.iter_mut().for_each(|claim| claim.resource.0 += (RESOURCES + 2) * board);
    };
    move_claims(&mut copy.claims);
    copy.dma.iter_mut().for_each(|user| user.0 += 3 * board);
    for candidate in copy.roles.iter_mut().flat_map(|role| &mut role.candidates) {
        candidate.pin.0 += 4 * board;
        move_claims(&mut candidate.claims);
    }
    copy
}

/// A problem with one or two devices in several copies: two resources and a rule belong to each
/// copy alone, the others to all. It has up to two boards, and possibly a device of another sort.
pub(crate) fn with_equal_bundles() -> impl Strategy<Value = Problem> {
    let devices = prop::collection::vec(device(2, 3), 1..3);
    (devices, 2..4u32, prop::option::of(device(2, 3)), problem(), any::<bool>()).prop_map(
        |(bundle, copies, other, base, other_first)| {
            let copy = |number: u32| bundle.iter().map(move |device| owned(device, number));
            let mut devices: Vec<Device> = (0..copies).flat_map(copy).collect();
            devices.truncate(4);
            if let Some(other) = other.filter(|_| devices.len() < 4) {
                devices.insert(if other_first { 0 } else { devices.len() }, other);
            }
            let pin = |number: u32| {
                let mut like = base.pins.iter().cycle().skip(number as usize);
                let (cost, shared) = like.next().map_or((1, false), |pin| (pin.cost, pin.shared));
                Pin { board: BoardId(number / 3), cost, shared }
            };
            let spare = |number: usize| base.boards.get(number).is_some_and(|board| board.spare);
            Problem {
                pins: (0..6).map(pin).collect(),
                boards: (0..2).map(|number| Board { spare: spare(number) }).collect(),
                devices,
                rules: RULES + 3,
                resources: RESOURCES + 2 + 2 * 3,
                ..base.clone()
            }
        },
    )
}

/// The device in a copy of its bundle.
fn owned(device: &Device, copy: u32) -> Device {
    let mut device = device.clone();
    let own_claims = |claims: &mut Vec<Claim>| {
        let own = claims.iter_mut().filter(|claim| claim.resource.0 < 2);
        own.for_each(|claim| claim.resource.0 += RESOURCES + 2 + 2 * copy);
    };
    let own_rules = |rules: &mut Vec<RuleId>| {
        rules.iter_mut().filter(|rule| rule.0 == 0).for_each(|rule| rule.0 = RULES + copy);
    };
    for alternative in &mut device.alternatives {
        own_claims(&mut alternative.claims);
        own_rules(&mut alternative.violates);
        for candidate in alternative.roles.iter_mut().flat_map(|role| &mut role.candidates) {
            own_claims(&mut candidate.claims);
            own_rules(&mut candidate.violates);
        }
    }
    device
}

fn only(problem: &Problem, keep: impl Fn(u32) -> bool) -> Problem {
    let devices = (0..).zip(&problem.devices).filter(|(i, _)| keep(*i)).map(|(_, d)| d.clone());
    Problem { devices: devices.collect(), ..problem.clone() }
}

fn compare(problem: &Problem) -> Result<(), TestCaseError> {
    let found: Vec<Found> = brute::all(problem);
    prop_assert_eq!(count(problem, Cancel::NEVER), Ok(found.len().into()));
    let listed: Result<Vec<_>, _> = enumerate(problem, Cancel::NEVER).collect();
    let listed = listed.map_err(|fault| TestCaseError::fail(fault.to_string()))?;
    prop_assert_eq!(listed.len(), found.len());
    for (answer, expected) in listed.iter().zip(&found) {
        prop_assert_eq!(answer.objective, expected.objective);
        prop_assert_eq!(&answer.choices, &expected.choices());
    }
    match (solve(problem, &Options::default()), found.first()) {
        (Ok(Outcome::Solved(answer)), Some(best)) => {
            prop_assert_eq!(answer.objective, best.objective);
            prop_assert_eq!(&answer.choices, &best.choices());
            prop_assert_eq!(check(problem, &answer), Ok(()));
            let any = Options { any: true, ..Options::default() };
            prop_assert!(matches!(solve(problem, &any), Ok(Outcome::Solved(_))));
        }
        (Ok(Outcome::Infeasible(conflict)), None) => {
            let inside = |i: u32| conflict.devices.iter().any(|d| d.0 == i);
            prop_assert!(brute::all(&only(problem, inside)).is_empty());
            for device in &conflict.devices {
                let rest = only(problem, |i| inside(i) && i != device.0);
                prop_assert!(!brute::all(&rest).is_empty(), "not minimal without {:?}", device);
            }
        }
        (outcome, best) => prop_assert!(false, "{outcome:?} where the oracle has {best:?}"),
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn agrees_with_the_oracle(problem in problem()) {
        prop_assume!(brute::combinations(&problem) < 30_000.0);
        compare(&problem)?;
    }

    #[test]
    fn agrees_with_the_oracle_on_equal_bundles(problem in with_equal_bundles()) {
        prop_assume!(brute::combinations(&problem) < 5_000.0);
        compare(&problem)?;
    }

    #[test]
    fn agrees_with_the_oracle_on_equal_boards(problem in on_equal_boards()) {
        prop_assume!(brute::combinations(&problem) < 3_000.0);
        compare(&problem)?;
    }
}
