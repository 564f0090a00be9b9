//! The filters of values before they are reported: constants of the runtime's types, and the variables of tasks.

use super::context::Context;
use super::item::{Constant, Entry, Table};
use super::section::Section;
use sensedsl_job::part::{FilterPlan, Number};

/// The argument for the filter of an item: the filter, or `None`. The filter's table is added to the section, and its
/// variable to `state`.
pub(super) fn pass(
    context: &Context<'_>,
    index: usize,
    section: &mut Section,
    state: &mut Vec<String>,
) -> String {
    let Some(plan) = plan_of(context, index) else { return "None".to_owned() };
    let (ident, upper) = (&plan.ident, plan.ident.to_uppercase());
    section.tables.push(Constant::Table(table(plan)));
    state.push(format!(
        "let mut {ident}_filter: Filter<[u8; tables::{upper}_FILTER.bytes(&SCHEMA.items[{index}])]> = \
         Filter::new(&tables::{upper}_FILTER);"
    ));
    format!("Some(&mut *{ident}_filter)")
}

/// [`pass`] for a device that the reporter polls: the variable is the reporter's.
pub(super) fn polled(context: &Context<'_>, index: usize, section: &mut Section) -> String {
    let mut state = Vec::new();
    let filter = pass(context, index, section, &mut state);
    section.states.append(&mut state);
    filter
}

/// The filters of several items: the variables of a task, and an expression for the filter of the item `index`.
pub(super) fn of_items(
    context: &Context<'_>,
    is_own: impl Fn(usize) -> bool,
    section: &mut Section,
) -> (Vec<String>, String) {
    let (mut state, mut arms) = (Vec::new(), String::new());
    for index in (0..context.job.devices.len()).filter(|index| is_own(*index)) {
        let before = state.len();
        let pass = pass(context, index, section, &mut state);
        if state.len() > before {
            arms.push_str(&format!("{index} => {pass}, "));
        }
    }
    let pass = if arms.is_empty() {
        "None".to_owned()
    } else {
        format!("match index {{ {arms}_ => None }}")
    };
    (state, pass)
}

/// The filter of an item.
fn plan_of<'a>(context: &Context<'a>, index: usize) -> Option<&'a FilterPlan> {
    let name = context.job.devices.get(index)?.name();
    let mut all = context.job.parts.iter().flat_map(|part| &part.plan.filters);
    all.find(|plan| plan.field == name)
}

fn table(plan: &FilterPlan) -> Table {
    let invalid = plan.invalid.iter();
    let invalid: Vec<String> = invalid
        .map(|(low, high)| format!("Range {{ low: {}, high: {} }}", number(*low), number(*high)))
        .collect();
    let change = plan.change.map_or("None".to_owned(), |one| format!("Some({})", number(one)));
    let wide = if plan.is_wide { "Some(sense_rt::WIDE)" } else { "None" };
    let members = vec![
        ("invalid", format!("&[{}]", invalid.join(", "))),
        ("wide", wide.to_owned()),
        ("median", plan.median.to_string()),
        ("smooth_ms", plan.smooth_ms.to_string()),
        ("change", change),
        ("heartbeat_ms", plan.heartbeat_ms.to_string()),
    ];
    Table {
        name: format!("{}_FILTER", plan.ident.to_uppercase()),
        type_: "FilterTable",
        members: members.into_iter().map(|(name, value)| (name, Entry::One(value))).collect(),
        has_more: false,
    }
}

/// A number in the runtime's words.
fn number(number: Number) -> String {
    match number {
        Number::Unsigned(number) => format!("Number::unsigned({number})"),
        // The literal of the least number would overflow before its sign is applied.
        Number::Signed(i64::MIN) => "Number::signed(i64::MIN)".to_owned(),
        Number::Signed(number) => format!("Number::signed({number})"),
        Number::Float32(number) => format!("Number::float32({number:?})"),
        Number::Float64(number) => format!("Number::float64({number:?})"),
    }
}
