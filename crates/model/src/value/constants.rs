//! The values of constants by name, which expressions look up.

use std::collections::BTreeMap;

use super::Value;

/// All constants by name.
#[derive(Clone, Debug, Default)]
pub(crate) struct Constants {
    pub(super) values: BTreeMap<String, Value>,
}

impl Constants {
    /// The value of a constant.
    pub(crate) fn get(&self, name: &str) -> Option<&Value> {
        self.values.get(name)
    }

    /// The names of the constants.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> + Clone {
        self.values.keys().map(String::as_str)
    }
}
