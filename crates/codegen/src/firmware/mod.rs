//! Firmware: the program on the board, for each operating system a folder and a line in
//! [`TARGETS`](crate::target::TARGETS).

pub mod chibios;
