//! Links of a page: where they lead in the repository, and how the book spells them.

/// The path that a link of `page` leads to, in the repository; none if it leads out of it.
pub(super) fn resolved(page: &str, link: &str) -> Option<String> {
    let mut names: Vec<&str> = page.split('/').collect();
    names.pop();
    for name in link.split('/').filter(|name| !name.is_empty() && *name != ".") {
        if name == ".." {
            names.pop()?;
        } else {
            names.push(name);
        }
    }
    Some(names.join("/"))
}

/// The way from one file to another.
pub(super) fn relative(from: &str, to: &str) -> String {
    let mut from: Vec<&str> = from.split('/').collect();
    from.pop();
    let mut to: Vec<&str> = to.split('/').collect();
    while to.len() > 1 && from.first().is_some_and(|name| to.first() == Some(name)) {
        from.remove(0);
        to.remove(0);
    }
    "../".repeat(from.len()) + &to.join("/")
}

/// A line with each of its links as `spelled` has it; `None` keeps it as it is.
pub(super) fn rewritten(line: &str, mut spelled: impl FnMut(&str) -> Option<String>) -> String {
    let (mut out, mut rest) = (String::new(), line);
    while let Some(at) = rest.find("](") {
        let (before, behind) = rest.split_at(at + 2);
        out.push_str(before);
        rest = behind;
        let Some((link, _)) = behind.split_once(')') else { continue };
        let is_code = out.matches('`').count() % 2 == 1;
        if is_code || link.is_empty() || link.contains(char::is_whitespace) {
            continue;
        }
        let Some(new) = spelled(link) else { continue };
        out.push_str(&new);
        rest = behind.get(link.len()..).unwrap_or("");
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_go_up_and_down() {
        let to = resolved("docs/start/a.md", "../../README.md");
        assert_eq!(to.as_deref(), Some("README.md"));
        assert_eq!(resolved("README.md", "../other"), None);
        assert_eq!(relative("start/a.md", "index.md"), "../index.md");
        assert_eq!(relative("drivers/a.md", "drivers/b.md"), "b.md");
        assert_eq!(relative("a.md", "start/b.md"), "start/b.md");
    }

    #[test]
    fn links_are_found_and_code_is_left() {
        let upper = |link: &str| (link != "keep").then(|| link.to_uppercase());
        let line = "[a](b) and ![c](d) `](e)` [`f`](g) [x](keep).";
        assert_eq!(rewritten(line, upper), "[a](B) and ![c](D) `](e)` [`f`](G) [x](keep).");
    }
}
