//! What people and programs read of the library's parts: facts in, tables, pages and JSON out.

mod human;
mod json;
mod page;
mod words;

use sensedsl_model::facts::PartFacts;
use sensedsl_model::kind::KindName;

pub use human::{listing, one};
pub use json::{value, values};
pub use page::{index, page};

/// Whether the part is of the kind, if one is asked for, and all words of `search` are somewhere in what is
/// known of it.
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
    let names = [part.name.as_str(), part.field, &part.part, &part.about];
    let lists = part.aliases.iter().chain(&part.notes).map(String::as_str);
    let all = names.into_iter().chain(lists).chain(kinds).chain(values);
    let text = all.collect::<Vec<_>>().join("\n").to_lowercase();
    search.to_lowercase().split_whitespace().all(|word| text.contains(word))
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
