//! The source of the book: the pages that `docs/SUMMARY.md` lists, a page for each board, and what they link to.
//!
//! Pages keep their links as a forge reads them. A link to another page leads to that page of the book, one to a text of
//! the repository to a page that shows it, one to a folder to a page that lists it, and pictures come along.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result, ensure};

use super::listing::{self, Piece};
use super::summary::{self, Entry};
use super::{Tree, boards, links};

const SUMMARY: &str = "docs/SUMMARY.md";
/// The page of all files that other pages show.
const FILES: &str = "repository/index.md";
/// Endings of pictures, which come along as they are.
const PICTURES: [&str; 3] = ["svg", "png", "ico"];
/// Larger files are not shown.
const SHOWN_MAX: usize = 200_000;

/// The files of the book's `src`.
pub(super) fn book(root: &Path) -> Result<Tree> {
    let mut book = Book {
        root,
        tree: Tree::new(),
        todo: Vec::new(),
        seen: BTreeSet::new(),
        files: Vec::new(),
    };
    let list = fs::read_to_string(root.join(SUMMARY)).context(SUMMARY)?;
    let drivers = book.children("docs/drivers", "md")?;
    let schemas = book.children("docs/schemas", "json")?;
    let list = list.lines().map(|line| book.linked(SUMMARY, line));
    let list = list.collect::<Result<Vec<_>>>()?.join("\n");
    while let Some(path) = book.todo.pop() {
        book.take(&path)?;
    }
    let pictures = boards::pages(&mut book.tree);
    let nested = drivers.iter().chain(&schemas).map(|(_, page)| page.as_str());
    let nested = nested.collect::<BTreeSet<_>>();
    let is_listed = |page: &str| nested.contains(page) || list.contains(&format!("]({page})"));
    book.files.retain(|(_, page)| !is_listed(page));
    book.files.sort();
    book.tree.insert(FILES.to_owned(), files_page(&book.files).into_bytes());
    let nested = [
        ("drivers/index.md", drivers),
        ("output.md", schemas),
        ("boards.md", pictures),
        (FILES, book.files),
    ];
    let list = summary::written(&(list + "\n"), FILES, &nested)?;
    book.tree.insert("SUMMARY.md".to_owned(), list.into_bytes());
    Ok(book.tree)
}

/// Where the book has a file of the repository.
pub(super) fn placed(path: &str) -> String {
    if path == "README.md" {
        return "index.md".to_owned();
    }
    if path == "docs/README.md" {
        return "pages.md".to_owned();
    }
    let place =
        path.strip_prefix("docs/").map_or_else(|| format!("repository/{path}"), str::to_owned);
    place.strip_suffix("README.md").map_or(place.clone(), |folder| format!("{folder}index.md"))
}

fn files_page(files: &[Entry]) -> String {
    let rows = files.iter().map(|(title, page)| {
        let link = links::relative(FILES, page);
        format!("- [`{title}`]({link})\n")
    });
    format!(
        "# Files\n\nFiles of the repository that these pages show.\n\n{}",
        rows.collect::<String>()
    )
}

struct Book<'a> {
    root: &'a Path,
    tree: Tree,
    /// Paths of the repository that are still to be taken.
    todo: Vec<String>,
    seen: BTreeSet<String>,
    /// All pages of the repository's files, and then those that no list has: what they are called, and where they are.
    files: Vec<Entry>,
}

impl Book<'_> {
    /// The pages of a folder's files, which no list names one by one.
    fn children(&mut self, folder: &str, end: &str) -> Result<Vec<Entry>> {
        let mut all = Vec::new();
        for name in names(&self.root.join(folder))? {
            let path = format!("{folder}/{name}");
            if !name.ends_with(&format!(".{end}")) || name == "README.md" {
                continue;
            }
            let text = fs::read_to_string(self.root.join(&path))?;
            let heading = text.lines().find_map(|line| line.strip_prefix("# "));
            let title = heading.filter(|_| end == "md").unwrap_or(&name).to_owned();
            all.push((title, self.place(&path)));
            self.want(path);
        }
        Ok(all)
    }

    fn want(&mut self, path: String) {
        if self.seen.insert(path.clone()) {
            self.todo.push(path);
        }
    }

    /// Where a link to a file or a folder leads in the book.
    fn place(&self, path: &str) -> String {
        let end = path.rsplit_once('.').map_or("", |(_, end)| end);
        if self.root.join(path).is_dir() {
            format!("{}/index.md", placed(path))
        } else if end == "md" || PICTURES.contains(&end) {
            placed(path)
        } else {
            format!("{}.md", placed(path))
        }
    }

    /// A line of a page with its links as the book has them. What they lead to is taken later.
    fn linked(&mut self, page: &str, line: &str) -> Result<String> {
        let mut wrong = None;
        let line = links::rewritten(line, |link| {
            if link.contains("://") || link.starts_with('#') || link.starts_with("mailto:") {
                return None;
            }
            let (path, anchor) = link.split_once('#').unwrap_or((link, ""));
            let found = links::resolved(page, path).filter(|path| self.root.join(path).exists());
            let Some(mut to) = found else {
                wrong = Some(link.to_owned());
                return None;
            };
            let readme = format!("{to}/README.md");
            if self.root.join(&readme).is_file() {
                to = readme;
            }
            // The list is beside every page, and the page of all pages says more of them.
            if to == SUMMARY {
                to = "docs/README.md".to_owned();
            }
            self.want(to.clone());
            let from = if page == SUMMARY { "SUMMARY.md".to_owned() } else { self.place(page) };
            let mut way = links::relative(&from, &self.place(&to));
            if page != SUMMARY && way.ends_with(".md") {
                way.replace_range(way.len() - 2.., "html");
            }
            Some(if anchor.is_empty() { way } else { format!("{way}#{anchor}") })
        });
        ensure!(wrong.is_none(), "{page}: {} is not there", wrong.unwrap_or_default());
        Ok(line)
    }

    fn take(&mut self, path: &str) -> Result<()> {
        let full = self.root.join(path);
        if full.is_dir() {
            return self.folder(path);
        }
        let bytes = fs::read(&full).with_context(|| path.to_owned())?;
        let end = path.rsplit_once('.').map_or("", |(_, end)| end);
        let place = self.place(path);
        if PICTURES.contains(&end) {
            self.tree.insert(place, bytes);
            return Ok(());
        }
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let page = if end == "md" { self.page(path, &text)? } else { shown(path, end, &text) };
        if end != "md" {
            self.tree.insert(placed(path), bytes);
        }
        self.files.push((path.to_owned(), place.clone()));
        self.tree.insert(place, page.into_bytes());
        Ok(())
    }

    fn page(&mut self, path: &str, text: &str) -> Result<String> {
        let mut page = String::new();
        for piece in listing::pieces(text) {
            match piece {
                Piece::Block(block) => page.push_str(&listing::written(&block)),
                Piece::Line(line) => {
                    let line = self.linked(path, line)?;
                    page.push_str(&match path {
                        "docs/boards.md" => boards::line(&line),
                        "docs/diagnostics.md" => anchored(&line),
                        _ => line,
                    });
                    page.push('\n');
                }
            }
        }
        Ok(page)
    }

    /// A page that lists a folder.
    fn folder(&mut self, path: &str) -> Result<()> {
        let mut page = format!("# {path}\n\n");
        for name in names(&self.root.join(path))? {
            let to = format!("{path}/{name}");
            let way = links::relative(&self.place(path), &self.place(&to));
            let way = way.strip_suffix(".md").map_or(way.clone(), |way| format!("{way}.html"));
            page.push_str(&format!("- [`{name}`]({way})\n"));
            self.want(to);
        }
        let place = self.place(path);
        self.files.push((path.to_owned(), place.clone()));
        self.tree.insert(place, page.into_bytes());
        Ok(())
    }
}

/// The names in a folder, in order.
fn names(folder: &Path) -> Result<Vec<String>> {
    let entries = fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let names = entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    let mut names = names.collect::<Result<Vec<_>>>()?;
    names.retain(|name| !name.starts_with('.'));
    names.sort();
    Ok(names)
}

/// The page of a file that is no page itself.
fn shown(path: &str, end: &str, text: &str) -> String {
    let name = path.rsplit('/').next().unwrap_or(path);
    let head = format!("# {path}\n\n[The file itself]({name})\n\n");
    if text.len() > SHOWN_MAX {
        return head;
    }
    let language = match end {
        "sense" | "json" | "xml" | "toml" | "csv" | "rs" | "c" | "py" => end,
        _ => "text",
    };
    let text = format!("{}\n", text.trim_end());
    head + &listing::written(&listing::Block { info: language, text, indent: "" })
}

/// A heading of a diagnostic can be found by its code alone.
fn anchored(line: &str) -> String {
    let code = line.strip_prefix("### ").and_then(|line| line.split_once(':'));
    code.map_or(line.to_owned(), |(code, _)| format!("<a id=\"{code}\"></a>\n\n{line}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_have_their_places() {
        let all = [
            "README.md",
            "docs/README.md",
            "docs/drivers/README.md",
            "docs/wire.md",
            "fuzz/README.md",
        ];
        let places =
            ["index.md", "pages.md", "drivers/index.md", "wire.md", "repository/fuzz/index.md"];
        assert_eq!(all.map(placed), places);
    }

    /// The whole book, as the repository has it.
    #[test]
    fn the_book_has_what_its_pages_link_to() {
        let tree = book(&crate::web::root().unwrap()).unwrap();
        let page = |path: &str| String::from_utf8(tree[path].clone()).unwrap();
        let list = page("SUMMARY.md");
        assert!(list.starts_with("# Summary\n\n[SenseDSL](index.md)\n"), "{list}");
        assert!(list.contains("\n  - [check.json](schemas/check.json.md)\n"), "{list}");
        assert!(list.contains("\n  - [NUCLEO-F401RE](boards/NUCLEO-F401RE.md)\n"), "{list}");
        assert!(page("index.md").contains("](start/without-a-board.html)"));
        assert!(page("diagnostics.md").contains("<a id=\"E0401\"></a>\n\n### E0401: "));
        assert!(page("repository/tests/robots/rover.sense.md").contains("class=\"sense\""));
        for line in list.lines().filter_map(|line| line.rsplit_once("](")) {
            let path = line.1.trim_end_matches(')');
            assert!(tree.contains_key(path), "{path} is listed, and is not there");
        }
    }
}
