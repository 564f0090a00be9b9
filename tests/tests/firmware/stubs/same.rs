//! Decides which files a compiler need not read twice.
//!
//! Most of a firmware is the runtime, and most of that does not depend on the design: a file is
//! compiled once for each family and each set of the settings that it names. Numbers from three on
//! count as the same, because they are sizes.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, PoisonError};

use super::super::facts::Folder;
use super::compiler::Firmware;

/// The facts about a text.
struct Known {
    /// The same number for texts that differ only in comments.
    number: usize,
    words: BTreeSet<String>,
    includes: Vec<String>,
}

/// All texts so far, and their numbers by the text without comments.
#[derive(Default)]
struct Texts {
    known: BTreeMap<String, Arc<Known>>,
    numbers: BTreeMap<String, usize>,
}

fn known(text: &str) -> Arc<Known> {
    static TEXTS: Mutex<Option<Texts>> = Mutex::new(None);
    let mut texts = TEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    let texts = texts.get_or_insert_default();
    if let Some(known) = texts.known.get(text) {
        return known.clone();
    }
    let code = without_comments(text);
    let is_no_word = |c: char| !(c.is_alphanumeric() || c == '_');
    let words = code.split(is_no_word).map(str::to_owned).collect();
    let includes = code.lines().filter_map(|line| line.trim().strip_prefix("#include \""));
    let includes = includes.map(|name| name.trim_end_matches('"').to_owned()).collect();
    let next = texts.numbers.len();
    let number = *texts.numbers.entry(code).or_insert(next);
    let known = Arc::new(Known { number, words, includes });
    let _ = texts.known.insert(text.to_owned(), known.clone());
    known
}

/// Everything that decides the compiler's output for a file: the MCU, the mode, the texts of ours
/// that it includes, and the settings that these name. The parts of the generated header that the
/// runtime and the user's file use also count as settings.
pub(super) fn key(one: &Firmware, mode: &str, path: &str) -> String {
    let is_generated = path.starts_with("generated/");
    let mut texts = BTreeMap::new();
    include(&one.files, path, is_generated, &mut texts);
    let names = |word: &str| texts.values().any(|text| text.words.contains(word));
    let mut key =
        format!("{path} {:?}", texts.values().map(|text| text.number).collect::<Vec<_>>());
    // Tables of values do not depend on the MCU.
    if !texts.values().any(|text| text.includes.iter().any(|name| name == "hal.h")) {
        return key;
    }
    key.push_str(&format!("{:?}\n", one.macros));
    if names("UP_SHELL") {
        key.push_str(mode);
    }
    let settings = ["cfg/up_conf.h", "cfg/halconf.h", "cfg/mcuconf.h", "cfg/chconf.h"];
    let model = (!is_generated).then_some("generated/sense_model.h");
    for line in settings.into_iter().chain(model).flat_map(|path| one.files[path].lines()) {
        let Some(setting) = line.strip_prefix("#define ") else { continue };
        let (name, value) = setting.split_once(' ').unwrap_or((setting, ""));
        // A generated file names units, and the stubs name the options that enable them.
        if is_generated || names(name) {
            let number = value.trim_end_matches('U').parse().unwrap_or(0);
            key.push_str(&format!("{name}={}\n", if number < 3 { value } else { "many" }));
        }
    }
    key
}

fn without_comments(text: &str) -> String {
    let mut parts = text.split("/*");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.filter_map(|part| part.split_once("*/")).fold(first, |text, (_, rest)| text + rest)
}

/// Collects a file and our own files that it includes, except for settings; the generated header
/// only on demand.
fn include(
    files: &Folder,
    path: &str,
    with_generated: bool,
    texts: &mut BTreeMap<String, Arc<Known>>,
) {
    let is_left_out = path.starts_with("generated/") && !with_generated;
    if path.starts_with("cfg/") || is_left_out || texts.contains_key(path) {
        return;
    }
    let text = known(&files[path]);
    let _ = texts.insert(path.to_owned(), text.clone());
    for name in &text.includes {
        let places = ["generated", "uproxy/core", "uproxy/chibios"];
        let paths = places.iter().map(|folder| format!("{folder}/{name}"));
        if let Some(path) = paths.into_iter().find(|path| files.contains_key(path)) {
            include(files, &path, with_generated, texts);
        }
    }
}
