//! Texts: the file that is asked for in; its syntax tree and those of the files it uses out.

pub(crate) mod files;
pub(crate) mod fixes;
pub(crate) mod numbered;
pub(crate) mod reader;
pub(crate) mod syntax_errors;
