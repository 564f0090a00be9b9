//! The user's tree of ChibiOS. In: a folder, and a board's requirements. Out: the full path of the folder.

use std::path::{Path, PathBuf};

use sensedsl_diagnostics::codes::{
    e0512_no_tree, e0513_not_a_tree, e0514_other_tree, e0515_tree_incomplete,
};
use sensedsl_diagnostics::{Diagnostic, Span};

use super::{Program, Wants};
use crate::files::shown;

/// The file without which a folder is not a tree.
const KERNEL: &str = "os/rt/rt.mk";

/// The files that tell the release of a tree, with the macro in each; the first file that exists counts.
const RELEASES: [(&str, &str); 2] =
    [("os/license/chversion.h", "CH_VERSION"), ("os/rt/include/ch.h", "CH_KERNEL_VERSION")];

/// The files of a demo's configuration that the generated files include.
const OF_CFG: [&str; 3] = ["chconf.h", "halconf.h", "mcuconf.h"];

/// The full path of the named tree, once it is known that the programs can be built with it.
pub(crate) fn tree(
    named: Option<&Path>,
    programs: &[(&Program, &Wants)],
    at: Span,
) -> Result<PathBuf, Box<Diagnostic>> {
    let version = programs.first().map_or("", |(_, wants)| wants.version.as_str());
    let tree = tree_of(named, version, at)?;
    let name = named.map(shown).unwrap_or_default();
    for (program, wants) in programs {
        let missing = missing(&tree, wants);
        if !missing.is_empty() {
            let board = &program.board;
            return Err(e0515_tree_incomplete::tree_incomplete(at, &name, board, &missing).into());
        }
    }
    Ok(tree)
}

/// The full path of the named tree, once it is known to be of that release; of any release if none is wanted.
pub(crate) fn tree_of(
    named: Option<&Path>,
    version: &str,
    at: Span,
) -> Result<PathBuf, Box<Diagnostic>> {
    let Some(named) = named.filter(|named| !named.as_os_str().is_empty()) else {
        return Err(e0512_no_tree::no_tree(at, version).into());
    };
    let name = shown(named);
    let not_a_tree = |why: &str| Err(e0513_not_a_tree::not_a_tree(at, &name, why, version).into());
    let tree = match named.canonicalize() {
        Ok(tree) if tree.is_dir() => tree,
        Ok(_) => return not_a_tree("it is a file"),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return not_a_tree("there is no such folder");
        }
        Err(error) => return not_a_tree(&error.to_string()),
    };
    if !tree.join(KERNEL).is_file() {
        return not_a_tree(&format!("it has no `{KERNEL}`"));
    }
    let full = shown(&tree);
    if let Some(sign) =
        full.chars().find(|c| c.is_whitespace() || "#$%:;\\*?[]'\"&|<>".contains(*c))
    {
        return Err(e0513_not_a_tree::not_readable(at, &full, sign).into());
    }
    let found = release(&tree);
    if !version.is_empty() && !is_of(&found, version) {
        return Err(e0514_other_tree::other_tree(at, &name, &found, version).into());
    }
    Ok(tree)
}

/// The release of a tree in its own words: `2021.11.5`, or `with kernel 7.0.6`.
pub(crate) fn release(tree: &Path) -> String {
    for (file, name) in RELEASES {
        let text = std::fs::read_to_string(tree.join(file)).unwrap_or_default();
        if let Some(value) = value(&text, name) {
            return if name == "CH_VERSION" { value } else { format!("with kernel {value}") };
        }
    }
    "of an unknown release".to_owned()
}

/// The value of a macro: `#define CH_VERSION "2021.11.5"`.
fn value(text: &str, name: &str) -> Option<String> {
    let mut defines = text.lines().filter_map(|line| line.trim().strip_prefix("#define"));
    let value = defines.find_map(|define| define.trim().strip_prefix(name)?.strip_prefix(' '))?;
    Some(value.trim().trim_matches('"').to_owned())
}

/// Whether `2021.11.5` or `21.11.5` belongs to `21.11`.
fn is_of(found: &str, version: &str) -> bool {
    let found = found.strip_prefix("20").unwrap_or(found);
    found.strip_prefix(version).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// The files that the tree lacks for a board. A folder that the Makefile names as a demo's configuration must have the
/// files that ours include.
fn missing(tree: &Path, wants: &Wants) -> Vec<String> {
    let mut missing = Vec::new();
    for path in &wants.paths {
        let there = tree.join(path);
        if !there.exists() {
            missing.push(path.clone());
        } else if path.starts_with("demos/") || path.starts_with("testhal/") {
            let absent = OF_CFG.iter().filter(|file| !there.join(file).is_file());
            missing.extend(absent.map(|file| format!("{path}/{file}")));
        }
    }
    missing
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn releases_are_read_and_compared() {
        let text =
            "#define CH_VERSION_STABLE       1\n#define CH_VERSION              \"2021.11.5\"\n";
        assert_eq!(value(text, "CH_VERSION").as_deref(), Some("2021.11.5"));
        assert_eq!(value(text, "CH_KERNEL_VERSION"), None);
        for (found, is) in [
            ("2021.11.5", true),
            ("21.11", true),
            ("2020.3.4", false),
            ("21.110.1", false),
            ("9.9.9", false),
            ("with kernel 7.0.6", false),
        ] {
            assert_eq!(is_of(found, "21.11"), is, "{found}");
        }
    }
}
