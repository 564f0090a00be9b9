//! What was checked, as `JUnit` XML: the form in which build servers show results.
//!
//! In: test suites, with the failures of each case. Out: a `JUnit` document. `JUnit` has no official schema: this one
//! has the elements and attributes that Jenkins, GitLab and GitHub's reporters read.

use crate::markup::escaped;

/// Cases that belong together, such as those of a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Suite {
    /// What was checked.
    pub name: String,
    /// In the order in which they are shown.
    pub cases: Vec<Case>,
}

/// One thing that was checked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Case {
    /// What it is called.
    pub name: String,
    /// The file that it is of.
    pub file: String,
    /// Why it failed; `None` if it passed.
    pub failure: Option<Failure>,
    /// What else was said of it.
    pub output: String,
}

/// Why a case failed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Failure {
    /// The code of the message, such as `E0203`.
    pub code: String,
    /// One line.
    pub message: String,
    /// All that is known, in several lines.
    pub text: String,
}

/// The document.
#[must_use]
pub fn junit(suites: &[Suite]) -> String {
    let all = || suites.iter().flat_map(|suite| &suite.cases);
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    out.push_str(&format!("<testsuites name=\"sensedsl\" {}>\n", counts(all())));
    for suite in suites {
        let name = escaped(&suite.name);
        out.push_str(&format!("  <testsuite name=\"{name}\" {}>\n", counts(suite.cases.iter())));
        for case in &suite.cases {
            push(&mut out, suite, case);
        }
        out.push_str("  </testsuite>\n");
    }
    out.push_str("</testsuites>\n");
    out
}

fn counts<'a>(cases: impl Iterator<Item = &'a Case>) -> String {
    let (mut tests, mut failures) = (0_usize, 0_usize);
    for case in cases {
        tests += 1;
        failures += usize::from(case.failure.is_some());
    }
    format!("tests=\"{tests}\" failures=\"{failures}\" errors=\"0\" skipped=\"0\"")
}

fn push(out: &mut String, suite: &Suite, case: &Case) {
    let [class, name, file] = [&suite.name, &case.name, &case.file].map(|text| escaped(text));
    out.push_str(&format!("    <testcase classname=\"{class}\" name=\"{name}\" file=\"{file}\""));
    if case.failure.is_none() && case.output.is_empty() {
        out.push_str("/>\n");
        return;
    }
    out.push_str(">\n");
    if let Some(Failure { code, message, text }) = &case.failure {
        let [code, message] = [code, message].map(|text| escaped(text));
        let text = lines(text);
        out.push_str(&format!(
            "      <failure type=\"{code}\" message=\"{message}\">{text}</failure>\n"
        ));
    }
    if !case.output.is_empty() {
        out.push_str(&format!("      <system-out>{}</system-out>\n", lines(&case.output)));
    }
    out.push_str("    </testcase>\n");
}

/// Several lines, each escaped.
fn lines(text: &str) -> String {
    text.trim_end().split('\n').map(escaped).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hostile_text_stays_text() {
        let failure = Failure {
            code: "E0203".into(),
            message: "two \"A\" & <b>".into(),
            text: "line 1\n]]> \u{1b}[31m line 2\n".into(),
        };
        let cases = vec![
            Case { name: "a".into(), file: "a.sense".into(), ..Case::default() },
            Case {
                name: "b".into(),
                failure: Some(failure),
                output: "noted".into(),
                ..Case::default()
            },
        ];
        let text = junit(&[Suite { name: "check".into(), cases }]);
        assert_eq!(
            text,
            r#"<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="sensedsl" tests="2" failures="1" errors="0" skipped="0">
  <testsuite name="check" tests="2" failures="1" errors="0" skipped="0">
    <testcase classname="check" name="a" file="a.sense"/>
    <testcase classname="check" name="b" file="">
      <failure type="E0203" message="two &quot;A&quot; &amp; &lt;b&gt;">line 1
]]&gt; \u{1b}[31m line 2</failure>
      <system-out>noted</system-out>
    </testcase>
  </testsuite>
</testsuites>
"#
        );
    }
}
