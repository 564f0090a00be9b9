//! Printing of templates, for everything that generates files.

/// Declares templates that print a value under a name. The crate has them in its folder, and depends on `askama`.
#[macro_export]
macro_rules! templates {
    ($value:ident: $type:ty; $($name:ident = $path:literal;)+) => {
        $(
            #[derive(askama::Template)]
            #[template(path = $path, escape = "none")]
            struct $name<'a> {
                $value: &'a $type,
            }
        )+
    };
}

/// Prints a template, and the final newline that the template engine removes. Templates are checked when this crate is
/// compiled, and they write to memory, so this can be empty only if a formatter fails by itself.
#[must_use]
pub fn print(template: &impl askama::Template) -> String {
    let mut text = template.render().unwrap_or_default();
    if !text.ends_with('\n') {
        text.push('\n');
    }
    text
}

/// Prints a template that is part of a file, without a final newline.
#[must_use]
pub fn block(template: &impl askama::Template) -> String {
    let text = print(template);
    text.trim_end_matches('\n').to_owned()
}
