//! The pipeline as its users see it: files with edits in, snapshots out.
//!
//! A [`Workspace`] holds the texts that an editor has open; other files come through
//! [`sensedsl_model::Files`]. [`Workspace::snapshot`] reads a file and what it uses, and
//! [`Snapshot::solve`] finds the wiring. A snapshot never changes: after an edit there is a new one.
//! A mistake in one device leaves that device out, and the rest can still be asked for its wiring.
//!
//! Nothing here does I/O, has a thread or a clock: whoever calls brings the files and says when time
//! is up. So the command line, an editor and a web page share this crate.

mod answer;
mod fit;
mod snapshot;
mod subject;
mod workspace;

pub use answer::{Answer, Ask, Goal};
pub use fit::{Fit, Quality};
pub use snapshot::{Snapshot, Sound, has_errors};
pub use subject::{Origin, printed_board};
pub use workspace::{Misplaced, On, Workspace};
