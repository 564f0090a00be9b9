//! Everything that `generate` writes for a few designs, byte for byte, as it was read and agreed to.
//!
//! The runtime's own files are copied from `runtime/` and left out here. After a change that is
//! meant: `cargo xtask bless`, and read the difference.

use std::collections::BTreeMap;
use std::fs;

use sensedsl_tests::{Scratch, root, sensedsl, tree};

/// Copied as they are from `runtime/`, whatever the design.
fn is_runtime(path: &str) -> bool {
    path.contains("/uproxy/") || path.contains("/include/sensedsl/")
}

fn generated(file: &str, arguments: &[&str]) -> BTreeMap<String, Vec<u8>> {
    let scratch = Scratch::new("golden");
    let call = sensedsl(["generate", file, "-q", "-o"]).arg(scratch.join("out")).args(arguments);
    let _ = call.run().exits(0);
    let mut files = tree(&scratch.join("out"));
    files.retain(|path, _| !is_runtime(path));
    // The list says again, in a SHA-256, what the files say.
    if let Some(list) = files.get_mut(".sensedsl-files") {
        let text = String::from_utf8_lossy(list).into_owned();
        let name = |line: &str| match line.split_once("  ") {
            Some((digest, name)) if digest.len() == 64 => format!("{name}\n"),
            _ => format!("{line}\n"),
        };
        *list = text.lines().map(name).collect::<String>().into_bytes();
    }
    files
}

/// Holds what is generated for `folder/example.sense` to the tree of that name.
fn agrees(folder: &str, example: &str, arguments: &[&str]) {
    let files = generated(&format!("{folder}/{example}.sense"), arguments);
    let folder = root().join("tests/golden").join(example);
    if std::env::var_os("SENSEDSL_BLESS").is_some() {
        if folder.exists() {
            fs::remove_dir_all(&folder).unwrap();
        }
        for (path, bytes) in &files {
            let path = folder.join(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, bytes).unwrap();
        }
    }
    let golden = tree(&folder);
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&files), names(&golden), "{example}: other files");
    for (path, bytes) in &files {
        let (found, agreed) =
            (String::from_utf8_lossy(bytes), String::from_utf8_lossy(&golden[path]));
        if let Some((number, (found, agreed))) =
            found.lines().zip(agreed.lines()).enumerate().find(|(_, (one, other))| one != other)
        {
            panic!("{example}/{path}:{}\n- {agreed}\n+ {found}\n", number + 1);
        }
        assert_eq!(bytes, &golden[path], "{example}/{path}: another end");
    }
}

#[test]
fn fig2() {
    agrees("examples", "fig2", &[]);
}

#[test]
fn miniature_car() {
    agrees("examples", "miniature_car", &[]);
}

#[test]
fn curves() {
    agrees("tests/hosts", "curves", &["--without", "firmware"]);
}
