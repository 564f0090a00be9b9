//! Files of a crate that need each other: at most three in a circle, so that each can be read without the rest.
//!
//! A path is followed through the `use` of a facade to the file that defines the item; a re-export that the file itself
//! does not name is no need. Code for tests does not count.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use sensedsl_tests::{TempDir, root, tree};

/// The most files that may need each other.
const CIRCLE_MAX: usize = 3;

/// A module, by the names of its parents and its own.
type Module = Vec<String>;

/// What a file says of others.
#[derive(Default)]
struct Source {
    children: BTreeSet<String>,
    /// The path behind each name that a `use` brings, and whether it is public.
    uses: BTreeMap<String, (Vec<String>, bool)>,
    /// All other paths, and all single names.
    paths: Vec<Vec<String>>,
    names: BTreeSet<String>,
}

/// The words and signs of a file without comments, strings and characters; `::` is one sign.
fn tokens(text: &str) -> Vec<String> {
    let chars: Vec<char> = text.chars().collect();
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let (mut at, mut tokens) = (0, Vec::new());
    while let Some(&c) = chars.get(at) {
        let rest = |count: usize| chars[at..chars.len().min(at + count)].iter().collect::<String>();
        if rest(2) == "//" {
            at += chars[at..].iter().take_while(|c| **c != '\n').count();
        } else if rest(3) == "r#\"" {
            at += 3;
            while at < chars.len() && !(chars[at] == '"' && chars.get(at + 1) == Some(&'#')) {
                at += 1;
            }
            at += 2;
        } else if c == '"' || (c == '\'' && (rest(2) == "'\\" || chars.get(at + 2) == Some(&'\'')))
        {
            at += 1;
            while at < chars.len() && chars[at] != c {
                at += if chars[at] == '\\' { 2 } else { 1 };
            }
            at += 1;
        } else if is_word(c) {
            let word: String = chars[at..].iter().take_while(|c| is_word(**c)).collect();
            at += word.chars().count();
            tokens.push(word);
        } else {
            let sign = if rest(2) == "::" { "::".to_owned() } else { c.to_string() };
            at += sign.len().max(1);
            if !c.is_whitespace() {
                tokens.push(sign);
            }
        }
    }
    tokens
}

/// Leaves out what is only compiled for tests: an item behind `#[cfg(test)]`.
fn without_tests(tokens: Vec<String>) -> Vec<String> {
    let mark = ["#", "[", "cfg", "(", "test", ")", "]"];
    let (mut at, mut kept) = (0, Vec::new());
    while at < tokens.len() {
        if !tokens[at..].iter().zip(mark).all(|(have, want)| have == want) || tokens.len() - at < 7
        {
            kept.push(tokens[at].clone());
            at += 1;
            continue;
        }
        at += mark.len();
        let mut depth = 0_i32;
        while at < tokens.len() {
            depth += i32::from(matches!(tokens[at].as_str(), "{" | "[" | "("));
            depth -= i32::from(matches!(tokens[at].as_str(), "}" | "]" | ")"));
            let is_end = depth == 0 && matches!(tokens[at].as_str(), "}" | ";");
            at += 1;
            if is_end {
                break;
            }
        }
    }
    kept
}

/// Reads one `use` tree, up to its end, with the path before it.
fn use_tree(
    tokens: &[String],
    at: &mut usize,
    before: &[String],
    found: &mut Vec<(String, Vec<String>)>,
) {
    let (mut path, mut is_empty) = (before.to_vec(), true);
    while let Some(token) = tokens.get(*at) {
        match token.as_str() {
            "::" => {}
            "{" => {
                while !matches!(tokens.get(*at).map(String::as_str), Some("}") | None) {
                    *at += 1;
                    use_tree(tokens, at, &path, found);
                }
                *at += 1;
                return;
            }
            "as" => {
                found.push((tokens[*at + 1].clone(), path));
                *at += 2;
                return;
            }
            // A comma stands before it.
            "}" if is_empty => return,
            ";" | "," | "}" => break,
            "self" if !path.is_empty() => {}
            word => path.push(word.to_owned()),
        }
        is_empty = false;
        *at += 1;
    }
    found.extend(path.last().cloned().map(|name| (name, path)));
}

fn source(text: &str) -> Source {
    let tokens = without_tests(tokens(text));
    let mut source = Source::default();
    let mut at = 0;
    while at < tokens.len() {
        let is_at = |place: usize, sign: &str| tokens.get(place).is_some_and(|one| one == sign);
        if is_at(at, "mod") && is_at(at + 2, ";") {
            source.children.insert(tokens[at + 1].clone());
            at += 3;
        } else if is_at(at, "use") {
            let is_public = at > 0 && matches!(tokens[at - 1].as_str(), "pub" | ")");
            let mut found = Vec::new();
            at += 1;
            use_tree(&tokens, &mut at, &[], &mut found);
            source.uses.extend(found.into_iter().map(|(name, path)| (name, (path, is_public))));
        } else {
            let mut path = vec![tokens[at].clone()];
            let is_start = at == 0 || tokens[at - 1] != "::";
            while is_at(at + 1, "::")
                && tokens.get(at + 2).is_some_and(|one| one != "<" && one != "{")
            {
                path.push(tokens[at + 2].clone());
                at += 2;
            }
            source.names.extend(path.first().cloned().filter(|_| is_start));
            if is_start && path.len() > 1 {
                source.paths.push(path);
            }
            at += 1;
        }
    }
    source
}

/// The file that defines what a path in a module leads to; `None` outside the crate.
fn leads_to(
    all: &BTreeMap<Module, Source>,
    from: &Module,
    path: &[String],
    depth: u8,
) -> Option<Module> {
    let own = &all[from];
    let ups = path.iter().take_while(|one| *one == "super").count();
    let (mut at, mut rest) = match path.first()?.as_str() {
        "crate" => (Vec::new(), &path[1..]),
        "super" => (from[..from.len().checked_sub(ups)?].to_vec(), &path[ups..]),
        "self" => (from.clone(), &path[1..]),
        first if own.children.contains(first) => (from.clone(), path),
        _ => return None,
    };
    while let Some((next, after)) = rest.split_first() {
        let child: Module = at.iter().chain([next]).cloned().collect();
        if !all.contains_key(&child) {
            break;
        }
        (at, rest) = (child, after);
    }
    let behind = rest.first().and_then(|name| Some(&all.get(&at)?.uses.get(name)?.0));
    match behind {
        Some(path) if depth < 8 => {
            let is_inside = ["crate", "super", "self"].contains(&path[0].as_str())
                || all[&at].children.contains(&path[0]);
            if is_inside { leads_to(all, &at, path, depth + 1) } else { None }
        }
        _ => all.contains_key(&at).then_some(at),
    }
}

/// The modules of a crate, and those that each needs.
fn needs(folder: &Path) -> BTreeMap<Module, BTreeSet<Module>> {
    let mut all = BTreeMap::new();
    for (name, bytes) in tree(folder) {
        let Some(inside) = name.strip_suffix(".rs") else { continue };
        let mut module: Module = inside.split('/').map(str::to_owned).collect();
        if module.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
            module.pop();
        }
        all.insert(module, source(&String::from_utf8(bytes).unwrap()));
    }
    let of = |module: &Module| {
        let own = &all[module];
        let brought = own
            .uses
            .iter()
            .filter(|(name, (_, is_public))| !is_public || own.names.contains(*name));
        let paths = brought.map(|(_, (path, _))| path).chain(&own.paths);
        let mut needed: BTreeSet<Module> =
            paths.filter_map(|path| leads_to(&all, module, path, 0)).collect();
        needed.remove(module);
        (module.clone(), needed)
    };
    all.keys().map(of).collect()
}

/// All that a module needs, and what that needs.
fn reach<'a>(
    needs: &'a BTreeMap<Module, BTreeSet<Module>>,
    from: &'a Module,
) -> BTreeSet<&'a Module> {
    let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(next) = open.pop() {
        open.extend(needs[next].iter().filter(|one| seen.insert(*one)));
    }
    seen
}

/// The circles of more than [`CIRCLE_MAX`] files, by the names of their modules.
fn circles(needs: &BTreeMap<Module, BTreeSet<Module>>) -> BTreeSet<String> {
    let reached: BTreeMap<&Module, BTreeSet<&Module>> =
        needs.keys().map(|module| (module, reach(needs, module))).collect();
    let mut circles = BTreeSet::new();
    for (module, from) in &reached {
        let circle = from.iter().filter(|one| reached[**one].contains(module));
        let names: Vec<String> = circle.map(|one| one.join("::")).collect();
        if names.len() > CIRCLE_MAX {
            circles.insert(names.join(" "));
        }
    }
    circles
}

#[test]
fn at_most_three_files_need_each_other() {
    let (mut found, mut modules) = (Vec::new(), 0);
    for entry in std::fs::read_dir(root().join("crates")).unwrap() {
        let folder = entry.unwrap().path().join("src");
        let needs = needs(&folder);
        modules += needs.len();
        found.extend(circles(&needs).into_iter().map(|circle| format!("{folder:?}: {circle}")));
    }
    assert!(found.is_empty(), "move what they share into a file of its own:\n{}", found.join("\n"));
    assert!(modules > 500, "{modules}");
}

/// Four files in a circle are found, also through a facade and through a path in the code.
#[test]
fn a_circle_is_found() {
    let folder = TempDir::new("circle");
    let write = |name, text: &str| folder.write(name, text);
    write("lib.rs", "mod a; mod b; mod c; mod d; pub use c::C; // b::B");
    write("a.rs", "use crate::b::{self, B as Other};");
    write("b.rs", "use super::{c::{self}, C,};");
    write("c.rs", "pub struct C; fn f() -> &'static str { crate::d::D; \"super::a\" }");
    write("d.rs", "#[cfg(test)] mod tests { use crate::a::A; }");
    assert_eq!(circles(&needs(folder.path())), BTreeSet::new());
    write("d.rs", "use crate::a::A;");
    assert_eq!(circles(&needs(folder.path())), BTreeSet::from(["a b c d".to_owned()]));
}
