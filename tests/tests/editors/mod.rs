//! What `editors/` has for editors, held to the compiler: the tree-sitter grammar gives the compiler's tree, the TextMate
//! grammar the compiler's tokens, and words and units are the same in all of them. Neovim and Emacs open files.

mod captures;
mod classes;
mod corpus;
mod extension;
mod generated;
mod plugins;
mod textmate;
mod texts;
mod tree_sitter;
mod trees;
mod words;
