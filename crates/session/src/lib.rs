//! The pipeline for its users: files with edits in, snapshots out.
//!
//! A [`Workspace`] holds the texts that are open in an editor; other files come through
//! [`sensedsl_model::Files`]. [`Workspace::snapshot`] reads a file and everything that it uses, and
//! [`Snapshot::solve`] finds the wiring. A snapshot never changes: after an edit there is a new
//! one. A mistake in one device leaves only that device out, and the rest can still be wired.
//!
//! Nothing here does I/O or has a thread or a clock: the caller provides the files and tells when
//! time is up. That is why the command line, an editor and a web page can share this crate.
//!
//! # Example
//!
//! ```
//! use sensedsl_model::NoFiles;
//! use sensedsl_session::{Ask, On, Workspace};
//!
//! let mut workspace = Workspace::default();
//! let text = "board Rover on STM32F4DiscoveryBoard {
//!     sensor Light returns uint16 { id = 1; type = analog; }
//! }";
//! workspace.open("rover.sense", text);
//! let before = workspace.snapshot("rover.sense", On::default(), &NoFiles);
//! let at = text.find("analog").unwrap();
//! workspace.edit("rover.sense", at..at + 6, "analogue").unwrap();
//! let after = workspace.snapshot("rover.sense", On::default(), &NoFiles);
//!
//! assert!(before.solve(&Ask::default()).wired().is_some());
//! assert!(after.solve(&Ask::default()).wired().is_none());
//! assert_eq!(after.diagnostics()[0].message, "`analogue` is not a kind of device");
//! ```

mod answer;
pub mod boards;
mod fit;
mod snapshot;
mod subject;
mod workspace;

pub use answer::{Answer, Ask, Goal, Patience};
pub use fit::{Fit, Quality};
pub use snapshot::{Snapshot, Sound, has_errors};
pub use subject::{Origin, printed_board};
pub use workspace::{EditOutOfRange, On, Workspace};
