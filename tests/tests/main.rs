//! All tests of the whole as one program: it is linked once, and its tests share all processors.
//! [`README.md`](../README.md) describes each module.
#![cfg(test)]
#![allow(clippy::disallowed_methods, reason = "tests make files, run programs and measure time")]

mod alloy;
mod boards;
mod boards_page;
mod can_peer;
mod circles;
mod command_line;
mod corpus;
mod crash;
mod decoders;
mod devices;
mod driver_tables;
mod drivers;
mod drivers_pages;
mod embassy;
mod examples;
mod false_alarms;
mod firmware;
mod generate;
mod golden;
mod hosts;
mod identifiers;
mod injection;
mod library_page;
mod limits;
mod limits_page;
mod messages;
mod monitor;
mod monitor_damage;
mod monitor_screen;
mod no_panic;
mod pages;
mod paper;
mod parts;
mod pictures;
mod prolog;
mod proof;
mod records;
mod robots;
mod scripts;
mod sheet;
mod shown_values;
mod simulate;
mod single_files;
mod sinks;
mod soft_units;
mod spreadsheets;
mod strangers;
mod tidy;
mod timing;
mod traceability;
mod web;
mod wiring;
mod wokwi;
