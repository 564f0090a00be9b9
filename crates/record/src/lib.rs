//! Runs of boards as files, in the format [MCAP](https://mcap.dev): written while they last, read again, and put into
//! other forms.
//!
//! In: news of boards ([`sensedsl_host::News`]) and something to write to. Out: a file that any reader of MCAP reads;
//! and the other way round, [`Entry`]s of such a file, in their order. The crate opens no files itself.
//!
//! A record has `schema.json` as an attachment, a channel for each device with messages in JSON, and what went over the
//! link, byte by byte; `docs/records.md` describes it. It is written in chunks, so one that ends anywhere is read up to
//! its last whole chunk.

mod channels;
pub mod convert;
pub mod page;
mod read;
mod series;
pub mod summary;
pub mod text;
mod write;

pub use channels::{EVENTS, HEALTH, PROFILE, RECEIVED, SCHEMA_FILE, SENT};
pub use read::{Ending, Entry, Past, RecordError, RecordReader};
pub use series::Series;
pub use write::Recorder;
