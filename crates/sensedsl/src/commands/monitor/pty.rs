//! A board's bytes on a pseudo-terminal, for a program that expects the board there: `--pty`.
//!
//! In: what the board sends, now or in a record. Out: the same bytes to the program, and answers to its questions who
//! the board is and how it is; its commands are not passed on.

use std::time::Duration;

use anyhow::Result;
use sensedsl_host::{Board, Moment, News, Output, What, Wish};
use sensedsl_wire::{Decoder, Direction, Event, Health, encode_health, encode_hello};

use crate::commands::simulate::Pty;

/// The pseudo-terminal of one board.
struct Mirror {
    place: usize,
    board: Board,
    pty: Pty,
    is_connected: bool,
    asked: Vec<u8>,
    health: Option<Health>,
    /// Where it is, until that is told.
    note: Option<String>,
}

/// One for each board; says where they are.
pub(super) fn of_boards(boards: &[Board]) -> Result<Vec<Box<dyn Output>>> {
    let mut all: Vec<Box<dyn Output>> = Vec::new();
    for (place, board) in boards.iter().enumerate() {
        let pty = Pty::open()?;
        let note = Some(format!("`{}` is at {}", board.name, pty.name()));
        let (asked, board) = (Vec::new(), board.clone());
        all.push(Box::new(Mirror {
            place,
            board,
            pty,
            is_connected: false,
            asked,
            health: None,
            note,
        }));
    }
    Ok(all)
}

impl Output for Mirror {
    fn take(&mut self, news: &News<'_>) {
        if news.board != self.place {
            return;
        }
        match news.what {
            What::Received(bytes) => self.pty.write(bytes, self.is_connected),
            What::Health(health) => self.health = Some(health.clone()),
            What::Sent(_)
            | What::Online
            | What::Offline(_)
            | What::Report(_)
            | What::Command { .. } => {}
        }
    }

    fn look(&mut self, _: Moment) -> Vec<Wish> {
        self.is_connected = self.pty.is_connected();
        self.asked.extend(self.pty.read());
        let mut decoder = Decoder::new(&self.board.schema, Direction::Actuator);
        let mut answers = Vec::new();
        // A question that is not whole yet is asked again.
        decoder.feed(&std::mem::take(&mut self.asked), |event| match event {
            Event::HelloRequest => answers.push(encode_hello(&self.board.schema)),
            Event::HealthRequest => answers.extend(
                self.health.iter().filter_map(|it| encode_health(&self.board.schema, it).ok()),
            ),
            Event::Hello(_) | Event::Report(..) | Event::Health(_) | Event::OtherHealth(_) => {}
        });
        for answer in answers {
            self.pty.write(&answer, self.is_connected);
        }
        self.note.take().map(Wish::Note).into_iter().collect()
    }

    fn close(&mut self, _: Moment) -> Vec<Wish> {
        let _ = self.pty.wait(Duration::from_millis(1));
        Vec::new()
    }
}
