//! Files that a source includes: a path in; its text out, unless it is too deep, one too many, or cannot be read.

use sensedsl_diagnostics::codes::e0808_too_many_includes;
use sensedsl_diagnostics::{FileId, Span};
use sensedsl_limits::{INCLUDE_DEPTH_MAX, INCLUDES_MAX};
use sensedsl_model::ReadError;

use crate::log::Log;
use crate::source::Source;

/// The files that may still be included.
#[derive(Debug)]
pub(crate) struct Includes {
    left: usize,
}

impl Includes {
    pub(crate) const fn new() -> Self {
        Self { left: INCLUDES_MAX }
    }

    /// Reads a file that is included at that place, by a file at that depth; what is wrong is reported.
    pub(crate) fn read(
        &mut self,
        source: &Source<'_>,
        path: &str,
        (depth, span): (usize, Span),
        log: &mut Log,
    ) -> Option<(FileId, String)> {
        let mut too_many = |limit: String| {
            log.once(e0808_too_many_includes::too_many_includes(span, path, &limit));
            None
        };
        if depth >= INCLUDE_DEPTH_MAX {
            return too_many(format!("{INCLUDE_DEPTH_MAX} files include each other already"));
        }
        let Some(fewer) = self.left.checked_sub(1) else {
            return too_many(format!("{INCLUDES_MAX} files are included already"));
        };
        self.left = fewer;
        match (source.beside)(path) {
            Ok(bytes) => Some(log.text(path, &bytes)),
            Err(ReadError::Missing) => {
                let what =
                    format!("`{path}` is not beside the file: what it says of pins is missing");
                log.dropped(span, "", &what);
                None
            }
            Err(unread) => {
                log.refused(span, path, &unread);
                None
            }
        }
    }
}
