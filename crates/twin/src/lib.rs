//! A board's twin: firmware runs on an emulated MCU, and a simulated world is on its pins.
//!
//! In: bytes, which are an image and what a host sends. Out: events with times. Time is virtual and counted in
//! nanoseconds since the board got power, so that a run is the same each time, to the byte.
//!
//! [`Surroundings`](sensedsl_surroundings::Surroundings) is the interface: an emulated MCU (feature `machine`) asks for
//! the signals on its pads and buses, and the parts here answer.
//!
//! [`world`] describes what happens around a board, [`plants`] turn what it does into what it measures, [`mod@bench`] puts parts behind its pins, [`soft`] does the board's
//! job in this program with [`tables`] of its parts, `emulated` does it with an image on the machine, and [`judge`]
//! compares the board's reports with the world. Nothing in this crate reads a file or a clock.
//!
//! # Example
//!
//! ```
//! # use sensedsl_diagnostics::SourceMap;
//! # use sensedsl_job::jobs;
//! # use sensedsl_model::NoFiles;
//! # use sensedsl_session::{Ask, On, Workspace};
//! use sensedsl_twin::bench::Bench;
//! use sensedsl_twin::soft::SoftBoard;
//! use sensedsl_twin::world::{self, Scene};
//! use sensedsl_wire::{Decoder, Direction, Event, Scalar};
//!
//! # let mut workspace = Workspace::default();
//! # let text = "board Rover on STM32F4DiscoveryBoard {
//! #     sensor Light returns uint16 { id = 1; type = analog; }
//! # }";
//! # workspace.open("rover.sense", text);
//! # let snapshot = workspace.snapshot("rover.sense", On::default(), &NoFiles);
//! # let answer = snapshot.solve(&Ask::default());
//! # let (design, wiring) = answer.wired().unwrap();
//! # let rover = jobs(design, wiring).next().unwrap();
//! // `rover` is the job of a board with one analog sensor, whose identifier is 1.
//! let text = "[devices]\nLight = 1000";
//! let scene = Scene {
//!     design,
//!     devices: &[rover.devices[0].index],
//!     transport: rover.board.link.transport,
//!     seed: None,
//!     samples: &|name| Err(format!("there is no {name}")),
//! };
//! # let file = SourceMap::default().add("world.toml", text);
//! let (world, mistakes) = world::read(file, text, &scene);
//! assert!(mistakes.is_empty());
//!
//! let mut board = SoftBoard::new(&rover, Bench::new(&rover, &world, 1));
//! board.run_until(1_000_000_000);
//! let mut light = None;
//! Decoder::new(&rover.schema, Direction::Sensor).feed(&board.link_read(), |event| {
//!     let Event::Report(_, values) = event else { return };
//!     light = values.into_iter().next();
//! });
//! assert_eq!(light, Some((1, vec![Scalar::Unsigned(1_000)])));
//! ```

mod arith;
pub mod bench;
pub mod commands;
#[cfg(feature = "machine")]
pub mod emulated;
pub mod judge;
#[cfg(feature = "machine")]
pub mod pads;
mod parts;
pub mod plants;
#[cfg(feature = "machine")]
mod ports;
pub mod range;
pub mod soft;
pub mod tables;
pub mod trial;
pub mod truth;
pub mod world;
