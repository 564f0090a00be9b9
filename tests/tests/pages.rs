//! Statements of pages about data agree with the data.

use std::collections::BTreeSet;

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
    for folder in ["docs/drivers", "docs/sinks", "docs/start"] {
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
