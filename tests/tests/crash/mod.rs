//! `generate` is stopped while it writes, runs at the same time as others, and meets full disks. In
//! each case the folder contains the old tree or the new one, the next run needs no help, and the
//! user's files are unchanged.
//!
//! A few cases of each kind run with the other tests. `SENSEDSL_CRASHES=300` requests 300 SIGKILL,
//! a third as many SIGTERM, SIGINT and rounds of four runs, and a fifteenth as many full disks.
#![cfg(target_os = "linux")]
#![expect(clippy::print_stderr, reason = "a test that measures")]

mod disks;
mod kills;
mod rounds;

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::MetadataExt as _;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

use sensedsl_tests::{RunOutput, TempDir, binary, design, sensedsl, state, tree, write_all};

/// The number of crashes requested; `None` for the few that always run.
fn asked() -> Option<usize> {
    std::env::var("SENSEDSL_CRASHES").ok().map(|text| text.parse().unwrap())
}

type Tree = BTreeMap<String, Vec<u8>>;

/// A folder that two designs are written to in turn. They differ in the board's name, so most files
/// of one are missing or different in the other.
struct Stage {
    scratch: TempDir,
    designs: [PathBuf; 2],
    /// The trees without the user's files.
    trees: [Tree; 2],
}

const NAMES: [&str; 2] = ["Robot", "Rover"];

/// The user's files: path and content.
const MINE: [(&str, &str); 4] = [
    ("firmware/Robot/user/user.c", "/* mine */\n"),
    ("firmware/Robot/user/more/own.h", "/* mine too */\n"),
    ("firmware/Robot/build/sense.o", "object"),
    (".git/HEAD", "ref: refs/heads/main\n"),
];

impl Stage {
    fn new(name: &str) -> Self {
        let scratch = TempDir::new(name);
        let devices: [&[&str]; 2] = [&["analog", "icu"], &["analog", "analog", "icu"]];
        let designs = [0, 1].map(|which| {
            let board = format!("{} on STM32F4DiscoveryBoard", NAMES[which]);
            scratch.write(&format!("{}.sense", NAMES[which]), design(&board, devices[which]))
        });
        let trees = [0, 1].map(|which| {
            let reference = scratch.join(&format!("reference/{which}"));
            let _ = run(&designs[which], &reference).exits(0);
            generated(&reference)
        });
        fs::create_dir(scratch.join("here")).unwrap();
        Self { scratch, designs, trees }
    }

    /// The output folder; beside it there is only what `generate` puts there.
    fn out(&self) -> PathBuf {
        self.scratch.join("here/out")
    }

    /// The index of the tree that is in a folder.
    #[track_caller]
    fn which(&self, out: &Path) -> usize {
        let found = generated(out);
        let which = self.trees.iter().position(|tree| *tree == found);
        which.unwrap_or_else(|| {
            let names: Vec<_> = found.keys().collect();
            panic!("{} holds neither tree: {names:#?}", out.display())
        })
    }

    /// Puts the user's files into a folder that contains the first tree.
    fn settle_in(&self, out: &Path) {
        write_all(out, MINE);
        std::os::unix::fs::symlink("user.c", out.join("firmware/Robot/user/link")).unwrap();
    }
}

/// The generated files, selected by their names.
fn generated(out: &Path) -> Tree {
    let theirs = |path: &str| path.split('/').any(|part| ["user", "build", ".git"].contains(&part));
    let mut files = if out.exists() { tree(out) } else { Tree::new() };
    files.retain(|path, _| !theirs(path));
    files
}

/// The properties of the user's files that no run may change: all that `stat` reports, except for
/// the access time.
fn identity(out: &Path) -> Vec<(String, u64, u32, u64, i64, i64)> {
    let mut all = Vec::new();
    for (path, _) in MINE {
        let found = fs::metadata(out.join(path)).unwrap_or_else(|e| panic!("{path}: {e}"));
        let size = found.size();
        all.push((path.into(), found.ino(), found.mode(), size, found.mtime(), found.ctime_nsec()));
    }
    let folder = fs::metadata(out.join("firmware/Robot/user")).unwrap();
    all.push(("user".into(), folder.ino(), folder.mode(), 0, folder.mtime(), folder.mtime_nsec()));
    let link = fs::read_link(out.join("firmware/Robot/user/link")).unwrap();
    all.push((link.display().to_string(), 0, 0, 0, 0, 0));
    all
}

fn run(file: &Path, out: &Path) -> RunOutput {
    sensedsl(["generate", "-q"]).arg(file).arg("-o").arg(out).run()
}

fn start(file: &Path, out: &Path) -> Child {
    let mut command = Command::new(binary());
    command.args(["generate", "-q"]).arg(file).arg("-o").arg(out);
    command.env("XDG_STATE_HOME", state());
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

/// Fails if there is anything beside the output folder.
#[track_caller]
fn nothing_beside(out: &Path) {
    let above = fs::read_dir(out.parent().unwrap()).unwrap();
    let names: Vec<_> = above.map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names, ["out"]);
    assert!(!out.join(".sensedsl-work").exists());
}
