//! The judge of the built site: every link and picture leads to a file that is there, and to an anchor that it has; no
//! page asks another host for anything.
//!
//! In: the files of the site. Out: how many pages and links there are, and the addresses elsewhere, which people may
//! follow; nobody asks them here.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Result, bail};

use super::{Tree, links};

/// What was found.
#[derive(Debug, Default)]
pub(super) struct Told {
    pub(super) pages: usize,
    pub(super) links: usize,
    pub(super) external: Vec<String>,
}

/// What a page says of itself and of others.
#[derive(Default)]
struct Page {
    anchors: BTreeSet<String>,
    /// Where links lead, which people follow.
    links: Vec<String>,
    /// What the browser fetches by itself.
    fetched: Vec<String>,
}

pub(super) fn judge(tree: &Tree) -> Result<Told> {
    let html = tree.iter().filter(|(path, _)| path.ends_with(".html"));
    let pages: BTreeMap<&str, Page> =
        html.map(|(path, bytes)| (path.as_str(), page(&String::from_utf8_lossy(bytes)))).collect();
    let (mut told, mut wrong) = (Told { pages: pages.len(), ..Told::default() }, Vec::new());
    let mut external = BTreeSet::new();
    for (path, page) in &pages {
        for link in &page.fetched {
            if is_elsewhere(link) {
                wrong.push(format!("{path} fetches {link}"));
            }
        }
        for link in page.links.iter().chain(&page.fetched) {
            if is_elsewhere(link) {
                external.insert(link.clone());
            } else if !["data:", "mailto:", "javascript:"]
                .iter()
                .any(|other| link.starts_with(other))
            {
                told.links += 1;
                wrong.extend(complaint(tree, &pages, path, link));
            }
        }
    }
    for (path, bytes) in tree.iter().filter(|(path, _)| path.ends_with(".css")) {
        for link in fetched_by_sheet(&String::from_utf8_lossy(bytes)) {
            if link.starts_with("data:") {
                continue;
            }
            if is_elsewhere(&link) {
                wrong.push(format!("{path} fetches {link}"));
            } else {
                wrong.extend(complaint(tree, &pages, path, &link));
            }
        }
    }
    if !wrong.is_empty() {
        bail!("the site has bad links:\n{}", wrong.join("\n"));
    }
    told.external = external.into_iter().collect();
    Ok(told)
}

/// What is wrong with a link of a page; nothing if it leads somewhere.
fn complaint(tree: &Tree, pages: &BTreeMap<&str, Page>, path: &str, link: &str) -> Option<String> {
    let (way, anchor) = link.split_once('#').unwrap_or((link, ""));
    let way = decoded(way.split('?').next().unwrap_or(way));
    let to = if way.is_empty() { Some(path.to_owned()) } else { links::resolved(path, &way) };
    let Some(mut to) = to else { return Some(format!("{path}: {link} leaves the site")) };
    if way.ends_with('/') || to.is_empty() {
        to = format!("{to}/index.html").trim_start_matches('/').to_owned();
    }
    if !tree.contains_key(&to) {
        return Some(format!("{path}: {link}: there is no {to}"));
    }
    let page = pages.get(to.as_str()).filter(|_| !anchor.is_empty())?;
    let has = page.anchors.contains(&decoded(anchor));
    // The studio takes a project behind `#p=`.
    (!has && !anchor.starts_with("p=")).then(|| format!("{path}: {link}: {to} has no such heading"))
}

/// Whether an address is of another host.
fn is_elsewhere(link: &str) -> bool {
    link.starts_with("//") || link.contains("://")
}

/// An address without `%20` and the like.
fn decoded(text: &str) -> String {
    let mut parts = text.split('%');
    let mut bytes = parts.next().unwrap_or("").as_bytes().to_vec();
    for part in parts {
        if let Some(byte) = part.get(..2).and_then(|code| u8::from_str_radix(code, 16).ok()) {
            bytes.push(byte);
            bytes.extend(part.bytes().skip(2));
        } else {
            bytes.push(b'%');
            bytes.extend(part.bytes());
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn page(html: &str) -> Page {
    let mut page = Page::default();
    super::html::tags(html, |name, attributes| {
        let of = |wanted: &str| {
            let found = attributes.iter().find(|(name, _)| name == wanted);
            found.map(|(_, value)| value.clone())
        };
        page.anchors.extend(of("id"));
        match name {
            "a" | "area" => {
                page.anchors.extend(of("name"));
                page.links.extend(of("href"));
            }
            "link" => page.fetched.extend(of("href")),
            _ => page.fetched.extend(of("src")),
        }
    });
    page
}

/// What a style sheet fetches.
fn fetched_by_sheet(css: &str) -> Vec<String> {
    let mut all = Vec::new();
    for (at, _) in css.match_indices("url(") {
        let link = css.get(at + 4..).and_then(|rest| rest.split(')').next());
        all.extend(link.map(|link| link.trim_matches(['"', '\'', ' ']).to_owned()));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(pages: &[(&str, &str)]) -> Result<Told> {
        let all = pages.iter().map(|(path, text)| ((*path).to_owned(), text.as_bytes().to_vec()));
        judge(&all.collect())
    }

    #[test]
    fn links_that_lead_somewhere_are_counted() {
        let good = "<h1 id=\"top\"><a href=\"a/b%20c.html?v=1#x\">b</a><a href=\"https://example.org\">e</a></h1>";
        let other = "<p id='x'><a href=../i.html#top></a><a href=\"#x\"></a><img src=\"p.svg\">";
        let found = told(&[("i.html", good), ("a/b c.html", other), ("a/p.svg", "")]).unwrap();
        assert_eq!((found.pages, found.links), (2, 4));
        assert_eq!(found.external, ["https://example.org"]);
    }

    #[test]
    fn what_is_missing_or_foreign_is_told() {
        let wrong = |page: &str, what: &str| {
            let error = told(&[("i.html", page), ("s.css", "a { background: url(\"s.css\") }")])
                .unwrap_err();
            assert!(error.to_string().contains(what), "{error}");
        };
        wrong("<a href=\"none.html\">", "there is no none.html");
        wrong("<a href=\"i.html#none\">", "i.html has no such heading");
        wrong("<a href=\"../x.html\">", "leaves the site");
        wrong("<script src=\"https://cdn.example/x.js\"></script>", "fetches https://cdn.example");
        wrong("<link rel=stylesheet href=//cdn.example/x.css>", "fetches //cdn.example");
        let sheet = told(&[("s.css", "a{background:url(none.png)}")]).unwrap_err();
        assert!(sheet.to_string().contains("there is no none.png"), "{sheet}");
    }
}
