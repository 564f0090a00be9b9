//! Where the version of the project stands: the text of a file in, the text with another version out.

use anyhow::{Result, ensure};

/// Where people read whom to cite.
pub(super) const CITATION: &str = "CITATION.cff";

/// A file that has the version.
pub(super) struct Place {
    pub(super) path: &'static str,
    /// What stands before the version in its line, and after it.
    around: [&'static str; 2],
    /// How often; none where every line counts that has it.
    pub(super) times: Option<usize>,
}

const fn once(path: &'static str, around: [&'static str; 2]) -> Place {
    Place { path, around, times: Some(1) }
}

/// All of them, but for the lock files of cargo, which cargo writes.
pub(super) const PLACES: &[Place] = &[
    // The crates of the workspace, which need one another by path and version.
    Place { path: "Cargo.toml", around: ["version = \"", "\""], times: None },
    once("crates/wasm/package.json", ["\"version\": \"", "\""]),
    once("editors/emacs/sensedsl-mode.el", [";; Version: ", "\n"]),
    once("editors/tree-sitter-sensedsl/package.json", ["\"version\": \"", "\""]),
    once("editors/tree-sitter-sensedsl/tree-sitter.json", ["\"version\": \"", "\""]),
    once("editors/vscode/package.json", ["\"version\": \"", "\""]),
    Place {
        path: "editors/vscode/package-lock.json",
        around: ["\"version\": \"", "\""],
        times: Some(2),
    },
    once("editors/zed/Cargo.toml", ["version = \"", "\""]),
    once("editors/zed/extension.toml", ["version = \"", "\""]),
    once("web/package.json", ["\"version\": \"", "\""]),
    Place { path: "web/package-lock.json", around: ["\"version\": \"", "\""], times: Some(2) },
];

/// The version now, from the manifest of the workspace.
pub(super) fn current(manifest: &str) -> Result<String> {
    let manifest: toml::Table = manifest.parse()?;
    let package = manifest.get("workspace").and_then(|workspace| workspace.get("package"));
    let version = package.and_then(|package| package.get("version")?.as_str());
    ensure!(version.is_some(), "the workspace has no version");
    Ok(version.unwrap_or_default().to_owned())
}

impl Place {
    /// The text with the new version.
    pub(super) fn renewed(&self, text: &str, old: &str, new: &str) -> Result<String> {
        let [before, after] = self.around;
        let (is, shall) = (format!("{before}{old}{after}"), format!("{before}{new}{after}"));
        let is_own = |line: &str| {
            self.times.is_some() || line.starts_with(&is) || line.contains("path = \"crates/")
        };
        let (mut renewed, mut times) = (String::new(), 0);
        for line in text.split_inclusive('\n') {
            let wanted = self.times.is_none_or(|all| times < all);
            if wanted && is_own(line) && line.contains(&is) {
                times += 1;
                renewed.push_str(&line.replacen(&is, &shall, 1));
            } else {
                renewed.push_str(line);
            }
        }
        let expected = self.times.unwrap_or(1);
        ensure!(times >= expected, "{} does not have the version {old}", self.path);
        Ok(renewed)
    }
}

/// `CITATION.cff` with version and date, which stand after the title.
pub(super) fn cited(text: &str, version: &str, date: &str) -> String {
    let mut cited = String::new();
    for line in text.split_inclusive('\n') {
        if line.starts_with("version:") || line.starts_with("date-released:") {
            continue;
        }
        cited.push_str(line);
        if line.starts_with("title:") {
            cited.push_str(&format!("version: {version}\ndate-released: {date}\n"));
        }
    }
    cited
}
