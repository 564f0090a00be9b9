//! The form of packed texts: paths and texts in, bytes out, and back.
//!
//! A head, an empty line, and what the head tells of. The head of a pack has a line for each group: its first path, how
//! many bytes it is of, and how many when it is deflated. The head of a group has a line for each file: its path, and how
//! many bytes it is of.

use std::sync::OnceLock;

use miniz_oxide::deflate::compress_to_vec;
use miniz_oxide::inflate::decompress_to_vec_with_limit;

/// The best that there is; it is done once, when a package is built.
pub(crate) const LEVEL: u8 = 10;
/// The bytes as they are, in the form of deflated ones.
#[cfg(feature = "build")]
pub(crate) const STORED: u8 = 0;
/// The texts of a group have so many bytes, unless there is a longer one. Deflating looks back half as far, and the first
/// answer waits for a group to be inflated: larger groups take longer and are hardly smaller.
const GROUP_BYTES: usize = 64 << 10;

/// Paths and texts.
type Files = Vec<(&'static str, &'static str)>;

/// Texts that are packed together.
#[derive(Debug)]
pub(crate) struct Group {
    /// The first path.
    pub(crate) first: &'static str,
    /// How many bytes are inflated.
    size: usize,
    packed: &'static [u8],
    files: OnceLock<Files>,
}

impl Group {
    /// Its files, in the order of their paths; none if it is damaged.
    pub(crate) fn files(&self) -> &[(&'static str, &'static str)] {
        self.files.get_or_init(|| files(self.packed, self.size).unwrap_or_default())
    }
}

/// Packs texts, each with its path: one line, with `/` between folders. The order does not matter.
#[must_use]
pub fn pack(files: Vec<(String, String)>) -> Vec<u8> {
    pack_at(LEVEL, files)
}

pub(crate) fn pack_at(level: u8, mut files: Vec<(String, String)>) -> Vec<u8> {
    files.sort_unstable();
    let (mut head, mut packed) = (String::new(), Vec::new());
    let mut rest = files.as_slice();
    while let Some((first, _)) = rest.first() {
        let (group, after) = rest.split_at_checked(length(rest)).unwrap_or((rest, &[]));
        rest = after;
        let bytes = unpacked(group);
        let deflated = compress_to_vec(&bytes, level);
        head.push_str(&format!("{first} {} {}\n", bytes.len(), deflated.len()));
        packed.extend(deflated);
    }
    [head.as_bytes(), b"\n", &packed].concat()
}

/// How many of the files are the first group: they are in one folder.
fn length(files: &[(String, String)]) -> usize {
    let Some((first, _)) = files.first() else { return 0 };
    let mut bytes = 0;
    let fits = |(path, text): &&(String, String)| {
        bytes += text.len();
        folder_of(path) == folder_of(first) && bytes <= GROUP_BYTES
    };
    files.iter().take_while(fits).count().max(1)
}

/// The outermost folder of a path.
pub(crate) fn folder_of(path: &str) -> &str {
    path.split_once('/').map_or(path, |(folder, _)| folder)
}

fn unpacked(files: &[(String, String)]) -> Vec<u8> {
    let mut all: String =
        files.iter().map(|(path, text)| format!("{path} {}\n", text.len())).collect();
    all.push('\n');
    all.extend(files.iter().map(|(_, text)| text.as_str()));
    all.into_bytes()
}

/// The groups of a pack; none if it is damaged.
pub(crate) fn groups(bytes: &'static [u8]) -> Option<Vec<Group>> {
    let end = bytes.windows(2).position(|two| two == b"\n\n")? + 1;
    let (head, rest) = bytes.split_at_checked(end)?;
    let mut rest = rest.get(1..)?;
    let line = |line: &'static str| {
        let (line, length) = numbered(line)?;
        let (first, size) = numbered(line)?;
        let (packed, after) = rest.split_at_checked(length)?;
        rest = after;
        Some(Group { first, size, packed, files: OnceLock::new() })
    };
    str::from_utf8(head).ok()?.lines().map(line).collect()
}

fn files(packed: &[u8], size: usize) -> Option<Files> {
    let bytes = decompress_to_vec_with_limit(packed, size).ok()?;
    let text: &'static str = String::from_utf8(bytes).ok()?.leak();
    let (head, mut rest) = text.split_once("\n\n")?;
    let line = |line: &'static str| {
        let (path, length) = numbered(line)?;
        let (one, after) = rest.split_at_checked(length)?;
        rest = after;
        Some((path, one))
    };
    head.lines().map(line).collect()
}

/// A line without the number at its end, and the number.
fn numbered(line: &str) -> Option<(&str, usize)> {
    let (line, number) = line.rsplit_once(' ')?;
    Some((line, number.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::Pack;

    fn packed(files: &[(&str, &str)]) -> Vec<u8> {
        let owned = |(path, text): &(&str, &str)| ((*path).to_owned(), (*text).to_owned());
        pack(files.iter().map(owned).collect())
    }

    #[test]
    fn texts_that_are_alike_take_little_room() {
        let text: String = (0..2_000).map(|n| format!("PA{n},TIM{}_CH1\n", n % 7)).collect();
        let names: Vec<String> = (0..40).map(|n| format!("boards/{n:02}/pins.csv")).collect();
        let files: Vec<(&str, &str)> = names.iter().map(|name| (name.as_str(), &*text)).collect();
        let bytes = packed(&files);
        assert!(bytes.len() * 8 < text.len() * files.len(), "{}", bytes.len());
        assert!(groups(bytes.leak()).unwrap().len() > 5, "each answer would inflate all");
    }

    #[test]
    fn a_folder_has_its_files_in_order() {
        let files = [("b/2", "two"), ("a", "alone"), ("b/10", "ten"), ("bb/1", ""), ("a/x/y", "z")];
        let pack = Pack::new(packed(&files).leak());
        assert_eq!(pack.folder("b").collect::<Vec<_>>(), [("b/10", "ten"), ("b/2", "two")]);
        assert_eq!(pack.folder("bb").collect::<Vec<_>>(), [("bb/1", "")]);
        assert_eq!(pack.folder("c").count(), 0);
        for (path, text) in files {
            assert_eq!(pack.text(path), text);
        }
        for path in ["", "b", "b/", "b/1", "b/3", "z"] {
            assert_eq!(pack.text(path), "", "{path}");
        }
    }

    proptest! {
        #[test]
        fn what_is_packed_comes_back(
            files in proptest::collection::btree_map("[ab]{1,2}/[a-c ]{1,3}", "[\\PC\n]{0,40}", 0..30),
        ) {
            let bytes = pack(files.clone().into_iter().rev().collect());
            prop_assert_eq!(&bytes, &pack(files.clone().into_iter().collect()));
            let pack = Pack::new(bytes.leak());
            for (path, text) in &files {
                prop_assert_eq!(pack.text(path), text);
            }
        }

        #[test]
        fn damaged_bytes_are_no_panic(at in 0_usize..400, byte in any::<u8>(), is_cut in any::<bool>()) {
            let files = [("a/1", "one text"), ("a/2", "another text"), ("b/1", "a third one")];
            let mut bytes = packed(&files);
            let at = at % bytes.len();
            if is_cut { bytes.truncate(at) } else { bytes[at] = byte }
            let pack = Pack::new(bytes.leak());
            for (path, _) in files {
                prop_assert!(pack.text(path).len() < 100);
            }
        }
    }
}
