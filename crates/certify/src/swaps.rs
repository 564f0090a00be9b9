//! Exchanges of two equal boards, or of equal devices.
//!
//! The solver states that they are equal; the swap is found by going through what devices can take
//! on both, side by side. The verifier checks whether it maps the problem to itself.

use std::collections::BTreeMap;

use sensedsl_solve::problem::{Alternative, Claim, DeviceId, Holder, Problem, RuleId};
use sensedsl_solve::trace::Exchange;

/// Pairs of numbers, each in both directions.
type Pairs = BTreeMap<u32, u32>;

/// A swap of two boards, or of devices.
#[derive(Default)]
pub(crate) struct Swap {
    pub(crate) boards: Option<(usize, usize)>,
    pub(crate) devices: Exchange,
    pub(crate) pins: Pairs,
    pub(crate) resources: Pairs,
    pub(crate) groups: Pairs,
    pub(crate) users: Pairs,
    pub(crate) streams: Pairs,
    pub(crate) rules: Pairs,
    /// Device, and two of its alternatives.
    pub(crate) ways: Vec<(usize, usize, usize)>,
}

/// Records that two change places; `None` if one of them already does so with another one.
fn pair(pairs: &mut Pairs, one: u32, other: u32) -> Option<()> {
    let there = *pairs.entry(one).or_insert(other);
    let back = *pairs.entry(other).or_insert(one);
    (there == other && back == one).then_some(())
}

impl Swap {
    /// The swap of two boards; `None` if they differ.
    pub(crate) fn of_boards(problem: &Problem, boards: (usize, usize)) -> Option<Self> {
        let mut swap = Self { boards: Some(boards), ..Self::default() };
        for (number, device) in problem.devices.iter().enumerate() {
            let on = |board: usize| {
                let all = device.alternatives.iter().enumerate();
                all.filter(move |(_, way)| way.board.0 as usize == board)
            };
            if on(boards.0).count() != on(boards.1).count() {
                return None;
            }
            for ((one, way), (other, image)) in on(boards.0).zip(on(boards.1)) {
                swap.ways.push((number, one, other));
                swap.way(problem, way, image)?;
            }
        }
        Some(swap)
    }

    /// The swap of devices; `None` if they differ.
    pub(crate) fn of_devices(problem: &Problem, devices: &Exchange) -> Option<Self> {
        let mut swap = Self { devices: devices.clone(), ..Self::default() };
        for (one, other) in devices {
            let ways = |device: &DeviceId| {
                problem.devices.get(device.0 as usize).map(|device| &device.alternatives)
            };
            for (way, image) in ways(one)?.iter().zip(ways(other)?) {
                swap.way(problem, way, image)?;
            }
        }
        Some(swap)
    }

    fn way(&mut self, problem: &Problem, one: &Alternative, other: &Alternative) -> Option<()> {
        self.claims(&one.claims, &other.claims)?;
        self.rules(&one.violates, &other.violates)?;
        for (user, image) in one.dma.iter().zip(&other.dma) {
            pair(&mut self.users, user.0, image.0)?;
            let requests = |user: u32| problem.dma.get(user as usize).map(|user| &user.requests);
            let (Some(from), Some(to)) = (requests(user.0), requests(image.0)) else { continue };
            for (from, to) in from.iter().zip(to) {
                for (stream, image) in from.streams.iter().zip(&to.streams) {
                    pair(&mut self.streams, stream.0, image.0)?;
                }
            }
        }
        for (role, image) in one.roles.iter().zip(&other.roles) {
            for (wire, image) in role.candidates.iter().zip(&image.candidates) {
                pair(&mut self.pins, wire.pin.0, image.pin.0)?;
                self.holder(wire.holder, image.holder)?;
                self.claims(&wire.claims, &image.claims)?;
                self.rules(&wire.violates, &image.violates)?;
            }
        }
        Some(())
    }

    fn claims(&mut self, one: &[Claim], other: &[Claim]) -> Option<()> {
        for (claim, image) in one.iter().zip(other) {
            pair(&mut self.resources, claim.resource.0, image.resource.0)?;
            self.holder(claim.holder, image.holder)?;
        }
        Some(())
    }

    fn rules(&mut self, one: &[RuleId], other: &[RuleId]) -> Option<()> {
        let mut both = one.iter().zip(other);
        both.try_for_each(|(rule, image)| pair(&mut self.rules, rule.0, image.0))
    }

    fn holder(&mut self, one: Holder, other: Holder) -> Option<()> {
        match (one, other) {
            (Holder::Own, Holder::Own) => Some(()),
            (Holder::Group(one), Holder::Group(other)) => pair(&mut self.groups, one, other),
            _ => None,
        }
    }
}
