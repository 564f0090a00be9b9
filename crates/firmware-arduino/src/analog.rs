//! Analog sensors: the classes of one cycle.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Diagnostic;
use sensedsl_files::{block, templates};
use sensedsl_job::part::FormulaPlan;
use sensedsl_job::{Cycle, JobDevice};
use sensedsl_model::kind::{Kind, KindName, Role};

use crate::context::Context;
use crate::section::{Cost, Section, Work};

templates! {
    s: Analog;
    Tables = "analog.c.txt";
}

struct Analog {
    classes: Vec<Class>,
}

struct Class {
    ident: String,
    cycle: Cycle,
    inputs: Vec<Input>,
}

/// An `up_analog_input_t`.
struct Input {
    place: String,
    field: String,
    pin: u8,
    element: u16,
    samples: u16,
    formula: Option<Computed>,
}

struct Computed {
    formula: &'static str,
    parameters: Option<String>,
    output: u8,
}

pub(crate) fn plan(context: &Context<'_>, _: &mut Vec<Diagnostic>) -> Section {
    let mut section = Section::default();
    let mut classes: BTreeMap<Cycle, Vec<Input>> = BTreeMap::new();
    for (device, wires) in context.devices(KindName::Analog) {
        for wire in wires {
            let Kind::Analog(analog) = &wire.connection.kind else { continue };
            let Some(pad) = wire.pad(Role::In) else { continue };
            let Some(pin) = context.names.analog_number(&pad.pin.name) else { continue };
            classes.entry(device.cycle).or_default().push(Input {
                place: wire.place(),
                field: device.name().to_owned(),
                pin,
                element: wire.element(),
                samples: analog.samples,
                formula: computed(context, device),
            });
        }
    }
    let has_formulas = classes.values().flatten().any(|input| input.formula.is_some());
    let class = |(cycle, inputs): (Cycle, Vec<Input>)| Class {
        ident: cycle.ident("analog"),
        cycle,
        inputs,
    };
    let analog = Analog { classes: classes.into_iter().map(class).collect() };
    section.sizes.push(("UP_HAS_FORMULAS", u32::from(has_formulas)));
    if analog.classes.is_empty() {
        return section;
    }
    section.headers.push("up_analog.h");
    section.work = analog.classes.iter().map(Class::work).collect();
    section.costs.push(Cost::new("analog sensors", 0, 1_200));
    section.tables = block(&Tables { s: &analog });
    section
}

fn computed(context: &Context<'_>, device: &JobDevice<'_>) -> Option<Computed> {
    let mut plans = context.job.parts.iter().flat_map(|part| &part.plan.formulas);
    let plan: &FormulaPlan = plans.find(|plan| plan.field == device.name())?;
    Some(Computed {
        formula: sensedsl_firmware_c::words::formula(&plan.formula),
        parameters: (!plan.parameters.is_empty()).then(|| format!("{}_parameters", plan.ident)),
        output: plan.output,
    })
}

impl Class {
    fn work(&self) -> Work {
        Work {
            title: self.cycle.title("ADC"),
            function: "up_analog_cycle",
            table: self.ident.clone(),
            cycle: self.cycle,
            field: self.inputs.first().map(|one| one.field.clone()).unwrap_or_default(),
        }
    }
}
