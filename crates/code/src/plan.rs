//! A board's job in; what the code of each controller gets and gives, with the names of its fields, out.

use sensedsl_job::{BoardJob, JobController, JobDevice};
use sensedsl_model::design::Presentation;
use sensedsl_model::reach;
use sensedsl_wire::ScalarType;

use crate::reserved;

/// What the code of a controller gets and gives.
#[derive(Clone, Debug)]
pub struct ControllerPlan {
    /// Its name in the file: `Follow`.
    pub name: String,
    /// The identifier in code: `follow`.
    pub ident: String,
    /// The name of its type in Rust: `Follow`.
    pub type_name: String,
    /// The time from the beginning of a step to that of the next one.
    pub every_ms: u32,
    /// What it gets, in the order of the file.
    pub reads: Vec<FieldPlan>,
    /// What it sets, in the order of the file.
    pub sets: Vec<FieldPlan>,
}

/// A device as a field of a structure.
#[derive(Clone, Debug)]
pub struct FieldPlan {
    /// The device's name in the file: `IRFront`.
    pub name: String,
    /// The field: `ir_front`.
    pub ident: String,
    /// The index of the device in the board's schema.
    pub index: usize,
    /// The type of one element.
    pub scalar: ScalarType,
    /// The number of elements; none for a single value.
    pub length: Option<u16>,
    /// The least and the greatest code that the device takes; none where its type holds any.
    pub range: Option<(f64, f64)>,
    /// How people are shown the value.
    pub shown: Presentation,
}

impl FieldPlan {
    fn new(index: usize, one: &JobDevice<'_>) -> Self {
        let value = one.device.value.value;
        Self {
            name: one.name().to_owned(),
            ident: reserved::field(&one.ident),
            index,
            scalar: value.scalar,
            length: value.length,
            range: reach::raw(one.device),
            shown: one.device.shown.clone(),
        }
    }

    /// Bytes of the whole value.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.element_bytes() * usize::from(self.count())
    }

    /// Bytes of one element.
    pub(crate) const fn element_bytes(&self) -> usize {
        self.scalar.size_bytes()
    }

    /// The number of elements; 1 for a single value.
    pub(crate) fn count(&self) -> u16 {
        self.length.unwrap_or(1)
    }
}

/// The code of a board's controllers, in the order of the file.
#[must_use]
pub fn controllers(job: &BoardJob<'_>) -> Vec<ControllerPlan> {
    job.controllers.iter().map(|one| of_controller(job, one)).collect()
}

fn of_controller(job: &BoardJob<'_>, one: &JobController<'_>) -> ControllerPlan {
    let fields = |list: &[usize]| {
        let all =
            list.iter().filter_map(|index| Some(FieldPlan::new(*index, job.devices.get(*index)?)));
        all.collect()
    };
    ControllerPlan {
        name: job.devices.get(one.own).map_or_else(String::new, |own| own.name().to_owned()),
        ident: reserved::controller(&one.ident),
        type_name: type_name(&one.ident),
        every_ms: one.controller.every_ms,
        reads: fields(&one.reads),
        sets: fields(&one.sets),
    }
}

/// A name in snake case as that of a type: `Follow`.
fn type_name(ident: &str) -> String {
    let words = ident.split('_').map(|word| {
        let mut letters = word.chars();
        let first = letters.next().map(|letter| letter.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    });
    let name: String = words.collect();
    // What its file uses, and a word of Rust.
    if ["In", "Out", "Self"].contains(&name.as_str()) { name + "Code" } else { name }
}
