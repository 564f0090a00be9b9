//! Typed indices: a vector knows its index type, so a pin never reads a device's entry.
//!
//! Every id of the crate is a `u32` of its own type. [`Ids`] are consecutive ids, [`IdVec`] holds
//! one item for each id, [`Rows`] holds a list for each id, and [`Blocks`] says which consecutive
//! ids belong to an id of another type. Plain slices are indexed by ids here and nowhere else.
#![expect(clippy::indexing_slicing, reason = "ids are checked once, by `model::validate`")]

mod rows;

pub(crate) use self::rows::{Blocks, Rows};

use crate::problem::{
    BoardId, DeviceId, DmaUser, DmaUserId, PinId, Problem, ResourceId, RuleId, SignalId, StreamId,
};
use std::fmt::Debug;
use std::marker::PhantomData;
use std::ops::{Index, IndexMut, Range};

/// A number that identifies one thing of one type.
pub(crate) trait Id: Copy + Ord + Debug {
    fn new(index: usize) -> Self;
    fn index(self) -> usize;
}

macro_rules! implement_id {
    ($($name:ident)*) => {$(
        impl Id for $name {
            fn new(index: usize) -> Self {
                Self(index as u32)
            }

            fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

/// Declares ids that only this crate uses.
macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
        pub(crate) struct $name(pub(crate) u32);
        implement_id!($name);
    )*};
}

implement_id!(BoardId DeviceId DmaUserId PinId ResourceId RuleId SignalId StreamId);

ids! {
    /// An alternative of some device, numbered over all devices.
    AltId;
    /// A role of some alternative, numbered over all alternatives.
    RoleId;
    /// A candidate of some role, numbered over all roles.
    CandId;
    /// A wire that several devices share.
    WireId;
    /// A resource that at most one unshared wire can pass.
    GateId;
    /// A wire that needs a pin in the flow: a role position of a device, or a shared wire.
    DemandId;
    /// A node of the flow network.
    NodeId;
    /// A constraint with a Lagrange multiplier.
    PriceId;
    /// Something that is opened once for all its users.
    FacilityId;
    /// A soft rule that several wires can violate.
    PenaltyId;
    /// An alternative within a Lagrangian subproblem.
    OptionId;
    /// A group of interchangeable devices with one Lagrangian subproblem.
    GroupId;
    /// A facility that can still be opened, with its Lagrangian subproblem.
    OpeningId;
    /// A role or DMA request that a subproblem fills.
    SlotId;
    /// One way to fill a slot.
    WayId;
    /// A place in the lists of prices.
    ListId;
    /// Wires that can be placed in the same ways.
    ClassId;
    /// A column of the linear program.
    ColumnId;
    /// A row of the linear program.
    RowId;
    /// An entry of the program's matrix, counted column by column.
    EntryId;
    /// A place among the entries of all rows.
    PlaceId;
    /// A step of an elimination or of the exchanges after it.
    StepId;
    /// A variable of the simplex method: first the columns, then one slack for each row.
    VarId;
}

/// Consecutive ids.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Ids<I> {
    start: u32,
    end: u32,
    id: PhantomData<I>,
}

impl<I> Clone for Ids<I> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<I> Copy for Ids<I> {}

impl<I> Default for Ids<I> {
    fn default() -> Self {
        Self { start: 0, end: 0, id: PhantomData }
    }
}

impl<I: Id> Ids<I> {
    /// The first `count` ids.
    pub(crate) fn first(count: usize) -> Self {
        Self { start: 0, end: count as u32, id: PhantomData }
    }

    pub(crate) fn from_to(start: I, end: I) -> Self {
        Self { start: start.index() as u32, end: end.index() as u32, id: PhantomData }
    }

    pub(crate) fn len(self) -> usize {
        (self.end - self.start) as usize
    }

    pub(crate) fn is_empty(self) -> bool {
        self.start == self.end
    }

    pub(crate) fn iter(self) -> IdIter<I> {
        IdIter { range: self.start..self.end, id: PhantomData }
    }

    /// The id at this position, which may be past the end.
    pub(crate) fn at(self, position: usize) -> I {
        I::new(self.start as usize + position)
    }

    /// The id at this position, unless it is past the end.
    pub(crate) fn nth(self, position: usize) -> Option<I> {
        (position < self.len()).then(|| self.at(position))
    }

    /// The position of the id in the range.
    pub(crate) fn position(self, id: I) -> usize {
        id.index() - self.start as usize
    }

    fn indices(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

impl<I: Id> IntoIterator for Ids<I> {
    type Item = I;
    type IntoIter = IdIter<I>;

    fn into_iter(self) -> IdIter<I> {
        self.iter()
    }
}

/// Iterator over consecutive ids.
#[derive(Clone, Debug)]
pub(crate) struct IdIter<I> {
    range: Range<u32>,
    id: PhantomData<I>,
}

impl<I: Id> Iterator for IdIter<I> {
    type Item = I;

    #[inline]
    fn next(&mut self) -> Option<I> {
        self.range.next().map(|index| I::new(index as usize))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.range.size_hint()
    }
}

impl<I: Id> DoubleEndedIterator for IdIter<I> {
    fn next_back(&mut self) -> Option<I> {
        self.range.next_back().map(|index| I::new(index as usize))
    }
}

impl<I: Id> ExactSizeIterator for IdIter<I> {}

/// One item for each id.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct IdVec<I, T> {
    items: Vec<T>,
    id: PhantomData<I>,
}

impl<I, T: Clone> Clone for IdVec<I, T> {
    fn clone(&self) -> Self {
        Self { items: self.items.clone(), id: PhantomData }
    }

    /// Reuses the memory.
    fn clone_from(&mut self, other: &Self) {
        self.items.clone_from(&other.items);
    }
}

impl<I, T> Default for IdVec<I, T> {
    fn default() -> Self {
        Self { items: Vec::new(), id: PhantomData }
    }
}

impl<I, T> From<Vec<T>> for IdVec<I, T> {
    fn from(items: Vec<T>) -> Self {
        Self { items, id: PhantomData }
    }
}

impl<I, T> FromIterator<T> for IdVec<I, T> {
    fn from_iter<A: IntoIterator<Item = T>>(items: A) -> Self {
        Self { items: items.into_iter().collect(), id: PhantomData }
    }
}

impl<I: Id, T> IdVec<I, T> {
    pub(crate) fn len(&self) -> usize {
        self.items.len()
    }

    pub(crate) fn ids(&self) -> Ids<I> {
        Ids::first(self.items.len())
    }

    /// Adds an item and returns its id.
    pub(crate) fn push(&mut self, item: T) -> I {
        self.items.push(item);
        I::new(self.items.len() - 1)
    }

    pub(crate) fn clear(&mut self) {
        self.items.clear();
    }

    pub(crate) fn iter(&self) -> std::slice::Iter<'_, T> {
        self.items.iter()
    }

    pub(crate) fn iter_mut(&mut self) -> std::slice::IterMut<'_, T> {
        self.items.iter_mut()
    }

    pub(crate) fn enumerate(&self) -> impl DoubleEndedIterator<Item = (I, &T)> + Clone {
        self.items.iter().enumerate().map(|(index, item)| (I::new(index), item))
    }

    /// The items of consecutive ids.
    pub(crate) fn of(&self, ids: Ids<I>) -> &[T] {
        &self.items[ids.indices()]
    }
}

impl<I: Id, T: Clone> IdVec<I, T> {
    /// The same item for each of `count` ids.
    pub(crate) fn same(item: T, count: usize) -> Self {
        vec![item; count].into()
    }

    pub(crate) fn fill(&mut self, item: T) {
        self.items.fill(item);
    }

    /// Replaces the contents with the same item for each of `count` ids.
    pub(crate) fn reset(&mut self, item: T, count: usize) {
        self.items.clear();
        self.items.resize(count, item);
    }
}

impl<I: Id, T: Copy> IdVec<I, T> {
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.items.copy_from_slice(&other.items);
    }
}

impl<I: Id, T> Index<I> for IdVec<I, T> {
    type Output = T;

    #[inline]
    fn index(&self, id: I) -> &T {
        &self.items[id.index()]
    }
}

impl<I: Id, T> IndexMut<I> for IdVec<I, T> {
    #[inline]
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.items[id.index()]
    }
}

impl<'a, I, T> IntoIterator for &'a IdVec<I, T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.items.iter()
    }
}

impl<'a, I, T> IntoIterator for &'a mut IdVec<I, T> {
    type Item = &'a mut T;
    type IntoIter = std::slice::IterMut<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.items.iter_mut()
    }
}

impl<I, T> IntoIterator for IdVec<I, T> {
    type Item = T;
    type IntoIter = std::vec::IntoIter<T>;

    fn into_iter(self) -> Self::IntoIter {
        self.items.into_iter()
    }
}

impl Problem {
    pub(crate) fn dma_user(&self, user: DmaUserId) -> &DmaUser {
        &self.dma[user.index()]
    }
}
