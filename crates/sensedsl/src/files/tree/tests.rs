//! A run is stopped after each single change, or a single change fails, and so does the run that
//! repairs it: the folder always holds the old tree or the new one, and the user's files are still
//! there.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use super::layout::{LIST, WORK, listed};
use super::*;
use crate::files::fault::Fault;

/// A folder for one test.
struct TempDir(PathBuf);

impl TempDir {
    fn new() -> Self {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let own = format!("sensedsl-tree-{}-{number}", std::process::id());
        // Thousands of folders are made and removed, which is much faster in memory.
        let in_memory = Path::new("/dev/shm").join(&own);
        if fs::create_dir_all(&in_memory).is_ok() {
            return Self(in_memory);
        }
        let path = std::env::temp_dir().join(own);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn out(&self) -> PathBuf {
        self.0.join("out")
    }
}

impl Drop for TempDir {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn take(out: &Path, wait: Duration, waiting: &mut dyn FnMut()) -> Result<Output, Trouble> {
    Output::take(out, Path::new(""), wait, waiting)
}

type Tree = BTreeMap<String, String>;

/// All files as they are found by their names, except the work of a run.
fn seen(root: &Path) -> Tree {
    let mut files = Tree::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                if path.file_name().unwrap() != WORK {
                    folders.push(path);
                }
            } else {
                let name = layout::slashed(path.strip_prefix(root).unwrap());
                files.insert(name, fs::read_to_string(&path).unwrap());
            }
        }
    }
    files
}

/// The files that a run writes: generated ones, and those that are the user's once they are there.
const OLD: &[(&str, &str)] =
    &[("a", "old a"), ("fw/A/Makefile", "same"), ("fw/A/gen/x.c", "old x"), ("host/old/y", "y")];
const OLD_ONCE: &str = "fw/A/user/user.c";
const NEW: &[(&str, &str)] =
    &[("a", "new a"), ("fw/A/Makefile", "same"), ("fw/A/gen/x.c", "new x"), ("fw/B/m", "m")];
const NEW_ONCE: &str = "fw/B/user/user.c";

/// A list without digests of files.
fn list(files: &[(&str, &str)]) -> String {
    layout::list(&files.iter().map(|(path, _)| ((*path).to_owned(), None)).collect())
}

/// The tree that a run writes into a folder.
fn new_tree<'a>(root: &Path, files: &'a [(&'a str, &'a str)], once: &'a [&'a str]) -> NewTree<'a> {
    let generated: BTreeSet<_> = files.iter().map(|(path, _)| (*path).to_owned()).collect();
    let stale = listed(&root.join(LIST)).unwrap().difference(&generated).cloned().collect();
    let wanted = files.iter().map(|(path, text)| (*path, *text, false));
    let once = once.iter().map(|path| (*path, "template", true));
    let new = wanted.chain(once).map(|(path, text, once)| {
        let there = fs::read_to_string(root.join(path)).ok();
        let changes = there.is_none_or(|found| !once && found != text);
        NewFile { path, bytes: text.as_bytes(), once, changes }
    });
    NewTree { files: new.collect(), list: list(files), stale }
}

/// Writes a tree as `generate` does.
fn write(out: &Path, fault: Fault, files: &[(&str, &str)], once: &[&str]) -> (bool, bool) {
    let ops = Ops { fault };
    let mut output = match Output::take_with(ops, out, Duration::ZERO, &mut || {}) {
        Ok(output) => output,
        Err(Trouble::Unrecovered(_) | Trouble::Unwritten(_)) => return (false, true),
        Err(other) => panic!("{other:?}"),
    };
    let root = output.root().to_path_buf();
    let new = new_tree(&root, files, once);
    let done = output.write(&new).is_ok();
    (done, output.ops.fault.has_struck())
}

/// A folder with the old tree and some files of the user's.
fn before() -> (TempDir, Tree) {
    let scratch = TempDir::new();
    let out = scratch.out();
    assert!(write(&out, Fault::default(), OLD, &[OLD_ONCE]).0);
    fs::write(out.join(OLD_ONCE), "mine").unwrap();
    fs::create_dir_all(out.join("fw/A/user/deep")).unwrap();
    fs::write(out.join("fw/A/user/deep/more.h"), "more").unwrap();
    fs::create_dir_all(out.join("fw/A/build")).unwrap();
    fs::write(out.join("fw/A/build/x.o"), "object").unwrap();
    fs::create_dir_all(out.join(".git")).unwrap();
    fs::write(out.join(".git/HEAD"), "ref").unwrap();
    let seen = seen(&out);
    (scratch, seen)
}

/// The tree after a run that is not stopped.
fn after(old: &Tree) -> Tree {
    let mut tree = old.clone();
    tree.retain(|name, _| !OLD.iter().any(|(path, _)| name == path));
    tree.extend(NEW.iter().map(|(path, text)| ((*path).to_owned(), (*text).to_owned())));
    tree.insert(NEW_ONCE.into(), "template".into());
    tree.insert(LIST.into(), list(NEW));
    tree
}

/// The entries that no run may ever touch, by inode if there are inodes.
#[cfg(unix)]
fn identity(out: &Path) -> Vec<(u64, i64, u64)> {
    use std::os::unix::fs::MetadataExt as _;
    let paths =
        ["", ".git", "fw/A/user", "fw/A/user/user.c", "fw/A/user/deep/more.h", "fw/A/build"];
    let found = paths.iter().map(|path| fs::metadata(out.join(path)).unwrap());
    found
        .map(|found| match found.is_dir() {
            true => (found.ino(), 0, 0),
            false => (found.ino(), found.ctime_nsec(), found.nlink()),
        })
        .collect()
}

#[cfg(not(unix))]
fn identity(_: &Path) -> Vec<u8> {
    Vec::new()
}

fn clean(scratch: &TempDir) {
    let left: Vec<_> =
        fs::read_dir(&scratch.0).unwrap().map(|one| one.unwrap().file_name()).collect();
    assert_eq!(left, ["out"]);
    assert!(!scratch.out().join(WORK).exists());
}

/// Runs a test for each change that may be the last one, in a folder of its own, until the test says that none struck.
fn at_each_change(mut test: impl FnMut(usize, &TempDir, &Tree) -> bool) {
    for n in 0.. {
        let (scratch, old) = before();
        if !test(n, &scratch, &old) {
            break;
        }
    }
}

/// Writes the new tree; returns whether that was done, and whether the fault struck.
fn renew(out: &Path, fault: Fault) -> (bool, bool) {
    write(out, fault, NEW, &[OLD_ONCE, NEW_ONCE])
}

/// Another run comes, and nothing stops it.
fn completes(scratch: &TempDir, wanted: &Tree, n: usize) {
    assert_eq!(renew(&scratch.out(), Fault::default()), (true, false), "{n}");
    assert_eq!(seen(&scratch.out()), *wanted, "{n}");
    clean(scratch);
}

#[test]
fn a_tree_replaces_another_and_what_is_the_user_s_stays_what_it_was() {
    let (scratch, old) = before();
    let out = scratch.out();
    let own = identity(&out);
    completes(&scratch, &after(&old), 0);
    assert_eq!(identity(&out), own, "the folder is the same for a shell that works in it");
    assert!(!out.join("host").exists(), "empty folders go");
}

#[test]
#[cfg(target_os = "linux")]
fn whatever_change_is_the_last_one_the_tree_is_the_old_or_the_new_one() {
    let mut states = [0, 0];
    at_each_change(|n, scratch, old| {
        let (out, own) = (scratch.out(), identity(&scratch.out()));
        let (done, struck) = renew(&out, Fault::killed_at(n));
        if !struck {
            assert!(done && n > 50, "{n} changes");
            return false;
        }
        let now = seen(&out);
        assert!(now == *old || now == after(old), "after {n} changes: {now:#?}");
        states[usize::from(now != *old)] += 1;
        // Another run comes, and is stopped as well.
        for m in (n % 17..).step_by(17) {
            let (_, struck) = renew(&out, Fault::killed_at(m));
            let now = seen(&out);
            assert!(now == *old || now == after(old), "after {n} and {m} changes: {now:#?}");
            if !struck {
                break;
            }
        }
        assert_eq!(seen(&out), after(old), "{n}");
        assert_eq!(identity(&out), own, "{n}");
        clean(scratch);
        true
    });
    assert!(states.iter().all(|count| *count > 5), "{states:?}");
}

#[test]
#[cfg(target_os = "linux")]
fn whoever_comes_after_a_kill_may_want_the_old_tree_again() {
    at_each_change(|n, scratch, old| {
        let out = scratch.out();
        let (_, struck) = renew(&out, Fault::killed_at(n));
        assert_eq!(write(&out, Fault::default(), OLD, &[OLD_ONCE]), (true, false), "{n}");
        let mut now = seen(&out);
        now.remove(NEW_ONCE);
        assert_eq!(now, *old, "{n}");
        clean(scratch);
        struck
    });
}

#[test]
#[cfg(target_os = "linux")]
fn a_change_that_fails_leaves_the_old_tree_or_the_new_one_and_no_leftovers() {
    at_each_change(|n, scratch, old| {
        let (done, struck) = renew(&scratch.out(), Fault::full_at(n));
        let now = seen(&scratch.out());
        if !done && now == *old {
            clean(scratch);
        }
        assert!(now == *old || now == after(old), "{n}: {now:#?}");
        assert!(!done || now == after(old), "{n}");
        completes(scratch, &after(old), n);
        struck
    });
}

#[test]
#[cfg(target_os = "linux")]
fn what_the_user_does_between_a_kill_and_the_next_run_is_kept() {
    at_each_change(|n, scratch, old| {
        let out = scratch.out();
        let (_, struck) = renew(&out, Fault::killed_at(n));
        let switched = out.join("fw/B").exists();
        // Some editors write in place, others replace the old file by a new one.
        fs::write(out.join(OLD_ONCE), "edited").unwrap();
        fs::write(out.join("fw/A/user/new.c"), "new").unwrap();
        fs::rename(out.join("fw/A/user/new.c"), out.join("fw/A/user/deep/more.h")).unwrap();
        fs::create_dir_all(out.join("host/build")).unwrap();
        fs::write(out.join("host/build/y.o"), "built").unwrap();
        fs::write(out.join("notes.txt"), "notes").unwrap();
        if switched {
            fs::write(out.join(NEW_ONCE), "edited too").unwrap();
        }
        let mut expected = after(old);
        for (path, text) in [
            (OLD_ONCE, "edited"),
            ("fw/A/user/deep/more.h", "new"),
            ("host/build/y.o", "built"),
            ("notes.txt", "notes"),
            (NEW_ONCE, if switched { "edited too" } else { "template" }),
        ] {
            expected.insert(path.into(), text.into());
        }
        completes(scratch, &expected, n);
        struck
    });
}

#[test]
fn a_journal_is_completed_by_the_next_run() {
    let mut between = 0;
    at_each_change(|n, scratch, old| {
        let out = scratch.out();
        let work = out.join(WORK);
        let journal = |fault| {
            let ops = Ops { fault };
            let _lock = Lock::take(&work, Duration::ZERO, &mut || {}).unwrap();
            let new = new_tree(&out, NEW, &[OLD_ONCE, NEW_ONCE]);
            let done = journal::recover(&ops, &out, &work)
                .and_then(|()| seal::set(&ops, &work))
                .map_err(Failure::Before)
                .and_then(|()| journal::write(&ops, &out, &work, &new));
            (done.is_ok(), ops.fault.has_struck())
        };
        let (done, struck) = journal(Fault::killed_at(n));
        let now = seen(&out);
        between += usize::from(now != *old && now != after(old));
        assert_eq!(done, !struck);
        // The next run repairs it, in whichever way it works.
        completes(scratch, &after(old), n);
        struck
    });
    assert!(between > 3, "a journal has states in between: {between}");
}

#[test]
fn where_nothing_can_stand_beside_the_folder_there_is_a_journal() {
    // A name that cannot become any longer.
    let scratch = TempDir::new();
    let out = scratch.0.join("x".repeat(250));
    for _ in 0..2 {
        assert_eq!(write(&out, Fault::default(), OLD, &[OLD_ONCE]), (true, false));
        fs::write(out.join(OLD_ONCE), "mine").unwrap();
        let old = seen(&out);
        assert_eq!(renew(&out, Fault::default()), (true, false));
        assert_eq!(seen(&out), after(&old));
        assert!(!out.join(WORK).exists());
    }
    assert_eq!(fs::read_dir(&scratch.0).unwrap().count(), 1);
}

#[test]
fn a_second_run_waits_and_gives_up() {
    let scratch = TempDir::new();
    let out = scratch.out();
    let first = take(&out, Duration::ZERO, &mut || {}).unwrap();
    let mut reported = 0;
    let second = take(&out, Duration::from_millis(500), &mut || reported += 1);
    assert!(matches!(second, Err(Trouble::Busy)));
    assert_eq!(reported, 1);
    drop(first);
    assert!(!out.exists(), "nothing was written");
    drop(take(&out, Duration::ZERO, &mut || {}).unwrap());
}

#[test]
#[cfg(target_os = "linux")]
fn an_unfinished_tree_whose_folder_was_replaced_is_not_removed() {
    let mut orphans = 0;
    at_each_change(|n, scratch, _| {
        let out = scratch.out();
        let (_, struck) = renew(&out, Fault::killed_at(n));
        fs::rename(&out, scratch.0.join("moved")).unwrap();
        fs::create_dir(&out).unwrap();
        if let Err(Trouble::Orphan(left)) = take(&out, Duration::ZERO, &mut || {}) {
            assert_eq!(fs::read_to_string(left.join(OLD_ONCE)).unwrap(), "mine");
            orphans += 1;
        }
        let places = ["moved", ".out.sensedsl-unfinished", "out"];
        let mut texts = places.iter().map(|place| scratch.0.join(place).join(OLD_ONCE));
        assert!(texts.any(|path| fs::read_to_string(path).is_ok_and(|text| text == "mine")), "{n}");
        struck
    });
    assert!(orphans > 3, "{orphans}");
}

#[test]
fn lines_of_a_list_that_leave_the_folder_are_not_believed() {
    let scratch = TempDir::new();
    let lies = "# head\n../a\n/etc/hostname\na/../../b\n\nfine/c\n";
    fs::write(scratch.0.join("list"), lies).unwrap();
    let found: Vec<String> = listed(&scratch.0.join("list")).unwrap().into_iter().collect();
    assert_eq!(found, ["fine/c"]);
    assert!(listed(&scratch.0.join("none")).unwrap().is_empty());
}
