//! HTML that mdBook has written: its tags, and what the site has otherwise.

use std::fs;
use std::path::Path;

use anyhow::{Result, ensure};

/// A name and a value.
type Attribute = (String, String);

/// Calls `then` with the name and the attributes of each tag that opens something. What is in scripts and comments is
/// no tag.
pub(super) fn tags(html: &str, mut then: impl FnMut(&str, &[Attribute])) {
    let mut rest = html;
    while let Some((_, behind)) = rest.split_once('<') {
        if let Some(comment) = behind.strip_prefix("!--") {
            rest = comment.split_once("-->").map_or("", |(_, rest)| rest);
            continue;
        }
        let name: String = behind.chars().take_while(char::is_ascii_alphanumeric).collect();
        rest = behind.get(name.len()..).unwrap_or("");
        if name.is_empty() {
            continue;
        }
        let (found, behind) = attributes(rest);
        rest = behind;
        let name = name.to_ascii_lowercase();
        then(&name, &found);
        if name == "script" || name == "style" {
            rest = rest.split_once(&format!("</{name}")).map_or("", |(_, rest)| rest);
        }
    }
}

/// The attributes of a tag, and what is behind it.
fn attributes(tag: &str) -> (Vec<Attribute>, &str) {
    let (mut all, mut rest) = (Vec::new(), tag);
    loop {
        rest = rest.trim_start_matches(|letter: char| letter.is_whitespace() || letter == '/');
        let end = rest.find(|letter: char| letter.is_whitespace() || "=>".contains(letter));
        let (name, behind) = rest.split_at(end.unwrap_or(rest.len()));
        let Some(value) = behind.trim_start().strip_prefix('=') else {
            if name.is_empty() {
                return (all, rest.strip_prefix('>').unwrap_or(""));
            }
            all.push((name.to_ascii_lowercase(), String::new()));
            rest = behind;
            continue;
        };
        let value = value.trim_start();
        let quote = value.chars().next().filter(|letter| "\"'".contains(*letter));
        let bare = quote.map_or(value, |_| value.get(1..).unwrap_or(""));
        let is_end = |letter: char| match quote {
            Some(quote) => letter == quote,
            None => letter.is_whitespace() || letter == '>',
        };
        let (value, behind) = bare.split_at(bare.find(is_end).unwrap_or(bare.len()));
        all.push((name.to_ascii_lowercase(), value.replace("&amp;", "&")));
        rest = if quote.is_some() { behind.get(1..).unwrap_or("") } else { behind };
    }
}

/// What mdBook's template has in every page and no setting of it can change, and what the site has instead. `ROOT` is the
/// way to the site's root.
const MENDED: [(&str, &str); 9] = [
    // The site has colours for two themes.
    (
        "<li role=\"none\"><button role=\"menuitem\" class=\"theme\" id=\"mdbook-theme-rust\">Rust</button></li>",
        "",
    ),
    (
        "<li role=\"none\"><button role=\"menuitem\" class=\"theme\" id=\"mdbook-theme-coal\">Coal</button></li>",
        "",
    ),
    (
        "<li role=\"none\"><button role=\"menuitem\" class=\"theme\" id=\"mdbook-theme-ayu\">Ayu</button></li>",
        "",
    ),
    ("id=\"mdbook-theme-navy\">Navy<", "id=\"mdbook-theme-navy\">Dark<"),
    // A label cannot be reached by keyboard, and cannot be open or closed. The site's script has the button switch.
    (
        "<label id=\"mdbook-sidebar-toggle\" class=\"icon-button\" for=\"mdbook-sidebar-toggle-anchor\"",
        "<button type=\"button\" id=\"mdbook-sidebar-toggle\" class=\"icon-button\"",
    ),
    ("</label>", "</button>"),
    ("<div id=\"mdbook-menu-bar\"", "<div role=\"banner\" id=\"mdbook-menu-bar\""),
    // The page's own heading is the first one.
    (
        "<h1 class=\"menu-title\">SenseDSL</h1>",
        "<div class=\"menu-title\"><a href=\"ROOTindex.html\">SenseDSL</a></div>",
    ),
    (
        "<div class=\"right-buttons\">",
        "<div class=\"right-buttons\"><a class=\"studio-link\" href=\"ROOTstudio/index.html\">Studio</a>",
    ),
];

/// Changes what mdBook's template has in every page.
pub(super) fn mend(site: &Path) -> Result<()> {
    for (path, bytes) in super::tree(site)? {
        let is_page = path.ends_with(".html") && !path.starts_with("studio/") && path != "toc.html";
        if is_page {
            let page = mended(&path, &String::from_utf8_lossy(&bytes))?;
            fs::write(site.join(&path), page)?;
        }
    }
    Ok(())
}

fn mended(path: &str, page: &str) -> Result<String> {
    let root = "../".repeat(path.matches('/').count());
    let mut page = page.to_owned();
    for (old, new) in MENDED {
        ensure!(page.contains(old), "mdBook's template has changed: {path} has no {old}");
        page = page.replacen(old, &new.replace("ROOT", &root), 1);
    }
    // A cell above a column without a name is no heading.
    Ok(page.replace("<th></th>", "<td></td>"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_have_their_attributes() {
        let html = "<!-- <a href=no> --><a  HREF=\"x?a=1&amp;b\" hidden data-x='a>b'>t</a><br/><img src=p.svg>\
                    <script>\"<a href=no>\"</script><p id=q>";
        let mut all = Vec::new();
        tags(html, |name, attributes| {
            let found = attributes.iter().map(|(name, value)| format!(" {name}={value}"));
            all.push(name.to_owned() + &found.collect::<String>());
        });
        let wanted =
            ["a href=x?a=1&b hidden= data-x=a>b", "br", "img src=p.svg", "script", "p id=q"];
        assert_eq!(all, wanted);
    }
}
