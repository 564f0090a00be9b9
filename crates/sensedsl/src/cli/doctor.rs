//! The arguments of `doctor`.

use clap::{Args, ValueEnum};

#[derive(Debug, Args)]
pub(crate) struct DoctorArgs {
    /// What you want to do; everything unless you say. With it, the exit status is 2 if something is missing
    #[arg(value_enum, value_name = "PURPOSE")]
    pub(crate) purposes: Vec<Purpose>,
    /// How to say it
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: DoctorFormat,
}

/// What somebody wants to do that takes more than this program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Purpose {
    /// Build firmware in C on `ChibiOS`
    Chibios,
    /// Build firmware in Rust on Embassy
    Embassy,
    /// Build and write Arduino sketches
    Arduino,
    /// Write a program to a board
    Flash,
    /// Talk to a board at a serial port
    Boards,
    /// Build and run a generated host application
    Hosts,
}

impl Purpose {
    /// All of them.
    pub(crate) const ALL: [Self; 6] =
        [Self::Chibios, Self::Embassy, Self::Arduino, Self::Flash, Self::Boards, Self::Hosts];

    /// Its name on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Chibios => "chibios",
            Self::Embassy => "embassy",
            Self::Arduino => "arduino",
            Self::Flash => "flash",
            Self::Boards => "boards",
            Self::Hosts => "hosts",
        }
    }

    /// What it is, as a heading.
    pub(crate) const fn title(self) -> &'static str {
        match self {
            Self::Chibios => "Firmware in C on ChibiOS",
            Self::Embassy => "Firmware in Rust on Embassy",
            Self::Arduino => "Arduino sketches",
            Self::Flash => "Write a program to a board",
            Self::Boards => "Boards at serial ports",
            Self::Hosts => "Host applications",
        }
    }
}

/// How `doctor` prints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum DoctorFormat {
    /// For people
    #[default]
    Human,
    /// For scripts
    Json,
}
