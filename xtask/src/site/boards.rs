//! A page with a picture for each built-in board, and what `docs/boards.md` has of them in the book.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use sensedsl_board::catalog::{self, Entry as Board};
use sensedsl_board::mcu;
use sensedsl_generate::target::systems_of;
use sensedsl_report::svg;
use sensedsl_session::boards::{free, links, package};

use super::Tree;
use super::listing::escaped;
use super::summary::Entry;

/// Puts the pages of all boards into the book; what they are called, and where they are.
pub(super) fn pages(tree: &mut Tree) -> Vec<Entry> {
    let mut all = Vec::new();
    for board in catalog::all() {
        let picture = svg::of_built_in(board);
        tree.insert(place(board, "md"), page(board, picture.as_deref()).into_bytes());
        if let Some(picture) = picture {
            tree.insert(place(board, "svg"), picture.into_bytes());
        }
        all.push((board.name.to_owned(), place(board, "md")));
    }
    all
}

fn place(board: &Board, end: &str) -> String {
    format!("boards/{}.{end}", board.name)
}

/// The name as a file writes it.
fn written(board: &Board) -> String {
    board.name.replace('-', "_")
}

fn page(board: &Board, picture: Option<&str>) -> String {
    let Board { name, mcu, description, aliases, .. } = board;
    let table = board.table();
    let mut page = format!("# {name}\n\n{description}\n\n");
    let mut fact = |what: &str, value: &str| {
        if !value.is_empty() {
            // A string always takes what is written.
            let _ = writeln!(page, "- **{what}**: {value}");
        }
    };
    fact("Also called", &aliases.join(", "));
    let package = package(board).map(|package| format!(" in {package}")).unwrap_or_default();
    fact("MCU", &format!("{mcu}{package}"));
    fact("Free pins", &format!("{} of {}", free(&table), table.pins.len()));
    fact("Link to a host", &links(board).join(", "));
    let systems = systems_of(board);
    let none = "none yet: it can be wired, drawn and simulated";
    fact(
        "Firmware",
        if systems.is_empty() { none.to_owned() } else { systems.join(", ") }.as_str(),
    );
    if picture.is_some() {
        let _ = write!(page, "\n[![The contacts of {name}]({name}.svg)]({name}.svg)\n");
    }
    let listing = format!(
        "board Robot on {} {{\n    sensor Light returns uint16 {{ type = analog; }}\n}}\n",
        written(board),
    );
    let block = super::listing::Block { indent: "", info: "sense robot.sense", text: listing };
    let _ = write!(page, "\n## Try it\n\n{}", super::listing::written(&block));
    let _ = write!(
        page,
        "\n`sensedsl boards {name}` prints the [table](../board-tables.html) of its pins. All boards are on [one \
         page](../boards.html).\n",
    );
    page
}

/// A line of `docs/boards.md`: a family has its pictures below its heading, a row leads to the page of its board.
pub(super) fn line(line: &str) -> String {
    if let Some(family) = line.strip_prefix("## ") {
        return format!("{line}\n\n{}", gallery(family));
    }
    let cell = line.strip_prefix("| ").and_then(|rest| rest.split_once(" |"));
    match cell.and_then(|(name, rest)| Some((catalog::find(name)?, rest))) {
        Some((board, rest)) => format!("| [{name}](boards/{name}.html) |{rest}", name = board.name),
        None => line.to_owned(),
    }
}

/// The pictures of a family's boards. They are fetched when they come into view.
fn gallery(family: &str) -> String {
    let mut cards = String::new();
    for board in catalog::all().iter().filter(|board| mcu::family(board.mcu) == family) {
        let Some(picture) = svg::of_built_in(board) else { continue };
        let size = size(&picture);
        let (name, about) = (board.name, escaped(board.description));
        let _ = writeln!(
            cards,
            "<li><a href=\"boards/{name}.html\" title=\"{about}\"><img src=\"boards/{name}.svg\" alt=\"\" \
             loading=\"lazy\"{size}><span>{name}</span></a></li>",
        );
    }
    if cards.is_empty() { cards } else { format!("<ul class=\"boards\">\n{cards}</ul>\n") }
}

/// Width and height of a picture, so that the page does not move when it comes.
fn size(picture: &str) -> String {
    let head = picture.split('>').next().unwrap_or("");
    let words = head.split_whitespace().filter_map(|word| word.split_once('='));
    let of: BTreeMap<&str, &str> = words.collect();
    let of = |name: &str| of.get(name).map(|size| format!(" {name}={size}")).unwrap_or_default();
    of("width") + &of("height")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_board_has_a_page_and_its_family_shows_it() {
        let mut tree = Tree::new();
        let all = pages(&mut tree);
        assert_eq!(all.len(), catalog::all().len());
        let board = catalog::find("NUCLEO_F401RE").unwrap();
        let page = String::from_utf8(tree[&place(board, "md")].clone()).unwrap();
        assert!(page.contains("- **MCU**: STM32F401RET6 in LQFP64"), "{page}");
        assert!(page.contains("data-run"), "{page}");
        assert!(tree[&place(board, "svg")].starts_with(b"<svg"));
        let family = line(&format!("## {}", mcu::family(board.mcu)));
        assert!(family.contains("<a href=\"boards/NUCLEO-F401RE.html\""), "{family}");
        let row = line("| NUCLEO-F401RE | x |");
        assert_eq!(row, "| [NUCLEO-F401RE](boards/NUCLEO-F401RE.html) | x |");
    }
}
