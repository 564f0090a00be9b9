//! Hosts with their middleware: placeholder filled in next.
