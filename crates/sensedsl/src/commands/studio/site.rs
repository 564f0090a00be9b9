//! The page's files: those that were put into this program when it was built, or those of a folder.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

use super::answer::Answer;
use crate::files::shown;

include!(concat!(env!("OUT_DIR"), "/studio.rs"));

/// Where the page's files are.
pub(super) enum Site {
    /// In this program.
    Own,
    /// In a folder.
    In(PathBuf),
}

impl Site {
    /// The files in a folder, or in this program.
    ///
    /// # Errors
    /// The folder has no page, or none is named and the program was built without.
    pub(super) fn find(folder: Option<&Path>) -> Result<Self> {
        match folder {
            Some(folder) if folder.join("index.html").is_file() => {
                Ok(Self::In(fs::canonicalize(folder)?))
            }
            Some(folder) => bail!("there is no page in {}: it has no index.html", shown(folder)),
            None if FILES.iter().any(|(path, _)| *path == "index.html") => Ok(Self::Own),
            None => bail!(
                "this program was built without the studio's page: make it with `cargo xtask studio`, \
                 and name its folder: sensedsl studio --site target/web/studio"
            ),
        }
    }

    /// The page itself, with the token that lets it ask for files.
    pub(super) fn page(&self, token: &str) -> Answer {
        let Some(bytes) = self.bytes("index.html") else {
            return Answer::refused(404, "the page is missing");
        };
        let text = String::from_utf8_lossy(&bytes);
        let token = format!("<meta name=\"sensedsl-token\" content=\"{token}\">\n</head>");
        Answer::file(kind("index.html"), text.replacen("</head>", &token, 1).into_bytes())
    }

    /// A file of the page.
    pub(super) fn file(&self, path: &str) -> Answer {
        let path = path.trim_start_matches('/');
        match self.bytes(path) {
            Some(bytes) => Answer::file(kind(path), bytes),
            None => Answer::refused(404, "not found"),
        }
    }

    fn bytes(&self, path: &str) -> Option<Vec<u8>> {
        let is_plain = path.split('/').all(|part| {
            !part.is_empty()
                && !part.starts_with('.')
                && part.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_'))
        });
        if !is_plain {
            return None;
        }
        match self {
            Self::Own => {
                FILES.iter().find(|(own, _)| *own == path).map(|(_, bytes)| bytes.to_vec())
            }
            Self::In(folder) => {
                let real = fs::canonicalize(folder.join(path)).ok()?;
                real.starts_with(folder).then(|| fs::read(real).ok()).flatten()
            }
        }
    }
}

/// What a browser is told about a file.
fn kind(path: &str) -> &'static str {
    match path.rsplit_once('.').map_or("", |(_, end)| end) {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "json" | "webmanifest" => "application/json",
        "svg" => "image/svg+xml",
        "png" => "image/png",
        "wasm" => "application/wasm",
        _ => "text/plain; charset=utf-8",
    }
}
