//! Rules: `prefer`, `avoid`, `reserve`, `release`, `allow`.

use sensedsl_board::pin::PinName;
use sensedsl_diagnostics::codes::{
    e0101_unexpected_token, e0110_misplaced_item, e0201_unknown_property, e0209_wrong_value,
    w0604_unused_rule,
};
use sensedsl_diagnostics::{Code, Diagnostic, FileId, Severity, Span, nearest};
use sensedsl_syntax::ast::{self, AstNode as _, DeviceItem, Rule};

use crate::design::{Allow, Design, Spanned, Wish, WishFor};
use crate::fields::{name_or_text, span};
use crate::kind::Role;

/// The properties that can be wished for beside the pins of the roles.
const WISHES: [&str; 4] = ["pin", "unit", "side", "header"];

/// All properties that can be wished for.
fn wishes() -> impl Iterator<Item = &'static str> {
    let roles = Role::ALL.into_iter().map(Role::property);
    WISHES.into_iter().chain(roles.filter(|name| *name != "pin"))
}

/// The rules of a board.
#[derive(Debug, Default)]
pub(crate) struct BoardRules {
    pub(crate) wishes: Vec<Wish>,
    pub(crate) reserved: Vec<Spanned<String>>,
    pub(crate) released: Vec<Spanned<String>>,
    pub(crate) allows: Vec<Allow>,
}

/// Reads the rules of a board.
pub(crate) fn of_board(
    file: FileId,
    node: &ast::Board,
    diagnostics: &mut Vec<Diagnostic>,
) -> BoardRules {
    let mut rules = BoardRules::default();
    let scope = span(file, node.range());
    for rule in node.rules() {
        match rule {
            Rule::Prefer(rule) => {
                rules.wishes.extend(wish(file, true, rule.property(), diagnostics));
            }
            Rule::Avoid(rule) => {
                rules.wishes.extend(wish(file, false, rule.property(), diagnostics));
            }
            Rule::Reserve(rule) => rules.reserved.extend(names(file, rule.names())),
            Rule::Release(rule) => rules.released.extend(names(file, rule.names())),
            Rule::Allow(rule) => rules.allows.extend(allow(file, &rule, scope, diagnostics)),
        }
    }
    rules
}

/// Reads the rules of a device.
pub(crate) fn of_device(
    file: FileId,
    node: &ast::Device,
    diagnostics: &mut Vec<Diagnostic>,
) -> (Vec<Wish>, Vec<Allow>) {
    let (mut wishes, mut allows) = (Vec::new(), Vec::new());
    let scope = span(file, node.range());
    for item in node.items() {
        let DeviceItem::Rule(rule) = item else { continue };
        match rule {
            Rule::Prefer(rule) => wishes.extend(wish(file, true, rule.property(), diagnostics)),
            Rule::Avoid(rule) => wishes.extend(wish(file, false, rule.property(), diagnostics)),
            Rule::Allow(rule) => allows.extend(allow(file, &rule, scope, diagnostics)),
            Rule::Reserve(_) | Rule::Release(_) => {
                let at = span(file, rule.range());
                let what = "`reserve` or `release` in a device";
                diagnostics.push(e0110_misplaced_item::misplaced_item(at, what, "into a board"));
            }
        }
    }
    (wishes, allows)
}

fn names(file: FileId, names: impl Iterator<Item = ast::Name>) -> Vec<Spanned<String>> {
    names
        .map(|name| Spanned { value: name.text().to_uppercase(), span: span(file, name.range()) })
        .collect()
}

fn wish(
    file: FileId,
    prefer: bool,
    property: Option<ast::Property>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Wish> {
    let property = property?;
    let (name, value) = (property.name()?, property.value()?);
    if wishes().all(|known| known != name.text()) {
        let word = if prefer { "`prefer`" } else { "`avoid`" };
        let meant = nearest(name.text(), wishes());
        diagnostics.push(e0201_unknown_property::unknown_property(
            span(file, name.range()),
            name.text(),
            word,
            meant,
        ));
        return None;
    }
    let at = span(file, property.range());
    let Some(text) = name_or_text(&value) else {
        let place = span(file, value.range());
        let wrong = e0209_wrong_value::wrong_value(place, name.text(), "a name", "another value");
        diagnostics.push(wrong);
        return None;
    };
    let what = match name.text() {
        "unit" => WishFor::Unit(text.to_uppercase()),
        "side" => WishFor::Side(text),
        "header" => WishFor::Header(text),
        property => match PinName::parse(&text) {
            Some(pin) => WishFor::Pin(Role::from_property(property), pin),
            None => {
                let place = span(file, value.range());
                let takes = "a pin such as PA1";
                diagnostics.push(e0209_wrong_value::wrong_value(
                    place,
                    property,
                    takes,
                    "another name",
                ));
                return None;
            }
        },
    };
    Some(Wish { prefer, what, span: at })
}

fn allow(
    file: FileId,
    rule: &ast::Allow,
    scope: Span,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Allow> {
    let (code, reason) = (rule.code()?, rule.reason()?);
    let at = span(file, code.range());
    let Some(known) = Code::find(code.text()) else {
        let found = format!("`{}`", code.text());
        diagnostics.push(e0101_unexpected_token::unexpected_token(
            at,
            "the code of a warning such as W0602",
            &found,
        ));
        return None;
    };
    Some(Allow { code: known, reason: reason.value(), span: span(file, rule.range()), scope })
}

/// Removes the warnings and hints that are allowed, and reports an `allow` that allowed nothing.
/// Wants all diagnostics of a run, those of later stages included.
pub fn apply_allows(design: &Design, diagnostics: &mut Vec<Diagnostic>) {
    let of_boards = design.boards.iter().flat_map(|board| &board.allows);
    let of_devices = design.devices.iter().flat_map(|device| &device.allows);
    let mut unused = Vec::new();
    for allow in of_boards.chain(of_devices) {
        let before = diagnostics.len();
        diagnostics.retain(|one| !covers(allow, one));
        if diagnostics.len() == before {
            let rule = format!("allow {}", allow.code);
            let why = "nothing of the kind would be said here";
            unused.push(w0604_unused_rule::unused_rule(allow.span, &rule, why));
        }
    }
    diagnostics.append(&mut unused);
}

fn covers(allow: &Allow, diagnostic: &Diagnostic) -> bool {
    let Span { file, start, end } = allow.scope;
    let place = diagnostic.primary.span;
    diagnostic.code == allow.code
        && diagnostic.severity != Severity::Error
        && place.file == file
        && (start..=end).contains(&place.start)
}
