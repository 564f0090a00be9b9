//! Names in code that are free: identifiers in, those that neither a language nor a header has out.

/// Words of C and C++ and of Rust, and macros of the headers that generated code includes, which a field may not be
/// called.
const WORDS: &[&str] = &[
    "abstract",
    "alignas",
    "alignof",
    "and",
    "as",
    "asm",
    "async",
    "atomic",
    "auto",
    "await",
    "become",
    "bool",
    "box",
    "break",
    "case",
    "catch",
    "char",
    "class",
    "compl",
    "concept",
    "const",
    "constexpr",
    "continue",
    "crate",
    "decltype",
    "default",
    "delete",
    "do",
    "double",
    "dyn",
    "else",
    "enum",
    "errno",
    "explicit",
    "export",
    "extern",
    "false",
    "final",
    "float",
    "fn",
    "for",
    "friend",
    "gen",
    "goto",
    "if",
    "impl",
    "in",
    "inline",
    "int",
    "let",
    "linux",
    "long",
    "loop",
    "macro",
    "match",
    "mod",
    "move",
    "mut",
    "mutable",
    "namespace",
    "new",
    "noexcept",
    "not",
    "nullptr",
    "operator",
    "or",
    "override",
    "priv",
    "private",
    "protected",
    "pub",
    "public",
    "ref",
    "register",
    "requires",
    "restrict",
    "return",
    "self",
    "short",
    "signed",
    "sizeof",
    "static",
    "struct",
    "super",
    "switch",
    "template",
    "this",
    "throw",
    "trait",
    "true",
    "try",
    "type",
    "typedef",
    "typeid",
    "typename",
    "typeof",
    "union",
    "unix",
    "unsafe",
    "unsigned",
    "unsized",
    "use",
    "using",
    "virtual",
    "void",
    "volatile",
    "where",
    "while",
    "xor",
    "yield",
];

/// Names of headers, and of files that a firmware has already, which a controller's files may not have.
const FILES: &[&str] = &[
    "assert",
    "board",
    "ch",
    "chconf",
    "complex",
    "ctype",
    "fenv",
    "hal",
    "halconf",
    "inttypes",
    "iso646",
    "limits",
    "locale",
    "main",
    "math",
    "mcuconf",
    "memory",
    "native",
    "osal",
    "sense",
    "setjmp",
    "shell",
    "signal",
    "stdalign",
    "stdarg",
    "stdatomic",
    "stdbool",
    "stddef",
    "stdint",
    "stdio",
    "stdlib",
    "stdnoreturn",
    "string",
    "strings",
    "tables",
    "tgmath",
    "threads",
    "time",
    "uchar",
    "usb",
    "usbcfg",
    "user",
    "wchar",
    "wctype",
];

/// An identifier as a field: `float_` for `float`.
pub(crate) fn field(ident: &str) -> String {
    if WORDS.contains(&ident) { format!("{ident}_") } else { ident.to_owned() }
}

/// An identifier as that of a controller, whose files are called so: `math_` for `math`.
#[must_use]
pub fn controller(ident: &str) -> String {
    if FILES.contains(&ident) { format!("{ident}_") } else { field(ident) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lists_are_sorted_and_have_nothing_twice() {
        assert!(WORDS.is_sorted_by(|one, next| one < next));
        assert!(FILES.is_sorted_by(|one, next| one < next));
    }

    #[test]
    fn what_a_language_or_a_header_has_gets_another_name() {
        assert_eq!([field("float"), field("line"), field("match")], ["float_", "line", "match_"]);
        assert_eq!(
            [controller("math"), controller("move"), controller("follow")],
            ["math_", "move_", "follow"]
        );
    }
}
