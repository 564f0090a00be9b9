//! The arguments of `cargo xtask fuzz`.

use std::time::Duration;

use anyhow::{Context as _, Result, bail};

use super::divided;

/// The usage of the task.
const USAGE: &str = "fuzz [TARGET…] [--hours N | --runs N | --ci] [--minimise]";
/// The time of a run for which none is given.
const TIME_DEFAULT: Duration = Duration::from_secs(600);

/// The amount of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Effort {
    /// This many inputs for each target.
    Runs(u64),
    /// This much time for all targets together.
    Time(Duration),
    /// The corpora and a few more seconds for each target, with the same choices each time.
    Brief,
}

impl Effort {
    /// The share of each of several targets.
    pub(super) fn share(self, targets: u32) -> Self {
        match self {
            Self::Time(time) => Self::Time(divided(time, targets)),
            Self::Runs(_) | Self::Brief => self,
        }
    }
}

/// The options of a call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Options {
    /// The names of the targets; empty for all.
    pub(super) targets: Vec<String>,
    pub(super) effort: Effort,
    pub(super) minimise: bool,
}

impl Options {
    pub(super) fn read(arguments: &[String]) -> Result<Self> {
        let mut options =
            Self { targets: Vec::new(), effort: Effort::Time(TIME_DEFAULT), minimise: false };
        let mut words = arguments.iter();
        while let Some(word) = words.next() {
            let mut number = || -> Result<f64> {
                let next = words.next().with_context(|| format!("{word} what? {USAGE}"))?;
                let number: f64 = next.parse().with_context(|| format!("{next} is no number"))?;
                if !(0.0..1e12).contains(&number) {
                    bail!("{word} {next} is too much or too little");
                }
                Ok(number)
            };
            match word.as_str() {
                "--hours" => {
                    options.effort = Effort::Time(Duration::from_secs_f64(number()? * 3600.0));
                }
                "--runs" => options.effort = Effort::Runs(number()? as u64),
                "--ci" => options.effort = Effort::Brief,
                "--minimise" => options.minimise = true,
                other if other.starts_with('-') => bail!("what is {other}? {USAGE}"),
                target => options.targets.push(target.to_owned()),
            }
        }
        Ok(options)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hours_are_shared_and_runs_are_not() {
        let read = |words: &str| {
            let words: Vec<String> = words.split_whitespace().map(str::to_owned).collect();
            Options::read(&words)
        };
        let options = read("pipeline certificate --hours 0.5 --minimise").unwrap();
        assert_eq!(options.targets, ["pipeline", "certificate"]);
        assert_eq!(options.effort.share(2), Effort::Time(Duration::from_secs(900)));
        assert!(options.minimise);
        assert_eq!(read("--runs 1e6").unwrap().effort.share(2), Effort::Runs(1_000_000));
        for wrong in ["--hours", "--hours x", "--hours -1", "--until 5"] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
