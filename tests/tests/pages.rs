//! What pages say of data is what the data says.

use std::collections::BTreeSet;

use sensedsl_board::catalog;
use sensedsl_board::profile::{self, Target};
use sensedsl_codegen::firmware::chibios;
use sensedsl_tests::text;

/// The firmware page names the MCUs that there is firmware for, without `STM32` after the first.
#[test]
fn the_firmware_page_names_its_mcus() {
    let page = text("docs/firmware.md");
    let limits = page.split("## Limits").nth(1).unwrap();
    let named: BTreeSet<&str> = limits
        .split(|c: char| !c.is_ascii_alphanumeric())
        .map(|word| word.trim_start_matches("STM32"))
        .filter(|word| word.len() == 4 && word.starts_with('F'))
        .collect();
    let mut served = BTreeSet::new();
    for line in profile::lines(profile::DEFAULT).unwrap() {
        for part in line.profile.parts.iter().filter(|_| chibios::is_served(&line.profile)) {
            served.insert(part.trim_start_matches("STM32").to_owned());
        }
    }
    let served: BTreeSet<&str> = served.iter().map(String::as_str).collect();
    assert_eq!(named, served);
}

/// The page of the parts says how many numbers the shipped table has; the RP parts are rules.
#[test]
fn counts_are_those_of_the_data() {
    let parts = sensedsl_parts::all().filter(|part| !part.base().starts_with("RP"));
    let numbers: usize = parts.map(|part| part.numbers().count()).sum();
    let grouped = format!("{},{:03} part numbers", numbers / 1000, numbers % 1000);
    assert!(text("docs/parts.md").contains(&grouped), "docs/parts.md: there are {grouped}");
}

/// The README says of how many STM32 families wiring knows the drivers.
#[test]
fn the_readme_counts_the_families() {
    let words = ["seven", "eight", "nine", "ten", "eleven", "twelve", "thirteen", "fourteen"];
    let families: BTreeSet<String> = profile::lines(profile::DEFAULT)
        .unwrap()
        .iter()
        .flat_map(|line| &line.profile.parts)
        .map(|part| sensedsl_board::mcu::family(part).to_owned())
        .collect();
    let word = words.get(families.len() - 7).unwrap();
    let wanted = format!("drivers of {word} STM32 families");
    assert!(text("README.md").contains(&wanted), "README.md: {wanted}: {families:?}");
}

/// Every board with a firmware profile and a folder in the tree is of a family that is named.
#[test]
fn boards_with_firmware_are_of_those_mcus() {
    let page = text("docs/firmware.md");
    let mut count = 0;
    for entry in catalog::all() {
        let in_tree = entry.board().is_ok_and(|board| board.chibios.is_some());
        let Ok(Target::Profile(profile)) = profile::find(profile::DEFAULT, entry.mcu) else {
            continue;
        };
        if in_tree && chibios::is_served(&profile) {
            let series = entry.mcu.get(5..9).unwrap();
            assert!(page.contains(series), "{}: docs/firmware.md lacks {series}", entry.name);
            count += 1;
        }
    }
    assert!(count >= 10, "{count}");
}
