//! Texts of the language: every file of the repository, every listing of the pages, and both with other spaces and other
//! values. Those that the compiler takes are what an editor has to understand.

use std::fs;
use std::path::{Path, PathBuf};

use sensedsl_tests::{Random, files, read, root};

/// Folders that are made.
const MADE: [&str; 4] = ["target", "build", "node_modules", "golden"];
/// What may stand in place of a space, and in place of a value, without being a mistake.
const SPACES: [&str; 6] = ["\n", " /* x */ ", " // x = \"\n", "\n\n\n", "\t", "\r\n"];
const VALUES: [&str; 23] = [
    "(1 + 2)",
    "N",
    "-N",
    "1 * 2",
    "- 3 / 4",
    "[1..2, 3]",
    "1..N",
    "+-1",
    "0x1F",
    "0XF0",
    "raw 307",
    "raw -20",
    "raw - 20",
    "raw",
    "--raw 1.5",
    "8N1",
    "P0.13",
    "20 deg/s",
    "[[1 -2], \"// \\u{b0}\"]",
    "9.8 m/s^2",
    "1e3kHz",
    "50 %",
    "0b1010_0000",
];

/// A text and where it is from.
#[derive(Debug)]
pub(super) struct Text {
    pub(super) name: String,
    pub(super) text: String,
}

/// All texts without a mistake of syntax: what is in files and on pages, then what comes of them by chance.
pub(super) fn accepted() -> Vec<Text> {
    let mut texts = as_written();
    let own = texts.len();
    assert!(own > 300, "{own} texts are left");
    let mut random = Random::new(0xED17);
    for at in 0..own {
        let changed = changed(&texts[at].text, &mut random);
        texts.push(Text { name: format!("{}, changed", texts[at].name), text: changed });
    }
    texts.retain(|text| is_accepted(&text.text));
    assert!(
        texts.len() > own + own / 2,
        "few of {own} texts can be changed: {}",
        texts.len() - own
    );
    texts
}

/// The texts of files and pages that the compiler takes.
pub(super) fn as_written() -> Vec<Text> {
    let paths = walk(&root(), "sense").into_iter();
    let of_files = paths.filter_map(|path| {
        // Some files of the corpus are not UTF-8.
        let text = String::from_utf8(fs::read(&path).unwrap()).ok()?;
        Some(Text { name: relative(&path), text })
    });
    let of_pages = walk(&root(), "md").into_iter().flat_map(|path| listings(&path));
    let mut texts: Vec<Text> = of_files.chain(of_pages).collect();
    texts.retain(|text| is_accepted(&text.text));
    texts
}

fn is_accepted(text: &str) -> bool {
    let parse = sensedsl_syntax::parse(text);
    parse.errors().is_empty() && parse.syntax().first_child().is_some()
}

/// The files with this ending, in order, except those that are made.
fn walk(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut paths = files(folder, ending);
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let mut folders: Vec<_> = entries.filter(|entry| entry.file_type().unwrap().is_dir()).collect();
    folders.retain(|entry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        !name.starts_with('.') && !MADE.contains(&name.as_str())
    });
    folders.sort_by_key(fs::DirEntry::file_name);
    paths.extend(folders.iter().flat_map(|entry| walk(&entry.path(), ending)));
    paths
}

fn relative(path: &Path) -> String {
    path.strip_prefix(root()).unwrap_or(path).display().to_string()
}

/// The listings of a page, by their line.
fn listings(path: &Path) -> Vec<Text> {
    let (page, mut found, mut open) = (read(path), Vec::new(), None);
    for (number, line) in (1..).zip(page.lines()) {
        if !line.starts_with("```") {
            if let Some(Text { text, .. }) = &mut open {
                text.push_str(line);
                text.push('\n');
            }
        } else if let Some(listing) = open.take() {
            found.push(listing);
        } else {
            open = Some(Text { name: format!("{}:{number}", relative(path)), text: String::new() });
        }
    }
    found
}

/// The same text with other spaces here and there, and other values.
fn changed(text: &str, random: &mut Random) -> String {
    let tree = sensedsl_syntax::parse(text).syntax();
    let mut out = String::new();
    let mut until = 0.into();
    for element in tree.descendants_with_tokens() {
        use sensedsl_syntax::SyntaxKind::{NameValue, Number, StringValue, Whitespace};
        if element.text_range().start() < until {
            continue;
        }
        let kind = element.kind();
        if matches!(kind, NameValue | Number | StringValue) && random.below(8) == 0 {
            out.push_str(VALUES[random.below(VALUES.len())]);
            until = element.text_range().end();
        } else if kind == Whitespace && random.below(16) == 0 {
            out.push_str(SPACES[random.below(SPACES.len())]);
        } else if let Some(token) = element.as_token() {
            out.push_str(token.text());
        }
    }
    out
}
