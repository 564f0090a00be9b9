//! The screen: a run on the whole terminal, with a table, plots, notes and a prompt.
//!
//! In: news, sentences and keys. Out: pictures, and what is asked for. `state.rs` knows what keys mean, `draw.rs` and
//! the files beside it draw, `guard.rs` has the terminal and gives it back.

mod canvas;
mod draw;
mod guard;
mod history;
mod keys;
mod notes;
#[cfg(test)]
mod picture;
mod plot;
mod prompt;
mod slider;
mod state;
mod style;
mod table;
#[cfg(test)]
mod tests;
mod traces;
mod view;
mod words;

use std::io;
use std::sync::mpsc::{Receiver, TryRecvError, sync_channel};
use std::time::{Duration, Instant};

use anyhow::Result;
use ratatui_crossterm::crossterm::event;
use sensedsl_host::{Board, Moment, News};

use super::face::{Ask, Face};
use super::link::Link;
use super::show::tables;
use crate::terminal::Terminal;
use guard::Guard;
use keys::{Key, Pressed};
use state::State;
use style::Look;

/// The least time between two pictures, and the usual one of a table.
const PAUSE_MIN: Duration = Duration::from_millis(50);
const USUAL: Duration = Duration::from_millis(100);
/// Plots are drawn so often while the time goes by that they show: what moves less than a dot is not seen.
const STEPS: u32 = 200;
const WITH_PLOTS_MAX: Duration = Duration::from_millis(500);
/// How many keys wait for the next look.
const PRESSED_MAX: usize = 256;

/// A run on the whole terminal.
pub(super) struct Screen<'a> {
    terminal: &'a Terminal,
    guard: Option<Guard>,
    state: State<'a>,
    pressed: Receiver<Pressed>,
    look: Look,
    drawn: Option<Instant>,
    is_pressed: bool,
}

impl<'a> Screen<'a> {
    /// Takes the terminal.
    ///
    /// # Errors
    /// Fails if the terminal cannot be taken: nobody can press keys, or it has no pages.
    pub(super) fn open(terminal: &'a Terminal, boards: Vec<&'a Board>) -> io::Result<Self> {
        let guard = Guard::open()?;
        Ok(Self {
            terminal,
            guard: Some(guard),
            state: State::new(boards),
            pressed: listen(),
            look: Look { has_colours: terminal.colour(), has_shapes: terminal.has_shapes() },
            drawn: None,
            is_pressed: false,
        })
    }

    /// Takes what was pressed since the last look.
    fn take_keys(&mut self) -> Result<Vec<Ask>> {
        let mut asks = Vec::new();
        // What is pressed next may depend on what becomes of the first thing that is asked for.
        while asks.is_empty() {
            let pressed = match self.pressed.try_recv() {
                Ok(pressed) => pressed,
                Err(TryRecvError::Empty) => return Ok(asks),
                // The terminal is gone.
                Err(TryRecvError::Disconnected) => {
                    asks.push(Ask::Quit);
                    return Ok(asks);
                }
            };
            self.is_pressed = true;
            match &pressed {
                Pressed::Key(Key::Named("ctrl-z")) => self.pause()?,
                Pressed::Key(Key::Named("ctrl-l")) => {
                    if let Some(guard) = &mut self.guard {
                        guard.renew()?;
                    }
                }
                Pressed::Key(_) | Pressed::Text(_) | Pressed::Resized => {
                    asks.extend(self.state.press(&pressed));
                }
            }
        }
        Ok(asks)
    }

    /// Lets the shell have the terminal until the program goes on.
    fn pause(&mut self) -> Result<()> {
        #[cfg(unix)]
        if let Some(guard) = &mut self.guard {
            guard::give_back();
            rustix::process::kill_process(
                rustix::process::getpid(),
                rustix::process::Signal::TSTP,
            )?;
            guard.keep()?;
        }
        Ok(())
    }

    fn is_due(&mut self) -> bool {
        let step = self.state.view.span() / STEPS;
        let pause = match (self.is_pressed, self.state.plotted.is_empty(), self.state.is_large) {
            (true, ..) => PAUSE_MIN,
            (false, true, _) => USUAL,
            // The table beside them goes on as usual.
            (false, false, false) => step.clamp(PAUSE_MIN, USUAL),
            (false, false, true) => step.clamp(PAUSE_MIN, WITH_PLOTS_MAX),
        };
        let is_due = self.drawn.is_none_or(|drawn| drawn.elapsed() >= pause);
        if is_due {
            (self.drawn, self.is_pressed) = (Some(Instant::now()), false);
        }
        is_due
    }
}

impl Face for Screen<'_> {
    fn take(&mut self, news: &News<'_>, _: &[Link<'_>]) -> Result<()> {
        self.state.hear(news);
        Ok(())
    }

    fn say(&mut self, text: &str) -> Result<()> {
        self.state.notes.say(self.state.now, text);
        Ok(())
    }

    fn look(&mut self, now: Moment, links: &[Link<'_>]) -> Result<Vec<Ask>> {
        self.state.now = now.run;
        let asks = self.take_keys()?;
        if !self.is_due() {
            return Ok(asks);
        }
        let Some(guard) = &mut self.guard else { return Ok(asks) };
        guard.keep()?;
        let (state, look) = (&mut self.state, self.look);
        let _ = guard.terminal.draw(|frame| {
            let cursor = draw::draw(frame.buffer_mut(), state, links, now.run, look);
            if let Some(cursor) = cursor {
                frame.set_cursor_position(cursor);
            }
        })?;
        Ok(asks)
    }

    fn close(&mut self, now: Moment, links: &[Link<'_>]) -> Result<()> {
        let Some(guard) = self.guard.take() else { return Ok(()) };
        drop(guard);
        for line in self.state.notes.left() {
            self.terminal.aside(&line)?;
        }
        // Of a board that never reported there is nothing to show.
        let has_values = links.iter().flat_map(|link| &link.latest).any(Option::is_some);
        let text = if has_values { tables(links, now.run) } else { String::new() };
        Ok(self.terminal.result(&text)?)
    }

    fn has_terminal(&self) -> bool {
        self.guard.is_some()
    }
}

/// What is pressed from now on. The thread waits for keys as long as the program runs: nothing can take it away from a
/// read.
fn listen() -> Receiver<Pressed> {
    let (to_screen, pressed) = sync_channel(PRESSED_MAX);
    let _ = std::thread::spawn(move || {
        while let Ok(event) = event::read() {
            if let Some(pressed) = keys::read(event)
                && to_screen.send(pressed).is_err()
            {
                return;
            }
        }
    });
    pressed
}
