//! The parts of the library, read once.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use sensedsl_model::facts::PartFacts;
use sensedsl_model::part_facts;

use crate::names::folded;

/// All parts, in the order of the library.
pub(crate) fn parts() -> &'static [PartFacts] {
    static PARTS: OnceLock<Vec<PartFacts>> = OnceLock::new();
    PARTS.get_or_init(part_facts)
}

/// The part with that name, or that other people call so.
pub(crate) fn part(name: &str) -> Option<&'static PartFacts> {
    static PLACES: OnceLock<BTreeMap<String, usize>> = OnceLock::new();
    let places = PLACES.get_or_init(|| {
        let aliases = parts().iter().enumerate();
        let aliases =
            aliases.flat_map(|(at, part)| part.aliases.iter().map(move |one| (folded(one), at)));
        let names = parts().iter().enumerate().map(|(at, part)| (folded(&part.name), at));
        // A name wins over an alias of another part.
        aliases.chain(names).collect()
    });
    parts().get(*places.get(&folded(name))?)
}
