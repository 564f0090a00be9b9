//! The text of a driver of the library: a name in; the driver as it stands in its file, with the comment above it, out.

use sensedsl_diagnostics::SourceMap;
use sensedsl_syntax::ast::AstNode as _;

use crate::driver::Drivers;

/// The text of the driver with that name, or of the part with that name.
#[must_use]
pub fn source(name: &str) -> Option<String> {
    let drivers = Drivers::new(&[], &mut SourceMap::default(), &mut Vec::new());
    let (text, driver) = drivers.text_of(name)?;
    let range = driver.node.range();
    let (start, end) = (usize::from(range.start()), usize::from(range.end()));
    let before = text.get(..start)?;
    let comment = before.lines().rev().take_while(|line| line.starts_with("//"));
    let mut lines: Vec<&str> = comment.collect();
    lines.reverse();
    let above: String = lines.iter().flat_map(|line| [*line, "\n"]).collect();
    Some(format!("{above}{}\n", text.get(start..end)?))
}
