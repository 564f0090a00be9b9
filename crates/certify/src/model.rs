//! The pin problem as things that are used: what each choice of a device uses, on whose behalf,
//! and which toll is paid for it.
#![expect(clippy::indexing_slicing, reason = "all indices are made here or checked by the solver")]

use std::collections::{BTreeMap, BTreeSet};

use sensedsl_solve::Objective;
use sensedsl_solve::problem::{Alternative, Candidate, Claim, Holder, Pin, Problem, RuleId};

use crate::labels::{AlternativeLabels, Labels};

/// What devices use.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Thing {
    Pin(usize),
    /// The move of the wire on a pin.
    Moved(usize),
    Resource(usize),
    Rule(usize),
    Spare(usize),
    Dma(usize),
}

/// On whose behalf several use a thing together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Behalf {
    Group(u32),
    /// A group on a pin agrees on the signal.
    GroupWith(u32, u32),
    All,
}

/// A use of a thing by a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Use {
    pub(crate) thing: usize,
    /// Where it stands among [`Model::shares`]; none for a device of its own, which pays the
    /// price of the thing.
    pub(crate) share: Option<usize>,
    /// Index in [`Model::classes`], likewise.
    pub(crate) class: Option<usize>,
}

/// A role of an alternative; `index` is its place in the problem.
#[derive(Debug)]
pub(crate) struct Role {
    pub(crate) index: usize,
    pub(crate) candidates: Vec<Vec<Use>>,
}

/// What an alternative uses whatever wires are chosen, and its roles by name.
#[derive(Debug)]
pub(crate) struct Uses {
    pub(crate) fixed: Vec<Use>,
    pub(crate) roles: Vec<Role>,
}

/// All uses of all choices.
#[derive(Debug, Default)]
pub(crate) struct Model {
    pub(crate) things: Vec<Thing>,
    /// The toll of a device for a thing that it uses together with others: thing, device.
    pub(crate) shares: Vec<(usize, usize)>,
    /// The thing that the members of a class use on one behalf.
    pub(crate) classes: Vec<usize>,
    /// Device, alternative.
    pub(crate) devices: Vec<Vec<Uses>>,
    /// Devices that can change places, in groups, in the order of names.
    pub(crate) alike: Vec<Vec<usize>>,
    /// For each device the place of each alternative in the order of names.
    pub(crate) places: Vec<Vec<usize>>,
}

/// Who holds each resource. A device that holds one for several groups cannot share it.
pub fn holders(claims: &[Claim]) -> BTreeMap<u32, Holder> {
    let mut holders = BTreeMap::new();
    for Claim { resource, holder } in claims {
        let held = holders.entry(resource.0).or_insert(*holder);
        if held != holder {
            *held = Holder::Own;
        }
    }
    holders
}

#[derive(Default)]
struct Maker {
    model: Model,
    thing_ids: BTreeMap<Thing, usize>,
    share_ids: BTreeMap<(usize, usize), usize>,
    class_ids: BTreeMap<(usize, Behalf), usize>,
}

impl Model {
    pub(crate) fn new(problem: &Problem, labels: &Labels) -> Self {
        let mut maker = Maker::default();
        for (number, device) in problem.devices.iter().enumerate() {
            let alternatives = device.alternatives.iter().enumerate().map(|(place, one)| {
                let names = &labels.alternatives[number][place].roles;
                maker.alternative(problem, number, one, names)
            });
            let alternatives = alternatives.collect();
            maker.model.devices.push(alternatives);
        }
        Self { alike: alike(problem, labels), places: places(labels), ..maker.model }
    }

    /// What using a thing weighs; the prices of streams decide it for [`Thing::Dma`].
    pub(crate) fn weight(&self, problem: &Problem, weights: &Objective, thing: usize) -> u64 {
        u64::from(match self.things[thing] {
            Thing::Pin(pin) => {
                let Pin { cost, shared, .. } = problem.pins[pin];
                let shared = u64::from(shared) * u64::from(weights.shared);
                return u64::from(weights.cost) * u64::from(cost) + shared;
            }
            Thing::Moved(_) => weights.moved,
            Thing::Rule(_) => weights.violated,
            Thing::Spare(_) => weights.spares,
            Thing::Resource(_) | Thing::Dma(_) => 0,
        })
    }
}

/// The groups of devices that do not differ, in the order of names.
fn alike(problem: &Problem, labels: &Labels) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..problem.devices.len()).collect();
    order.sort_by_key(|device| &labels.devices[*device]);
    let same = |a: usize, b: usize| {
        problem.devices[a] == problem.devices[b] && labels.alternatives[a] == labels.alternatives[b]
    };
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for device in order {
        match groups.iter_mut().find(|group| same(group[0], device)) {
            Some(group) => group.push(device),
            None => groups.push(vec![device]),
        }
    }
    groups.retain(|group| group.len() > 1);
    groups
}

fn places(labels: &Labels) -> Vec<Vec<usize>> {
    let of_device = |alternatives: &Vec<AlternativeLabels>| {
        let before = |one: &AlternativeLabels| {
            alternatives.iter().filter(|other| other.name < one.name).count()
        };
        alternatives.iter().map(before).collect()
    };
    labels.alternatives.iter().map(of_device).collect()
}

impl Maker {
    fn thing(&mut self, thing: Thing) -> usize {
        let next = self.model.things.len();
        let id = *self.thing_ids.entry(thing).or_insert(next);
        if id == next {
            self.model.things.push(thing);
        }
        id
    }

    fn uses(&mut self, thing: Thing, device: usize, behalf: Option<Behalf>) -> Use {
        let thing = self.thing(thing);
        let Some(behalf) = behalf else { return Use { thing, share: None, class: None } };
        let next = self.model.shares.len();
        let share = *self.share_ids.entry((thing, device)).or_insert(next);
        if share == next {
            self.model.shares.push((thing, device));
        }
        let next = self.model.classes.len();
        let class = *self.class_ids.entry((thing, behalf)).or_insert(next);
        if class == next {
            self.model.classes.push(thing);
        }
        Use { thing, share: Some(share), class: Some(class) }
    }

    fn alternative(
        &mut self,
        problem: &Problem,
        device: usize,
        alternative: &Alternative,
        role_names: &[String],
    ) -> Uses {
        let mut fixed = self.claims(device, &alternative.claims);
        fixed.extend(self.rules(device, &alternative.violates));
        let users: BTreeSet<_> = alternative.dma.iter().collect();
        for user in users {
            fixed.push(self.uses(Thing::Dma(user.0 as usize), device, Some(Behalf::All)));
        }
        let board = alternative.board.0 as usize;
        if problem.boards[board].spare {
            fixed.push(self.uses(Thing::Spare(board), device, Some(Behalf::All)));
        }
        let mut order: Vec<usize> = (0..alternative.roles.len()).collect();
        order.sort_by_key(|index| &role_names[*index]);
        let roles = order.into_iter().map(|index| {
            let candidates = alternative.roles[index].candidates.iter();
            let candidates = candidates.map(|one| self.candidate(device, one)).collect();
            Role { index, candidates }
        });
        let roles = roles.collect();
        Uses { fixed, roles }
    }

    fn candidate(&mut self, device: usize, candidate: &Candidate) -> Vec<Use> {
        let pin = candidate.pin.0 as usize;
        let behalf = match candidate.holder {
            Holder::Own => None,
            Holder::Group(group) => Some(Behalf::GroupWith(group, candidate.signal.0)),
        };
        let mut uses = vec![self.uses(Thing::Pin(pin), device, behalf)];
        if candidate.moved {
            uses.push(self.uses(Thing::Moved(pin), device, behalf));
        }
        uses.extend(self.claims(device, &candidate.claims));
        uses.extend(self.rules(device, &candidate.violates));
        uses
    }

    fn claims(&mut self, device: usize, claims: &[Claim]) -> Vec<Use> {
        let behalf = |holder| match holder {
            Holder::Own => None,
            Holder::Group(group) => Some(Behalf::Group(group)),
        };
        let uses = holders(claims).into_iter().map(|(resource, holder)| {
            self.uses(Thing::Resource(resource as usize), device, behalf(holder))
        });
        uses.collect()
    }

    fn rules(&mut self, device: usize, rules: &[RuleId]) -> Vec<Use> {
        let rules: BTreeSet<_> = rules.iter().collect();
        let uses = rules
            .into_iter()
            .map(|rule| self.uses(Thing::Rule(rule.0 as usize), device, Some(Behalf::All)));
        uses.collect()
    }
}
