//! The certificate as text: the problem in names, the answer, the record of the search.
#![expect(clippy::indexing_slicing, reason = "labels are there for all numbers, which are checked")]

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use sensedsl_diagnostics::visible_json;
use sensedsl_solve::problem::{Alternative, Candidate, Claim, Holder, Problem, Role, RuleId};
use sensedsl_solve::{Answer, Objective};
use serde_json::{Value, json};

use crate::Subject;
use crate::labels::{Labels, distinct};

/// The holder of each resource. A device that holds one for several groups cannot share it.
pub fn holders(claims: &[Claim]) -> BTreeMap<u32, Holder> {
    let mut holders = BTreeMap::new();
    for Claim { resource, holder } in claims {
        let held = holders.entry(resource.0).or_insert(*holder);
        if held != holder {
            *held = Holder::Own;
        }
    }
    holders
}

pub(crate) struct Writer<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) labels: &'a Labels,
}

/// An object of named values.
fn object(entries: impl IntoIterator<Item = (String, Value)>) -> Value {
    Value::Object(entries.into_iter().collect())
}

/// An object of the values that are not empty.
fn stated<const N: usize>(entries: [(&str, Value); N]) -> Value {
    let says = |value: &Value| match value {
        Value::Null => false,
        Value::Array(all) => !all.is_empty(),
        Value::Object(all) => !all.is_empty(),
        Value::Bool(_) | Value::Number(_) | Value::String(_) => true,
    };
    let stated = entries.into_iter().filter(|(_, value)| says(value));
    object(stated.map(|(name, value)| (name.to_owned(), value)))
}

/// An object with one entry on each line.
fn lines(entries: impl IntoIterator<Item = (String, Value)>) -> String {
    let entries = entries.into_iter().map(|(name, value)| format!("{}: {value}", json!(name)));
    let entries = entries.collect::<Vec<_>>().join(",\n");
    if entries.is_empty() { "{}".to_owned() } else { format!("{{\n{entries}\n}}") }
}

impl Writer<'_> {
    /// The whole text.
    pub(crate) fn certificate(
        &self,
        subject: &Subject,
        answer: Option<&Answer>,
        search: &str,
    ) -> String {
        let Self { problem, labels } = self;
        let boards = labels.boards.iter().zip(&problem.boards);
        let boards = object(boards.map(|(name, board)| (name.clone(), board.spare.into())));
        let pins = labels.pins.iter().zip(&problem.pins);
        let pins = object(pins.map(|(name, pin)| (name.clone(), pin.cost.into())));
        let shared = labels.pins.iter().zip(&problem.pins).filter(|(_, pin)| pin.shared);
        let shared: Value = shared.map(|(name, _)| name.as_str()).collect();
        let dma = labels.dma.iter().zip(&problem.dma).map(|(name, user)| {
            let streams = user.requests.iter().map(|request| {
                request.streams.iter().map(|one| self.stream(one.0)).collect::<Vec<_>>()
            });
            (name.clone(), streams.collect())
        });
        let devices = labels.devices.iter().enumerate();
        let devices = lines(devices.map(|(d, name)| (name.clone(), self.device(d))));
        let mut text = format!("{{\n\"format\": {},\n", json!(sensedsl_proof::format::NAME));
        // Writing to a String cannot fail.
        let _ = write!(
            text,
            "\"subject\": {},\n\"problem\": {{\n\"boards\": {boards},\n\"pins\": {pins},\n\"shared\": {shared},\n\"dma\": {},\n\
             \"devices\": {devices}\n}},\n\"answer\": ",
            of(subject),
            object(dma)
        );
        match answer {
            Some(answer) => self.answer(&mut text, answer),
            None => text.push_str("null"),
        }
        let _ = write!(text, ",\n\"search\": {search}\n}}\n");
        text
    }

    fn stream(&self, stream: u32) -> &str {
        &self.labels.streams[stream as usize]
    }

    fn device(&self, d: usize) -> Value {
        let all = self.problem.devices[d].alternatives.iter().enumerate();
        object(
            all.map(|(a, one)| (self.labels.alternatives[d][a].name.clone(), self.way(d, a, one))),
        )
    }

    fn way(&self, d: usize, a: usize, alternative: &Alternative) -> Value {
        let names = &self.labels.alternatives[d][a].roles;
        let roles = names.iter().zip(&alternative.roles);
        let roles = roles.map(|(name, role)| (name.clone(), self.role(role)));
        let dma: BTreeSet<_> =
            alternative.dma.iter().map(|one| &self.labels.dma[one.0 as usize]).collect();
        stated([
            ("board", self.labels.boards[alternative.board.0 as usize].as_str().into()),
            ("claims", self.claims(&alternative.claims)),
            ("violates", self.violates(&alternative.violates)),
            ("dma", json!(dma)),
            ("roles", object(roles)),
        ])
    }

    fn role(&self, role: &Role) -> Value {
        object(role.candidates.iter().map(|one| {
            let value = stated([
                ("pin", self.labels.pins[one.pin.0 as usize].as_str().into()),
                (
                    "holder",
                    if one.holder == Holder::Own {
                        Value::Null
                    } else {
                        self.holder(one.holder).into()
                    },
                ),
                ("signal", self.labels.signals[&one.signal.0].as_str().into()),
                ("claims", self.claims(&one.claims)),
                ("violates", self.violates(&one.violates)),
                ("moved", if one.moved { true.into() } else { Value::Null }),
            ]);
            (self.candidate(one), value)
        }))
    }

    /// The name of a candidate in its role.
    fn candidate(&self, candidate: &Candidate) -> String {
        let pin = &self.labels.pins[candidate.pin.0 as usize];
        format!("{pin} {}", self.labels.signals[&candidate.signal.0])
    }

    fn claims(&self, claims: &[Claim]) -> Value {
        object(holders(claims).into_iter().map(|(resource, by)| {
            (self.labels.resources[resource as usize].clone(), self.holder(by).into())
        }))
    }

    fn holder(&self, holder: Holder) -> &str {
        match holder {
            Holder::Own => "own",
            Holder::Group(group) => &self.labels.groups[group as usize],
        }
    }

    fn violates(&self, rules: &[RuleId]) -> Value {
        let rules: BTreeSet<_> =
            rules.iter().map(|rule| &self.labels.rules[rule.0 as usize]).collect();
        json!(rules)
    }

    fn answer(&self, text: &mut String, answer: &Answer) {
        let wiring = answer.choices.iter().enumerate().map(|(d, choice)| {
            let alternative = &self.problem.devices[d].alternatives[choice.alternative];
            let labels = &self.labels.alternatives[d][choice.alternative];
            let wires = labels.roles.iter().zip(&alternative.roles).zip(&choice.candidates);
            let wires = wires.map(|((name, role), candidate)| {
                (name.clone(), self.candidate(&role.candidates[*candidate]).into())
            });
            let takes = json!({ "takes": labels.name, "wires": object(wires) });
            (self.labels.devices[d].clone(), takes)
        });
        let streams = answer.dma.iter().map(|(user, streams)| {
            let streams: Vec<_> = streams.iter().map(|one| self.stream(one.0)).collect();
            (self.labels.dma[user.0 as usize].clone(), json!(streams))
        });
        // Writing to a String cannot fail.
        let _ = write!(
            text,
            "{{\n\"objective\": {},\n\"wiring\": {},\n\"streams\": {}\n}}",
            objective(&answer.objective),
            lines(wiring),
            object(streams)
        );
    }
}

/// The text of a subject. Names of files may contain invisible characters.
fn of(subject: &Subject) -> String {
    let Subject { tool, options, files, built_in } = subject;
    let named = |all: &[(String, String)]| {
        let names = distinct(all.iter().map(|(name, _)| name.clone()));
        lines(names.into_iter().zip(all.iter().map(|(_, value)| value.as_str().into())))
    };
    let (options, files, built_in) = (named(options), named(files), named(built_in));
    let text = format!(
        "{{\n\"tool\": {},\n\"options\": {options},\n\"files\": {files},\n\"built_in\": {built_in}\n}}",
        json!(tool)
    );
    visible_json(&text).into_owned()
}

fn objective(objective: &Objective) -> Value {
    let Objective { moved, violated, shared, cost, spares } = objective;
    json!({
        "moved": moved, "violated": violated, "shared": shared, "cost": cost, "spares": spares,
    })
}
