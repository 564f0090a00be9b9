//! `cargo xtask site`: the documentation as a site in `target/site`: a book that mdBook makes of `docs`, the studio in
//! `studio/`, and the playground, which runs the listings of tutorials in the page.
//!
//!     cargo xtask site [--studio FOLDER] [--twice]
//!
//! Unless `--studio` names one that is there already, the studio is built. `--twice` builds the site a second time and
//! compares the two. A link that leads nowhere, or a page that would ask another host for anything, is an error.
//!
//! The pages are read on a forge as well, so they link to files of the repository. A book has only what is below one
//! folder: `pages` puts together what the pages need, and `check` judges the HTML that comes of it.

mod boards;
mod check;
mod html;
mod links;
mod listing;
mod pages;
mod summary;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail, ensure};

use crate::{say, studio, web};

/// The release of mdBook that the theme was made for.
const MDBOOK: &str = "0.5.4";

/// Paths of a tree, with `/` between the names, and what is there.
type Tree = BTreeMap<String, Vec<u8>>;

pub(crate) fn run(arguments: &[String]) -> Result<()> {
    let root = web::root()?;
    let (mut is_twice, mut folder) = (false, None);
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.as_str() {
            "--twice" => is_twice = true,
            "--studio" => folder = Some(rest.next().context("--studio needs a folder")?),
            other => bail!("site [--studio FOLDER] [--twice], not {other}"),
        }
    }
    let mdbook = mdbook()?;
    let studio = if let Some(folder) = folder {
        PathBuf::from(folder).canonicalize().with_context(|| folder.clone())?
    } else {
        studio::run()?;
        root.join("target/web/studio")
    };
    let site = root.join("target/site");
    let told = build(&root, &mdbook, &studio, &site)?;
    if is_twice {
        let again = root.join("target/site.again");
        build(&root, &mdbook, &studio, &again)?;
        let differing = differences(&tree(&site)?, &tree(&again)?);
        ensure!(differing.is_empty(), "a second build differs: {}", differing.join(", "));
        fs::remove_dir_all(&again)?;
        say("a second build has the same bytes\n")?;
    }
    fs::write(root.join("target/site.external.txt"), told.external.join("\n") + "\n")?;
    say(&format!(
        "{}: {} pages, {} links within the site, all good; {} links elsewhere are in target/site.external.txt\n",
        site.display(),
        told.pages,
        told.links,
        told.external.len(),
    ))
}

/// Where mdBook is; another release than the theme's is refused.
fn mdbook() -> Result<String> {
    let program = std::env::var("MDBOOK").unwrap_or_else(|_| "mdbook".to_owned());
    let how = format!("cargo install --locked --debug --version {MDBOOK} mdbook");
    let output = Command::new(&program).arg("--version").output();
    let output = output.with_context(|| format!("{program} is missing: {how}"))?;
    let version = String::from_utf8_lossy(&output.stdout).trim().to_owned();
    let is_right = version == format!("mdbook v{MDBOOK}");
    ensure!(is_right, "{program} is {version}, and the site needs {MDBOOK}: {how}");
    Ok(program)
}

/// Builds the site beside its place, judges it, and puts it there.
fn build(root: &Path, mdbook: &str, studio: &Path, site: &Path) -> Result<check::Told> {
    ensure!(studio.join("index.html").is_file(), "there is no studio in {}", studio.display());
    let (source, next) = (root.join("target/site.source"), root.join("target/site.next"));
    for folder in [&source, &next] {
        if folder.exists() {
            fs::remove_dir_all(folder)?;
        }
    }
    let book = pages::book(root)?;
    write(&source.join("src"), &book)?;
    fs::copy(root.join("docs/book.toml"), source.join("book.toml")).context("docs/book.toml")?;
    write(&source.join("theme"), &tree(&root.join("docs/theme"))?)?;
    fs::copy(root.join("web/static/icon.svg"), source.join("theme/favicon.svg"))?;
    scripts(root, studio, &source)?;
    let mut book = Command::new(mdbook);
    book.arg("build").arg(&source).arg("--dest-dir").arg(&next).env("RUST_LOG", "warn");
    ensure!(book.status()?.success(), "the book was not built");
    write(&next.join("playground"), &tree(&source.join("playground"))?)?;
    write(&next.join("studio"), &tree(studio)?)?;
    html::mend(&next)?;
    let told = check::judge(&tree(&next)?)?;
    if site.exists() {
        fs::remove_dir_all(site)?;
    }
    fs::rename(&next, site)?;
    Ok(told)
}

/// The scripts of the pages: what each page loads, and the playground, which it loads when somebody wants it.
fn scripts(root: &Path, studio: &Path, into: &Path) -> Result<()> {
    let folder = root.join("web");
    if !folder.join("node_modules").exists() {
        studio::npm(&folder, &["ci", "--no-audit", "--no-fund"])?;
    }
    let mut node = Command::new("node");
    node.current_dir(&folder).arg("book.mjs").arg("--studio").arg(studio).arg("--into").arg(into);
    let is_built = node.status().context("Node is missing: install Node 20 or later")?.success();
    ensure!(is_built, "the scripts of the site were not built");
    Ok(())
}

fn write(folder: &Path, tree: &Tree) -> Result<()> {
    for (name, bytes) in tree {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap_or(folder))?;
        fs::write(&path, bytes).with_context(|| path.display().to_string())?;
    }
    Ok(())
}

/// All files below a folder.
fn tree(folder: &Path) -> Result<Tree> {
    let (mut all, mut folders) = (Tree::new(), vec![folder.to_path_buf()]);
    while let Some(from) = folders.pop() {
        for entry in fs::read_dir(&from).with_context(|| from.display().to_string())? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder)?.to_string_lossy().replace('\\', "/");
                all.insert(name, fs::read(&path)?);
            }
        }
    }
    Ok(all)
}

/// The files that only one of two trees has, or that are not the same in both.
fn differences(one: &Tree, other: &Tree) -> Vec<String> {
    let names = one.keys().chain(other.keys().filter(|name| !one.contains_key(*name)));
    names.filter(|name| one.get(*name) != other.get(*name)).cloned().collect()
}
