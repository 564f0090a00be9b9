//! `cargo xtask release VERSION`: makes a release of the sources.
//!
//! In: the version, and the date (`--date`, today unless you say). Out, with `--write`: the version in all manifests, the
//! changelog with what stood in `changes/`, the date in `CITATION.cff`, the lock files. Without it the command only says
//! what it would do. `--artefacts FOLDER` builds what is handed out, with its checksums, by `packaging/artefacts.sh`; it
//! takes an hour or more. Nothing is committed, tagged or published: what remains to be done is printed.

mod changelog;
mod places;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail, ensure};

use crate::parts::sources;

/// What is asked for.
struct Asked {
    version: String,
    date: String,
    is_written: bool,
    artefacts: Option<PathBuf>,
}

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let asked = Asked::of(arguments)?;
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()?;
    if let Some(folder) = &asked.artefacts {
        return artefacts(&root, &asked.version, folder);
    }
    let release = Release::new(&root, &asked.version, &asked.date)?;
    for (path, _) in &release.changed {
        crate::say(&format!("changed: {path}\n"))?;
    }
    for path in &release.removed {
        crate::say(&format!("removed: {path}\n"))?;
    }
    crate::say(&format!("\n{}\n", release.section.trim_end()))?;
    if !asked.is_written {
        return crate::say("\nnothing was written: `--write` does it\n");
    }
    release.write(&root)?;
    for manifest in ["Cargo.toml", "fuzz/Cargo.toml"] {
        let mut cargo = Command::new(env!("CARGO"));
        cargo.args(["update", "--quiet", "--workspace", "--offline", "--manifest-path"]);
        let status = cargo.arg(root.join(manifest)).status()?;
        ensure!(status.success(), "the lock file of {manifest} was not written");
    }
    crate::say(&steps(&release.old, &asked.version))
}

impl Asked {
    fn of(arguments: &[String]) -> Result<Self> {
        let usage =
            "cargo xtask release VERSION [--date YYYY-MM-DD] [--write | --artefacts FOLDER]";
        let (mut version, mut date, mut is_written, mut artefacts) = (None, None, false, None);
        let mut rest = arguments.iter();
        while let Some(argument) = rest.next() {
            match argument.as_str() {
                "--date" => date = Some(rest.next().context(usage)?.clone()),
                "--write" => is_written = true,
                "--artefacts" => artefacts = Some(PathBuf::from(rest.next().context(usage)?)),
                word if version.is_none() && !word.starts_with('-') => {
                    version = Some(word.to_owned());
                }
                _ => bail!(usage),
            }
        }
        let version = version.context(usage)?;
        ensure!(numbers(&version).is_some(), "{version} is not a version such as 1.2.3");
        let date = date.map_or_else(today, Ok)?;
        ensure!(is_date(&date), "{date} is not a date such as 2030-01-31");
        Ok(Self { version, date, is_written, artefacts })
    }
}

/// The three numbers of a version.
fn numbers(version: &str) -> Option<[u64; 3]> {
    let all: Option<Vec<u64>> = version.split('.').map(|part| part.parse().ok()).collect();
    all?.try_into().ok()
}

fn is_date(text: &str) -> bool {
    let lengths: Vec<usize> = text.split('-').map(str::len).collect();
    lengths == [4, 2, 2] && text.bytes().all(|byte| byte == b'-' || byte.is_ascii_digit())
}

fn today() -> Result<String> {
    let output = Command::new("date").args(["-u", "+%F"]).output().context("date")?;
    Ok(String::from_utf8(output.stdout)?.trim().to_owned())
}

/// What a release changes.
struct Release {
    /// Paths and their new text.
    changed: Vec<(String, String)>,
    /// The version before.
    old: String,
    /// What the changelog has now.
    removed: Vec<String>,
    /// The section of the changelog.
    section: String,
}

impl Release {
    /// Works out what a release of the sources below `root` changes.
    fn new(root: &Path, version: &str, date: &str) -> Result<Self> {
        let text = |path: &str| sources::text(&root.join(path));
        let old = places::current(&text("Cargo.toml")?)?;
        ensure!(
            numbers(version) >= numbers(&old),
            "{version} comes before {old}, which is the version now"
        );
        let mut changed = Vec::new();
        for place in places::PLACES {
            let before = text(place.path)?;
            changed.push((place.path.to_owned(), place.renewed(&before, &old, version)?));
        }
        changed.push((
            places::CITATION.into(),
            places::cited(&text(places::CITATION)?, version, date),
        ));
        let fragments = changelog::fragments(&root.join("changes"))?;
        let (whole, section) =
            changelog::renewed(&text(changelog::PAGE)?, &fragments, version, date)?;
        changed.push((changelog::PAGE.into(), whole));
        let removed = fragments.into_iter().map(|one| format!("changes/{}", one.file)).collect();
        Ok(Self { changed, old, removed, section })
    }

    fn write(&self, root: &Path) -> Result<()> {
        for (path, text) in &self.changed {
            sources::write(&root.join(path), text.as_bytes())?;
        }
        for path in &self.removed {
            std::fs::remove_file(root.join(path)).with_context(|| path.clone())?;
        }
        Ok(())
    }
}

/// What a person does then.
fn steps(old: &str, version: &str) -> String {
    format!(
        "
read the difference, then:

    git commit -am 'Release {version}'
    bash .ci/full
    cargo semver-checks --workspace --baseline-rev v{old}  # unless this is the first release
    cargo xtask release {version} --artefacts target/release-{version}
    git tag -s v{version} -F target/release-{version}/tag-message.txt
    cargo publish --workspace --dry-run  # without it the crates are published, in the order of their needs
"
    )
}

fn artefacts(root: &Path, version: &str, folder: &Path) -> Result<()> {
    let own = places::current(&sources::text(&root.join("Cargo.toml"))?)?;
    ensure!(own == version, "the sources are {own}: `cargo xtask release {version} --write` first");
    let page = sources::text(&root.join(changelog::PAGE))?;
    let section = changelog::section_of(&page, version)
        .with_context(|| format!("{} says nothing of {version}", changelog::PAGE))?;
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let message = format!("SenseDSL {version}\n\n{}\n", changelog::plain(section));
    sources::write(&folder.join("tag-message.txt"), message.as_bytes())?;
    let mut script = Command::new("sh");
    script.arg(root.join("packaging/artefacts.sh")).arg(folder.canonicalize()?);
    ensure!(script.status()?.success(), "not all was built");
    Ok(())
}
