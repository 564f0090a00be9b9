//! The examples of the tree-sitter grammar, in the form of its own tool: a name, a text, and the tree with the names of
//! fields.

use sensedsl_tests::{files, read};

use super::texts::Text;
use super::tree_sitter::{folder, program, shapes};

#[test]
fn every_example_has_its_tree() {
    let Some(program) = program() else { return };
    let mut count = 0;
    for file in files(&folder().join("test/corpus"), "txt") {
        let page = read(&file);
        // A name stands between two lines of `=`.
        let mut parts = page.split("==================\n").skip(1);
        while let (Some(name), Some(rest)) = (parts.next(), parts.next()) {
            let (text, tree) = rest.split_once("\n---\n").unwrap();
            let name = format!("{}: {}", file.display(), name.trim());
            let found = shapes(program, &[Text { name: name.clone(), text: text.to_owned() }]);
            assert_eq!(words(&found[0]), words(tree), "{name}");
            count += 1;
        }
    }
    assert!(count > 15, "{count} examples");
}

fn words(tree: &str) -> String {
    let spaced = tree.replace('(', " ( ").replace(')', " ) ");
    spaced.split_whitespace().collect::<Vec<_>>().join(" ")
}
