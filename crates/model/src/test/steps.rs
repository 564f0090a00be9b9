//! Steps of a test: what the host sets, what breaks, and the rules, each in; the same with devices and nanoseconds out.

use sensedsl_diagnostics::codes::{
    e0209_wrong_value, e0234_value_does_not_fit, e0254_time_of_test as time_wrong,
    e0257_not_set_by_host as not_set, e0258_fault_of_test as fault_wrong,
};
use sensedsl_diagnostics::{Diagnostic, Span, nearest};
use sensedsl_rules::{Rule, Shape};
use sensedsl_syntax::ast::{self, AstNode as _, Step};
use sensedsl_wire::Direction;

use super::condition::Conditions;
use super::names::{Scope, pulses_us};
use super::times::{self, Length};
use crate::design::{Device, DeviceIndex, FaultKind, Setting, TestFault, TestRule, TestSignal};
use crate::fields::{Codes, code_of};
use crate::part::reach;
use crate::spanned::{Spanned, span};
use crate::value::{Evaluator, Measure, Number, Value};

/// What the steps of a test come to.
pub(super) struct Steps {
    pub(super) sets: Vec<Setting>,
    pub(super) faults: Vec<TestFault>,
    pub(super) signals: Vec<TestSignal>,
    pub(super) rules: Vec<TestRule>,
}

/// Reads the steps of a test.
pub(super) struct Reader<'a> {
    conditions: Conditions<'a>,
    /// None if it could not be read.
    length: Option<Length>,
    sets: Vec<Setting>,
    faults: Vec<TestFault>,
    rules: Vec<TestRule>,
}

/// The clauses of a rule.
struct Clauses {
    within: Option<Spanned<u64>>,
    from: Option<Spanned<u64>>,
    to: Option<Spanned<u64>>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(
        scope: Scope<'a>,
        length: Option<Length>,
        diagnostics: &'a mut Vec<Diagnostic>,
    ) -> Self {
        let conditions = Conditions::new(scope, diagnostics);
        let (sets, faults, rules) = Default::default();
        Self { conditions, length, sets, faults, rules }
    }

    pub(super) fn finish(mut self) -> Steps {
        self.sets.sort_by_key(|one| one.at_ns);
        self.faults.sort_by_key(|one| one.at_ns);
        let (sets, faults, rules) = (self.sets, self.faults, self.rules);
        Steps { sets, faults, signals: self.conditions.signals(), rules }
    }

    pub(super) fn step(&mut self, step: &Step) {
        let read = match step {
            Step::Set(set) => self.set(set),
            Step::Fault(fault) => self.fault(fault),
            Step::Always(rule) => {
                let clauses = [rule.within(), rule.from(), rule.to()];
                self.steady(rule.condition(), clauses, Shape::Always, step)
            }
            Step::Never(rule) => {
                let clauses = [rule.within(), rule.from(), rule.to()];
                self.steady(rule.condition(), clauses, Shape::Never, step)
            }
            Step::Eventually(rule) => self.eventually(rule, step),
            Step::When(rule) => self.when(rule, step),
        };
        // What is missing has been told.
        let _: Option<()> = read;
    }

    fn say(&mut self, report: Diagnostic) {
        self.conditions.diagnostics().push(report);
    }

    fn span(&self, range: sensedsl_syntax::TextRange) -> Span {
        span(self.conditions.scope().file, range)
    }

    fn time(&mut self, node: &ast::Value) -> Option<Spanned<u64>> {
        let (scope, length) = (self.conditions.scope(), self.length);
        times::time(scope, node, length, self.conditions.diagnostics())
    }

    /// `at TIME set NAME = VALUE;`
    fn set(&mut self, node: &ast::SetStep) -> Option<()> {
        let at = self.time(&node.at()?);
        let name = node.name()?;
        let device = self.actuator(&name);
        let (scope, value) = (self.conditions.scope(), node.value()?);
        let number = Evaluator::new(scope.file, scope.constants, self.conditions.diagnostics())
            .value(&value);
        let ((device, target), at) = (device?, at?);
        let place = self.span(value.range());
        let number = match number {
            Value::Number(number) => number,
            Value::Unknown => return None,
            Value::Name(word) if word == "true" || word == "false" => {
                Number::of(f64::from(u8::from(word == "true")), Measure::Bare)
            }
            Value::Name(_) | Value::Text(_) | Value::List(_) | Value::Range(_) => {
                let takes = "a number, with or without a unit, `true` or `false`";
                let report = e0209_wrong_value::wrong_value;
                self.say(report(place, name.text(), takes, "something else"));
                return None;
            }
        };
        match code_of(&number, &target.shown, codes(target)) {
            Ok(raw) => {
                self.sets.push(Setting { device, at_ns: at.value, raw });
                Some(())
            }
            Err(why) => {
                let message = format!("`{}`: {}", name.text(), why.0);
                let report = e0234_value_does_not_fit::value_does_not_fit;
                self.say(report(place, &message, &why.1, None));
                None
            }
        }
    }

    /// The actuator of that name, if the host can set it.
    fn actuator(&mut self, name: &ast::Name) -> Option<(DeviceIndex, &'a Device)> {
        let scope = self.conditions.scope();
        let at = self.span(name.range());
        let Some((index, device)) = scope.device(name.text()) else {
            if !scope.is_absent(name.text()) {
                let all = scope.design.devices.iter();
                let all = all.filter(|device| device.direction == Direction::Actuator);
                let near = nearest(name.text(), all.map(|device| device.name.value.as_str()));
                self.say(not_set::unknown(at, name.text(), near));
            }
            return None;
        };
        if device.direction == Direction::Sensor {
            self.say(not_set::sensor(at, name.text(), device.name.span));
            return None;
        }
        if let Some(owner) = scope.design.owner(index).filter(|owner| !owner.host_overrides) {
            let own = scope.design.device(owner.device).map_or("", |own| own.name.value.as_str());
            let set = owner.sets.iter().find(|one| one.value == index);
            let place = set.map_or(device.name.span, |one| one.span);
            self.say(not_set::owned(at, name.text(), own, place));
            return None;
        }
        Some((index, device))
    }

    /// `fault KIND [of DEVICE] at TIME [for TIME];`
    fn fault(&mut self, node: &ast::FaultStep) -> Option<()> {
        let at = self.time(&node.at()?);
        let lasts = node.lasts().map(|lasts| self.time(&lasts));
        let word = node.kind()?;
        let place = self.span(word.range());
        let Some(kind) = FaultKind::find(word.text()) else {
            let all = FaultKind::ALL.map(FaultKind::name);
            let near = nearest(word.text(), all);
            self.say(fault_wrong::unknown(place, word.text(), near, &all.join(", ")));
            return None;
        };
        let device = match node.device() {
            None if kind.is_of_board() => None,
            None => {
                self.say(fault_wrong::of_what(place, kind.name()));
                return None;
            }
            Some(device) if kind.is_of_board() => {
                let at = self.span(device.range());
                self.say(fault_wrong::of_board(at, kind.name()));
                return None;
            }
            Some(device) => Some(self.sensor(&device, kind)?),
        };
        let lasts_ns = match lasts {
            Some(lasts) => lasts?.value,
            None => match kind.usual_ns() {
                Some(usual_ns) => usual_ns,
                None => {
                    self.say(fault_wrong::how_long(place, kind.name()));
                    return None;
                }
            },
        };
        self.faults.push(TestFault { kind, device, at_ns: at?.value, lasts_ns });
        Some(())
    }

    /// The sensor of that name, if it can have the fault.
    fn sensor(&mut self, name: &ast::Name, kind: FaultKind) -> Option<DeviceIndex> {
        let scope = self.conditions.scope();
        let at = self.span(name.range());
        let is_sensor = |device: &&Device| device.direction == Direction::Sensor;
        let found = scope.device(name.text()).filter(|(_, device)| is_sensor(device));
        let Some((index, device)) = found else {
            if !scope.is_absent(name.text()) {
                let all = scope.design.devices.iter().filter(is_sensor);
                let near = nearest(name.text(), all.map(|device| device.name.value.as_str()));
                self.say(fault_wrong::not_a_sensor(at, name.text(), near));
            }
            return None;
        };
        if device.kind.code().is_some() || !kind.fits(&device.kind) {
            let on = device.kind.name().name();
            let report = fault_wrong::not_of_kind;
            self.say(report(at, kind.name(), name.text(), on, kind.needs()));
            return None;
        }
        Some(index)
    }

    /// `always`, `never`
    fn steady(
        &mut self,
        condition: Option<ast::Condition>,
        clauses: [Option<ast::Value>; 3],
        shape: fn(sensedsl_rules::Formula) -> Shape,
        step: &Step,
    ) -> Option<()> {
        let formula = self.conditions.condition(&condition?);
        let [within, from, to] = clauses;
        if let Some(within) = &within {
            let at = self.span(within.range());
            let help = "leave it out, or say where the rule holds with `from` and `to`";
            self.say(time_wrong::misplaced(at, "within", help));
        }
        let clauses = self.clauses([None, from, to])?;
        self.rule(shape(formula?), &clauses, step);
        Some(())
    }

    fn eventually(&mut self, node: &ast::EventuallyRule, step: &Step) -> Option<()> {
        let formula = self.conditions.condition(&node.condition()?);
        let clauses = self.clauses([node.within(), node.from(), node.to()])?;
        if let (Some(_), Some(to)) = (clauses.within, clauses.to) {
            let help = "`within` is how long it may take, `to` until when: write one of them";
            self.say(time_wrong::misplaced(to.span, "to", help));
            return None;
        }
        let within_ns = clauses.within.map(|within| within.value);
        if let Some(within) = clauses.within {
            let last_ns = clauses.from.map_or(0, |from| from.value).saturating_add(within.value);
            self.inside(last_ns, within.span)?;
        }
        self.rule(Shape::Eventually(formula?, within_ns), &clauses, step);
        Some(())
    }

    fn when(&mut self, node: &ast::WhenRule, step: &Step) -> Option<()> {
        let condition = self.conditions.condition(&node.condition()?);
        let then = self.conditions.condition(&node.then()?);
        let clauses = self.clauses([node.within(), node.from(), node.to()])?;
        let within_ns = clauses.within.map(|within| within.value);
        self.rule(Shape::When(condition?, then?, within_ns), &clauses, step);
        Some(())
    }

    /// The times of a rule; none if one of them is wrong.
    fn clauses(&mut self, written: [Option<ast::Value>; 3]) -> Option<Clauses> {
        let mut read = written.map(|one| one.map(|one| self.time(&one)));
        let [within, from, to] = read.each_mut().map(Option::take);
        let clauses = Clauses {
            within: within.map_or(Some(None), |one| one.map(Some))?,
            from: from.map_or(Some(None), |one| one.map(Some))?,
            to: to.map_or(Some(None), |one| one.map(Some))?,
        };
        if let (Some(from), Some(to)) = (clauses.from, clauses.to)
            && from.value >= to.value
        {
            let (first, last) = (times::shown(from.value), times::shown(to.value));
            self.say(time_wrong::reversed(to.span, &first, &last));
            return None;
        }
        Some(clauses)
    }

    /// Refuses a moment after the end of the test.
    fn inside(&mut self, at_ns: u64, at: Span) -> Option<()> {
        let Some(length) = self.length.filter(|length| at_ns > length.ns) else { return Some(()) };
        let (time, end) = (times::shown(at_ns), times::shown(length.ns));
        self.say(time_wrong::after_end(at, &time, &end, length.span));
        None
    }

    fn rule(&mut self, shape: Shape, clauses: &Clauses, step: &Step) {
        let from_ns = clauses.from.map_or(0, |from| from.value);
        let rule = Rule { shape, from_ns, to_ns: clauses.to.map(|to| to.value) };
        let written = step.syntax().text().to_string();
        let text = written.split_whitespace().collect::<Vec<_>>().join(" ");
        let text = text.trim_end_matches(';').to_owned();
        let (span, margin) = (self.span(step.range()), self.conditions.margin());
        self.rules.push(TestRule { rule, text, span, margin });
    }
}

/// The codes that an actuator can be set to.
fn codes(device: &Device) -> Codes {
    Codes {
        range: reach::raw(device),
        is_whole: device.value.value.scalar.integer_range().is_some(),
        pulses_us: pulses_us(device),
    }
}
