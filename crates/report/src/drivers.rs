//! The library's parts for people and programs: facts in, tables, pages and JSON out.

mod human;
mod json;
mod page;
mod words;

use sensedsl_model::facts::PartFacts;
use sensedsl_model::kind::KindName;

pub use human::{listing, one};
pub use json::{value, values};
pub use page::{index, page};

/// Whether the part is of the kind, if one is asked for, and all words of `search` occur in what is
/// known about it: anywhere in a name, at the beginning of a word in a sentence.
#[must_use]
pub fn is_wanted(part: &PartFacts, kind: Option<KindName>, search: &str) -> bool {
    if kind.is_some_and(|kind| !part.kinds.contains(&kind)) {
        return false;
    }
    let kinds = part.kinds.iter().map(|kind| kind.name());
    let values = part
        .values
        .iter()
        .flat_map(|one| one.name.as_deref().into_iter().chain(one.shown.quantity.as_deref()));
    let names = [part.name.as_str(), part.field, &part.part].into_iter();
    let names = names.chain(part.aliases.iter().map(String::as_str)).chain(kinds).chain(values);
    let names: Vec<String> = names.map(str::to_lowercase).collect();
    let sentences = part.module.notes.iter().chain([&part.about]).map(|text| text.to_lowercase());
    let sentences: Vec<String> = sentences.collect();
    let is_in = |word: &str| {
        let begins = |text: &String| {
            text.split(|c: char| !c.is_alphanumeric()).any(|one| one.starts_with(word))
        };
        let is_name = names.iter().any(|name| name.contains(word));
        // `can` is a bus, and also a word in many sentences.
        let is_kind = KindName::from_name(word).is_some();
        is_name
            || part.words.iter().any(|one| one.starts_with(word))
            || (!is_kind && sentences.iter().any(begins))
    };
    // A plural is found like its singular: `motor drivers`.
    let is_found = |word: &str| {
        let one = word.strip_suffix('s').filter(|one| one.len() > 3);
        is_in(word) || one.is_some_and(is_in)
    };
    search.to_lowercase().split_whitespace().all(is_found)
}

/// The parts by field, in the order of the library.
fn by_field(parts: &[PartFacts]) -> Vec<(String, Vec<&PartFacts>)> {
    let mut fields: Vec<(String, Vec<&PartFacts>)> = Vec::new();
    for part in parts {
        let title = words::field(part.field);
        match fields.last_mut() {
            Some((last, list)) if *last == title => list.push(part),
            _ => fields.push((title, vec![part])),
        }
    }
    fields
}
