//! Whether a case distinction leaves nothing out and all its leaves weigh enough.
//!
//! Devices whose alternatives are the same in every respect can change places in any wiring and
//! nothing else changes. So it is enough to look at the wirings in which such *alike* devices, in
//! the order of their names, take alternatives in the order of their names.

use crate::budget::{self, Budget};
use crate::format::{Alternative, Candidate, Case, Map, Node, Problem, Proof};
use crate::{Refuted, ensure, known, leaf};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// What can still be taken in a case.
#[derive(Clone)]
pub(crate) struct Open<'a> {
    /// For each device its alternatives.
    pub(crate) devices: BTreeMap<&'a str, BTreeMap<&'a str, OpenAlternative<'a>>>,
    /// Rules that are violated for sure, and paid.
    pub(crate) violated: BTreeSet<&'a str>,
}

/// An alternative with the candidates that are left for its roles.
#[derive(Clone)]
pub(crate) struct OpenAlternative<'a> {
    pub(crate) of: &'a Alternative,
    pub(crate) roles: BTreeMap<&'a str, BTreeMap<&'a str, &'a Candidate>>,
}

/// By what a case differs from the one above.
enum Step<'a> {
    Nothing,
    /// The device takes one of these alternatives.
    Takes(&'a str, &'a BTreeSet<String>),
    /// The wire of the device takes one of these candidates.
    Wires(&'a str, &'a str, &'a BTreeSet<String>),
    Kept(&'a str),
    Violated(&'a str),
}

/// What can be taken in a case whose parts wait, and how many steps it takes to go through it.
type Waiting<'a> = Rc<(Open<'a>, usize)>;

fn named<T>(map: &Map<T>) -> impl Iterator<Item = (&str, &T)> {
    map.iter().map(|(name, one)| (name.as_str(), one))
}

impl<'a> Open<'a> {
    /// Everything.
    fn new(problem: &'a Problem) -> Self {
        let open = |of: &'a Alternative| {
            let roles = named(&of.roles).map(|(name, all)| (name, named(all).collect()));
            OpenAlternative { of, roles: roles.collect() }
        };
        let devices = named(&problem.devices)
            .map(|(name, all)| (name, named(all).map(|(name, of)| (name, open(of))).collect()));
        Self { devices: devices.collect(), violated: BTreeSet::new() }
    }

    fn step(&mut self, step: &Step<'a>) {
        match step {
            Step::Nothing => {}
            Step::Takes(device, these) => {
                self.devices.entry(device).or_default().retain(|name, _| these.contains(*name));
            }
            Step::Wires(device, role, these) => {
                let of_device = self.devices.entry(device).or_default().values_mut();
                for left in of_device.filter_map(|one| one.roles.get_mut(role)) {
                    left.retain(|name, _| these.contains(*name));
                }
            }
            Step::Kept(rule) => self.keep_rule(rule),
            Step::Violated(rule) => {
                self.violated.insert(rule);
            }
        }
    }

    /// Takes away all that violates the rule.
    fn keep_rule(&mut self, rule: &str) {
        for alternatives in self.devices.values_mut() {
            alternatives.retain(|_, one| !one.of.violates.contains(rule));
            let roles = alternatives.values_mut().flat_map(|one| one.roles.values_mut());
            for candidates in roles {
                candidates.retain(|_, one| !one.violates.contains(rule));
            }
        }
    }

    /// Takes away what cannot be taken for want of a candidate.
    fn prune(&mut self) {
        for alternatives in self.devices.values_mut() {
            alternatives.retain(|_, one| one.roles.values().all(|left| !left.is_empty()));
        }
    }

    /// Takes away what would be out of order among alike devices.
    fn sort(&mut self, alike: &[&'a str]) {
        let mut least = None;
        for device in alike {
            let left = self.devices.entry(device).or_default();
            left.retain(|name, _| Some(*name) >= least);
            least = left.keys().next().copied().or(least);
        }
        let mut most = None;
        for device in alike.iter().rev() {
            let left = self.devices.entry(device).or_default();
            left.retain(|name, _| most.is_none_or(|most| *name <= most));
            most = left.keys().next_back().copied().or(most);
        }
    }
}

/// Devices that can change places, in groups, each in the order of names.
fn alike(problem: &Problem) -> Vec<Vec<&str>> {
    let mut groups: BTreeMap<&Map<Alternative>, Vec<&str>> = BTreeMap::new();
    for (name, device) in named(&problem.devices) {
        groups.entry(device).or_default().push(name);
    }
    groups.into_values().collect()
}

/// Checks that all wirings weigh more than `limit`.
pub(crate) fn check(
    problem: &Problem,
    proof: &Proof,
    limit: i128,
    budget: &mut Budget,
) -> Result<(), Refuted> {
    let alike = alike(problem);
    let of_dma = budget::of_dma(problem);
    // A node is taken out when it is reached, so a second way to it, or a circle, is found.
    let mut nodes: Vec<Option<&Node>> = proof.nodes.iter().map(Some).collect();
    let all = Open::new(problem);
    let size = budget::of_case(&all);
    budget.wait(size)?;
    let mut cases = vec![(0, Rc::new((all, size)), Step::Nothing)];
    while let Some((at, above, step)) = cases.pop() {
        let node = nodes.get_mut(at).and_then(Option::take);
        let node = node.ok_or_else(|| Refuted(format!("node {at} is not there, or not new")))?;
        budget.step(above.1)?;
        let mut open = match Rc::try_unwrap(above) {
            Ok((open, size)) => {
                budget.resume(size);
                open
            }
            Err(above) => above.0.clone(),
        };
        open.step(&step);
        open.prune();
        alike.iter().for_each(|group| open.sort(group));
        if let Node::Leaf(leaf) = node {
            budget.step(of_dma)?;
            let weight = leaf::bound(problem, &open, proof.weights, leaf)?;
            let least = limit * i128::from(leaf.scale);
            let enough = weight.is_none_or(|weight| weight > least);
            ensure(enough, || format!("leaf {at} does not show what it has to"))?;
            continue;
        }
        let size = budget::of_case(&open);
        let more = distinguished(at, node, &Rc::new((open, size)))?;
        if !more.is_empty() {
            budget.wait(size)?;
        }
        cases.extend(more);
    }
    Ok(())
}

/// The cases of a node with their nodes, none of which is left out.
fn distinguished<'a>(
    at: usize,
    node: &'a Node,
    open: &Waiting<'a>,
) -> Result<Vec<(usize, Waiting<'a>, Step<'a>)>, Refuted> {
    let with = |case: &'a Case, step| (case.then, Rc::clone(open), step);
    Ok(match node {
        Node::Device { device, cases } => {
            covered(at, cases, known(&open.0.devices, "device", device)?)?;
            cases.iter().map(|case| with(case, Step::Takes(device, &case.keep))).collect()
        }
        Node::Role { device, role, cases } => {
            let all = only(&open.0, device).and_then(|one| one.roles.get(role.as_str()));
            let all = all.ok_or_else(|| Refuted(format!("node {at} has no such role")))?;
            covered(at, cases, all)?;
            cases.iter().map(|case| with(case, Step::Wires(device, role, &case.keep))).collect()
        }
        Node::Rule { rule, kept, violated } => vec![
            (*kept, Rc::clone(open), Step::Kept(rule)),
            (*violated, Rc::clone(open), Step::Violated(rule)),
        ],
        Node::Leaf(_) => Vec::new(),
    })
}

/// The one alternative that a device has left.
fn only<'o, 'a>(open: &'o Open<'a>, device: &str) -> Option<&'o OpenAlternative<'a>> {
    let mut left = open.devices.get(device)?.values();
    left.next().filter(|_| left.next().is_none())
}

/// Checks that each choice is left in one of the cases.
fn covered<T>(at: usize, cases: &[Case], all: &BTreeMap<&str, T>) -> Result<(), Refuted> {
    let kept: BTreeSet<&str> =
        cases.iter().flat_map(|case| &case.keep).map(String::as_str).collect();
    let missing = all.keys().find(|name| !kept.contains(**name));
    missing.map_or(Ok(()), |name| Err(Refuted(format!("node {at} leaves out {name}"))))
}
