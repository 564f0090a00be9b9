//! What a driver says of its part for the people who wire it.

/// A part as people buy it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Module {
    /// Its full name; empty if the driver gives none.
    pub title: String,
    /// The names on the connector of the usual module, in order.
    pub connector: Vec<String>,
    /// The wires, or `supply` and `ground`, whose contact the driver states: name and contact.
    pub contacts: Vec<(String, String)>,
    /// What anyone who wires it must know.
    pub notes: Vec<String>,
}
