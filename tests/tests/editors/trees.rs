//! The tree-sitter grammar gives the compiler's tree: the same nodes, names of nodes, words and comments at the same
//! places, for every text that the compiler takes.

use sensedsl_syntax::{SyntaxElement, SyntaxKind, SyntaxToken};

use super::texts::accepted;
use super::tree_sitter::{Node, Piece, program, trees};

#[test]
fn the_tree_is_the_compilers() {
    let Some(program) = program() else { return };
    let texts = accepted();
    for (text, tree) in texts.iter().zip(trees(program, None, &texts)) {
        let broken =
            tree.nodes.iter().find(|node| node.state == "error" || node.state == "missing");
        assert!(broken.is_none(), "{}: {broken:?}\n{}", text.name, text.text);
        let (wanted, wanted_comments) = of_compiler(&text.text);
        let (found, comments) = of_grammar(&tree.nodes);
        let pairs = wanted.iter().zip(&found);
        let differ = pairs.into_iter().find(|(wanted, found)| wanted != found);
        assert!(differ.is_none(), "{}: {differ:?}\n{}", text.name, text.text);
        assert_eq!(wanted.len(), found.len(), "{}", text.name);
        assert_eq!(wanted_comments, comments, "{}", text.name);
    }
}

/// Nodes and tokens, then comments, which a tree may have inside of a node or between two.
type Shape = (Vec<Piece>, Vec<Piece>);

fn of_compiler(text: &str) -> Shape {
    let tree = sensedsl_syntax::parse(text).syntax();
    let (mut nodes, mut comments) = (Vec::new(), Vec::new());
    for element in tree.descendants_with_tokens().skip(1) {
        let kind = element.kind();
        let (mut from, to) =
            (element.text_range().start().into(), element.text_range().end().into());
        let piece_name = match &element {
            SyntaxElement::Node(_) => snake_case(kind),
            SyntaxElement::Token(token) if is_sign_of_code(token) => continue,
            SyntaxElement::Token(token) => name_of_token(token),
        };
        if let Some(sign) = element.as_token().and_then(sign_of_code) {
            from = sign.text_range().start().into();
        }
        if kind.is_comment() {
            comments.push((from, to, piece_name));
        } else if !kind.is_trivia() {
            nodes.push((from, to, piece_name));
        }
    }
    (nodes, comments)
}

/// In `raw -20` the sign belongs to the number here, and is a token of its own there.
fn is_sign_of_code(token: &SyntaxToken) -> bool {
    matches!(token.kind(), SyntaxKind::Plus | SyntaxKind::Minus)
        && token.next_token().is_some_and(|next| sign_of_code(&next).as_ref() == Some(token))
}

fn sign_of_code(token: &SyntaxToken) -> Option<SyntaxToken> {
    let is_number = matches!(token.kind(), SyntaxKind::Int | SyntaxKind::Float);
    let number = token.parent().filter(|_| is_number)?;
    let first = number.first_token()?;
    let sign = token.prev_token()?;
    let is_sign = matches!(sign.kind(), SyntaxKind::Plus | SyntaxKind::Minus);
    (first.kind() == SyntaxKind::RawKw && is_sign && sign.parent()? == number).then_some(sign)
}

fn name_of_token(token: &SyntaxToken) -> String {
    match token.kind() {
        SyntaxKind::Ident => "identifier".to_owned(),
        SyntaxKind::Int => "integer".to_owned(),
        SyntaxKind::Str => "string".to_owned(),
        kind @ (SyntaxKind::Float
        | SyntaxKind::Unit
        | SyntaxKind::LineComment
        | SyntaxKind::BlockComment) => snake_case(kind),
        // A keyword is named by its word, which is what is in the text; so are marks.
        kind => kind.word().unwrap_or(token.text()).to_owned(),
    }
}

/// `OnClause` as `on_clause`.
fn snake_case(kind: SyntaxKind) -> String {
    let mut name = String::new();
    for letter in format!("{kind:?}").chars() {
        if letter.is_uppercase() && !name.is_empty() {
            name.push('_');
        }
        name.extend(letter.to_lowercase());
    }
    name
}

fn of_grammar(all: &[Node]) -> Shape {
    let (mut nodes, mut comments) = (Vec::new(), Vec::new());
    // Parts of a string and of a unit are tokens of the grammar alone.
    let mut within = usize::MAX;
    for node in all.iter().skip(1) {
        if node.depth > within {
            continue;
        }
        within = usize::MAX;
        match (node.state.as_str(), node.piece.2.as_str()) {
            ("named", "line_comment" | "block_comment") => comments.push(node.piece.clone()),
            ("named", "block") => {}
            (_, name) => {
                if node.state == "named" && matches!(name, "string" | "unit") {
                    within = node.depth;
                }
                nodes.push(node.piece.clone());
            }
        }
    }
    (nodes, comments)
}
