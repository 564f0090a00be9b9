//! Counts how wires can be put on pins: classes of interchangeable wires in, a number out.
//!
//! The pins are taken one after another. The rest depends only on how many wires of each class are
//! still to be placed and who holds the resources that later pins can claim; ways that agree on
//! these are added up. This is dynamic programming over a frontier (J. Kawahara et al.,
//! *Frontier-based search for enumerating all constrained subgraphs with compressed
//! representation*, 2017). Classes that share no pin and no resource are counted separately, and
//! counts are remembered (R. J. Bayardo and J. D. Pehoushek, *Counting models using connected
//! components*, 2000).

use crate::cancel::Cancel;
use crate::index::{ClassId, Id, IdVec};
use crate::model::agree;
use crate::problem::{Claim, Holder, PinId, ResourceId};
use num_bigint::BigUint;
use std::collections::{BTreeMap, BTreeSet};

/// One way to place a wire. A claim for the device alone excludes everybody else.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Place {
    pub(crate) pin: PinId,
    pub(crate) claims: Vec<Claim>,
}

/// Wires that can be placed in the same ways.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Class {
    /// Sorted; a place that occurs twice counts twice.
    pub(crate) places: Vec<Place>,
    pub(crate) wires: u32,
}

/// Counts, and remembers the parts that it has counted.
///
/// A count is meaningless once the caller has given up, so callers check that first.
pub(crate) struct Counter<'a> {
    known: BTreeMap<Vec<Class>, BigUint>,
    cancel: Cancel<'a>,
}

impl<'a> Counter<'a> {
    pub(crate) fn new(cancel: Cancel<'a>) -> Self {
        Self { known: BTreeMap::new(), cancel }
    }

    /// Number of ways to place all wires of all classes.
    pub(crate) fn count(&mut self, classes: Vec<Class>) -> BigUint {
        let mut total = BigUint::from(1u32);
        for part in components(classes) {
            let count = match self.known.get(&part) {
                Some(count) => count.clone(),
                None => {
                    let count = count_part(&part, self.cancel);
                    self.known.insert(part, count.clone());
                    count
                }
            };
            total *= count;
            if total == BigUint::ZERO {
                break;
            }
        }
        total
    }
}

/// Something that a place takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Taken {
    Pin(PinId),
    Resource(ResourceId),
}

/// Splits the classes into parts that share neither pin nor resource.
fn components(classes: Vec<Class>) -> Vec<Vec<Class>> {
    let mut parts: Vec<(BTreeSet<Taken>, Vec<Class>)> = Vec::new();
    for class in classes {
        let mut keys: BTreeSet<Taken> = class
            .places
            .iter()
            .flat_map(|p| {
                let resources = p.claims.iter().map(|claim| Taken::Resource(claim.resource));
                resources.chain([Taken::Pin(p.pin)])
            })
            .collect();
        let mut members = vec![class];
        let mut apart = Vec::new();
        for (other, mut its) in parts {
            if keys.is_disjoint(&other) {
                apart.push((other, its));
            } else {
                keys.extend(other);
                members.append(&mut its);
            }
        }
        apart.push((keys, members));
        parts = apart;
    }
    let sorted = |(_, mut part): (_, Vec<Class>)| {
        part.sort_unstable();
        part
    };
    parts.into_iter().map(sorted).collect()
}

fn count_part(classes: &[Class], cancel: Cancel<'_>) -> BigUint {
    if classes.iter().any(|c| c.places.is_empty() && c.wires > 0) {
        return BigUint::ZERO;
    }
    match Plan::new(classes) {
        Some(plan) => match plan.run::<u128>(cancel) {
            Some(count) => BigUint::from(count),
            None => plan.run::<BigUint>(cancel).unwrap_or_default(),
        },
        None => split(classes, cancel),
    }
}

/// For a part that needs too many bits for one key: places one wire in every way and counts the
/// rest.
fn split(classes: &[Class], cancel: Cancel<'_>) -> BigUint {
    let mut total = BigUint::ZERO;
    let mut classed = classes.iter().enumerate();
    let Some((first, class)) = classed.find(|(_, c)| c.wires > 0) else {
        return BigUint::from(1u32);
    };
    for place in &class.places {
        if cancel.is_over() {
            break;
        }
        let mut rest = Vec::new();
        for (index, class) in classes.iter().enumerate() {
            let wires = class.wires - u32::from(index == first);
            let places = class.places.iter().filter(|p| compatible(place, p)).cloned().collect();
            if wires > 0 {
                rest.push(Class { places, wires });
            }
        }
        total += Counter::new(cancel).count(rest);
    }
    total
}

fn compatible(one: &Place, other: &Place) -> bool {
    let clash = |a: &Claim| {
        other.claims.iter().any(|b| a.resource == b.resource && !agree(a.holder, b.holder))
    };
    one.pin != other.pin && !one.claims.iter().any(clash)
}

/// Number of states between two checks whether the caller has given up.
const ASK: usize = 1 << 14;

/// A number of ways, which may or may not overflow.
trait Tally: Sized + Clone {
    fn one() -> Self;
    fn times(&self, factor: u32) -> Option<Self>;
    fn plus(&mut self, other: &Self) -> Option<()>;
}

impl Tally for u128 {
    fn one() -> Self {
        1
    }

    fn times(&self, factor: u32) -> Option<Self> {
        self.checked_mul(Self::from(factor))
    }

    fn plus(&mut self, other: &Self) -> Option<()> {
        *self = self.checked_add(*other)?;
        Some(())
    }
}

impl Tally for BigUint {
    fn one() -> Self {
        Self::from(1u32)
    }

    fn times(&self, factor: u32) -> Option<Self> {
        Some(self * factor)
    }

    fn plus(&mut self, other: &Self) -> Option<()> {
        *self += other;
        Some(())
    }
}

/// Some bits of the key.
#[derive(Clone, Copy, Debug, Default)]
struct Field {
    shift: u32,
    mask: u128,
}

impl Field {
    fn get(self, key: u128) -> u128 {
        key >> self.shift & self.mask
    }

    fn bits(self) -> u128 {
        self.mask << self.shift
    }
}

/// A claim within a place: the field must be 0 or (for a group) `value`.
#[derive(Clone, Copy, Debug)]
struct Take {
    field: Field,
    value: u128,
    shared: bool,
}

#[derive(Clone, Debug)]
struct Step {
    /// Class and claims of each way to use the pin.
    uses: Vec<(ClassId, Vec<Take>)>,
    /// Fields that are not needed after this pin.
    forget: u128,
    /// The most wires of each class that later pins can take.
    later: IdVec<ClassId, u32>,
}

struct Plan {
    wires: IdVec<ClassId, Field>,
    start: u128,
    steps: Vec<Step>,
}

/// The order of the pins, and what it means for the resources.
struct Timeline {
    order: Vec<PinId>,
    /// The last step at which each resource is claimed.
    last: BTreeMap<ResourceId, usize>,
    /// The holders for which each resource can be claimed.
    holders: BTreeMap<ResourceId, Vec<Holder>>,
}

impl Timeline {
    fn new(classes: &[Class]) -> Self {
        let order = order(classes);
        let mut last = BTreeMap::new();
        let mut holders: BTreeMap<ResourceId, Vec<Holder>> = BTreeMap::new();
        for (step, pin) in order.iter().enumerate() {
            for place in classes.iter().flat_map(|c| &c.places).filter(|p| p.pin == *pin) {
                for &Claim { resource, holder } in &place.claims {
                    last.insert(resource, step);
                    let holders = holders.entry(resource).or_default();
                    if !holders.contains(&holder) {
                        holders.push(holder);
                    }
                }
            }
        }
        Self { order, last, holders }
    }

    /// The changes to the key when a wire is placed; new resources get their bits.
    fn takes(
        &self,
        place: &Place,
        fields: &mut BTreeMap<ResourceId, Field>,
        used: &mut u128,
    ) -> Option<Vec<Take>> {
        let mut takes = Vec::new();
        for Claim { resource, holder } in &place.claims {
            let holders = self.holders.get(resource)?;
            let field = match fields.get(resource) {
                Some(field) => *field,
                None => claim_bits(used, holders.len() as u128)?,
            };
            fields.insert(*resource, field);
            let value = holders.iter().position(|h| h == holder)? as u128 + 1;
            takes.push(Take { field, value, shared: *holder != Holder::Own });
        }
        Some(takes)
    }
}

impl Plan {
    /// `None` when a key has too few bits.
    fn new(classes: &[Class]) -> Option<Self> {
        let timeline = Timeline::new(classes);
        let mut used: u128 = 0;
        let mut wires = IdVec::default();
        let mut start = 0;
        for class in classes {
            let field = claim_bits(&mut used, u128::from(class.wires))?;
            start |= u128::from(class.wires) << field.shift;
            wires.push(field);
        }
        let mut fields: BTreeMap<ResourceId, Field> = BTreeMap::new();
        let mut steps = Vec::new();
        let mut rest: BTreeSet<PinId> = timeline.order.iter().copied().collect();
        for (step, pin) in timeline.order.iter().enumerate() {
            rest.remove(pin);
            let mut uses = Vec::new();
            for (index, class) in classes.iter().enumerate() {
                for place in class.places.iter().filter(|p| p.pin == *pin) {
                    let takes = timeline.takes(place, &mut fields, &mut used)?;
                    uses.push((ClassId::new(index), takes));
                }
            }
            let ends = |resource: &ResourceId| timeline.last.get(resource) == Some(&step);
            let ending = fields.iter().filter(|(resource, _)| ends(resource));
            let forget = ending.fold(0, |bits, (_, field)| bits | field.bits());
            used &= !forget;
            fields.retain(|resource, _| !ends(resource));
            let later = |class: &Class| {
                let pins: BTreeSet<PinId> = class.places.iter().map(|p| p.pin).collect();
                pins.intersection(&rest).count() as u32
            };
            steps.push(Step { uses, forget, later: classes.iter().map(later).collect() });
        }
        Some(Self { wires, start, steps })
    }

    fn run<T: Tally>(&self, cancel: Cancel<'_>) -> Option<T> {
        let mut states: Vec<(u128, T)> = vec![(self.start, T::one())];
        let mut next: Vec<(u128, T)> = Vec::new();
        for step in &self.steps {
            next.clear();
            let possible = |key: u128| {
                let fields = self.wires.iter().zip(&step.later);
                fields.clone().all(|(field, later)| field.get(key) <= u128::from(*later))
            };
            for (number, (key, ways)) in states.iter().enumerate() {
                if number % ASK == 0 && cancel.is_over() {
                    return T::one().times(0);
                }
                if possible(*key) {
                    next.push((key & !step.forget, ways.clone()));
                }
                for (class, takes) in &step.uses {
                    let left = self.wires[*class].get(*key);
                    if left == 0 {
                        continue;
                    }
                    let Some(taken) = take(*key, takes) else { continue };
                    let new = (taken - (1 << self.wires[*class].shift)) & !step.forget;
                    if possible(new) {
                        next.push((new, ways.times(left as u32)?));
                    }
                }
            }
            next.sort_unstable_by_key(|state| state.0);
            states.clear();
            for (key, ways) in next.drain(..) {
                match states.last_mut() {
                    Some((old, sum)) if *old == key => sum.plus(&ways)?,
                    _ => states.push((key, ways)),
                }
            }
        }
        match states.pop() {
            Some((_, ways)) => Some(ways),
            // Nothing survived: there are zero ways. This is not an overflow.
            None => T::one().times(0),
        }
    }
}

fn take(key: u128, takes: &[Take]) -> Option<u128> {
    let mut key = key;
    for take in takes {
        let held = take.field.get(key);
        if held == 0 {
            key |= take.value << take.field.shift;
        } else if !take.shared || held != take.value {
            return None;
        }
    }
    Some(key)
}

/// Finds free adjacent bits for the values 0 to `most`.
fn claim_bits(used: &mut u128, most: u128) -> Option<Field> {
    let width = 128 - most.leading_zeros();
    let mask = if width >= 128 { u128::MAX } else { (1 << width) - 1 };
    let shift = (0..=128 - width.max(1)).find(|s| *used & (mask << s) == 0)?;
    *used |= mask << shift;
    Some(Field { shift, mask })
}

/// Something that connects pins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    Class(ClassId),
    Resource(ResourceId),
}

/// Orders the pins so that few resources are open at a time.
fn order(classes: &[Class]) -> Vec<PinId> {
    let mut claims: BTreeMap<PinId, BTreeSet<Key>> = BTreeMap::new();
    let mut users: BTreeMap<Key, BTreeSet<PinId>> = BTreeMap::new();
    for (index, class) in classes.iter().enumerate() {
        for place in &class.places {
            let keys = claims.entry(place.pin).or_default();
            keys.extend(place.claims.iter().map(|claim| Key::Resource(claim.resource)));
            keys.insert(Key::Class(ClassId::new(index)));
        }
    }
    for (pin, keys) in &claims {
        for key in keys {
            users.entry(*key).or_default().insert(*pin);
        }
    }
    let left =
        |users: &BTreeMap<Key, BTreeSet<PinId>>, key: &Key| users.get(key).map_or(0, BTreeSet::len);
    let mut open: BTreeSet<Key> = BTreeSet::new();
    let mut order = Vec::new();
    while !claims.is_empty() {
        // Opening costs, closing pays; ties go to the pin with the fewest relatives left.
        let price = |(pin, keys): &(&PinId, &BTreeSet<Key>)| {
            let opens = keys.iter().filter(|k| !open.contains(k) && left(&users, k) > 1).count();
            let closes = keys.iter().filter(|k| open.contains(k) && left(&users, k) == 1).count();
            let relatives: usize = keys.iter().map(|k| left(&users, k)).sum();
            (opens as isize - closes as isize, relatives, **pin)
        };
        let Some((pin, keys)) = claims.iter().min_by_key(price) else { break };
        let (pin, keys) = (*pin, keys.clone());
        claims.remove(&pin);
        for key in keys {
            if let Some(pins) = users.get_mut(&key) {
                pins.remove(&pin);
            }
            open.insert(key);
        }
        order.push(pin);
    }
    order
}
