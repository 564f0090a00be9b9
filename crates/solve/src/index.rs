//! Typed indices: a vector knows what it is indexed by, so a pin never reads a device's entry.
//!
//! Every id of the crate is a `u32` of its own type. [`Ids`] are consecutive ids, [`IdVec`] holds
//! one item for each id, [`Rows`] holds a list for each id, and [`Blocks`] says which consecutive
//! ids belong to an id of another type. This is the only file that indexes plain slices by ids.
#![expect(clippy::indexing_slicing, reason = "ids are checked once, by `model::validate`")]

use crate::problem::{
    BoardId, DeviceId, DmaUser, DmaUserId, PinId, Problem, ResourceId, RuleId, SignalId, StreamId,
};
use std::fmt::Debug;
use std::marker::PhantomData;
use std::ops::{Index, IndexMut, Range};

/// A number that names one thing of one sort.
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
    /// A resource that at most one wire of its own can pass.
    GateId;
    /// A wire that needs a pin in the flow: a role position of a device, or a shared wire.
    DemandId;
    /// A node of the flow network.
    NodeId;
    /// A constraint with a Lagrange multiplier.
    PriceId;
    /// Something that is opened once for all who use it.
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

    /// The id that stands at this position; it may lie beyond the end.
    pub(crate) fn at(self, position: usize) -> I {
        I::new(self.start as usize + position)
    }

    /// The id at this position, if there are so many.
    pub(crate) fn nth(self, position: usize) -> Option<I> {
        (position < self.len()).then(|| self.at(position))
    }

    /// Where the id stands among these.
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

    /// Forgets what is in it and holds the same item for each of `count` ids.
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

/// Which consecutive ids of one sort belong to each id of another: the alternatives of a device.
#[derive(Clone, Debug)]
pub(crate) struct Blocks<I, J> {
    start: Vec<u32>,
    ids: PhantomData<(I, J)>,
}

impl<I, J> Default for Blocks<I, J> {
    fn default() -> Self {
        Self { start: vec![0], ids: PhantomData }
    }
}

impl<I: Id, J: Id> Blocks<I, J> {
    /// The next id of the one sort owns all ids of the other that follow, up to `end` of them.
    pub(crate) fn close(&mut self, end: usize) {
        self.start.push(end as u32);
    }

    pub(crate) fn of(&self, owner: I) -> Ids<J> {
        let owner = owner.index();
        Ids { start: self.start[owner], end: self.start[owner + 1], id: PhantomData }
    }

    /// All that belongs to consecutive owners.
    pub(crate) fn of_all(&self, owners: Ids<I>) -> Ids<J> {
        let start = self.start[owners.start as usize];
        Ids { start, end: self.start[owners.end as usize], id: PhantomData }
    }

    /// Number of ids that have an owner.
    pub(crate) fn total(&self) -> usize {
        self.start.last().map_or(0, |end| *end as usize)
    }

    /// Whether as many owners in both places own as many each.
    pub(crate) fn same_sizes(&self, one: Ids<I>, other: Ids<I>) -> bool {
        same_sizes(&self.start, one.indices(), other.indices())
    }
}

/// A list for each id, all of them in one vector.
#[derive(Clone, Debug)]
pub(crate) struct Rows<I, T> {
    start: Vec<u32>,
    items: Vec<T>,
    id: PhantomData<I>,
}

impl<I, T> Default for Rows<I, T> {
    fn default() -> Self {
        Self { start: vec![0], items: Vec::new(), id: PhantomData }
    }
}

impl<I: Id, T> Rows<I, T> {
    /// Adds an item to the list that is being filled.
    pub(crate) fn add(&mut self, item: T) {
        self.items.push(item);
    }

    pub(crate) fn extend(&mut self, items: impl IntoIterator<Item = T>) {
        self.items.extend(items);
    }

    /// Ends the list that is being filled and begins the next one.
    pub(crate) fn close(&mut self) {
        self.start.push(self.items.len() as u32);
    }

    /// Adds a whole list.
    pub(crate) fn push(&mut self, items: impl IntoIterator<Item = T>) -> I {
        self.extend(items);
        self.close();
        I::new(self.len() - 1)
    }

    /// The list that is being filled.
    pub(crate) fn open(&mut self) -> &mut [T] {
        let start = self.start.last().map_or(0, |end| *end as usize);
        &mut self.items[start..]
    }

    /// Forgets all lists.
    pub(crate) fn clear(&mut self) {
        self.start.truncate(1);
        self.items.clear();
    }

    pub(crate) fn len(&self) -> usize {
        self.start.len() - 1
    }

    pub(crate) fn ids(&self) -> Ids<I> {
        Ids::first(self.len())
    }

    /// The items of all lists.
    pub(crate) fn items(&self) -> &[T] {
        &self.items
    }

    /// Whether as many lists in both places have the same lengths.
    fn same_sizes(&self, one: Ids<I>, other: Ids<I>) -> bool {
        same_sizes(&self.start, one.indices(), other.indices())
    }

    fn span(&self, rows: Ids<I>) -> &[T] {
        let Range { start, end } = rows.indices();
        &self.items[self.start[start] as usize..self.start[end] as usize]
    }
}

impl<I: Id, T: PartialEq> Rows<I, T> {
    /// Whether the lists in both places are the same.
    pub(crate) fn equal(&self, one: Ids<I>, other: Ids<I>) -> bool {
        self.same_sizes(one, other) && self.span(one) == self.span(other)
    }
}

impl<I: Id, T: Copy> Rows<I, T> {
    /// Sorts pairs of id and item into lists and keeps the order within each list.
    pub(crate) fn collect(rows: usize, pairs: &[(I, T)]) -> Self {
        let Some(&(_, any)) = pairs.first() else {
            return Self { start: vec![0; rows + 1], ..Self::default() };
        };
        let mut start = vec![0_u32; rows + 1];
        for (row, _) in pairs {
            start[row.index() + 1] += 1;
        }
        for row in 0..rows {
            start[row + 1] += start[row];
        }
        let mut next = start.clone();
        let mut items = vec![any; pairs.len()];
        for &(row, item) in pairs {
            items[next[row.index()] as usize] = item;
            next[row.index()] += 1;
        }
        Self { start, items, id: PhantomData }
    }
}

impl<I: Id, T> Index<I> for Rows<I, T> {
    type Output = [T];

    #[inline]
    fn index(&self, row: I) -> &[T] {
        let row = row.index();
        &self.items[self.start[row] as usize..self.start[row + 1] as usize]
    }
}

fn same_sizes(start: &[u32], one: Range<usize>, other: Range<usize>) -> bool {
    let ends = |rows: &Range<usize>| {
        let first = start[rows.start];
        start[rows.start..=rows.end].iter().map(move |end| end - first)
    };
    one.len() == other.len() && ends(&one).eq(ends(&other))
}

impl Problem {
    pub(crate) fn dma_user(&self, user: DmaUserId) -> &DmaUser {
        &self.dma[user.index()]
    }
}
