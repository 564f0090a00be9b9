//! A device tree's source in; its nodes with their properties out. Of a node that several blocks
//! describe, the last value of a property counts, as in the tree that is built.

use std::collections::BTreeMap;

use sensedsl_diagnostics::{FileId, Span};

/// The place of a node in its tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct NodeIndex(usize);

/// The nodes of a tree. A node comes after the one that it is in.
#[derive(Debug, Default)]
pub(super) struct Tree {
    nodes: Vec<Node>,
    /// The nodes by what they are in and their names.
    named: BTreeMap<(Option<NodeIndex>, String), NodeIndex>,
    labels: BTreeMap<String, NodeIndex>,
}

/// A node.
#[derive(Debug, Default)]
pub(super) struct Node {
    within: Option<NodeIndex>,
    /// Its label, or else its name without the address.
    pub(super) name: String,
    /// The name as it is written: `&usart1`, `led_0`, `bme280@77`.
    pub(super) head: String,
    properties: BTreeMap<String, (String, Span)>,
    /// The nodes in it, in order.
    pub(super) children: Vec<NodeIndex>,
}

impl Node {
    pub(super) fn value(&self, property: &str) -> Option<&str> {
        self.properties.get(property).map(|(value, _)| value.as_str())
    }

    /// The value of a property and its place.
    pub(super) fn placed(&self, property: &str) -> Option<(&str, Span)> {
        self.properties.get(property).map(|(value, span)| (value.as_str(), *span))
    }

    fn is_off(&self) -> bool {
        matches!(self.value("status"), Some("\"disabled\"" | "\"reserved\""))
    }
}

/// A line `#include`: the file, whether its name stands in quotes, and the place.
pub(super) type Include = (String, bool, Span);

impl Tree {
    /// Adds a file; returns what it includes.
    pub(super) fn read(&mut self, file: FileId, text: &str) -> Vec<Include> {
        let plain = without_comments(text);
        let mut includes = Vec::new();
        let mut open: Vec<NodeIndex> = Vec::new();
        let (mut start, mut quoted) = (0, false);
        for (at, c) in plain.char_indices() {
            quoted = (quoted != (c == '"')) && c != '\n';
            if quoted || !matches!(c, '{' | '}' | ';' | '\n') {
                continue;
            }
            let said = plain.get(start..at).unwrap_or_default();
            let begin = start + (said.len() - said.trim_start().len());
            let (said, span) = (said.trim(), Span::new(file, begin.min(at)..at));
            match c {
                // A line of the preprocessor ends with the line; all others go on.
                '\n' if !said.starts_with('#') || said.starts_with("#address") => continue,
                '\n' => includes.extend(include(said, span)),
                '{' => open.push(self.open(said, open.last().copied())),
                '}' => drop(open.pop()),
                _ => self.property(said, open.last().copied(), span),
            }
            start = at + 1;
        }
        includes
    }

    /// The node of a block: a name in another node, `/`, or `&usart1`.
    fn open(&mut self, head: &str, within: Option<NodeIndex>) -> NodeIndex {
        let (labels, name) = head.rsplit_once(':').unwrap_or(("", head));
        let label = labels.rsplit(':').next().map(str::trim).filter(|label| !label.is_empty());
        let name = name.split_whitespace().last().unwrap_or_default();
        let referred = name.strip_prefix('&').and_then(|of| self.labels.get(of)).copied();
        let node = referred.unwrap_or_else(|| self.named(name, label, within));
        if let Some(label) = label {
            self.labels.entry(label.to_owned()).or_insert(node);
        }
        node
    }

    fn named(&mut self, name: &str, label: Option<&str>, within: Option<NodeIndex>) -> NodeIndex {
        let key = (within, name.to_owned());
        if let Some(known) = self.named.get(&key) {
            return *known;
        }
        let node = NodeIndex(self.nodes.len());
        let shown = label.unwrap_or(name).split('@').next().unwrap_or_default().to_owned();
        let head = name.to_owned();
        self.nodes.push(Node { within, name: shown, head, ..Node::default() });
        self.named.insert(key, node);
        if let Some(parent) = within.and_then(|within| self.nodes.get_mut(within.0)) {
            parent.children.push(node);
        }
        node
    }

    fn property(&mut self, said: &str, within: Option<NodeIndex>, span: Span) {
        let Some(node) = within.and_then(|within| self.nodes.get_mut(within.0)) else { return };
        let (name, value) = said.split_once('=').unwrap_or((said, ""));
        node.properties.insert(name.trim().to_owned(), (value.trim().to_owned(), span));
    }

    /// A node.
    pub(super) fn node(&self, node: NodeIndex) -> Option<&Node> {
        self.nodes.get(node.0)
    }

    /// The node with a label.
    pub(super) fn labelled(&self, label: &str) -> Option<NodeIndex> {
        self.labels.get(label).copied()
    }

    /// The nodes that are in use, in order: none that are disabled, or in such ones.
    pub(super) fn in_use(&self) -> Vec<&Node> {
        let mut is_on: Vec<bool> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let above = node.within.is_none_or(|within| is_on.get(within.0) == Some(&true));
            is_on.push(above && !node.is_off());
        }
        let nodes = self.nodes.iter().zip(is_on);
        nodes.filter(|(_, is_on)| *is_on).map(|(node, _)| node).collect()
    }
}

fn include(line: &str, span: Span) -> Option<Include> {
    let named = line.strip_prefix("#include")?.trim();
    Some((named.trim_matches(['"', '<', '>']).to_owned(), named.starts_with('"'), span))
}

/// The text with spaces in place of comments, so that places stay.
fn without_comments(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    let mut chars = text.chars().peekable();
    let (mut quoted, mut in_line, mut in_block) = (false, false, false);
    while let Some(c) = chars.next() {
        let next = chars.peek().copied();
        if !quoted && !in_line && !in_block {
            in_line = c == '/' && next == Some('/');
            in_block = c == '/' && next == Some('*');
        }
        if in_block && c == '*' && next == Some('/') {
            chars.next();
            plain.push_str("  ");
            in_block = false;
            continue;
        }
        in_line &= c != '\n';
        quoted = (quoted != (c == '"' && !in_line && !in_block)) && c != '\n';
        let is_shown = !in_line && !in_block || c == '\n';
        if is_shown {
            plain.push(c);
        } else {
            plain.extend(std::iter::repeat_n(' ', c.len_utf8()));
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::log::Log;

    fn tree(text: &str) -> (Tree, Vec<Include>) {
        let file = Log::default().sources.add("b.dts", text);
        let mut tree = Tree::default();
        let includes = tree.read(file, text);
        (tree, includes)
    }

    #[test]
    fn blocks_of_one_node_are_joined() {
        let text = "#include <st/a.dtsi>\n/ {\n leds { /* é{ */ l0: led_0 { a = <1>, // }\n <2>; }; };\n};\n\
                    &uart1 { a = \"x{;\"; status = \"disabled\"; };\n&uart1 { status = \"okay\"; };\n\
                    &off { status = \"disabled\"; in { a = <3>; }; };\n&l0 { b; };\n";
        let (tree, includes) = tree(text);
        assert_eq!(includes.first().map(|one| (one.0.as_str(), one.1)), Some(("st/a.dtsi", false)));
        let heads: Vec<&str> = tree.in_use().iter().map(|node| node.head.as_str()).collect();
        assert_eq!(heads, ["/", "leds", "led_0", "&uart1"]);
        let led = tree.node(tree.labelled("l0").unwrap()).unwrap();
        assert_eq!((led.name.as_str(), led.value("b")), ("l0", Some("")));
        let (value, span) = led.placed("a").unwrap();
        assert!(value.starts_with("<1>,") && value.ends_with("<2>"), "{value}");
        assert!(text[span.range()].starts_with("a = <1>"));
    }

    #[test]
    fn no_text_is_too_odd() {
        for text in
            ["}", "{{{", "/*", "//", "*/", "a = ", "};;", "&x {", "\"", "/*/ a { };", "#\n#"]
        {
            let _ = tree(text).0.in_use();
        }
    }
}
