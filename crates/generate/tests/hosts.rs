//! Every host that a crate has is offered: `HOSTS` lists as many as there are implementations.
#![expect(clippy::disallowed_methods, reason = "a test of sources reads them")]
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::BTreeSet;
use std::path::Path;

use sensedsl_generate::host::HOSTS;

/// The number of hosts in the sources of a folder.
fn implemented(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let of = |path: std::path::PathBuf| {
        if path.is_dir() {
            return implemented(&path);
        }
        let is_source = path.extension().is_some_and(|end| end == "rs");
        let text = if is_source { std::fs::read_to_string(&path).unwrap() } else { String::new() };
        text.matches("impl Host for ").count()
    };
    entries.map(of).sum()
}

#[test]
fn every_host_has_its_line() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let all = std::fs::read_dir(crates).unwrap().map(|entry| entry.unwrap().path());
    let hosts = all.filter(|path| {
        path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("host-"))
    });
    let all: usize = hosts.map(|path| implemented(&path.join("src"))).sum();
    assert_eq!(HOSTS.len(), all, "HOSTS in crates/generate/src/host.rs");
    let names: BTreeSet<&str> = HOSTS.iter().map(|host| host.name()).collect();
    assert_eq!(names.len(), all, "two hosts have one name");
}
