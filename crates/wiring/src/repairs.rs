//! Repairs for a design that has no wiring: changes that were each tried by solving.

mod alike;
mod budget;
mod proposals;
mod repair;

pub use repair::{Repair, Repaired};

use sensedsl_model::design::{Design, PartIndex};

use self::alike::Alike;
use self::budget::{Budget, SHARES, TrialResult};
use self::proposals::{is_exclusive, proposals};
use crate::Cancel;
use crate::formulate::Formulation;

/// The results of trying changes that could help.
#[derive(Debug)]
pub(crate) struct Repairs {
    /// The changes that help, the gentlest first.
    pub found: Vec<Repaired>,
    /// Whether it is known that there is still no wiring whichever of the devices is left out.
    pub others_remain: bool,
}

/// The most changes that are tried; each costs a search for the best wiring. For a conflict in a
/// robot there are a few dozen.
const TRIED_MAX: usize = 256;

/// The repairs that work, the gentlest first: another link if the file asks for none, then freeing
/// what was fixed, then sharing, then moving, then doing without something, then leaving a device
/// out; within each, the cheapest wiring first. At most [`TRIED_MAX`] are tried, beginning with
/// those that concern only a link or one device, of which there are three each. Each has its share
/// of the steps, so that hard ones are left out.
pub(crate) fn find(
    design: &Design,
    formulation: &Formulation<'_>,
    parts: &[PartIndex],
    cancel: Cancel<'_>,
) -> Repairs {
    let mut budget = Budget::new(cancel);
    let mut proposals = proposals(design, parts);
    proposals.sort_by_key(|repair| !is_of_one_device(repair));
    let is_drop = |repair: &Repair| matches!(repair, Repair::Drop(_));
    let is_cut = proposals.iter().skip(TRIED_MAX).any(is_drop);
    proposals.truncate(TRIED_MAX);
    let mut found = Vec::new();
    // If there is no wiring without any of the devices, there is none whatever is done to them.
    let others = retained(design, |part| !parts.contains(&part));
    if budget.is_impossible(&others) {
        proposals.retain(|repair| !repair.is_of_devices());
    }
    // They are few, so most changes that do not help are quickly found out with them alone.
    let devices = retained(design, |part| parts.contains(&part));
    proposals.retain(|repair| {
        // The conflict is minimal.
        is_drop(repair) || !budget.is_impossible(&repair.renumbered(parts).applied(&devices))
    });
    let mut alike = Alike::new(formulation);
    // First comes what is quickly known about each: a hard one does not cost the others their turn.
    for share in SHARES {
        alike.begin_round();
        proposals.retain(|repair| {
            let as_well_as = alike.of(design, formulation, repair);
            let known = as_well_as.and_then(|change| alike.known(change));
            let tried = known.unwrap_or_else(|| budget.tried(design, repair, share));
            if let Some(change) = as_well_as {
                alike.learn(change, tried);
            }
            if let TrialResult::Helps { cost, is_best } = tried {
                found.push(Repaired { repair: repair.clone(), cost, is_best });
            }
            tried == TrialResult::Unknown
        });
    }
    let is_open = is_cut || proposals.iter().any(is_drop);
    let others_remain = !is_open && !found.iter().any(|one| is_drop(&one.repair));
    if !found.iter().any(|one| matches!(one.repair, Repair::Share(_))) {
        found.extend(sharing(design, parts, &mut budget));
    }
    found.sort_by_key(|one| (rank(design, &one.repair), one.cost));
    Repairs { found, others_remain }
}

/// The design with only these of its parts, which get new numbers.
fn retained(design: &Design, holds: impl Fn(PartIndex) -> bool) -> Design {
    let mut some = design.clone();
    some.retain_parts(|part, _| holds(part));
    some
}

/// The first two devices, or else all, for which it would help to share a bus.
fn sharing(design: &Design, parts: &[PartIndex], budget: &mut Budget<'_>) -> Option<Repaired> {
    let exclusive = |index: &&PartIndex| is_exclusive(design, **index);
    let exclusive: Vec<PartIndex> = parts.iter().filter(exclusive).copied().collect();
    let (first, others) = exclusive.split_first()?;
    let pairs = others.iter().map(|other| vec![*first, *other]);
    pairs.take(TRIED_MAX).chain([exclusive.clone()]).find_map(|some| {
        let repair = Repair::Share(some);
        match budget.tried(design, &repair, SHARES[1]) {
            TrialResult::Helps { cost, is_best } => Some(Repaired { repair, cost, is_best }),
            TrialResult::IsNoHelp | TrialResult::Unknown => None,
        }
    })
}

fn rank(design: &Design, repair: &Repair) -> usize {
    match repair {
        Repair::Relink(on, _) if design.board(*on).is_some_and(|board| !board.link.stated) => 0,
        Repair::Free(_) => 0,
        Repair::Share(_) => 1,
        Repair::Retune(..) => 2,
        Repair::Move(..) => 3,
        Repair::Unreserve(..) => 4,
        Repair::Release(..) => 5,
        Repair::Relink(..) => 6,
        Repair::Drop(_) => 7,
    }
}

const fn is_of_one_device(repair: &Repair) -> bool {
    match repair {
        Repair::Relink(..) | Repair::Free(_) | Repair::Share(_) | Repair::Drop(_) => true,
        Repair::Retune(..) | Repair::Move(..) | Repair::Unreserve(..) | Repair::Release(..) => {
            false
        }
    }
}
