//! E0223: a file outside of the project's folder is named.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0223",
    title: "a file outside of the project's folder is named",
    explanation: r#"A design may use files and tables that are in the folder of the file on the command line, or below it.
A design from somebody else cannot read other files of the machine that way, whether by `..`, by an absolute
path or by a symbolic link.

Way out: copy the file into the folder, or allow its folder on the command line:
`--allow-outside ../shared`. The option can be given several times."#,
});

/// `path` is the path as the file names it, `folder` the folder that would have to be allowed.
pub fn outside_folder(span: Span, path: &str, folder: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{path}` is outside of the project's folder"))
        .here("not read")
        .help(format!("copy it into the folder, or allow it with `--allow-outside {folder}`"))
}
