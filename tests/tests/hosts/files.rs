//! Generated files on disk.

use std::path::{Path, PathBuf};

use sensedsl_generate::host;
use sensedsl_job::host::{HostBoard, HostPlan};
use sensedsl_tests::write_all;

use crate::firmware::tools::empty;

/// An empty folder for this test run.
pub(crate) fn folder(name: &str) -> PathBuf {
    empty(&format!("hosts/{name}"))
}

/// Writes one host of a design, called `robot`, into a folder of its own.
pub(crate) fn generate(host: &str, test: &str, boards: &[HostBoard]) -> PathBuf {
    generate_as("robot", host, test, boards)
}

/// Like [`generate`], with another name.
pub(crate) fn generate_as(name: &str, host: &str, test: &str, boards: &[HostBoard]) -> PathBuf {
    let path = folder(&format!("{test}-{host}"));
    let files = host::find(host).unwrap().render(&HostPlan::new(name, boards));
    assert!(!files.is_empty());
    write_all(&path, files.iter().map(|(name, entry)| (name, &entry.bytes)));
    path
}

/// All sources of a generated host with that extension, relative to its folder.
pub(crate) fn sources(path: &Path, extension: &str) -> Vec<String> {
    let end = format!(".{extension}");
    let sources: Vec<String> =
        sensedsl_tests::tree(path).into_keys().filter(|name| name.ends_with(&end)).collect();
    assert!(!sources.is_empty(), "{}: no {end}", path.display());
    sources
}
