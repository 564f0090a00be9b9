//! Sessions of an editor, in the same process: a file for each feature.
#![cfg(test)]

mod corpus;
mod session;

mod actions;
mod completion;
mod completion_corpus;
mod control;
mod fixes;
mod formatting;
mod hints;
mod lifecycle;
mod references;
mod signature;
