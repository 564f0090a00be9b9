//! What the code of a controller gets and gives, as it was when the folder was written last, and as it is now: the user's
//! file is never changed, so whoever generates is told what to change in it.

use std::path::Path;

use sensedsl_files::FileSet;

/// What a generated declaration says of a controller: a list of devices with their types for each of both words.
struct Interface {
    gets: Vec<String>,
    gives: Vec<String>,
}

impl Interface {
    /// That of a text; none if it declares no controller.
    fn of(text: &str) -> Option<Self> {
        let list = |word: &str| {
            let lines =
                text.lines().take(12).map(|line| line.trim_start_matches([' ', '*', '/', '!']));
            let list = lines.filter_map(|line| line.strip_prefix(word)).next()?;
            let each = list.split("), ").map(|one| one.trim_end_matches(')').to_owned() + ")");
            Some(each.filter(|one| one != "nothing)").collect())
        };
        Some(Self { gets: list("Gets: ")?, gives: list("Gives: ")? })
    }
}

/// What is in one list and not in the other.
fn beyond<'a>(all: &'a [String], others: &[String]) -> Vec<&'a str> {
    all.iter().filter(|one| !others.contains(one)).map(String::as_str).collect()
}

/// A message for each controller whose file was made before, and which gets or gives something else now. `different`:
/// the files of `root` that are going to be written anew.
pub(super) fn changes(root: &Path, files: &FileSet, different: &[String]) -> Vec<String> {
    let mut messages = Vec::new();
    for path in different {
        let new = files.get(path).and_then(|file| str::from_utf8(&file.bytes).ok());
        let Some(new) = new.and_then(Interface::of) else { continue };
        let old = std::fs::read_to_string(root.join(path)).ok();
        let Some(old) = old.as_deref().and_then(Interface::of) else { continue };
        let Some(own) = own_file(files, path) else { continue };
        let said = [
            ("gets", beyond(&new.gets, &old.gets)),
            ("no longer gets", beyond(&old.gets, &new.gets)),
            ("sets", beyond(&new.gives, &old.gives)),
            ("no longer sets", beyond(&old.gives, &new.gives)),
        ];
        let said = said.iter().filter(|(_, names)| !names.is_empty());
        let said: Vec<String> =
            said.map(|(what, names)| format!("{what} {}", names.join(", "))).collect();
        if !said.is_empty() {
            messages.push(format!("change {own}: its step {}", said.join("; ")));
        }
    }
    messages
}

/// The user's file that goes with a declaration: of the same name, in a folder `user` of the same firmware.
fn own_file<'a>(files: &'a FileSet, declared: &str) -> Option<&'a str> {
    let stem = |path: &str| Path::new(path).file_stem().map(ToOwned::to_owned);
    let firmware = |path: &str| path.split('/').take(2).collect::<Vec<_>>().join("/");
    files.iter().map(|(path, file)| (path, file.once)).find_map(|(path, is_once)| {
        let is_it = is_once
            && path.contains("/user/")
            && stem(path) == stem(declared)
            && firmware(path) == firmware(declared);
        is_it.then_some(path)
    })
}
