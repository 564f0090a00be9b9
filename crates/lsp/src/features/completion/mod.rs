//! Completion: what may be written at the cursor. One file for each concern.

mod blocks;
mod boards;
mod control;
pub(crate) mod described;
mod devices;
mod drivers;
mod files;
mod heads;
mod item;
mod pins;
pub(crate) mod site;
pub(crate) mod subject;
mod values;

use serde_json::Value;

use crate::context::Context;
use crate::protocol::{CompletionList, CompletionParams, Markup};
use item::Item;
use site::Site;
use subject::Subject;

/// What may be written at a place.
pub(crate) fn at(cx: &Context<'_>, params: &CompletionParams) -> CompletionList {
    let offset = cx.offset(params.position);
    let trigger = params.context.as_ref().and_then(|context| context.trigger_character.as_deref());
    let Some(site) = Site::of(cx, offset) else {
        return CompletionList { is_incomplete: false, items: Vec::new() };
    };
    let typed_nothing = site.word.is_empty() && site.before.is_empty();
    // A space that indents a line, or that goes on in a text, asks for nothing.
    let is_idle = match trigger {
        Some(" ") => typed_nothing || site.in_text,
        Some("\"") => !site.in_text,
        _ => false,
    };
    let subject = Subject::of(cx, &site);
    let items = if is_idle || site.in_number { Vec::new() } else { items(&subject) };
    item::list(cx, &site, offset, items)
}

fn items(subject: &Subject<'_, '_>) -> Vec<Item> {
    let site = subject.site;
    if site.in_text && site.words() == ["use"] {
        return files::used(subject);
    }
    let is_step = subject.place == subject::Place::Test && !site.before.is_empty();
    if let Some(items) = (is_step && !site.in_text).then(|| control::of_step(subject)).flatten() {
        return items;
    }
    if site.property().is_some() {
        return values::of_property(subject);
    }
    if site.in_text {
        return Vec::new();
    }
    if site.before.is_empty() { blocks::items(subject) } else { heads::items(subject) }
}

/// An item with its documentation.
pub(crate) fn resolved(mut item: Value) -> Value {
    let text = item.get("data").and_then(|data| {
        let of = |name: &str| data.get(name).and_then(Value::as_str);
        let page = of("part").and_then(drivers::page);
        page.or_else(|| of("board").and_then(boards::page))
            .or_else(|| of("mcu").and_then(boards::mcu))
    });
    let shown = text.and_then(|text| serde_json::to_value(Markup::new(text)).ok());
    if let (Some(shown), Some(item)) = (shown, item.as_object_mut()) {
        item.insert("documentation".to_owned(), shown);
    }
    item
}
