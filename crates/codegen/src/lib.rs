//! From a wired design to files: plans decide, templates print.

pub mod fileset;
