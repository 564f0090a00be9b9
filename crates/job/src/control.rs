//! The user's code on a board: what it reads and sets, and whom an actuator obeys.

use sensedsl_model::design::Controller;

use crate::BoardJob;

/// Code of the user's that runs in a cycle of its own.
#[derive(Clone, Debug)]
pub struct JobController<'a> {
    /// The controller.
    pub controller: &'a Controller,
    /// The identifier in code, in snake case: `follow`.
    pub ident: String,
    /// The index into [`BoardJob::devices`] of the device that counts its steps that were late or too long.
    pub own: usize,
    /// Indices into [`BoardJob::devices`] of the devices whose values it gets.
    pub reads: Vec<usize>,
    /// Indices into [`BoardJob::devices`] of the devices that it sets.
    pub sets: Vec<usize>,
}

/// Whom a device that is set obeys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// The host; or nobody, because it is measured.
    Host,
    /// A controller; what the host commands is refused.
    Code,
    /// A controller, unless the host has commanded something and still speaks.
    CodeOrHost,
}

impl BoardJob<'_> {
    /// Whom a device obeys, by its index into [`BoardJob::devices`].
    #[must_use]
    pub fn owner(&self, index: usize) -> Owner {
        match self.controllers.iter().find(|one| one.sets.contains(&index)) {
            Some(own) if own.controller.host_overrides => Owner::CodeOrHost,
            Some(_) => Owner::Code,
            None => Owner::Host,
        }
    }
}
