//! When to give up: a question of the caller's, asked between the steps of whatever takes long.
//!
//! The library has no clock. Whoever has one (or a flag that another thread sets) hands it in here,
//! and all that a search does on the way to its answer asks the same value.

/// What ends a search before its answer is known.
///
/// Once it has said that it is over it has to stay so.
#[derive(Clone, Copy, Default)]
pub struct Cancel<'a>(Option<&'a (dyn Fn() -> bool + Sync)>);

impl<'a> Cancel<'a> {
    /// Nothing ends it.
    pub const NEVER: Self = Self(None);

    /// It ends when this says true.
    #[must_use]
    pub const fn when(over: &'a (dyn Fn() -> bool + Sync)) -> Self {
        Self(Some(over))
    }

    /// Whether it is over.
    #[must_use]
    pub fn is_over(self) -> bool {
        self.0.is_some_and(|over| over())
    }
}
