//! Rules of tests while a board runs: what arrives in, each rule that stops holding out, at once.
//!
//! A run has no end, and may last for days. So each look judges only what came since the look before, and for a `when` as
//! much as its time reaches back; everything older is forgotten. A broken rule is told once, and again only after it has
//! held for a second.

use std::collections::BTreeMap;

use sensedsl_diagnostics::Span;
use sensedsl_model::design::{Design, DeviceIndex, SignalOf, Test, TestRule};
use sensedsl_rules::Shape;
use sensedsl_wire::Status;

use super::verdict::{Judged, RuleVerdict, judge_rule};
use super::{MS, Recording, is_hidden};

/// How long a rule must have held before it is told again.
const HELD_NS: u64 = 1_000 * MS;

/// All rules of a design's tests, over a run that has no end.
pub struct RunningRules<'a> {
    design: &'a Design,
    tests: Vec<Running>,
    /// The time of the last look, before which nothing is judged again.
    looked_ns: u64,
}

/// A rule that does not hold any more.
#[derive(Clone, Debug, PartialEq)]
pub struct Broken {
    /// The name of its test.
    pub test: String,
    /// The rule, as it is written.
    pub rule: String,
    /// Where.
    pub span: Span,
    /// When, with the values there, and by how much.
    pub judged: Judged,
}

/// A test, and what came of its signals.
struct Running {
    test: Test,
    recording: Recording,
    came_ns: BTreeMap<DeviceIndex, u64>,
    rules: Vec<Watched>,
}

/// A rule, and how far it has been judged.
struct Watched {
    rule: TestRule,
    /// The device of which nobody sees what the rule is about.
    unseen: Option<String>,
    from_ns: u64,
    broken_ns: Option<u64>,
    count: u32,
    is_over: bool,
}

impl<'a> RunningRules<'a> {
    /// The rules of all tests. `is_there`: whether values of a device can come.
    #[must_use]
    pub fn new(design: &'a Design, is_there: &dyn Fn(DeviceIndex) -> bool) -> Self {
        let unseen = |test: &Test, rule: &TestRule| {
            let mut found = None;
            rule.rule.shape.for_each_signal(&mut |number| {
                let signal = test.signals.get(number);
                let hidden = signal.filter(|signal| {
                    !is_there(signal.device) || is_hidden(design, signal.device, signal.of)
                });
                found = found.take().or_else(|| hidden.map(|signal| signal.name.clone()));
            });
            found
        };
        let running = |test: &Test| Running {
            recording: Recording::new(test),
            came_ns: BTreeMap::new(),
            rules: test
                .rules
                .iter()
                .map(|rule| Watched {
                    unseen: unseen(test, rule),
                    from_ns: rule.rule.from_ns,
                    rule: rule.clone(),
                    broken_ns: None,
                    count: 0,
                    is_over: false,
                })
                .collect(),
            test: test.clone(),
        };
        Self { design, tests: design.tests.iter().map(running).collect(), looked_ns: 0 }
    }

    /// The rules that cannot be watched, each with what nobody sees.
    #[must_use]
    pub fn unseen(&self) -> Vec<(&str, &str)> {
        let rules = self.tests.iter().flat_map(|one| &one.rules);
        rules.filter_map(|one| Some((one.rule.text.as_str(), one.unseen.as_deref()?))).collect()
    }

    /// How many rules are watched, and how often each broken one was told.
    #[must_use]
    pub fn counts(&self) -> (usize, Vec<(&str, u32)>) {
        let seen =
            || self.tests.iter().flat_map(|one| &one.rules).filter(|one| one.unseen.is_none());
        let broken = seen().filter(|one| one.count > 0);
        (seen().count(), broken.map(|one| (one.rule.text.as_str(), one.count)).collect())
    }

    /// A value of a device came or was sent; `shown` gives that of an element. One that is told after a look counts from
    /// that look on.
    pub fn value(&mut self, device: DeviceIndex, at_ns: u64, shown: &dyn Fn(usize) -> Option<f64>) {
        let at_ns = at_ns.max(self.looked_ns);
        for one in &mut self.tests {
            one.came_ns.insert(device, at_ns);
            for (number, signal) in one.test.signals.iter().enumerate() {
                if let SignalOf::Value(element) = signal.of
                    && signal.device == device
                    && let Some(value) = shown(element)
                {
                    one.recording.settle(number, at_ns);
                    one.recording.take(number, at_ns, signal.unit.computed(value));
                }
            }
        }
    }

    /// The state of a device came.
    pub fn health(&mut self, device: DeviceIndex, at_ns: u64, status: Status) {
        let at_ns = at_ns.max(self.looked_ns);
        for one in &mut self.tests {
            for (number, signal) in one.test.signals.iter().enumerate() {
                if signal.of == SignalOf::Health && signal.device == device {
                    one.recording.settle(number, at_ns);
                    one.recording.take(number, at_ns, f64::from(status.code()));
                }
            }
        }
    }

    /// Whether a rule asks for states of devices.
    #[must_use]
    pub fn asks_for_health(&self) -> bool {
        let mut signals = self.tests.iter().flat_map(|one| &one.test.signals);
        signals.any(|signal| signal.of == SignalOf::Health)
    }

    /// The rules that have been broken since the look before. At the end, what should have come once is told, too.
    pub fn look(&mut self, now_ns: u64, is_end: bool) -> Vec<Broken> {
        let design = self.design;
        self.looked_ns = now_ns;
        self.tests.iter_mut().flat_map(|one| one.look(design, now_ns, is_end)).collect()
    }
}

impl Running {
    fn look(&mut self, design: &Design, now_ns: u64, is_end: bool) -> Vec<Broken> {
        for (number, signal) in self.test.signals.iter().enumerate() {
            if signal.of == SignalOf::Age {
                let since_ns = self.came_ns.get(&signal.device).copied().unwrap_or(0);
                let age_ms = crate::arith::number(now_ns.saturating_sub(since_ns) / MS);
                self.recording.take(number, now_ns, signal.unit.computed(age_ms));
            } else {
                self.recording.settle(number, now_ns);
            }
        }
        self.recording.trace.end_ns = now_ns;
        let mut all = Vec::new();
        for watched in &mut self.rules {
            if watched.unseen.is_some() || watched.is_over {
                continue;
            }
            let (is_once, may_come, back_ns) = match &watched.rule.rule.shape {
                Shape::When(_, _, within_ns) => (false, false, within_ns.unwrap_or(0)),
                Shape::Always(_) | Shape::Never(_) => (false, false, 0),
                Shape::Eventually(_, Some(_)) => (true, false, 0),
                // What may come until the end is told there.
                Shape::Eventually(_, None) => (true, !is_end, 0),
            };
            let mut rule = watched.rule.clone();
            rule.rule.from_ns = watched.from_ns;
            let judged = judge_rule(design, &self.test, &rule, &self.recording.trace);
            let is_violated = matches!(judged.verdict, RuleVerdict::Violated { .. });
            // It has come, so that nothing of it is left to judge or to keep.
            watched.is_over = is_once && judged.is_held();
            if is_violated && !may_come {
                let was_ns = watched.broken_ns.replace(now_ns);
                watched.is_over = is_once;
                if was_ns.is_none_or(|was_ns| now_ns - was_ns > HELD_NS) {
                    watched.count += 1;
                    let (test, rule) = (self.test.name.value.clone(), watched.rule.text.clone());
                    all.push(Broken { test, rule, span: watched.rule.span, judged });
                }
            }
            if !is_once || may_come {
                watched.from_ns = watched.from_ns.max(now_ns.saturating_sub(back_ns));
            }
        }
        let needed = self.rules.iter().filter(|one| one.unseen.is_none() && !one.is_over);
        let needed_ns = needed.map(|one| one.from_ns).min().unwrap_or(now_ns);
        self.recording.forget(needed_ns);
        all
    }
}

#[cfg(test)]
mod tests {
    use sensedsl_model::{NoFiles, Request, resolve};

    use super::*;

    const TEXT: &str = "board B on NUCLEO_F446RE {
        sensor Front returns uint16 { type = analog; quantity = cm; }
        actuator Lamp accepts bool { type = digital; }
        actuator Left accepts uint16 { type = pwm; }
        controller Go every 10 ms { reads = [Front]; sets = [Left]; }
    }
    test T {
        for = 10 s;
        always Front < 100 cm;
        when Front < 20 cm then Lamp within 200 ms;
        always Left < 50 %;
        eventually Front > 90 cm within 2 s;
        when age(Front) > 500 ms then Lamp within 100 ms;
    }";

    /// What is told of values that come at milliseconds.
    fn told(values: &[(u64, &str, f64)], until_ms: u64) -> Vec<(String, u64)> {
        let request = Request { path: "a.sense", text: TEXT, ..Request::default() };
        let resolved = resolve(&request, &NoFiles);
        let design = resolved.design.unwrap();
        let find = |name: &str| {
            let all = design.devices.iter().position(|one| one.name.value == name);
            DeviceIndex(all.unwrap())
        };
        let mut rules = RunningRules::new(&design, &|_| true);
        assert_eq!(rules.unseen(), [("always Left < 50 %", "Left")]);
        let (mut all, mut values) = (Vec::new(), values.iter().peekable());
        for now_ms in (0..=until_ms).step_by(50) {
            while let Some((at_ms, name, value)) = values.next_if(|one| one.0 <= now_ms) {
                rules.value(find(name), at_ms * MS, &|_| Some(*value));
            }
            let broken = rules.look(now_ms * MS, false).into_iter();
            all.extend(broken.map(|one| {
                let RuleVerdict::Violated { first, .. } = &one.judged.verdict else {
                    panic!("{one:?}")
                };
                (one.rule, first.at_ns / MS)
            }));
        }
        all
    }

    /// `Front` in so many steps of 50 ms.
    fn steady(steps: u64, value: impl Fn(u64) -> f64) -> Vec<(u64, &'static str, f64)> {
        let lamp = [(0, "Lamp", 0.0)];
        lamp.into_iter().chain((0..steps).map(|step| (step * 50, "Front", value(step)))).collect()
    }

    #[test]
    fn a_rule_that_breaks_is_told_once_until_it_has_held_again() {
        let mut values = steady(130, |step| if step == 30 { 95.0 } else { 50.0 });
        assert_eq!(told(&values, 3_000), []);
        let high = |at_ms: u64| (3_000..3_200).contains(&at_ms) || (6_000..6_040).contains(&at_ms);
        for one in values.iter_mut().filter(|one| one.1 == "Front" && high(one.0)) {
            one.2 = 120.0;
        }
        let always = "always Front < 100 cm".to_owned();
        assert_eq!(told(&values, 6_400), [(always.clone(), 3_000), (always, 6_000)]);
    }

    #[test]
    fn what_must_come_is_waited_for_and_silence_is_seen() {
        let near = steady(30, |step| if step == 20 { 10.0 } else { 95.0 });
        let found = told(&near, 1_450);
        assert_eq!(found, [("when Front < 20 cm then Lamp within 200 ms".to_owned(), 1_000)]);
        // The lamp in time.
        let mut lit = near;
        lit.insert(lit.iter().position(|one| one.0 == 1_150).unwrap(), (1_150, "Lamp", 1.0));
        assert_eq!(told(&lit, 1_450), []);
        let found = told(&steady(1, |_| 95.0), 900);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].0.starts_with("when age(Front)") && found[0].1 <= 550, "{found:?}");
        let never = told(&steady(50, |_| 50.0), 2_400);
        assert_eq!(never, [("eventually Front > 90 cm within 2 s".to_owned(), 2_000)]);
    }
}
