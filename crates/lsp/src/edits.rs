//! Changes of a text in the language, for features: see [`sensedsl_syntax::edit`].

pub(crate) use sensedsl_syntax::edit::{Edit, added, applied, begun, removed, token_at};
