//! Boards with an AVR: images on [a board around simavr's processor](../../avr/README.md), a process that asks what is
//! around it.
//!
//! [`child`] is that process, [`board`] puts it on the bench of a job, with the world and the judge of the other
//! emulated boards, [`trial`] runs it under a host, and [`pads`] compares its registers with the wiring. Needs a C
//! compiler and libsimavr; programs need avr-gcc and avr-libc, sketches the Arduino core.

pub(crate) mod board;
pub(crate) mod child;
mod codec;
mod faults;
mod follower;
mod hosts;
mod jobs;
mod mistakes;
mod pads;
mod sketches;
mod tools;
mod trial;
mod units;
mod usb;
