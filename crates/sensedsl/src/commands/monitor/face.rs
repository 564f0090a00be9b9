//! What people see of a run: printed values, or a screen.

use anyhow::Result;
use sensedsl_host::{Moment, News};

use super::link::Link;

/// What people ask for.
pub(super) enum Ask {
    /// An actuator is to be set, of any board or of the one that is named before a slash.
    Set {
        /// Its name.
        name: String,
        /// The value, as it is shown.
        text: String,
    },
    /// The end.
    Quit,
}

/// A way to show a run to people.
pub(super) trait Face {
    /// Shows what happened.
    fn take(&mut self, news: &News<'_>, links: &[Link<'_>]) -> Result<()>;
    /// Shows a sentence.
    fn say(&mut self, text: &str) -> Result<()>;
    /// Shows what is due, and gives what was asked for meanwhile; called some fifty times a second.
    fn look(&mut self, now: Moment, links: &[Link<'_>]) -> Result<Vec<Ask>>;
    /// Shows what stays, and gives the terminal back.
    fn close(&mut self, now: Moment, links: &[Link<'_>]) -> Result<()>;
    /// Whether it has the whole terminal: keys are its own, and it stays when nothing more comes.
    fn has_terminal(&self) -> bool {
        false
    }
}
