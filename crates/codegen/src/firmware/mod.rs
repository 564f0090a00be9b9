//! Firmware: the program on the board, for each operating system one module.

pub mod chibios;
