//! When to give up: a function of the caller in, asked between the steps of whatever takes long.
//!
//! The library has no clock. A caller that has one, or a flag that another thread sets, hands it in
//! here. Everything on the way to an answer asks the same value.

/// What ends a search before its answer is known.
///
/// Once it is over it must stay over.
#[derive(Clone, Copy, Default)]
pub struct Cancel<'a>(Option<&'a (dyn Fn() -> bool + Sync)>);

impl<'a> Cancel<'a> {
    /// Nothing ends the search.
    pub const NEVER: Self = Self(None);

    /// The search ends when this returns true.
    #[must_use]
    pub const fn when(over: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(Some(over))
    }

    /// Whether the search is to end.
    #[must_use]
    pub fn is_over(self) -> bool {
        self.0.is_some_and(|over| over())
    }
}
