//! The changelog: fragments of `changes/` in, a section of `CHANGELOG.md` out.

use std::path::Path;

use anyhow::{Context as _, Result, ensure};

use crate::parts::sources;

/// The page.
pub(super) const PAGE: &str = "CHANGELOG.md";
/// The tasks, in the order in which the page has them.
const TASKS: [&str; 6] = ["Describe", "Wire", "Build", "Connect", "Simulate", "Embed"];
/// The most characters of a line.
const WIDTH: usize = 120;

/// What a file of `changes/` says.
#[derive(Debug)]
pub(super) struct Fragment {
    /// The name of the file.
    pub(super) file: String,
    task: String,
    text: String,
}

/// All of them, in the order of their names.
pub(super) fn fragments(folder: &Path) -> Result<Vec<Fragment>> {
    let mut all = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let file = entry?.file_name().to_string_lossy().into_owned();
        if file == "README.md" || !file.ends_with(".md") {
            continue;
        }
        let whole = sources::text(&folder.join(&file))?;
        let (task, text) = whole.split_once('\n').unwrap_or((&whole, ""));
        let task = task.trim().to_owned();
        ensure!(TASKS.contains(&task.as_str()), "changes/{file}: `{task}` is not a task");
        let text: Vec<&str> = text.split_whitespace().collect();
        ensure!(!text.is_empty(), "changes/{file} says nothing");
        all.push(Fragment { file, task, text: text.join(" ") });
    }
    all.sort_by(|one, other| one.file.cmp(&other.file));
    Ok(all)
}

/// The page with the fragments in the section of the version, and that section. A section that is not released yet
/// becomes that of the version; otherwise one is begun.
pub(super) fn renewed(
    page: &str,
    fragments: &[Fragment],
    version: &str,
    date: &str,
) -> Result<(String, String)> {
    let at = page.find("\n## ").context("the changelog has no section")? + 1;
    let (head, sections) = page.split_at(at);
    let end = sections.get(1..).and_then(|rest| Some(rest.find("\n## ")? + 2));
    let (first, older) = sections.split_at(end.unwrap_or(sections.len()));
    let (heading, body) = first.split_once('\n').unwrap_or((first, ""));
    let is_open = heading.ends_with("(not released)");
    ensure!(
        is_open || !fragments.is_empty(),
        "nothing has changed since {}: `changes/` is empty",
        heading.trim_start_matches("## ")
    );
    let (body, older) = if is_open { (body, older.to_owned()) } else { ("", sections.to_owned()) };
    let mut section = format!("## {version} ({date})\n");
    for task in TASKS {
        let mark = format!("\n### {task}\n");
        let own = body.split_once(&mark).map_or("", |(_, rest)| {
            rest.find("\n### ").and_then(|end| rest.get(..end)).unwrap_or(rest)
        });
        let new = fragments.iter().filter(|one| one.task == task);
        let new: String = new.map(|one| wrapped(&one.text)).collect();
        let own = own.trim();
        let gap = if own.is_empty() || new.is_empty() { "" } else { "\n" };
        if !own.is_empty() || !new.is_empty() {
            section.push_str(&format!("{mark}\n{own}{gap}{}\n", new.trim_end()));
        }
    }
    let gap = if older.is_empty() { "" } else { "\n" };
    Ok((format!("{head}{section}{gap}{older}"), section))
}

/// An entry of a list, in lines that are not too long.
fn wrapped(text: &str) -> String {
    let (mut lines, mut line) = (String::new(), "-".to_owned());
    for word in text.split(' ') {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push_str(&line);
            lines.push('\n');
            line = " ".to_owned();
        }
        line.push(' ');
        line.push_str(word);
    }
    format!("{lines}{line}\n")
}

/// What the page says of a version, without its heading.
pub(super) fn section_of<'p>(page: &'p str, version: &str) -> Option<&'p str> {
    let (_, rest) = page.split_once(&format!("\n## {version} ("))?;
    let (_, rest) = rest.split_once('\n')?;
    let end = rest.find("\n## ").unwrap_or(rest.len());
    rest.get(..end).map(str::trim)
}

/// Markdown as text for a tag: git takes lines that begin with `#` for remarks.
pub(super) fn plain(section: &str) -> String {
    section.replace("### ", "")
}
