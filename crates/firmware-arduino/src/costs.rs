//! What the core's code takes that values and parts need, whatever their kind.

use sensedsl_job::BoardJob;
use sensedsl_job::part::{FilterPlan, uses};

use crate::section::Cost;

/// Receiving commands, and giving them to their devices.
const COMMANDS: (u32, u32) = (90, 1_600);
/// Numbers with a point, made of whole ones and back.
const REALS_FLASH_BYTES: u32 = 2_500;
/// What is done to values before they are reported.
const INVALID_FLASH_BYTES: u32 = 1_600;
const MEDIAN_FLASH_BYTES: u32 = 1_100;
const SMOOTH_FLASH_BYTES: u32 = 2_700;
const CHANGE_FLASH_BYTES: u32 = 1_000;
/// An `up_filter_state_t`.
const FILTER_BYTES: u32 = 14;
/// How parts on buses begin, and are asked who they are.
const STARTS_FLASH_BYTES: u32 = 900;
const FORMULAS_FLASH_BYTES: u32 = 4_800;
/// Numbers in texts.
const TEXTS_FLASH_BYTES: u32 = 4_200;

/// All of it for a board.
pub(crate) fn of_values(job: &BoardJob<'_>) -> Vec<Cost> {
    let mut costs = filters(job);
    let all = uses(job);
    let has = |name: &str| all.iter().any(|(own, is_used)| *own == name && *is_used);
    if job.has_actuators() {
        costs.push(Cost::new("commands of the host", COMMANDS.0, COMMANDS.1));
    }
    if has("reals") {
        costs.push(Cost::new("numbers with a point", 0, REALS_FLASH_BYTES));
    }
    if has("chip-init") || has("chip-identity") {
        costs.push(Cost::new("how parts are started", 0, STARTS_FLASH_BYTES));
    }
    if has("chip-formulas") {
        costs.push(Cost::new("formulas", 0, FORMULAS_FLASH_BYTES));
    }
    let messages = job.parts.iter().filter_map(|part| part.plan.message.as_ref());
    let mut fields = messages.flat_map(|message| &message.fields);
    if fields.any(|field| field.how.value().is_none()) {
        costs.push(Cost::new("numbers in texts", 0, TEXTS_FLASH_BYTES));
    }
    costs
}

fn filters(job: &BoardJob<'_>) -> Vec<Cost> {
    let all: Vec<&FilterPlan> = job.parts.iter().flat_map(|part| &part.plan.filters).collect();
    let ram = |one: &&FilterPlan| FILTER_BYTES + 8 * u32::try_from(one.memory_words).unwrap_or(0);
    let any = |has: fn(&FilterPlan) -> bool| all.iter().any(|one| has(one));
    let flash = [
        (any(|one| !one.invalid.is_empty()), INVALID_FLASH_BYTES),
        (any(|one| one.median > 1), MEDIAN_FLASH_BYTES),
        (any(|one| one.smooth_ms > 0), SMOOTH_FLASH_BYTES),
        (any(|one| one.change.is_some()), CHANGE_FLASH_BYTES),
    ];
    let flash = flash.iter().filter(|(has, _)| *has).map(|(_, bytes)| bytes).sum();
    let own = |one: &&FilterPlan| Cost::new(format!("the filter of {}", one.field), ram(one), 0);
    std::iter::once(Cost::new("filters", 0, flash)).chain(all.iter().map(own)).collect()
}
