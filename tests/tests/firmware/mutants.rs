//! Mistakes put into generated files, one at a time, with the checks that notice them: the second
//! reader (`facts`, `details`), and a compiler with the stub headers (`stubs`). Golden files see
//! every change, so they are not counted here.
//!
//! `docs/mutants.md` has the table; `SENSEDSL_BLESS=1 cargo test --workspace --test all
//! firmware::mutants` writes it. A mistake that only a compiler with the real tree notices counts
//! as unnoticed, because most machines have no tree; `-- --ignored firmware::mutants --nocapture`
//! checks with the tree too (`CHIBIOS`).

use std::path::Path;
use std::process::Command;

use sensedsl_tests::{Mistake, assert_page, is_thorough, mistakes, write_file};

use super::applications::{CAR, FIG2};
use super::facts::{self, Folder};
use super::tools::scratch;
use super::{chibios, stubs};

const HARDWARE: &str = "generated/sense_hw.c";

/// The files compiled with the tree: the generated ones, and those of the tree that read the
/// generated settings.
const OBJECTS: [&str; 8] = [
    "sense_hw",
    "sense_model",
    "up_main",
    "up_rt",
    "up_report",
    "hal_st_lld",
    "hal_adc_lld",
    "hal_icu_lld",
];

fn write(folder: &Path, files: &Folder) {
    for (path, text) in files {
        let path = folder.join(path);
        // An unchanged file keeps its time, so that make compiles only what has changed.
        if std::fs::read_to_string(&path).is_ok_and(|there| there == *text) {
            continue;
        }
        write_file(&path, text);
    }
}

/// Whether the compiler with the real tree, or a guard, stops or warns.
fn tree_notices(tree: &Path, folder: &Path) -> bool {
    let mut make = Command::new("make");
    make.current_dir(folder).arg("-j2").arg(format!("CHIBIOS={}", tree.display()));
    make.args(OBJECTS.map(|name| format!("./build/development/obj/{name}.o")));
    let output = make.output().unwrap();
    !output.status.success() || String::from_utf8_lossy(&output.stderr).contains("warning")
}

/// Puts one mutant after the other into a design's files, and passes each result to `then`.
fn each(mutants: &[Mistake], name: &str, mut then: impl FnMut([bool; 2], &Path)) {
    facts::with(FIG2, |design, wiring, folder| {
        let macros = stubs::macros_of("STM32F4DiscoveryBoard");
        let place = scratch(name);
        write(&place, &folder);
        let sources = stubs::sources(&folder);
        assert_eq!(stubs::compile(&place, &macros, "development", &sources), "");
        assert_eq!(facts::differences(design, wiring, &folder), [] as [&str; 0]);
        for change in mutants.iter().flat_map(|mutant| &mutant.places) {
            let path = change.name.as_str();
            let mut mutated = folder.clone();
            let text = mutated.get_mut(path).unwrap();
            *text = change.once(text);
            write(&place, &mutated);
            // A header is included in many files; a source is compiled by itself.
            let changed = if path.ends_with(".c") { vec![path] } else { sources.clone() };
            let notices = [
                // If the reader cannot read the files at all, it has noticed as well.
                std::panic::catch_unwind(|| {
                    !facts::differences(design, wiring, &mutated).is_empty()
                })
                .unwrap_or(true),
                !stubs::compile(&place, &macros, "development", &changed).is_empty(),
            ];
            then(notices, &place);
        }
    });
}

/// The subject of a file.
fn class(path: &str) -> &'static str {
    match path {
        HARDWARE => "Wires, drivers and threads",
        "cfg/mcuconf.h" => "Units and streams",
        "cfg/up_conf.h" => "Sizes",
        _ => "Schema and values",
    }
}

fn page(rows: &[(&Mistake, [bool; 2])]) -> String {
    let mut page = String::new();
    let mut of = "";
    for (mutant, notices) in rows {
        let class = class(&mutant.places[0].name);
        if class != of {
            of = class;
            page.push_str(&format!(
                "\n## {of}\n\n| mistake | reader | compiler |\n| --- | --- | --- |\n"
            ));
        }
        let star = if mutant.has_survived { "*" } else { "" };
        let marks = notices.map(|noticed| if noticed { "yes" } else { "" });
        page.push_str(&format!("| {}{star} | {} | {} |\n", mutant.what, marks[0], marks[1]));
    }
    let unseen: Vec<_> = rows.iter().filter(|(mutant, _)| !mutant.why.is_empty()).collect();
    let seen = |at: usize| rows.iter().filter(|(_, notices)| notices[at]).count();
    page.push_str(&format!(
        "\n## Nobody notices\n\nOf {} mistakes the reader notices {}, the compiler {}, and nobody {}.\n",
        rows.len(),
        seen(0),
        seen(1),
        unseen.len()
    ));
    for (mutant, _) in unseen {
        page.push_str(&format!("\n- **{}**: {}\n", mutant.what, mutant.why));
    }
    page
}

#[test]
fn mutants_of_generated_files_are_noticed() {
    if !is_thorough() {
        return;
    }
    let (mutants, mut notices) = (mistakes("fig2.txt"), Vec::new());
    each(&mutants, "mutants-stubs", |noticed, _| notices.push(noticed));
    let rows: Vec<_> = mutants.iter().zip(notices).collect();
    for (mutant, notices) in &rows {
        assert_eq!(notices.contains(&true), mutant.why.is_empty(), "{mutant:?}: {notices:?}");
    }
    assert_page("docs/mutants.md", "## ", page(&rows).trim_start());
}

#[test]
#[ignore = "compiles with the tree a hundred times"]
fn mutants_are_noticed_by_the_tree() {
    let Some(tree) = chibios::tree() else { return };
    let (mutants, mut seen) = (mistakes("fig2.txt"), 0);
    let mut names = mutants.iter().map(|mutant| &mutant.what);
    each(&mutants, "mutants-tree", |notices, place| {
        let noticed = tree_notices(&tree, place);
        seen += usize::from(noticed);
        let marks = [notices[0], notices[1], noticed].map(|one| if one { "yes" } else { "-" });
        eprintln!("| {} | {} |", names.next().unwrap(), marks.join(" | "));
    });
    let whole = chibios::write("mutants-none", FIG2).join("STM32F4DiscoveryBoard");
    assert!(!tree_notices(&tree, &whole), "the files are wrong without a mutant");
    eprintln!("the tree notices {seen} of {}", mutants.len());
    assert!(seen >= 8, "{seen}");
}

/// The text that each mutant replaces must exist, so that the list follows the templates.
#[test]
fn mutants_are_of_texts_that_are_there() {
    facts::with(FIG2, |_, _, folder| {
        let mutants = mistakes("fig2.txt");
        assert!(mutants.len() > 50 && mutants.iter().all(|mutant| mutant.places.len() == 1));
        for place in mutants.iter().flat_map(|mutant| &mutant.places) {
            let _ = place.once(&folder[&place.name]);
        }
    });
    facts::with(CAR, |_, _, folder| assert!(folder.contains_key(HARDWARE)));
}
