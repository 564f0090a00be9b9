//! The host for MATLAB and Octave: what reads a record of a run, as a struct for each device.
//!
//! In: a [`HostPlan`]. Out: files. `names.rs` makes field names, `view.rs` puts the plan in MATLAB's words, `runtime/` is
//! hand-written and copied.
//!
//! # Example
//!
//! ```
//! use std::collections::BTreeMap;
//!
//! use sensedsl_host_matlab::Matlab;
//! use sensedsl_job::host::{Host as _, HostBoard, HostPlan};
//! use sensedsl_wire::{Direction, Item, ScalarType, Schema, ValueType};
//!
//! let light = Item {
//!     id: 17,
//!     name: "Light".to_owned(),
//!     direction: Direction::Sensor,
//!     value: ValueType::scalar(ScalarType::Uint16),
//! };
//! let rover = HostBoard {
//!     name: "Rover".to_owned(),
//!     schema: Schema { items: vec![light], ..Schema::default() },
//!     baud: 115_200,
//!     silence_ms: None,
//!     presentations: BTreeMap::new(),
//!     cycles_ms: BTreeMap::new(),
//! };
//! let files = Matlab.render(&HostPlan::new("garden", &[rover]));
//! let plots = files.get("plot_garden.m").unwrap();
//! assert!(str::from_utf8(&plots.bytes).unwrap().contains("plot(run.Rover.Light.t, run.Rover.Light.value"));
//! ```

mod names;
mod view;

use sensedsl_files::{FileSet, print, templates};
use sensedsl_job::host::{About, Compile, Host, HostPlan};
use view::DesignView;

/// The host `matlab`.
pub struct Matlab;

templates! {
    design: DesignView;
    Plot = "plot.m.txt";
    Readme = "README.md.txt";
}

/// The hand-written reader.
const READER: &str = include_str!("../runtime/read_record.m");

impl Host for Matlab {
    fn name(&self) -> &'static str {
        "matlab"
    }

    fn about(&self) -> About {
        About {
            language: "MATLAB, Octave 7",
            needs: "nothing",
            gives: "a reader of the monitor's records: a struct with times, values and unit for each device",
        }
    }

    /// A file of functions calls none of them.
    fn compile(&self) -> Compile {
        Compile {
            program: "octave-cli",
            arguments: &["--norc", "--quiet"],
            extension: "m",
            standard: "",
            tree: None,
        }
    }

    fn render(&self, plan: &HostPlan) -> FileSet {
        let design = &DesignView::new(plan);
        let mut files = FileSet::default();
        files.add("README.md", print(&Readme { design }));
        files.add("read_record.m", READER);
        files.add(format!("plot_{}.m", design.own), print(&Plot { design }));
        files
    }
}
