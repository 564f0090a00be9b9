//! A release of a copy of the repository's own files.

use std::path::{Path, PathBuf};

use super::{Release, changelog, is_date, numbers, places};

struct Copy(PathBuf);

impl Drop for Copy {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Everything that a release reads, as it is now.
fn copy(name: &str) -> Copy {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let place = std::env::temp_dir().join(format!("sensedsl-{name}-{}", std::process::id()));
    let mut files: Vec<String> = places::PLACES.iter().map(|place| place.path.to_owned()).collect();
    files.extend([places::CITATION.to_owned(), changelog::PAGE.to_owned()]);
    for entry in std::fs::read_dir(root.join("changes")).unwrap() {
        files.push(format!("changes/{}", entry.unwrap().file_name().to_string_lossy()));
    }
    for file in files {
        let into = place.join(&file);
        std::fs::create_dir_all(into.parent().unwrap()).unwrap();
        let _ = std::fs::copy(root.join(&file), into).unwrap();
    }
    Copy(place)
}

fn text(copy: &Copy, path: &str) -> String {
    std::fs::read_to_string(copy.0.join(path)).unwrap()
}

#[test]
fn a_copy_is_released() {
    let copy = copy("release");
    let fragments = changelog::fragments(&copy.0.join("changes")).unwrap();
    let old = places::current(&text(&copy, "Cargo.toml")).unwrap();
    let release = Release::new(&copy.0, "7.91.3", "2031-02-28").unwrap();
    release.write(&copy.0).unwrap();

    assert_eq!(places::current(&text(&copy, "Cargo.toml")).unwrap(), "7.91.3");
    let manifest = text(&copy, "Cargo.toml");
    let own = manifest.lines().filter(|line| line.contains("path = \"crates/")).count();
    assert_eq!(manifest.matches("\"7.91.3\"").count(), own + 1);
    for place in places::PLACES {
        let text = text(&copy, place.path);
        match place.times {
            // A lock file of npm has its own version first; that of another package may be the same.
            Some(times) => assert_eq!(text.matches("7.91.3").count(), times, "{}", place.path),
            None => assert!(place.renewed(&text, &old, "8.0.0").is_err(), "{}", place.path),
        }
    }
    let cited = text(&copy, places::CITATION);
    assert_eq!(
        cited.matches("\nversion: 7.91.3\ndate-released: 2031-02-28\n").count(),
        1,
        "{cited}"
    );

    let page = text(&copy, changelog::PAGE);
    let section = changelog::section_of(&page, "7.91.3").unwrap();
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    for one in &fragments {
        let said = std::fs::read_to_string(
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../changes").join(&one.file),
        );
        let said = said.unwrap();
        let said = words(said.split_once('\n').unwrap().1);
        assert!(words(section).contains(&format!("- {said}")), "{}", one.file);
    }
    assert!(page.lines().all(|line| line.chars().count() <= 120));
    let left = std::fs::read_dir(copy.0.join("changes")).unwrap().count();
    assert_eq!(left, 1, "the README alone is left");

    // Nothing has changed since.
    assert!(Release::new(&copy.0, "7.91.4", "2031-03-01").is_err());
    // What comes next has a section of its own, above.
    std::fs::write(copy.0.join("changes/next.md"), "Wire\n\nA wire is shorter.\n").unwrap();
    let next = Release::new(&copy.0, "7.92.0", "2031-04-01").unwrap();
    next.write(&copy.0).unwrap();
    let page = text(&copy, changelog::PAGE);
    assert_eq!(changelog::section_of(&page, "7.92.0").unwrap(), "### Wire\n\n- A wire is shorter.");
    assert!(page.find("## 7.92.0 (2031-04-01)") < page.find("## 7.91.3 (2031-02-28)"));
    assert_eq!(
        text(&copy, places::CITATION).matches("version: ").count(),
        2,
        "cff-version, version"
    );
    assert!(Release::new(&copy.0, "7.91.9", "2031-04-02").is_err(), "an older version");
}

#[test]
fn what_is_no_fragment_is_told() {
    let copy = copy("fragments");
    std::fs::write(copy.0.join("changes/odd.md"), "Solder\n\nA joint is better.\n").unwrap();
    let why = Release::new(&copy.0, "7.91.3", "2031-02-28").err().unwrap().to_string();
    assert!(why.contains("changes/odd.md") && why.contains("Solder"), "{why}");
}

#[test]
fn versions_and_dates() {
    assert_eq!(numbers("1.20.3"), Some([1, 20, 3]));
    assert!(numbers("1.2").is_none() && numbers("v1.2.3").is_none());
    assert!(is_date("2031-02-28") && !is_date("28.2.2031") && !is_date("2031-2-28"));
}
