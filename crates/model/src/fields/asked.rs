//! What readers ask for, in tests: the names of properties, and what each takes in the words of [`Takes`].
//!
//! The description of the language is held to this.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use crate::meaning::Takes;

/// The properties that were asked for, and what each takes where the reader says it.
pub(crate) type Asked = BTreeMap<String, BTreeSet<String>>;

thread_local! {
    static ASKED: RefCell<Asked> = RefCell::default();
}

pub(super) fn name(name: &str) {
    ASKED.with_borrow_mut(|asked| {
        asked.entry(name.to_owned()).or_default();
    });
}

pub(super) fn takes(name: &str, takes: &Takes) {
    say(name, takes.to_string());
}

pub(super) fn words<T>(name: &str, words: &[(&str, T)]) {
    let words: Vec<String> = words.iter().map(|(word, _)| format!("`{word}`")).collect();
    let is_truth = words == ["`true`", "`false`"];
    say(name, if is_truth { Takes::Truth.to_string() } else { one_of(&words) });
}

/// As [`Takes::Words`] is shown.
fn one_of(words: &[String]) -> String {
    match words {
        [only] => only.clone(),
        words => format!("one of {}", words.join(", ")),
    }
}

fn say(name: &str, takes: String) {
    ASKED.with_borrow_mut(|asked| {
        asked.entry(name.to_owned()).or_default().insert(takes);
    });
}

/// What is asked for while something is done, in this thread.
pub(crate) fn during(work: impl FnOnce()) -> Asked {
    let before = ASKED.take();
    work();
    ASKED.replace(before)
}
