//! The kinds of tokens and nodes in the tree, and the binding to the tree library.
//!
//! Keywords are contextual: the lexer knows only identifiers, and the parser turns an identifier
//! into a keyword where the grammar expects one, so that `driver = srf08;` remains a property.

/// Generates the type, the list of all kinds by their discriminants, and the words of keywords.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident $(= $word:literal)?,)*) => {
        /// The kind of a token or a node.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(u16)]
        #[expect(missing_docs, reason = "each kind is named after the grammar")]
        pub enum SyntaxKind {
            $($(#[$doc])* $kind,)*
        }

        /// Every kind at the index of its discriminant, to convert a raw kind back.
        const ALL: &[SyntaxKind] = &[$(SyntaxKind::$kind),*];

        /// Keywords with their words.
        const WORDS: &[(SyntaxKind, &str)] = &[$($((SyntaxKind::$kind, $word),)?)*];
    };
}

kinds! {
    // Trivia, which the parser skips.
    Bom,
    Whitespace,
    LineComment,
    BlockComment,
    /// Characters that do not belong to any token; reported by the lexer, skipped by the parser.
    Unknown,

    // Tokens.
    Ident,
    Int,
    Float,
    Str,
    LBrace,
    RBrace,
    LBracket,
    RBracket,
    LParen,
    RParen,
    Eq,
    Semicolon,
    Comma,
    Plus,
    Minus,
    Star,
    Slash,
    DotDot,
    Lt,
    LtEq,
    Gt,
    GtEq,
    EqEq,
    NotEq,
    /// Between two names: `Follow.overruns`.
    Dot,
    /// The unit after a number; an identifier to the lexer.
    Unit,

    // Keywords; identifiers to the lexer.
    UseKw = "use",
    ConstKw = "const",
    SpareKw = "spare",
    BoardKw = "board",
    OnKw = "on",
    LinkKw = "link",
    SensorKw = "sensor",
    ReturnsKw = "returns",
    ActuatorKw = "actuator",
    AcceptsKw = "accepts",
    ChipKw = "chip",
    ConnectionKw = "connection",
    ReadingKw = "reading",
    CommandKw = "command",
    DriverKw = "driver",
    ForKw = "for",
    PreferKw = "prefer",
    AvoidKw = "avoid",
    ReserveKw = "reserve",
    ReleaseKw = "release",
    AllowKw = "allow",
    /// Before a number: marks it as a code, not a shown value.
    RawKw = "raw",
    ControllerKw = "controller",
    EveryKw = "every",
    TestKw = "test",
    AtKw = "at",
    SetKw = "set",
    FaultKw = "fault",
    OfKw = "of",
    AlwaysKw = "always",
    NeverKw = "never",
    EventuallyKw = "eventually",
    WhenKw = "when",
    ThenKw = "then",
    WithinKw = "within",
    FromKw = "from",
    ToKw = "to",
    AndKw = "and",
    OrKw = "or",
    NotKw = "not",
    InKw = "in",

    // Nodes.
    SourceFile,
    Use,
    Const,
    Board,
    OnClause,
    Link,
    Device,
    Type,
    Chip,
    Connection,
    Reading,
    Command,
    Driver,
    Kind,
    Property,
    Prefer,
    Avoid,
    Reserve,
    Release,
    Allow,
    Number,
    NameValue,
    StringValue,
    List,
    /// A sign before a name, a bracketed value or another signed value: `-N`, `-(1 + N)`.
    Signed,
    Paren,
    Binary,
    Range,
    Controller,
    Test,
    SetStep,
    FaultStep,
    AlwaysRule,
    NeverRule,
    EventuallyRule,
    WhenRule,
    /// `within TIME`, `from TIME`, `to TIME` after a rule.
    Clause,
    Compare,
    /// `VALUE in FIRST .. LAST`
    Inside,
    Logic,
    Not,
    Index,
    Call,
    Member,
    /// Tokens that fit nowhere; always accompanied by an error.
    Error,
}

impl SyntaxKind {
    /// Whether the parser skips tokens of this kind.
    #[must_use]
    pub fn is_trivia(self) -> bool {
        self <= Self::Unknown
    }

    /// The word of a keyword; `None` for everything else.
    #[must_use]
    pub fn word(self) -> Option<&'static str> {
        WORDS.iter().find(|entry| entry.0 == self).map(|entry| entry.1)
    }

    /// The words of all keywords, each of which is one only where the grammar has it.
    pub fn keywords() -> impl Iterator<Item = &'static str> {
        WORDS.iter().map(|entry| entry.1)
    }

    /// Whether this is a comment.
    #[must_use]
    pub fn is_comment(self) -> bool {
        matches!(self, Self::LineComment | Self::BlockComment)
    }
}

/// The type that binds [`SyntaxKind`] to the tree library; it has no values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SenseDsl {}

impl rowan::Language for SenseDsl {
    type Kind = SyntaxKind;

    fn kind_from_raw(raw: rowan::SyntaxKind) -> SyntaxKind {
        ALL.get(usize::from(raw.0)).copied().unwrap_or(SyntaxKind::Error)
    }

    fn kind_to_raw(kind: SyntaxKind) -> rowan::SyntaxKind {
        rowan::SyntaxKind(kind as u16)
    }
}

/// A node of the tree.
pub type SyntaxNode = rowan::SyntaxNode<SenseDsl>;
/// A token of the tree.
pub type SyntaxToken = rowan::SyntaxToken<SenseDsl>;
/// A node or a token of the tree.
pub type SyntaxElement = rowan::SyntaxElement<SenseDsl>;

#[cfg(test)]
mod tests {
    use super::*;
    use rowan::Language;

    #[test]
    fn every_kind_survives_the_way_through_its_raw_form() {
        for &kind in ALL {
            assert_eq!(SenseDsl::kind_from_raw(SenseDsl::kind_to_raw(kind)), kind);
        }
    }
}
