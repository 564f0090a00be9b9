//! Folders of strangers: whatever a cloned or unpacked project contains, `generate` changes nothing
//! outside its output folder and nothing in `user/` and `.git`, and never hangs.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::os::unix::fs::{MetadataExt as _, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

use sensedsl_tests::{Random, RunOutput, TempDir, design, few, one_in, read, sensedsl, text, tree};

const USER: &str = "build/firmware/Robot/user";
const SHEET: &str = "build/wiring.md";

/// A home with files in it, and beside it a project of unknown origin.
struct Clone {
    scratch: TempDir,
    output: String,
}

/// Everything that `stat` reports about files that must not change, with their content.
type Seen = BTreeMap<PathBuf, (u64, u32, u64, i64, i64, Vec<u8>)>;

impl Clone {
    /// A project whose output was generated on another machine.
    fn new(made: &BTreeMap<String, Vec<u8>>) -> Self {
        let scratch = TempDir::new("stranger");
        for name in [".bashrc", "notes.txt", "keys/id"] {
            scratch.write(&format!("home/{name}"), format!("the user's {name}"));
        }
        fs::create_dir_all(scratch.join("home/empty")).unwrap();
        let clone = Self { scratch, output: "build".to_owned() };
        clone.file("robot.sense", design("Robot on STM32F4DiscoveryBoard", &["analog"]));
        for (path, bytes) in made {
            clone.file(&format!("build/{path}"), bytes);
        }
        clone.file(&format!("{USER}/own.c"), "int own;\n");
        clone.file("build/.git/config", "[core]\n");
        clone.file(".git/config", "[core]\n");
        clone
    }

    fn path(&self, path: &str) -> PathBuf {
        self.scratch.join("clone").join(path)
    }

    fn file(&self, path: &str, bytes: impl AsRef<[u8]>) {
        self.scratch.write(&format!("clone/{path}"), bytes);
    }

    /// A place in the project where there is nothing now.
    fn cleared(&self, path: &str) -> PathBuf {
        let path = self.path(path);
        let _ = fs::remove_file(&path);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        path
    }

    /// Puts a link to something of the user's, or to anything else, in the place of what is there.
    fn link(&self, path: &str, target: &str) {
        let path = self.cleared(path);
        symlink(target.replace('~', &self.scratch.join("home").display().to_string()), path)
            .unwrap();
    }

    fn pipe(&self, path: &str) {
        let path = self.cleared(path);
        assert!(Command::new("mkfifo").arg(path).status().unwrap().success());
    }

    fn hard(&self, path: &str, of: &str) {
        fs::hard_link(self.scratch.join("home").join(of), self.cleared(path)).unwrap();
    }

    /// Does what a line of a trap says.
    fn set_up(&mut self, line: &str) {
        let home = self.scratch.join("home").display().to_string();
        let (word, rest) = line.split_once(' ').unwrap();
        let (path, other) = rest.split_once(' ').unwrap_or((rest, ""));
        match word {
            "link" => self.link(path, other),
            "journal" => self.journal(path, other),
            "file" => self.file(path, other.replace("\\n", "\n")),
            "listed" => self.listed(&path.replace('~', &home)),
            "pipe" => self.pipe(path),
            "hard" => self.hard(path, other),
            "output" => self.output = path.to_owned(),
            "remove" if self.path(path).is_dir() => fs::remove_dir_all(self.path(path)).unwrap(),
            "remove" => fs::remove_file(self.path(path)).unwrap(),
            _ => panic!("{line}"),
        }
    }

    /// Adds a line to the list, with the right SHA-256 if the file exists.
    fn listed(&self, entry: &str) {
        let list = read(&self.path("build/.sensedsl-files"));
        let path = self.path("build").join(entry);
        let sum = Command::new("sha256sum").arg(path).output().unwrap().stdout;
        let sum = String::from_utf8_lossy(&sum).into_owned();
        let sum = sum.split_once(' ').map_or(String::new(), |(sum, _)| format!("{sum}  "));
        self.file("build/.sensedsl-files", format!("{list}{sum}{entry}\n"));
    }

    /// Writes the files that an interrupted run leaves in a working folder.
    fn journal(&self, work: &str, path: &str) {
        self.file(&format!("{work}/complete"), "");
        self.file(&format!("{work}/list"), format!("{path}\n"));
        self.file(&format!("{work}/stale"), "x/notes.txt\n");
        self.file(&format!("{work}/once"), "");
        self.file(&format!("{work}/files/{path}"), "evil\n");
        self.file(&format!("{work}/files/.sensedsl-files"), "evil\n");
    }

    fn generate(&self, more: &[&str]) -> RunOutput {
        let call = sensedsl(["generate", "-q", "robot.sense", "-o", &self.output]).args(more);
        let state = self.scratch.join("state").display().to_string();
        call.within(&self.path("")).env("XDG_STATE_HOME", &state).run()
    }

    /// The state of the home, of the project without its output, and of the user's files in the
    /// output.
    fn precious(&self) -> Seen {
        let mut seen = Seen::new();
        let mut ways = vec![self.scratch.join("home"), self.scratch.join("clone")];
        let output = self.path("build");
        while let Some(way) = ways.pop() {
            let found = fs::symlink_metadata(&way).unwrap();
            let below = way.strip_prefix(&output).ok();
            let theirs = |path: &Path| path.iter().any(|part| part == "user" || part == ".git");
            let is_output = below.is_some_and(|below| !theirs(below));
            // A run that writes creates and removes a lock and a seal beside the output, and their
            // folder if it contains nothing else.
            let is_folder_of_lock = found.is_dir() && way.ends_with(".build.sensedsl-work");
            let is_lock = is_folder_of_lock
                || way.file_name().is_some_and(|name| name == "lock" || name == "seal");
            let has_lock = way == self.path("");
            let is_folder = found.is_dir();
            if is_folder {
                ways.extend(fs::read_dir(&way).unwrap().map(|entry| entry.unwrap().path()));
            }
            if is_output && !(found.is_symlink() && below == Some(Path::new(""))) || is_lock {
                continue;
            }
            let bytes = match () {
                () if found.is_symlink() => {
                    fs::read_link(&way).unwrap().into_os_string().into_encoded_bytes()
                }
                () if found.is_file() => fs::read(&way).unwrap(),
                () => Vec::new(),
            };
            // A second name comes and goes with the link in the output.
            let time = if has_lock { (0, 0) } else { (found.mtime(), found.mtime_nsec()) };
            let size = if is_folder { 0 } else { found.size() };
            seen.insert(way, (found.ino(), found.mode(), size, time.0, time.1, bytes));
        }
        seen
    }
}

/// The traps of `tests/strangers.txt`: what each is called, and what sets it up.
fn traps() -> Vec<(String, Vec<String>)> {
    let text = text("tests/strangers.txt");
    let cases = text.split("\n\n").skip(1).map(|case| {
        let mut lines = case.lines();
        let name = lines.next().unwrap().to_owned();
        (name, lines.map(|line| line.trim().to_owned()).collect())
    });
    cases.collect()
}

/// The output generated on another machine.
fn made() -> BTreeMap<String, Vec<u8>> {
    let scratch = TempDir::new("other-machine");
    let text = design("Robot on STM32F4DiscoveryBoard", &["analog"]);
    let file = scratch.write("robot.sense", text);
    let call = sensedsl(["generate", "-q"]).arg(file).arg("-o").arg(scratch.join("build"));
    let _ = call.env("XDG_STATE_HOME", &scratch.join("state").display().to_string()).run().exits(0);
    tree(&scratch.join("build"))
}

/// Runs `generate` in a hostile project, as a user does, and as a user who trusts everything in it.
#[track_caller]
fn harmless(name: &str, made: &BTreeMap<String, Vec<u8>>, prepare: &dyn Fn(&mut Clone)) {
    let all = [&["--adopt"][..], &[], &["--without", "firmware"]];
    // The first variant trusts the most.
    for more in few(&all, 1) {
        let mut clone = Clone::new(made);
        prepare(&mut clone);
        let mut before = clone.precious();
        let ran = clone.generate(more);
        assert!((0..=2).contains(&ran.status), "{name}: {} {}", ran.status, ran.stderr);
        if ran.status != 0 {
            assert!(ran.stderr.contains("error"), "{name}: {}", ran.stderr);
        }
        let _ = clone.generate(&[]);
        let mut after = clone.precious();
        // A missing file of the user's is created, if its folder is a real one.
        let once = clone.path(USER).join("user.c");
        if !before.contains_key(&once) {
            for seen in [&mut before, &mut after] {
                seen.remove(&once);
                seen.remove(&clone.path(USER));
                seen.remove(&clone.path(USER).join(".user.c.sensedsl-part-1-1"));
            }
        }
        let changed: Vec<_> = before
            .iter()
            .filter(|(path, one)| after.get(*path) != Some(*one))
            .map(|(path, _)| path)
            .chain(after.keys().filter(|path| !before.contains_key(*path)))
            .collect();
        assert!(changed.is_empty(), "{name} {more:?}: {changed:#?}\n{}", ran.stderr);
    }
}

#[test]
fn hostile_folders_change_nothing_that_is_not_theirs() {
    let made = made();
    let traps = traps();
    assert!(traps.len() >= 40, "{}", traps.len());
    for (name, lines) in one_in(8, traps) {
        harmless(&name, &made, &|clone| lines.iter().for_each(|line| clone.set_up(line)));
    }
}

#[test]
fn drawn_hostile_folders_change_nothing_that_is_not_theirs() {
    let made = made();
    let paths: Vec<&String> = made.keys().collect();
    for seed in one_in(8, 0..15) {
        harmless(&format!("seed {seed}"), &made, &|clone| {
            let mut random = Random::new(seed);
            for _ in 0..=random.below(4) {
                let path = paths[random.below(paths.len())];
                let way: Vec<&Path> = Path::new(path).ancestors().collect();
                // The path of the file itself, or of a folder above it.
                let way = way[random.below(way.len() - 1)].display().to_string();
                let target = ["~", "~/empty", "~/.bashrc", "~/new", "../../../home"];
                let target = target[random.below(target.len())];
                match random.below(6) {
                    0 | 1 => clone.link(&format!("build/{way}"), target),
                    2 => clone.journal("build/.sensedsl-work", &format!("{way}/.bashrc")),
                    3 => clone.journal(".build.sensedsl-work", &format!("{way}/.bashrc")),
                    4 if clone.path("build/.sensedsl-files").is_file() => clone.listed(&way),
                    _ => clone.link(&format!(".build.sensedsl-unfinished/{way}"), target),
                }
            }
        });
    }
}

#[test]
fn a_clone_of_another_machine_is_taken_over_where_nothing_was_changed() {
    let made = made();
    let clone = Clone::new(&made);
    let _ = clone.generate(&[]).exits(0);
    let _ = clone.generate(&["--check"]).exits(0);
    // The design develops: files that are no longer generated are removed, because they are as
    // listed.
    let clone = Clone::new(&made);
    clone.file("robot.sense", design("Rover on STM32F4DiscoveryBoard", &["analog"]));
    let _ = clone.generate(&[]).exits(0);
    let _ = clone.generate(&["--check"]).exits(0);
    let left = tree(&clone.path("build/firmware/Robot"));
    assert_eq!(left.keys().collect::<Vec<_>>(), ["user/own.c", "user/user.c"]);
    // A file that this machine wrote may be overwritten, whatever its content is now and wherever
    // it was moved.
    fs::rename(clone.path("build"), clone.path("moved")).unwrap();
    let clone = Clone { output: "moved".to_owned(), ..clone };
    clone.file("moved/wiring.md", "changed");
    let _ = clone.generate(&[]).exits(0);
    assert_ne!(read(&clone.path("moved/wiring.md")), "changed");
}

#[test]
fn a_changed_file_of_another_machine_is_replaced_only_where_that_is_said() {
    let clone = Clone::new(&made());
    clone.file(SHEET, "notes of somebody's");
    let ran = clone.generate(&[]).exits(1);
    assert!(ran.stderr.contains("error[E0526]") && ran.stderr.contains("wiring.md"));
    assert_eq!(read(&clone.path(SHEET)), "notes of somebody's");
    let _ = clone.generate(&["--adopt"]).exits(0);
    assert_ne!(read(&clone.path(SHEET)), "notes of somebody's");
    // A list of an earlier version has no SHA-256.
    let clone = Clone::new(&made());
    clone.file("build/.sensedsl-files", "schema.json\n");
    clone.file("build/schema.json", "of an earlier version");
    let ran = clone.generate(&[]).exits(1);
    assert!(ran.stderr.contains("error[E0526]") && ran.stderr.contains("schema.json"));
    let _ = clone.generate(&["--adopt"]).exits(0);
}

#[test]
fn what_is_refused_says_what_to_do() {
    let cases = [
        ("a journal in the folder, through a link", "error[E0525]", ".sensedsl-work"),
        ("an unfinished tree that is a link", "error[E0525]", ".build.sensedsl-unfinished"),
        ("a working folder beside that is a link", "error[E0525]", ".build.sensedsl-work"),
        ("an output folder below a link", "error[E0524]", "`out` is a link that leads to"),
        ("a user folder that is a link to an empty one", "error[E0524]", "user/user.c"),
        ("a generated folder that is a link", "error[E0502]", "firmware"),
    ];
    let (made, traps) = (made(), traps());
    for (name, code, what) in cases {
        let mut clone = Clone::new(&made);
        let (_, lines) = traps.iter().find(|(one, _)| *one == name).unwrap();
        lines.iter().for_each(|line| clone.set_up(line));
        let ran = clone.generate(&[]).exits(1);
        assert!(ran.stderr.contains(code) && ran.stderr.contains(what), "{name}: {}", ran.stderr);
    }
}

#[test]
fn a_machine_without_a_place_for_its_state_still_writes() {
    let made = made();
    let clone = Clone::new(&made);
    clone.file("state", "not a folder");
    let state = clone.path("state").display().to_string();
    for output in ["build", "new"] {
        let call = sensedsl(["generate", "-q", "robot.sense", "-o", output]);
        let call = call.env("XDG_STATE_HOME", &state).env("HOME", "/nonexistent");
        let _ = call.within(&clone.path("")).run().exits(0);
    }
}
