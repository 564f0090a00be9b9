//! The list of the book's pages: that of `docs/SUMMARY.md`, and below some of them those that the builder adds.

use anyhow::{Context as _, Result};

/// What a page is called, and where it is in the book.
pub(super) type Entry = (String, String);

/// The list with more pages below those that `nested` names; `files` is a page that only the book has, at the end.
pub(super) fn written(list: &str, files: &str, nested: &[(&str, Vec<Entry>)]) -> Result<String> {
    let list = format!("{list}- [Files]({files})\n");
    let mut out = String::new();
    for line in list.lines() {
        out.push_str(line);
        out.push('\n');
        let found = nested.iter().find(|(page, _)| line.ends_with(&format!("]({page})")));
        let Some((_, entries)) = found else { continue };
        let depth = line.len() - line.trim_start().len() + 2;
        for (title, page) in entries {
            let title = title.replace(['[', ']'], "");
            out.push_str(&format!("{}- [{title}]({page})\n", " ".repeat(depth)));
        }
    }
    for (page, _) in nested {
        let is_there = out.contains(&format!("]({page})"));
        is_there.then_some(()).with_context(|| format!("docs/SUMMARY.md does not list {page}"))?;
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_come_below_the_one_that_they_belong_to() {
        let nested =
            [("b.md", vec![("C [x]".to_owned(), "b/c.md".to_owned())]), ("f.md", Vec::new())];
        let found = written("- [A](a.md)\n  - [B](b.md)\n", "f.md", &nested).unwrap();
        assert_eq!(found, "- [A](a.md)\n  - [B](b.md)\n    - [C x](b/c.md)\n- [Files](f.md)\n");
        let error = written("- [A](a.md)\n", "f.md", &nested).unwrap_err();
        assert_eq!(error.to_string(), "docs/SUMMARY.md does not list b.md");
    }
}
