//! What all views are made with: a node of the tree in, its children and tokens, or a view over it, out.

use crate::kind::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};
use rowan::TextRange;

/// A view over one or several kinds of nodes.
pub trait AstNode: Sized {
    /// The view over `node`, if the node is of this kind.
    fn cast(node: SyntaxNode) -> Option<Self>;
    /// The node.
    fn syntax(&self) -> &SyntaxNode;
    /// The range of the node, without the trivia around it.
    fn range(&self) -> TextRange {
        self.syntax().text_range()
    }
}

/// Declares views, each over one kind of node, and the methods that list all children of a kind.
macro_rules! nodes {
    ($($(#[$doc:meta])* $name:ident = $kind:ident
        $({ $($(#[$all_doc:meta])* $all:ident: $child:ty,)+ })?;)+) => { $(
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        pub struct $name(SyntaxNode);

        impl AstNode for $name {
            fn cast(node: SyntaxNode) -> Option<Self> {
                (node.kind() == SyntaxKind::$kind).then_some(Self(node))
            }
            fn syntax(&self) -> &SyntaxNode {
                &self.0
            }
        }

        $(impl $name {
            $($(#[$all_doc])*
            pub fn $all(&self) -> impl Iterator<Item = $child> + use<> {
                children(&self.0)
            })+
        })?
    )+ };
}

pub(super) use nodes;

/// Declares a view that is one of several views.
macro_rules! choice {
    ($(#[$doc:meta])* $name:ident { $($(#[$variant_doc:meta])* $variant:ident($view:ty)),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Eq, Hash)]
        pub enum $name {
            $($(#[$variant_doc])* $variant($view),)+
        }

        impl AstNode for $name {
            fn cast(node: SyntaxNode) -> Option<Self> {
                $(if let Some(view) = <$view>::cast(node.clone()) {
                    return Some(Self::$variant(view));
                })+
                None
            }
            fn syntax(&self) -> &SyntaxNode {
                match self {
                    $(Self::$variant(view) => view.syntax(),)+
                }
            }
        }
    };
}

pub(super) use choice;

pub(super) fn children<N: AstNode>(node: &SyntaxNode) -> impl Iterator<Item = N> + use<N> {
    node.children().filter_map(N::cast)
}

pub(super) fn tokens(
    node: &SyntaxNode,
    kind: SyntaxKind,
) -> impl Iterator<Item = SyntaxToken> + use<> {
    node.children_with_tokens()
        .filter_map(SyntaxElement::into_token)
        .filter(move |token| token.kind() == kind)
}

pub(super) fn token(node: &SyntaxNode, kind: SyntaxKind) -> Option<SyntaxToken> {
    tokens(node, kind).next()
}
