//! `cargo xtask packages FOLDER`: writes the table that Embassy's lock files are computed from.
//!
//! In: a folder with the lock files of all sorts of projects, as cargo writes them: `check.lock`, `check-f3.lock`,
//! `check-g4.lock`, `check-rp.lock`, `check-nrf.lock`, the same with `firmware`, and `firmware-esp32c3.lock` and
//! `firmware-esp32c6.lock`. Out: `packages.txt` of `crates/firmware-embassy`, which has each crate once, with conditions
//! for its dependencies.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context as _, Result, bail, ensure};

use crate::parts::sources::{self, text};

/// The sorts of projects, with the tags that apply to each.
const SORTS: [(&str, &[&str]); 12] = [
    ("check", &["check", "stm32"]),
    ("check-g4", &["check", "stm32", "g4"]),
    ("check-f3", &["check", "stm32", "f3"]),
    ("check-rp", &["check", "rp"]),
    ("check-nrf", &["check", "nrf"]),
    ("firmware", &["firmware", "stm32"]),
    ("firmware-g4", &["firmware", "stm32", "g4"]),
    ("firmware-f3", &["firmware", "stm32", "f3"]),
    ("firmware-rp", &["firmware", "rp"]),
    ("firmware-nrf", &["firmware", "nrf"]),
    ("firmware-esp32c3", &["firmware", "esp", "esp32c3"]),
    ("firmware-esp32c6", &["firmware", "esp", "esp32c6"]),
];
/// The conditions, the simplest ones first.
const CONDITIONS: [&str; 26] = [
    "",
    "check",
    "firmware",
    "stm32",
    "rp",
    "nrf",
    "esp",
    "esp32c3",
    "esp32c6",
    "f3",
    "g4",
    "check stm32",
    "check rp",
    "check nrf",
    "firmware stm32",
    "firmware rp",
    "firmware nrf",
    "firmware or rp",
    "firmware or rp or nrf",
    "check or rp",
    "f3 or g4",
    "stm32 or firmware nrf",
    "stm32 or rp or nrf",
    "stm32 or rp",
    "firmware nrf or esp",
    "firmware stm32 or firmware rp or firmware nrf",
];
/// The HAL's dependencies that it only has if a timer is left for the clock; a lock file of a project with one has
/// them.
const CLOCK: [&str; 2] = ["embassy-time-driver", "embassy-time-queue-utils"];

/// The name; the version as numbers, which order versions; and the version as it is written.
type Package = (String, Vec<u64>, String);

/// The checksum, and the dependencies.
type Locked = (Option<String>, Vec<Package>);

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let [folder] = arguments else { bail!("cargo xtask packages FOLDER") };
    let mut locks = Vec::new();
    for (sort, tags) in SORTS {
        let path = Path::new(folder).join(format!("{sort}.lock"));
        locks.push((tags, read(&text(&path)?).with_context(|| path.display().to_string())?));
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let path = root.join("crates/firmware-embassy/src/templates/packages.txt");
    let before = text(&path)?;
    let head: Vec<&str> = before.lines().take_while(|line| line.starts_with('#')).collect();
    let mut table = head.join("\n") + "\n";
    let all: BTreeSet<&Package> = locks.iter().flat_map(|(_, lock)| lock.keys()).collect();
    for package in &all {
        let here: Vec<(&[&str], &Locked)> =
            locks.iter().filter_map(|(tags, lock)| Some((*tags, lock.get(*package)?))).collect();
        let checksum = here.iter().find_map(|(_, (checksum, _))| checksum.clone());
        table.push_str(&format!("{} {}\n", shown(package), checksum.unwrap_or_else(|| "-".into())));
        let needs: BTreeSet<&Package> = here.iter().flat_map(|(_, (_, needs))| needs).collect();
        for need in needs {
            let condition = condition(package, need, &here)?;
            table.push_str(&format!("    {}{condition}\n", shown(need)));
        }
    }
    sources::write(&path, table.as_bytes())?;
    crate::say(&format!("{} crates\n", all.len()))
}

fn shown((name, _, version): &Package) -> String {
    format!("{name} {version}")
}

/// The condition of a dependency, as the table has it.
fn condition(package: &Package, need: &Package, here: &[(&[&str], &Locked)]) -> Result<String> {
    if package.0 == "embassy-stm32" && CLOCK.contains(&need.0.as_str()) {
        return Ok(" if clock".to_owned());
    }
    let fits = |condition: &&&str| {
        let mut all = here.iter();
        all.all(|(tags, (_, needs))| holds(condition, tags) == needs.contains(need))
    };
    let found = CONDITIONS.iter().find(fits);
    let found = found.with_context(|| {
        let needing = here.iter().filter(|(_, (_, needs))| needs.contains(need));
        let needing: Vec<String> = needing.map(|(tags, _)| tags.join(" ")).collect();
        let (package, need) = (shown(package), shown(need));
        format!("no condition holds where {package} needs {need}: {}", needing.join(" or "))
    })?;
    Ok(if found.is_empty() { String::new() } else { format!(" if {found}") })
}

fn holds(condition: &str, tags: &[&str]) -> bool {
    let mut either = condition.split(" or ");
    either.any(|one| one.split_whitespace().all(|tag| tags.contains(&tag)))
}

fn package(name: &str, version: &str) -> Package {
    let numbers = version.split(['.', '-', '+']).map_while(|part| part.parse().ok());
    (name.to_owned(), numbers.collect(), version.to_owned())
}

/// The packages of a lock file.
fn read(lock: &str) -> Result<BTreeMap<Package, Locked>> {
    let file: toml::Table = lock.parse()?;
    let packages = file.get("package").and_then(toml::Value::as_array).context("no packages")?;
    let word = |one: &toml::Value, name: &str| {
        one.get(name).and_then(toml::Value::as_str).map(str::to_owned)
    };
    let mut by_name: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for one in packages {
        let (name, version) = (word(one, "name"), word(one, "version"));
        by_name.entry(name.context("no name")?).or_default().push(version.context("no version")?);
    }
    let mut found = BTreeMap::new();
    for one in packages {
        let (name, own) = (word(one, "name"), word(one, "version"));
        let package = package(&name.context("no name")?, &own.context("no version")?);
        let mut needs = Vec::new();
        let list = one.get("dependencies").and_then(toml::Value::as_array);
        for need in list.into_iter().flatten().filter_map(toml::Value::as_str) {
            let (name, named) = need.split_once(' ').unwrap_or((need, ""));
            let known = by_name.get(name).with_context(|| format!("{need} is not there"))?;
            let only = known.first().filter(|_| known.len() == 1 || !named.is_empty());
            ensure!(only.is_some(), "{need} has several versions");
            let own = if named.is_empty() { only.map_or("", String::as_str) } else { named };
            needs.push(self::package(name, own));
        }
        found.insert(package, (word(one, "checksum"), needs));
    }
    Ok(found)
}
