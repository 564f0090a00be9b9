//! The arguments of `monitor` that say which other programs get the values.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;
use sensedsl_sinks::config::ROS_DISTROS;

#[derive(Debug, Args)]
pub(crate) struct SinkArgs {
    /// Pass the values on to other programs, as this configuration says
    #[arg(long, value_name = "FILE", help_heading = "Other programs")]
    pub(crate) config: Option<PathBuf>,
    /// Print a configuration for the boards of the design, with comments; or write it to a file
    #[arg(long, value_name = "FILE", num_args = 0..=1, require_equals = true, help_heading = "Other programs")]
    pub(crate) init_config: Option<Option<PathBuf>>,
    /// Publish the values at an MQTT broker, and take commands from there
    #[arg(long, value_name = "BROKER", help_heading = "Other programs")]
    pub(crate) mqtt: Option<String>,
    /// Serve pages and scripts over WebSocket, at 127.0.0.1:8765 unless you say
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, require_equals = true, help_heading = "Other programs")]
    pub(crate) websocket: Option<Option<String>>,
    /// Send the values to `PlotJuggler`, at 127.0.0.1:9870 unless you say
    #[arg(long, value_name = "ADDRESS", num_args = 0..=1, require_equals = true, help_heading = "Other programs")]
    pub(crate) plotjuggler: Option<Option<String>>,
    /// The release of the other programs of ROS 2, in place of `distro` in the file
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(ROS_DISTROS), help_heading = "Other programs")]
    pub(crate) ros_distro: Option<String>,
}

impl SinkArgs {
    /// Whether any program gets the values.
    pub(crate) fn is_any(&self) -> bool {
        let short = [self.websocket.is_some(), self.plotjuggler.is_some(), self.mqtt.is_some()];
        self.config.is_some() || short.contains(&true)
    }
}
