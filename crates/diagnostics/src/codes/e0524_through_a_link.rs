//! E0524: the output would be written through a link.

use super::{Code, CodeInfo, Diagnostic, Span};

/// The code.
pub const CODE: Code = Code(&CodeInfo {
    code: "E0524",
    title: "the output would be written through a link",
    explanation: r#"A project that was cloned or unpacked can hold symbolic links to anywhere. `generate` writes and
removes nothing through a link in the output folder, and does not write to an output folder that is
reached through a link which leads out of the folder that it stands in. Files that you keep behind a
link called `user` are read by the build as before; `generate` only refuses to make one there.

Way out: look where the link leads. Where it is yours, name the folder itself, or make the missing
file yourself; where it is not, remove the link."#,
});

/// The output folder is reached through a link.
pub fn folder_is_elsewhere(span: Span, link: &str, target: &str) -> Diagnostic {
    Diagnostic::new(CODE, span, format!("`{link}` is a link that leads to `{target}`"))
        .help("if the link is yours, name the folder that it leads to: `-o` with that path")
}

/// Files to write would be behind a link in the folder.
pub fn files_are_elsewhere(span: Span, folder: &str, files: &str) -> Diagnostic {
    let message = format!("`{folder}` holds links where these files have to be written: {files}");
    Diagnostic::new(CODE, span, message)
        .help("remove the links, or make the missing files in `user/` yourself")
}
