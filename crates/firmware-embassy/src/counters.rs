//! Hardware that counts by itself, edges or the steps of an encoder: the reporter has the drivers and reads them.

use super::context::{Context, Wired, scalar};
use super::filter;
use super::hal::contract::inputs::Counter;
use super::section::{Field, Keep, Section};
use sensedsl_job::JobConnection;

/// Hands the driver of a wire to the reporter, and gives the expression that reads it.
pub(super) fn keep(wire: &JobConnection<'_>, counter: Counter, section: &mut Section) -> String {
    let Counter { made, suffix, type_ } = counter;
    section.fields.push(Field::of(wire.ident.clone(), wire.place(), made));
    let (name, from) = (format!("{}_{suffix}", wire.ident), format!("wiring.{}", wire.ident));
    let read = format!("{name}.count()");
    section.keeps.push(Keep { name, type_, from });
    read
}

/// The reporter reads counters of 16 bits so often that no wrap is lost. `counts` has an expression for each wire.
pub(super) fn poll(
    context: &Context<'_>,
    wired: &Wired<'_>,
    counts: &[String],
    section: &mut Section,
) {
    let filter = filter::polled(context, wired.index, section);
    let (ident, value) = (&wired.device.ident, wired.device.device.value.value);
    section.states.push(format!("let mut {ident}_counters = [Counter::NEW; {}];", counts.len()));
    section.states.push(format!("let mut {ident}_repeat = Repeat::NEW;"));
    let mut poll = vec![format!("let before = {ident}_counters.map(|counter| counter.total());")];
    let steps = counts.iter().enumerate();
    poll.extend(steps.map(|(at, count)| format!("{ident}_counters[{at}].step({count});")));
    poll.push(format!("let counts = {ident}_counters.map(|counter| counter.total());"));
    let store = format!(
        "store_count({}, i64::from(count), value.get_mut(at * {}..).unwrap_or_default());",
        scalar(value.scalar),
        value.scalar.size_bytes()
    );
    poll.push(format!("if {ident}_repeat.is_due(counts != before, 1_000, now_ms()) {{"));
    poll.push(format!("    let mut value = [0; {}];", value.size_bytes()));
    poll.push(format!("    for (at, count) in counts.into_iter().enumerate() {{ {store} }}"));
    poll.push(format!(
        "    BOARD.report({filter}, tables::{}, Outcome::Fresh, &mut value);",
        wired.device.ident.to_uppercase()
    ));
    poll.push("}".to_owned());
    section.polls.push(poll);
}
