//! A weight that no wiring of a case is below, from tolls.
//!
//! Each device pays a toll for each thing it uses: a pin, a resource, a violated rule, a spare
//! board, a peripheral with DMA requests. It chooses for itself, without regard for the others,
//! the cheapest it can take; so all devices together pay at least the sum of those minima.
//! In a wiring, whoever uses a thing does so on one behalf: a device alone, or the devices of one
//! group. So the thing takes in at most what the members of one behalf pay together, which is its
//! weight plus an *excess*. Therefore
//!
//! > weight of any wiring  >=  sum of the devices' minima  -  sum of the things' excesses.
//!
//! This holds for any tolls whatever. DMA streams have prices instead: a request weighs what the
//! cheapest stream that serves it costs, and as each stream serves one request, all requests
//! together weigh no more than all streams cost, which is taken off.

use crate::format::{Candidate, Leaf, OWN, Objective, Problem};
use crate::tree::{Open, OpenAlternative};
use crate::{Refuted, ensure, known};
use std::collections::{BTreeMap, BTreeSet};

/// Kind and name.
type Thing<'a> = (&'static str, &'a str);
/// Holder, and what its members agree on; the device for [`OWN`].
type Behalf<'a> = (&'a str, &'a str);
/// All that one choice uses.
type Uses<'a> = Vec<(Thing<'a>, Behalf<'a>)>;

struct Account<'a, 'o> {
    problem: &'a Problem,
    open: &'o Open<'a>,
    weights: Objective,
    leaf: &'a Leaf,
    /// What the requests of each peripheral weigh.
    dma: BTreeMap<&'a str, i128>,
    /// Who could pay for a thing, by behalf.
    payers: BTreeMap<Thing<'a>, BTreeMap<Behalf<'a>, BTreeSet<&'a str>>>,
}

/// The weight times the leaf's scale; none when a device has nothing left to take.
pub(crate) fn bound<'a>(
    problem: &'a Problem,
    open: &Open<'a>,
    weights: Objective,
    leaf: &'a Leaf,
) -> Result<Option<i128>, Refuted> {
    ensure(leaf.scale > 0, || "a leaf's scale is 0".into())?;
    let dma = requests(problem, leaf);
    let mut account = Account { problem, open, weights, leaf, dma, payers: BTreeMap::new() };
    let streams = leaf.prices.get("stream").into_iter().flat_map(|all| all.values());
    let streams: i128 = streams.map(|price| i128::from(*price)).sum();
    let paid = open.violated.len() as i128 * i128::from(weights.violated);
    let mut bound = paid * i128::from(leaf.scale) - streams;
    for (device, alternatives) in &open.devices {
        let mut least = None;
        for alternative in alternatives.values() {
            least = least.into_iter().chain(account.toll_of(device, alternative)?).min();
        }
        let Some(least) = least else { return Ok(None) };
        bound += least;
    }
    for (thing, behalves) in &account.payers {
        bound -= account.excess(*thing, behalves)?;
    }
    Ok(Some(bound))
}

impl<'a> Account<'a, '_> {
    /// The least that a device pays for an alternative; none when a role has no candidate.
    fn toll_of(
        &mut self,
        device: &'a str,
        alternative: &OpenAlternative<'a>,
    ) -> Result<Option<i128>, Refuted> {
        let mut sum = Some(0);
        let mut before = BTreeSet::new();
        for choices in places(self.problem, device, alternative) {
            let mut least = None;
            for uses in &choices {
                let mut toll: i128 = 0;
                for (thing, behalf) in uses {
                    let paid = thing.0 == "rule" && self.open.violated.contains(thing.1);
                    // A device pays for a thing once: where it may use it first.
                    if !paid && !before.contains(thing) {
                        toll += self.toll(*thing, *behalf, device)?;
                        let behalves = self.payers.entry(*thing).or_default();
                        behalves.entry(*behalf).or_default().insert(device);
                    }
                }
                least = least.into_iter().chain([toll]).min();
            }
            sum = sum.zip(least).map(|(sum, toll)| sum + toll);
            // A device uses a pin once anyway, and pays for it wherever that is.
            let others = choices.into_iter().flatten().map(|(thing, _)| thing);
            before.extend(others.filter(|(kind, _)| !["pin", "moved"].contains(kind)));
        }
        Ok(sum)
    }

    /// What a thing takes in beyond its weight, at most.
    fn excess(
        &self,
        thing: Thing<'_>,
        behalves: &BTreeMap<Behalf<'_>, BTreeSet<&str>>,
    ) -> Result<i128, Refuted> {
        let mut excess = 0;
        for (behalf, members) in behalves {
            let mut income = 0;
            for device in members {
                income += self.toll(thing, *behalf, device)?;
            }
            excess = excess.max(income - self.weight(thing)?);
        }
        Ok(excess)
    }

    /// What a device pays for a thing.
    fn toll(&self, thing: Thing<'_>, behalf: Behalf<'_>, device: &str) -> Result<i128, Refuted> {
        let (kind, name) = thing;
        if behalf.0 == OWN {
            let price = self.leaf.prices.get(kind).and_then(|things| things.get(name));
            return price.map_or_else(|| self.weight(thing), |price| Ok(i128::from(*price)));
        }
        let toll = self.leaf.tolls.get(kind).and_then(|things| things.get(name)?.get(device));
        Ok(toll.map_or(0, |toll| i128::from(*toll)))
    }

    /// What a thing adds to the weight of a wiring that uses it, times the scale.
    fn weight(&self, (kind, name): Thing<'_>) -> Result<i128, Refuted> {
        let Objective { moved, violated, shared, cost, spares } = self.weights;
        let weight = match kind {
            "pin" => {
                let pin = known(&self.problem.pins, kind, name)?;
                let shared = if self.problem.shared.contains(name) { shared } else { 0 };
                i128::from(cost) * i128::from(*pin) + i128::from(shared)
            }
            "moved" => i128::from(moved),
            "rule" => i128::from(violated),
            "spare" => i128::from(spares),
            "dma" => return known(&self.dma, kind, name).copied(),
            _ => 0,
        };
        Ok(weight * i128::from(self.leaf.scale))
    }
}

/// What the requests of each peripheral weigh: the price of the cheapest stream for each.
fn requests<'a>(problem: &'a Problem, leaf: &Leaf) -> BTreeMap<&'a str, i128> {
    let prices = leaf.prices.get("stream");
    let price = |stream: &String| prices.and_then(|all| all.get(stream)).copied().unwrap_or(0);
    let least = |request: &BTreeSet<String>| request.iter().map(price).min().unwrap_or(0);
    let all = |requests: &[_]| requests.iter().map(least).map(i128::from).sum();
    problem.dma.iter().map(|(user, requests)| (user.as_str(), all(requests))).collect()
}

/// What an alternative uses: first whatever wires are chosen, then for each role by candidate.
fn places<'a>(
    problem: &Problem,
    device: &'a str,
    alternative: &OpenAlternative<'a>,
) -> Vec<Vec<Uses<'a>>> {
    let all = |kind| move |name: &'a String| ((kind, name.as_str()), ("all", ""));
    let claim = |(name, holder): (&'a String, &'a String)| {
        (("resource", name.as_str()), (holder.as_str(), if holder == OWN { device } else { "" }))
    };
    let of = alternative.of;
    let spare = problem.boards.get(&of.board) == Some(&true);
    let mut anyway: Uses<'_> = of.claims.iter().map(claim).collect();
    anyway.extend(of.violates.iter().map(all("rule")));
    anyway.extend(of.dma.iter().map(all("dma")));
    anyway.extend(spare.then_some(&of.board).map(all("spare")));
    let of_candidate = |one: &&'a Candidate| {
        let Candidate { pin, holder, signal, claims, violates, moved } = *one;
        let behalf = (holder.as_str(), if holder == OWN { device } else { signal });
        let mut uses: Uses<'_> = vec![(("pin", pin), behalf)];
        uses.extend(moved.then_some((("moved", pin.as_str()), behalf)));
        uses.extend(claims.iter().map(claim));
        uses.extend(violates.iter().map(all("rule")));
        uses
    };
    let roles = alternative.roles.values().map(|left| left.values().map(of_candidate).collect());
    std::iter::once(vec![anyway]).chain(roles).collect()
}
