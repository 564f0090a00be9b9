//! What a HAL of Embassy must say so that projects are generated for its MCUs.
//!
//! A [`Hal`] is a crate of Embassy; its [`Drivers`] are what the crate can do on one line of MCUs. There is a small
//! trait for each kind of device, and a HAL answers `None` for the kinds that it has no driver for: these are reported
//! as gaps. In: the context of a board. Out: pieces of a project as data, in the words of the HAL. What is the same for
//! all HALs is decided by the file of the kind, which names none of them.
//!
//! What all HALs have in common, and a new one must have as well: `Input`, `Output`, `Level` and `Pull` for GPIO;
//! `Peri` and `interrupt`; `hal::pac`, where a unit's registers have the unit's name; and a folder in `sense-embassy`
//! with modules of the same names as those of its neighbours.

pub(crate) mod buses;
pub(crate) mod inputs;
pub(crate) mod link;
pub(crate) mod motors;
pub(crate) mod outputs;
pub(crate) mod types;

use sensedsl_board::profile::TargetProfile;
use sensedsl_job::{BoardJob, JobConnection};

use crate::context::Context;
use crate::names::{Chip, Names};
use buses::{Can, I2c, OneWire, Serial, Spi};
use inputs::{Analog, Capture, Edges, Encoder};
use link::Link;
use motors::Motors;
use outputs::{Dac, Pins, Pulses};
use types::Types;

/// A crate of Embassy with the drivers of some MCUs.
pub(crate) trait Hal: Sync {
    /// The crate, and texts that are the same for all its MCUs.
    fn package(&self) -> &'static Package;

    /// What it can do on one line of MCUs. It reads the keys of `[system]` that are its own
    /// ([`Names::settings`], [`Names::line_settings`]) and refuses those that it does not know.
    ///
    /// # Errors
    ///
    /// What is wrong with the keys.
    fn drivers(&self, names: &Names) -> Result<Box<dyn Drivers>, String>;
}

/// The crate of a HAL, and texts that are the same for all its MCUs.
#[derive(Debug)]
pub(crate) struct Package {
    /// What profiles call the HAL, which is its feature in `sense-embassy` as well.
    pub(crate) name: &'static str,
    /// The crate: `embassy-rp`.
    pub(crate) crate_name: &'static str,
    /// The exact version.
    pub(crate) version: &'static str,
    /// How programs run on its cores.
    pub(crate) core: &'static Core,
    /// The ticks of its time driver in a second, as features of `embassy-time` are spelled: `1_000_000`.
    pub(crate) tick_hz: &'static str,
    /// The imports of `main.rs`: complete lines.
    pub(crate) main_uses: &'static str,
    /// The imports of `wiring.rs`: complete lines.
    pub(crate) wiring_uses: &'static str,
    /// The features of the HAL that `sense-embassy` needs.
    pub(crate) runtime_asks: &'static [&'static str],
    /// The features of `sense-embassy` that say which versions of units an MCU has: all that a section may ask for.
    pub(crate) runtime_features: &'static [&'static str],
    /// The lines of `sense-embassy`'s manifest for crates that only this HAL's folder needs.
    pub(crate) runtime_needs: &'static [&'static str],
    /// The lines of the manifest of a check of types, beside that of the HAL.
    pub(crate) check_needs: &'static [&'static str],
    /// How a program is written to a board without a debug probe; `None` if that takes a probe.
    pub(crate) loader: Option<Loader>,
}

/// How programs are put together, started and run on a sort of cores.
#[derive(Debug)]
pub(crate) struct Core {
    /// Whether it is a Cortex-M, whose assembler and atomics `sense-embassy` needs crates for.
    pub(crate) is_cortex_m: bool,
    /// The lines of a program's manifest for what starts it and runs its tasks.
    pub(crate) needs: &'static [&'static str],
    /// The crates that every interrupt goes through, with how they are optimised.
    pub(crate) speeds: &'static [(&'static str, &'static str)],
    /// The attribute of `main`.
    pub(crate) main: &'static str,
    /// What a boot loader looks for in a program: an item of `main.rs`.
    pub(crate) item: Option<&'static str>,
    /// Arguments of the compiler, as a list of TOML without its brackets.
    pub(crate) rustflags: &'static str,
    /// The command that runs a program on a board, without the program. `{chip}` is what debug probes call the chip.
    pub(crate) runner: &'static str,
    /// How one gets that command, and what it does.
    pub(crate) runner_from: &'static str,
    pub(crate) runs: &'static str,
}

/// Cortex-M, with the executor that runs a level of priority in an interrupt.
pub(crate) static CORTEX_M: Core = Core {
    is_cortex_m: true,
    needs: &[
        "cortex-m-rt = \"=0.7.7\"",
        "embassy-executor = { version = \"=0.10.0\", features = [\"executor-interrupt\", \"executor-thread\", \"platform-cortex-m\"] }",
    ],
    speeds: &[
        ("embassy-executor", "3"),
        ("embassy-hal-internal", "3"),
        ("embassy-sync", "\"s\""),
        ("embassy-time", "3"),
        ("embassy-time-queue-utils", "3"),
    ],
    main: "embassy_executor::main",
    item: None,
    rustflags: "\"-C\", \"link-arg=--nmagic\", \"-C\", \"link-arg=-Tlink.x\"",
    runner: "probe-rs run --chip {chip}",
    runner_from: "Debug probes: `cargo install probe-rs-tools`.",
    runs: "writes it to the board by a debug probe; needs probe-rs",
};

/// How a boot loader takes a program over USB.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Loader {
    /// What the person does first: `hold BOOTSEL while the board is plugged in`.
    pub(crate) how: &'static str,
    /// The command, without the path of the program.
    pub(crate) command: &'static str,
}

/// What a HAL can do on one line of MCUs. A kind of device without drivers is a gap.
pub(crate) trait Drivers {
    /// The project as a whole.
    fn project(&self) -> &dyn Project;
    /// Pins and outputs of GPIO.
    fn pins(&self) -> &dyn Pins;
    /// The link to the host.
    fn link(&self) -> &dyn Link;

    /// Digital inputs whose edges interrupt.
    fn edges(&self) -> Option<&dyn Edges> {
        None
    }
    /// Analog inputs.
    fn analog(&self) -> Option<&dyn Analog> {
        None
    }
    /// Input capture.
    fn capture(&self) -> Option<&dyn Capture> {
        None
    }
    /// Encoders of two tracks.
    fn encoder(&self) -> Option<&dyn Encoder> {
        None
    }
    /// Pulses that timers make.
    fn pulses(&self) -> Option<&dyn Pulses> {
        None
    }
    /// Stepper motors.
    fn motors(&self) -> Option<&dyn Motors> {
        None
    }
    /// Analog outputs.
    fn dac(&self) -> Option<&dyn Dac> {
        None
    }
    /// I²C buses.
    fn i2c(&self) -> Option<&dyn I2c> {
        None
    }
    /// SPI buses.
    fn spi(&self) -> Option<&dyn Spi> {
        None
    }
    /// Wires that both ends pull low.
    fn onewire(&self) -> Option<&dyn OneWire> {
        None
    }
    /// Serial ports.
    fn serial(&self) -> Option<&dyn Serial> {
        None
    }
    /// CAN controllers.
    fn can(&self) -> Option<&dyn Can> {
        None
    }
    /// The wiring in types, for `check --typecheck`.
    fn types(&self) -> Option<&dyn Types> {
        None
    }
}

/// Makes the settings of a HAL its drivers, which it has for these kinds.
macro_rules! drivers {
    ($settings:ty; $($kind:ident: $driver:path,)+) => {
        impl $crate::hal::contract::Drivers for $settings {
            fn project(&self) -> &dyn $crate::hal::contract::Project {
                self
            }
            fn pins(&self) -> &dyn $crate::hal::contract::outputs::Pins {
                self
            }
            fn link(&self) -> &dyn $crate::hal::contract::link::Link {
                self
            }
            $(
                fn $kind(&self) -> Option<&dyn $driver> {
                    Some(self)
                }
            )+
        }
    };
}
pub(crate) use drivers;

/// What a project as a whole has of its HAL.
pub(crate) trait Project {
    /// The mistakes in the names of a profile; empty if there are none.
    fn problems(&self, _profile: &TargetProfile, _names: &Names) -> Vec<String> {
        Vec::new()
    }

    /// Why there is no project for a board, worded to follow a colon; `None` if there is one.
    fn refusal(&self, _job: &BoardJob<'_>, _profile: &TargetProfile) -> Option<String> {
        None
    }

    /// What a connection needs and there is no code for, although the HAL has drivers of its kind, worded to follow
    /// "has no code for".
    fn lacks(&self, _job: &BoardJob<'_>, _wire: &JobConnection<'_>) -> Option<&'static str> {
        None
    }

    /// The features of the HAL's crate, the chip's among them.
    fn features(&self, context: &Context<'_>) -> Vec<String>;

    /// The lines of the manifest for what only this chip's program needs, beside the HAL.
    fn needs(&self, _context: &Context<'_>) -> Vec<String> {
        Vec::new()
    }

    /// Conditions of `templates/packages.txt` that hold for a chip, beside the name of the HAL.
    fn lock_tags(&self, _chip: &Chip) -> Vec<&'static str> {
        Vec::new()
    }

    /// The family of the chip in UF2 files; `None` if the board's boot loader does not take them.
    fn uf2_family(&self, _context: &Context<'_>) -> Option<u32> {
        None
    }

    /// How `main` begins. `is_usb`: whether the link needs the clock of a USB device.
    fn begin(&self, context: &Context<'_>, is_usb: bool) -> Begin;

    /// The number of the least urgent interrupt that tasks can run in; the HAL's own interrupts have the number 0.
    fn last_priority(&self, context: &Context<'_>) -> usize;
}

/// How a project begins, in the words of its HAL.
#[derive(Debug)]
pub(crate) struct Begin {
    /// The type of the HAL's configuration.
    pub(crate) config_type: &'static str,
    /// The body of the function that makes it, a line each.
    pub(crate) config: Vec<String>,
    /// The first statements of `main`: they begin `STATUS` with the cause of the reset, and make `wiring`.
    pub(crate) start: Vec<String>,
    pub(crate) watchdog: Watchdog,
    /// Arguments of the linker besides those of all cores: `, "-C", "link-arg=…"`.
    pub(crate) scripts: &'static str,
    /// `memory.x`; `None` if the HAL has it.
    pub(crate) memory: Option<String>,
}

/// The watchdog, which has the methods `unleash` and `pet`.
#[derive(Debug)]
pub(crate) struct Watchdog {
    pub(crate) type_: String,
    pub(crate) make: String,
}
