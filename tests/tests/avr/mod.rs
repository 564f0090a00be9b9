//! Boards with an AVR: images on [a board around simavr's processor](../../avr/README.md), a process that asks what is
//! around it.
//!
//! [`child`] is that process, [`board`] puts it on the bench of a job, with the world and the judge of the other
//! emulated boards. Needs a C compiler and libsimavr; programs need avr-gcc and avr-libc, sketches the Arduino core.

pub(crate) mod board;
pub(crate) mod child;
mod codec;
mod follower;
mod jobs;
mod sketches;
mod tools;
mod units;
mod usb;
