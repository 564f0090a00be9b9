//! The typed views over controllers, tests and conditions.
#![allow(clippy::unwrap_used, clippy::indexing_slicing, reason = "a test may panic")]

use sensedsl_syntax::ast::{AstNode, Comparison, Condition, Operator, Step, Value};
use sensedsl_syntax::parse;

const OVEN: &str = include_str!("samples/thermostat.sense");

fn text(node: &impl AstNode) -> String {
    node.syntax().text().to_string()
}

/// A condition with all its parentheses.
fn shape(condition: &Condition) -> Option<String> {
    Some(match condition {
        Condition::Logic(one) => {
            let word = if one.is_and() { "and" } else { "or" };
            format!("({} {word} {})", shape(&one.left()?)?, shape(&one.right()?)?)
        }
        Condition::Not(one) => format!("(not {})", shape(&one.condition()?)?),
        Condition::Compare(one) => {
            let how = match one.comparison()? {
                Comparison::Less => "<",
                Comparison::AtMost => "<=",
                Comparison::Greater => ">",
                Comparison::AtLeast => ">=",
                Comparison::Equal => "==",
                Comparison::Unequal => "!=",
            };
            format!("({} {how} {})", shape(&one.left()?)?, shape(&one.right()?)?)
        }
        Condition::Inside(one) => {
            let range = one.range_of()?;
            let (first, last) = (text(&range.first()?), text(&range.last()?));
            format!("({} in {first} to {last})", shape(&one.value()?)?)
        }
        Condition::Operation(one) => {
            let how = match one.operator()? {
                Operator::Add => "+",
                Operator::Subtract => "-",
                Operator::Multiply => "*",
                Operator::Divide => "/",
            };
            format!("({} {how} {})", shape(&one.left()?)?, shape(&one.right()?)?)
        }
        Condition::Signed(one) => {
            let sign = if one.is_negative() { "-" } else { "+" };
            format!("({sign}{})", shape(&one.condition()?)?)
        }
        Condition::Paren(one) => shape(&one.condition()?)?,
        Condition::Number(one) => text(one),
        Condition::Name(one) => one.name()?.text().to_owned(),
        Condition::Index(one) => format!("{}[{}]", one.name()?.text(), shape(&one.index()?)?),
        Condition::Call(one) => {
            let arguments: Option<Vec<_>> = one.arguments().map(|one| shape(&one)).collect();
            format!("{}({})", one.name()?.text(), arguments?.join(", "))
        }
        Condition::Member(one) => format!("{}.{}", one.name()?.text(), one.word()?.text()),
    })
}

fn step(step: &Step) -> Option<String> {
    let time = |value: Option<Value>| value.map_or("-".to_owned(), |value| text(&value));
    Some(match step {
        Step::Set(one) => {
            format!("{}: {} = {}", time(one.at()), one.name()?.text(), text(&one.value()?))
        }
        Step::Fault(one) => {
            let device = one.device().map_or("-".to_owned(), |name| name.text().to_owned());
            format!("{} {device} {} {}", one.kind()?.text(), time(one.at()), time(one.lasts()))
        }
        Step::Always(one) => format!("always {}", shape(&one.condition()?)?),
        Step::Never(one) => {
            format!("never {} {} {}", shape(&one.condition()?)?, time(one.from()), time(one.to()))
        }
        Step::Eventually(one) => {
            format!("eventually {} {}", shape(&one.condition()?)?, time(one.within()))
        }
        Step::When(one) => {
            let (when, then) = (shape(&one.condition()?)?, shape(&one.then()?)?);
            format!("when {when} then {then} {}", time(one.within()))
        }
    })
}

#[test]
fn controllers_and_tests_are_seen_as_they_are_written() {
    let file = parse(OVEN).ast();
    let board = file.boards().next().unwrap();
    let controller = board.controllers().next().unwrap();
    assert_eq!(controller.name().unwrap().text(), "Hold");
    assert_eq!(text(&controller.every().unwrap()), "20 ms");
    assert_eq!(controller.properties().count(), 3);
    let test = file.tests().next().unwrap();
    assert_eq!((test.name().unwrap().text(), test.properties().count()), ("Warm", 2));
    let steps: Option<Vec<_>> = test.steps().map(|one| step(&one)).collect();
    assert_eq!(
        steps.unwrap(),
        [
            "1 s: Target = 200 degC",
            "no_answer Heat 6 s 500 ms",
            "reset - 30 s -",
            "always ((Heater in 0 % to 100 %) and ((Heat < 250 degC) or (not (Heater > 0))))",
            "never (Hold.overruns > 0) 2 s 50 s",
            "eventually (Heat >= (Target - 2)) 2 * REACTION + 20 s",
            "when rising((Heat > 230 degC)) then (Heater == 0) REACTION",
            "when (age(Heat) > 100 ms) then (Line[(2 + 1)] != ((-raw_offset) * 2)) -",
        ]
    );
}

/// Words of tests are names everywhere else.
#[test]
fn words_of_tests_are_names_elsewhere() {
    let text = "board at {\n    sensor when returns uint8 {\n        from = not;\n        in = [and, or];\n    }\n}\n";
    let parsed = parse(text);
    assert_eq!(parsed.errors(), &[]);
    let device = parsed.ast().boards().next().unwrap().devices().next().unwrap();
    assert_eq!(device.name().unwrap().text(), "when");
    assert_eq!(device.properties().count(), 2);
}
