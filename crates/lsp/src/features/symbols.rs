//! Symbols: the outline of a file, and the search over all open designs with what they use.

use sensedsl_diagnostics::Span;
use sensedsl_syntax::TextRange;
use sensedsl_syntax::ast::{self, AstNode};
use serde_json::Value;

use crate::answer::{Refusal, parameters};
use crate::context::{Context, bytes};
use crate::protocol::{DocumentSymbol, QueryParams, SymbolInformation, symbol};

/// The outline of a file.
pub(crate) fn of_file(cx: &Context<'_>) -> Vec<DocumentSymbol> {
    outline(&cx.ast()).into_iter().map(|one| one.shown(cx)).collect()
}

/// What has the wanted letters in its name, in this order, in a design and the files that it uses.
pub(crate) fn found(cx: &Context<'_>, params: &Value) -> Result<Vec<Value>, Refusal> {
    let QueryParams { query } = parameters(params.clone())?;
    let mut found = Vec::new();
    for (file, tree) in cx.analysis.snapshot.trees() {
        let mut rest: Vec<(Symbol, String)> =
            outline(&tree.ast()).into_iter().rev().map(|one| (one, String::new())).collect();
        while let Some((one, within)) = rest.pop() {
            let span = Span::new(*file, bytes(one.selection));
            if let Some(location) = cx.location(span).filter(|_| matches(&one.name, &query)) {
                let told = SymbolInformation {
                    name: one.name.clone(),
                    kind: one.kind,
                    location,
                    container_name: within,
                };
                found.extend(serde_json::to_value(told).ok());
            }
            rest.extend(one.children.into_iter().rev().map(|child| (child, one.name.clone())));
        }
    }
    Ok(found)
}

/// Whether a name has these letters in this order, whatever the case.
fn matches(name: &str, query: &str) -> bool {
    let mut letters = name.chars().flat_map(char::to_lowercase);
    query.chars().flat_map(char::to_lowercase).all(|wanted| letters.any(|one| one == wanted))
}

/// A named thing of a file.
struct Symbol {
    name: String,
    detail: String,
    kind: u8,
    whole: TextRange,
    selection: TextRange,
    children: Vec<Symbol>,
}

impl Symbol {
    fn new(name: Option<ast::Name>, kind: u8, node: &impl AstNode) -> Option<Self> {
        let name = name?;
        Some(Self {
            name: name.text().to_owned(),
            detail: String::new(),
            kind,
            whole: node.range(),
            selection: name.range(),
            children: Vec::new(),
        })
    }

    fn detail(mut self, detail: impl Into<String>) -> Self {
        self.detail = detail.into();
        self
    }

    fn with(mut self, children: impl Iterator<Item = Option<Self>>) -> Self {
        self.children = children.flatten().collect();
        self
    }

    fn shown(self, cx: &Context<'_>) -> DocumentSymbol {
        DocumentSymbol {
            name: self.name,
            detail: self.detail,
            kind: self.kind,
            range: cx.range_of(self.whole),
            selection_range: cx.range_of(self.selection),
            children: self.children.into_iter().map(|one| one.shown(cx)).collect(),
        }
    }
}

fn outline(file: &ast::SourceFile) -> Vec<Symbol> {
    let items = file.items().filter_map(|item| match item {
        ast::FileItem::Use(_) => None,
        ast::FileItem::Board(board) => of_board(&board),
        ast::FileItem::Constant(one) => {
            let value = one.value().map(|value| value.syntax().text().to_string());
            let symbol = Symbol::new(one.name(), symbol::CONSTANT, &one)?;
            Some(symbol.detail(value.unwrap_or_default()))
        }
        ast::FileItem::Device(device) => of_device(&device),
        ast::FileItem::Chip(chip) => of_chip(&chip),
        ast::FileItem::Driver(driver) => of_driver(&driver),
        ast::FileItem::Test(test) => Symbol::new(test.name(), symbol::METHOD, &test),
    });
    items.collect()
}

fn of_board(board: &ast::Board) -> Option<Symbol> {
    let symbol = Symbol::new(board.name(), symbol::CLASS, board)?;
    let on = board.on().map(|on| match on {
        ast::BoardSource::Name(name) => format!("on {}", name.text()),
        ast::BoardSource::File(path) => format!("on {}", path.value()),
    });
    let parts = board.parts().map(|part| match part {
        ast::Item::Device(device) => of_device(&device),
        ast::Item::Chip(chip) => of_chip(&chip),
        ast::Item::Controller(one) => of_controller(&one),
    });
    Some(symbol.detail(on.unwrap_or_default()).with(parts))
}

fn of_device(device: &ast::Device) -> Option<Symbol> {
    let is_actuator = device.direction() == Some(ast::Direction::Actuator);
    let kind = if is_actuator { symbol::FUNCTION } else { symbol::FIELD };
    let ty = device.ty().map(|ty| ty.syntax().text().to_string().trim().to_owned());
    let of =
        ["type", "driver"].into_iter().find_map(|wanted| value_of(device.properties(), wanted));
    let detail = [ty, of].into_iter().flatten().collect::<Vec<_>>().join(", ");
    Some(Symbol::new(device.name(), kind, device)?.detail(detail))
}

fn of_chip(chip: &ast::Chip) -> Option<Symbol> {
    let symbol = Symbol::new(chip.name(), symbol::OBJECT, chip)?;
    let driver = value_of(chip.properties(), "driver");
    let devices = chip.devices().map(|device| of_device(&device));
    Some(symbol.detail(driver.unwrap_or_default()).with(devices))
}

fn of_controller(controller: &ast::Controller) -> Option<Symbol> {
    let symbol = Symbol::new(controller.name(), symbol::METHOD, controller)?;
    let every = controller.every().map(|every| every.syntax().text().to_string());
    Some(symbol.detail(every.map(|every| format!("every {}", every.trim())).unwrap_or_default()))
}

fn of_driver(driver: &ast::Driver) -> Option<Symbol> {
    let symbol = Symbol::new(driver.name(), symbol::INTERFACE, driver)?;
    let kind = driver.kind().map(|kind| format!("for {}", kind.text()));
    let items = driver.items().map(|item| match item {
        ast::DriverItem::Property(_) => None,
        ast::DriverItem::Connection(one) => Symbol::new(one.name(), symbol::PROPERTY, &one),
        ast::DriverItem::Reading(one) => Symbol::new(one.name(), symbol::FIELD, &one),
        ast::DriverItem::Command(one) => Symbol::new(one.name(), symbol::FUNCTION, &one),
    });
    Some(symbol.detail(kind.unwrap_or_default()).with(items))
}

/// The text of a property's value.
fn value_of(mut properties: impl Iterator<Item = ast::Property>, wanted: &str) -> Option<String> {
    let found = properties.find(|one| one.name().is_some_and(|name| name.text() == wanted))?;
    Some(found.value()?.syntax().text().to_string().trim().to_owned())
}
