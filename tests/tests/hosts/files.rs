//! Generated files on disk.

use std::path::{Path, PathBuf};

use sensedsl_generate::host;
use sensedsl_job::host::{HostBoard, HostPlan};

/// An empty folder for this test run.
pub(crate) fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("hosts").join(name);
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
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
    for (name, entry) in files.iter() {
        let file = path.join(name);
        std::fs::create_dir_all(file.parent().unwrap()).unwrap();
        std::fs::write(file, &entry.bytes).unwrap();
    }
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
