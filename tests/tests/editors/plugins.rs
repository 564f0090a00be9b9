//! Neovim, Vim and Emacs with the files of `editors/`: a `.sense` file gets its type, its comments, its colours, and the
//! indentation that `sensedsl fmt` has; Neovim takes the compiled tree-sitter grammar too.

use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use sensedsl_tests::{TempDir, files, has, read, root, run};
use serde_json::Value;

use super::classes::{Class, classes};
use super::tree_sitter::folder;

/// The examples, and what has every word of the language.
fn paths() -> Vec<PathBuf> {
    let folders = ["examples", "crates/syntax/tests/samples", "tests/editors", "tests/robots"];
    folders.iter().flat_map(|folder| files(&root().join(folder), "sense")).collect()
}

/// Asks an editor about files; the words of each come back with its answer. Its settings are in `home`.
fn ask(paths: &[PathBuf], home: &Path, editor: &mut Command) -> Vec<Value> {
    let scratch = TempDir::new("editor");
    let request: Vec<(PathBuf, Vec<(usize, usize)>)> = (paths.iter().enumerate())
        .map(|(number, path)| {
            let text = read(path);
            let places = classes(&text).into_iter().map(|(from, ..)| place(&text, from)).collect();
            // Editors lock a file that they change, beside it.
            (scratch.write(&format!("{number}.sense"), text), places)
        })
        .collect();
    let words = scratch.write("words.json", serde_json::to_vec(&request).unwrap());
    let answer = scratch.join("answer.json");
    editor.env("WORDS", words).env("ANSWER", &answer).env("HOME", home).stdin(Stdio::null());
    editor.env_remove("XDG_CONFIG_HOME").env_remove("XDG_DATA_HOME");
    let _ = run(editor);
    let answers: Vec<Value> = serde_json::from_str(&read(&answer)).unwrap();
    assert_eq!(answers.len(), paths.len());
    answers
}

/// Line and column of a byte, from 1.
fn place(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at];
    (before.matches('\n').count() + 1, at - before.rfind('\n').map_or(0, |end| end + 1) + 1)
}

#[track_caller]
fn check(
    paths: &[PathBuf],
    answers: &[Value],
    filetype: &str,
    colour: fn(Class) -> &'static [&'static str],
) {
    for (path, answer) in paths.iter().zip(answers) {
        let (text, name) = (read(path), path.display());
        assert_eq!(answer["filetype"], filetype, "{name}");
        let comment = answer["comment"].as_str().unwrap();
        assert!(comment.starts_with("// "), "{name}: {comment}");
        let colours = answer["colours"].as_array().unwrap();
        for ((from, to, class), found) in classes(&text).into_iter().zip(colours) {
            let found = found.as_str().unwrap_or_default();
            let at = place(&text, from);
            assert!(
                colour(class).contains(&found),
                "{name}:{at:?}: `{}` is {found:?}",
                &text[from..to]
            );
        }
        assert_eq!(answer["text"], text, "{name}, indented anew");
    }
}

/// The README's link, from where an editor looks for packages.
fn linked(packages: &Path) {
    std::fs::create_dir_all(packages).unwrap();
    symlink(root().join("editors/neovim"), packages.join("sensedsl")).unwrap();
}

fn words_of_vim(class: Class) -> &'static [&'static str] {
    match class {
        Class::Comment => &["sensedslComment"],
        Class::Constant => &["sensedslName", "sensedslConst", "sensedslResource", "sensedslCode"],
        Class::Device => &["sensedslDevice", "sensedslController"],
        Class::Function => &["sensedslFunction"],
        Class::Keyword => &[
            "sensedslKeyword",
            "sensedslOn",
            "sensedslFor",
            "sensedslVerb",
            "sensedslRaw",
            "sensedslJoint",
        ],
        Class::Number => &["sensedslNumber"],
        Class::Property => &["sensedslProperty", "sensedslMember"],
        Class::Text => &["sensedslString"],
        Class::Thing => &["sensedslThing"],
        Class::Type => &["sensedslType"],
        Class::Unit => &["sensedslUnit"],
    }
}

fn script() -> String {
    format!("source {}", root().join("tests/editors/answers.vim").display())
}

#[test]
fn neovim_opens_files() {
    if !has("nvim") || !has("gcc") {
        return;
    }
    let home = TempDir::new("neovim");
    let site = home.join(".local/share/nvim/site");
    linked(&site.join("pack/sensedsl/start"));
    for has_parser in [false, true] {
        if has_parser {
            std::fs::create_dir_all(site.join("parser")).unwrap();
            let mut gcc = Command::new("gcc");
            gcc.args(["-shared", "-fPIC", "-O1", "-I"]).arg(folder().join("src"));
            gcc.arg(folder().join("src/parser.c")).arg("-o").arg(site.join("parser/sensedsl.so"));
            let _ = run(&mut gcc);
        }
        let mut nvim = Command::new("nvim");
        nvim.args(["--headless", "-n", "-i", "NONE", "-u", "NORC", "-c", &script()]);
        let paths = paths();
        let answers = ask(&paths, home.path(), &mut nvim);
        for answer in &answers {
            assert_eq!(answer["tree_sitter"], has_parser);
        }
        check(&paths, &answers, "sensedsl", words_of_vim);
    }
}

#[test]
fn vim_opens_files() {
    if !has("vim") {
        return;
    }
    let home = TempDir::new("vim");
    linked(&home.join(".vim/pack/sensedsl/start"));
    let mut vim = Command::new("vim");
    // Without a terminal, and with what stands beside its settings.
    vim.args(["-es", "-N", "-n", "-i", "NONE", "-u", "NORC", "-c", &script()]);
    let paths = paths();
    check(&paths, &ask(&paths, home.path(), &mut vim), "sensedsl", words_of_vim);
}

#[test]
fn emacs_opens_files() {
    if !has("emacs") {
        return;
    }
    let mut emacs = Command::new("emacs");
    // Debian's start file makes its packages known, Eglot among them.
    emacs.args(["--batch", "--no-init-file", "-l"]).arg(root().join("tests/editors/emacs.el"));
    emacs.env("MODE", root().join("editors/emacs"));
    let paths = paths();
    let home = TempDir::new("emacs");
    let answers = ask(&paths, home.path(), &mut emacs);
    for (path, answer) in paths.iter().zip(&answers) {
        assert_eq!(answer["toggled"], true, "{}, commented and back", path.display());
    }
    check(&paths, &answers, "sensedsl-mode", |class| match class {
        Class::Comment => &["font-lock-comment-delimiter-face", "font-lock-comment-face"],
        // A word as a value is plain.
        Class::Constant => &["font-lock-constant-face", "nil", ""],
        Class::Device => &["font-lock-function-name-face"],
        Class::Keyword => &["font-lock-keyword-face"],
        Class::Number => &["font-lock-constant-face"],
        Class::Property => &["font-lock-variable-name-face"],
        Class::Text => &["font-lock-string-face"],
        Class::Thing => &["font-lock-type-face"],
        Class::Function | Class::Type | Class::Unit => &["font-lock-builtin-face"],
    });
}
