//! The summary of a run. In: libFuzzer's output. Out: one line for people.

use std::path::PathBuf;

/// The figures of one run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    executions: u64,
    per_second: u64,
    /// The number of edges reached, and of all edges.
    edges: (u64, u64),
    features: u64,
    inputs: u64,
    /// How far the inputs got, in the target's words.
    stages: Option<String>,
    pub(super) findings: Vec<PathBuf>,
}

impl Tally {
    pub(super) fn read(log: &str, findings: Vec<PathBuf>) -> Self {
        let mut tally = Self { findings, ..Self::default() };
        for line in log.lines() {
            if let Some(stat) = line.strip_prefix("stat::") {
                let value = stat.rsplit(' ').next().and_then(|value| value.parse().ok());
                match (stat.split(':').next().unwrap_or_default(), value) {
                    ("number_of_executed_units", Some(value)) => tally.executions = value,
                    ("average_exec_per_sec", Some(value)) => tally.per_second = value,
                    _ => {}
                }
            } else if let Some(stages) = line.strip_prefix("stages: ") {
                tally.stages = Some(stages.to_owned());
            } else if line.starts_with('#') {
                tally.progress(line);
            } else if line.contains("inline 8-bit counters): ") {
                let before = line.split(" (").nth(1).unwrap_or_default();
                let number = before.split_whitespace().next().and_then(|word| word.parse().ok());
                tally.edges.1 += number.unwrap_or(0);
            }
        }
        tally
    }

    /// Reads a progress line: `#12 NEW cov: 345 ft: 678 corp: 9/10b …`.
    fn progress(&mut self, line: &str) {
        let words: Vec<&str> = line.split_whitespace().collect();
        for pair in words.windows(2) {
            let &[name, value] = pair else { continue };
            let value = value.split('/').next().and_then(|value| value.parse().ok());
            match (name, value) {
                ("cov:", Some(value)) => self.edges.0 = value,
                ("ft:", Some(value)) => self.features = value,
                ("corp:", Some(value)) => self.inputs = value,
                _ => {}
            }
        }
    }

    pub(super) fn line(&self, target: &str) -> String {
        let Self { executions, per_second, edges: (edges, all), features, inputs, .. } = self;
        let mut line = format!(
            "{target:18} {executions:>10} executions {per_second:>7}/s  {edges:>6} of {all} edges  \
             {features:>6} features  {inputs:>5} inputs  {} findings\n",
            self.findings.len()
        );
        if let Some(stages) = &self.stages {
            line.push_str(&format!("    {stages}\n"));
        }
        line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_read_from_the_log() {
        let log = "INFO: Loaded 1 modules   (2904 inline 8-bit counters): 2904 [0x1, 0x2), \n\
            #2\tINITED cov: 107 ft: 108 corp: 1/1b exec/s: 0 rss: 40Mb\n\
            #900\tNEW    cov: 211 ft: 290 corp: 12/88b lim: 4 exec/s: 450 rss: 41Mb\n\
            stat::number_of_executed_units: 1000\nstat::average_exec_per_sec:     500\n\
            stages: run 1000\n";
        let tally = Tally::read(log, Vec::new());
        let expected = Tally {
            executions: 1000,
            per_second: 500,
            edges: (211, 2904),
            features: 290,
            inputs: 12,
            stages: Some("run 1000".into()),
            findings: Vec::new(),
        };
        assert_eq!(tally, expected);
    }
}
