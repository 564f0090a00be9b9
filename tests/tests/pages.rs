//! Statements of pages about data agree with the data.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use sensedsl_board::profile;
use sensedsl_firmware_chibios as chibios;
use sensedsl_tests::{read, root, text};

/// The firmware page names exactly the families that have firmware, without `STM32`.
#[test]
fn the_firmware_page_names_its_families() {
    let page = words_of("docs/firmware.md");
    let limits = page.split("## Limits").nth(1).unwrap();
    let named = limits.split("every STM32 family with a profile (").nth(1).unwrap();
    let named = named.split(')').next().unwrap().split(',');
    let named: BTreeSet<&str> = named.map(str::trim).collect();
    let mut served = BTreeSet::new();
    for line in profile::lines(profile::DEFAULT).unwrap() {
        assert!(chibios::is_served(&line.profile), "{}", line.profile.line);
        served.insert(line.profile.family.trim_start_matches("STM32").to_owned());
    }
    let served: BTreeSet<&str> = served.iter().map(String::as_str).collect();
    assert_eq!(named, served);
}

/// The text of a page with single spaces between words, independent of its line breaks.
fn words_of(page: &str) -> String {
    text(page).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The page of the parts gives the number of part numbers in the shipped table; the RP parts are
/// rules.
#[test]
fn counts_are_those_of_the_data() {
    let parts = sensedsl_parts::all().filter(|part| !part.base().starts_with("RP"));
    let numbers: usize = parts.map(|part| part.numbers().count()).sum();
    let grouped = format!("{},{:03} part numbers", numbers / 1000, numbers % 1000);
    assert!(words_of("docs/parts.md").contains(&grouped), "docs/parts.md: there are {grouped}");
}

/// The page of what is missing names the families that have firmware in C.
#[test]
fn what_is_missing_names_the_families() {
    let families: BTreeSet<String> = profile::lines(profile::DEFAULT)
        .unwrap()
        .iter()
        .flat_map(|line| &line.profile.parts)
        .map(|part| sensedsl_board::mcu::family(part).replace("STM32", ""))
        .collect();
    let mut names: Vec<String> = families.into_iter().collect();
    let last = names.pop().unwrap();
    let wanted = format!("STM32 {} and {last}", names.join(", "));
    assert!(words_of("docs/missing.md").contains(&wanted), "docs/missing.md: {wanted}");
}

/// Prose has at most 120 characters a line, so that it can be read and compared side by side.
#[test]
fn prose_is_wrapped() {
    const LETTERS_MAX: usize = 120;
    let mut pages: Vec<_> = ["README", "ARCHITECTURE", "CONTRIBUTING", "CHANGELOG", "SECURITY"]
        .iter()
        .map(|page| root().join(format!("{page}.md")))
        .collect();
    let docs = std::fs::read_dir(root().join("docs")).unwrap();
    pages.extend(docs.map(|entry| entry.unwrap().path()));
    let folders = ["drivers", "guides", "hosts", "migrate", "sinks", "start", "tutorials"];
    for folder in folders.map(|name| format!("docs/{name}")) {
        let entries = std::fs::read_dir(root().join(folder)).unwrap();
        pages.extend(entries.map(|entry| entry.unwrap().path()));
    }
    // This page is made from texts in the code, which are indented there.
    pages.retain(|path| path.extension().is_some_and(|end| end == "md"));
    pages.retain(|path| !path.ends_with("diagnostics.md"));
    assert!(pages.len() > 15);
    for page in pages {
        let mut is_code = false;
        for (number, line) in (1..).zip(read(&page).lines()) {
            is_code ^= line.trim_start().starts_with("```");
            let is_prose = !is_code && !line.starts_with('|') && !line.contains("](");
            let letters = line.chars().count();
            assert!(!is_prose || letters <= LETTERS_MAX, "{}:{number}: {letters}", page.display());
        }
    }
}

/// The pages of the repository: those at its root, and those in the folders that have some.
fn pages() -> Vec<PathBuf> {
    let mut all = Vec::new();
    let mut folders = vec![root()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            let is_foreign =
                ["target", "build", "node_modules", "golden", "corpus"].contains(&name.as_str());
            if path.is_dir() && !is_foreign && (!name.starts_with('.') || name == ".github") {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "md") {
                all.push(path);
            }
        }
    }
    all.sort();
    all
}

/// The names of a page's headings, as links have them.
fn anchors(page: &Path) -> BTreeSet<String> {
    let text = read(page);
    let headings = text.lines().filter(|line| line.starts_with('#'));
    let name = |heading: &str| -> String {
        let plain = heading.trim_start_matches('#').trim().to_lowercase();
        let letters = plain.chars().filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
        letters.map(|c| if c == ' ' { '-' } else { c }).collect()
    };
    headings.map(name).collect()
}

/// Where the links of a page lead: the path and the heading of each.
fn links(text: &str) -> Vec<(String, Option<String>)> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices("](") {
        let Some((link, _)) = text.get(at + 2..).and_then(|rest| rest.split_once(')')) else {
            continue;
        };
        if link.contains("://") || link.contains(char::is_whitespace) || link.is_empty() {
            continue;
        }
        let (path, anchor) =
            link.split_once('#').map_or((link, None), |(path, anchor)| (path, Some(anchor)));
        found.push((path.to_owned(), anchor.map(str::to_owned)));
    }
    found
}

/// The book has every page of `docs` and of the root, each once. Those of drivers the builder puts below their list
/// (`xtask/src/site/pages.rs`).
#[test]
fn the_book_leaves_no_page_out() {
    let (docs, drivers) = (root().join("docs"), root().join("docs/drivers"));
    let listed = links(&text("docs/SUMMARY.md"));
    let listed = listed.iter().map(|(path, _)| docs.join(path).canonicalize().unwrap());
    let mut listed: Vec<PathBuf> = listed.collect();
    listed.sort();
    let mut wanted = pages();
    wanted.retain(|page| {
        let is_own = page.starts_with(&docs) || page.parent() == Some(&root());
        let is_added = page.starts_with(&drivers) && !page.ends_with("README.md");
        is_own && !is_added && !page.ends_with("SUMMARY.md")
    });
    let wanted: Vec<PathBuf> = wanted.iter().map(|page| page.canonicalize().unwrap()).collect();
    assert_eq!(listed, wanted);
}

/// Every link between pages leads to a file that is there, and to a heading in it.
#[test]
fn links_lead_somewhere() {
    let (mut wrong, mut count) = (Vec::new(), 0);
    for page in pages() {
        for (path, anchor) in links(&read(&page)) {
            count += 1;
            let to =
                if path.is_empty() { page.clone() } else { page.parent().unwrap().join(&path) };
            let has_heading = |anchor: &String| {
                to.extension().is_none_or(|end| end != "md") || anchors(&to).contains(anchor)
            };
            if !to.exists() || !anchor.as_ref().is_none_or(has_heading) {
                wrong.push(format!("{}: {path}#{}", page.display(), anchor.unwrap_or_default()));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    assert!(count > 500, "only {count} links were found");
}
