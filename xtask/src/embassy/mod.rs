//! `cargo xtask profiles embassy [--check]`: writes the target profiles for Embassy, or compares them.
//!
//! In: the metadata of the crate `stm32-metapac`, from which `embassy-stm32` itself is also made, and `facts.toml`,
//! which has the facts that are kept by hand. Out: a file for each family in `targets/embassy-0.6/`.

mod facts;
mod lines;
mod metadata;
mod print;

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Result, bail, ensure};

use crate::parts::sources;
use facts::Facts;
use metadata::Chip;

/// Runs the command.
pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let is_check = match arguments {
        [] => false,
        [one] if one == "--check" => true,
        _ => bail!("cargo xtask profiles embassy [--check]"),
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = sources::fetch(&root)?.metapac;
    let facts = Facts::read()?;
    let mut families: BTreeMap<String, Vec<Chip>> = BTreeMap::new();
    for chip in metadata::read(&folder)? {
        if facts.without.iter().any(|start| chip.name.starts_with(start)) {
            continue;
        }
        // Variants with the same name differ in ways that no part number tells.
        if facts.family.contains_key(&chip.family) && !chip.name.contains('-') {
            families.entry(chip.family.clone()).or_default().push(chip);
        }
    }
    let target = root.join("crates/board/targets").join(&facts.target);
    std::fs::create_dir_all(&target)?;
    let mut stale = Vec::new();
    for (family, chips) in &families {
        let text = print::file(&facts, family, chips, &folder)?;
        let path = target.join(format!("{}.toml", family.to_lowercase()));
        if !sources::is_fresh(&path, &text, is_check)? {
            stale.push(family.as_str());
        }
    }
    ensure!(stale.is_empty(), "not as they would be written: {}", stale.join(", "));
    crate::say(&format!("{} families of {}\n", families.len(), facts.target))
}
