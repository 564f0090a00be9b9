//! Texts: the file that is asked for in, its syntax trees and those of the files it uses out, and changed texts.

pub(crate) mod files;
pub(crate) mod numbered;
pub(crate) mod reader;
pub(crate) mod syntax_errors;
