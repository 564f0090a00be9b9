//! Printing of templates, the same for all that generate.

/// Prints a template and the line end that the template engine takes away. Templates are checked
/// when this crate is compiled and they write to memory, so that only a formatter that fails by
/// itself could make this empty.
#[must_use]
pub fn print(template: &impl askama::Template) -> String {
    let mut text = template.render().unwrap_or_default();
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text
}

/// Prints a template that is a part of a file: no line end stands behind it.
#[must_use]
pub fn block(template: &impl askama::Template) -> String {
    let text = print(template);
    text.trim_end_matches('\n').to_owned()
}
