//! Cancellation: a function of the caller's that every long computation calls between its steps.
//!
//! The library has no clock. A caller that has one, or a flag that another thread sets, passes it
//! in here. Every step on the way to an answer asks the same value.

/// What ends a search before its answer is known.
///
/// Once it has ended the search, it must keep doing so.
#[derive(Clone, Copy, Default)]
pub struct Cancel<'a>(Option<&'a (dyn Fn() -> bool + Sync)>);

impl<'a> Cancel<'a> {
    /// Never ends the search.
    pub const NEVER: Self = Self(None);

    /// Ends the search when this function returns true.
    #[must_use]
    pub const fn when(over: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(Some(over))
    }

    /// Whether the search must end.
    #[must_use]
    pub fn is_over(self) -> bool {
        self.0.is_some_and(|over| over())
    }
}
