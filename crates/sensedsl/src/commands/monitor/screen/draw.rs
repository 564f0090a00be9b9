//! The whole picture: boards, table, plots, notes and the line at the bottom, or the page of keys.
//!
//! In: the state, the links and the time. Out: a frame of the terminal. Any size will do: what there is no room for is
//! left out, the table last.

use std::time::Duration;

use ratatui_core::buffer::Buffer;
use ratatui_core::layout::{Position, Rect};
use sensedsl_diagnostics::visible;
use sensedsl_wire::Direction;

use super::super::link::Link;
use super::super::words::restarted;
use super::keys::HELP;
use super::prompt::Check;
use super::state::{Condition, Mode, State};
use super::style::{Look, Tone};
use super::words::{cut, moment, put, width, wrapped};
use super::{plot, table};

/// The least rows of plots: one frame, and the times below it.
const PLOTS_MIN: u16 = plot::FRAME_MIN + 1;
/// The most rows of the latest notes.
const NOTES_MAX: u16 = 6;
/// The columns of a group of keys, with the space between two.
const GROUP: u16 = 40;
const KEYS: usize = 17;

/// Which rows are for what.
struct Rows {
    heads: u16,
    table: u16,
    plots: u16,
    notes: u16,
    foot: u16,
}

/// Draws everything. Gives the place of the cursor, where something is being written.
pub(super) fn draw(
    buffer: &mut Buffer,
    state: &mut State<'_>,
    links: &[Link<'_>],
    now: Duration,
    look: Look,
) -> Option<Position> {
    state.now = now;
    let all = buffer.area;
    if all.is_empty() {
        return None;
    }
    if state.mode == Mode::Help {
        help(buffer, all, state, look);
        return None;
    }
    let rows = rows(state, all);
    let mut top = all.y;
    let mut next = |height: u16| {
        let area = Rect { y: top, height, ..all };
        top += height;
        area
    };
    let (heads_at, table_at, plots_at) = (next(rows.heads), next(rows.table), next(rows.plots));
    let (notes_at, foot_at) = (next(rows.notes), next(rows.foot));
    heads(buffer, heads_at, state, links, (now, look));
    table::draw(buffer, table_at, state, links, (now, look));
    plot::draw(buffer, plots_at, state, (now, look));
    notes(buffer, notes_at, state, look);
    foot(buffer, foot_at, state, (rows.plots, look))
}

fn rows(state: &State<'_>, all: Rect) -> Rows {
    let height = all.height;
    let foot = if state.mode == Mode::Prompt && height >= 4 { 2 } else { 1 };
    let boards = u16::try_from(state.boards.len()).unwrap_or(u16::MAX);
    let heads = if height >= 4 { boards.min((height / 5).max(1)) } else { 0 };
    let rest = height.saturating_sub(foot + heads);
    if state.mode == Mode::Notes {
        return Rows { heads, table: 0, plots: 0, notes: rest, foot };
    }
    let said = u16::try_from(state.notes.len()).unwrap_or(u16::MAX);
    let notes = if height >= 10 { said.min((height / 8).clamp(1, NOTES_MAX)) } else { 0 };
    let rest = rest - notes;
    let wanted = u16::try_from(state.shown.len()).unwrap_or(u16::MAX).saturating_add(1).max(2);
    let plots = match (state.plotted.is_empty(), state.is_large) {
        (true, _) => 0,
        (false, true) => rest,
        // Half of it, and what the table does not need.
        (false, false) => rest - wanted.min(rest / 2),
    };
    let plots = if plots < PLOTS_MIN && !state.is_large { 0 } else { plots };
    Rows { heads, table: rest - plots, plots, notes, foot }
}

/// A line a board: what it is called, whether it is there, and how it is.
fn heads(
    buffer: &mut Buffer,
    area: Rect,
    state: &State<'_>,
    links: &[Link<'_>],
    (now, look): (Duration, Look),
) {
    let wide = links.iter().map(|link| width(&visible(&link.board.name))).max().unwrap_or_default();
    let fit = usize::from(area.height);
    for (row, (index, link)) in (area.y..area.bottom()).zip(links.iter().enumerate()) {
        if index + 1 == fit && links.len() > fit {
            let (text, tone) = rest(state, links, index);
            let _ = put(buffer, area, (area.x, row), &text, look.of(tone));
            return;
        }
        let name = visible(&link.board.name);
        let x = put(buffer, area, (area.x, row), &name, look.of(Tone::Head));
        let x = x.max(area.x.saturating_add(u16::try_from(wide).unwrap_or(0))).saturating_add(1);
        let (text, tone) = match state.condition(index) {
            _ if link.is_over => ("over".to_owned(), Tone::Faint),
            Condition::Asking => ("asking who it is".to_owned(), Tone::Warning),
            Condition::Online => ("online".to_owned(), Tone::Good),
            Condition::Offline(why) => (format!("OFFLINE: {}", visible(why)), Tone::Bad),
        };
        let mut x = put(buffer, area, (x, row), &text, look.of(tone));
        if let Some(path) = link.source.path() {
            let at = (x.saturating_add(2), row);
            x = put(buffer, area, at, &visible(path), look.of(Tone::Plain));
        }
        for (fact, tone) in facts(link, now) {
            x = put(buffer, area, (x.saturating_add(2), row), &fact, look.of(tone));
        }
    }
}

/// How the boards are that have no line of their own.
fn rest(state: &State<'_>, links: &[Link<'_>], first: usize) -> (String, Tone) {
    let away: Vec<String> = (first..links.len())
        .filter(|board| matches!(state.condition(*board), Condition::Offline(_)))
        .filter_map(|board| links.get(board))
        .map(|link| visible(&link.board.name).into_owned())
        .collect();
    let count = links.len() - first;
    let all = if first == 0 { format!("{count} boards") } else { format!("{count} more boards") };
    if away.is_empty() {
        (all, Tone::Faint)
    } else {
        (format!("{all}, OFFLINE: {}", away.join(" ")), Tone::Bad)
    }
}

/// What is counted of a board; what went wrong comes first, because the end may be cut off.
fn facts(link: &Link<'_>, now: Duration) -> Vec<(String, Tone)> {
    let counts = link.counts();
    let health = link.health.as_ref();
    let refused = health.map_or(0, |health| u64::from(health.reports_refused));
    let wrong = [
        (counts.dropped_bytes, "bytes dropped"),
        (counts.lost, "reports lost"),
        (refused, "reports refused"),
    ];
    let mut facts =
        vec![(moment(now), Tone::Plain), (format!("{} frames", counts.frames), Tone::Plain)];
    let some = wrong.iter().filter(|(count, _)| *count > 0);
    facts.extend(some.map(|(count, what)| (format!("{count} {what}"), Tone::Warning)));
    let restarted = health.and_then(|health| restarted(link.board, health));
    facts.extend(restarted.map(|text| (text, Tone::Warning)));
    if let Some(health) = health {
        let up = moment(Duration::from_millis(health.uptime_ms.into()));
        facts.push((format!("up {up}"), Tone::Plain));
        facts.push((format!("{} reports sent", health.reports_sent), Tone::Plain));
        if health.load_percent <= 100 {
            facts.push((format!("load {} %", health.load_percent), Tone::Plain));
        }
    }
    facts
}

/// The latest notes, or in their own page those that are scrolled to.
fn notes(buffer: &mut Buffer, area: Rect, state: &mut State<'_>, look: Look) {
    let room = usize::from(area.height);
    if room == 0 {
        return;
    }
    if state.mode == Mode::Notes {
        state.page = room;
    }
    // A note takes a line at least, so there are no more than these.
    let mut lines: Vec<(String, String)> = Vec::new();
    for (at, text) in state.notes.seen(room) {
        let mut time = format!("{:>9}  ", moment(*at));
        let columns = usize::from(area.width).saturating_sub(width(&time));
        for line in wrapped(text, columns) {
            let blank = " ".repeat(width(&time));
            lines.push((std::mem::replace(&mut time, blank), line));
        }
    }
    let first = lines.len().saturating_sub(room);
    for (row, (time, text)) in (area.y..area.bottom()).zip(lines.iter().skip(first)) {
        let x = put(buffer, area, (area.x, row), time, look.of(Tone::Faint));
        let _ = put(buffer, area, (x, row), text, look.of(Tone::Plain));
    }
}

/// The line at the bottom: what is being written, what a key came to, or which keys there are.
fn foot(
    buffer: &mut Buffer,
    area: Rect,
    state: &State<'_>,
    (plots, look): (u16, Look),
) -> Option<Position> {
    let at = (area.x, area.y);
    match state.mode {
        Mode::Prompt => return Some(prompt(buffer, area, state, look)),
        Mode::Filter => {
            let text =
                cut(&format!("/{}", visible(&state.filter)), usize::from(area.width.max(1)) - 1);
            let x = put(buffer, area, at, &text, look.of(Tone::Plain));
            let found = format!(
                "   {} of {}: Enter keeps them, Esc shows all",
                state.shown.len(),
                state.items.len()
            );
            let _ = put(buffer, area, (x, area.y), &found, look.of(Tone::Faint));
            return Some((x, area.y).into());
        }
        Mode::Table | Mode::Notes | Mode::Help => {}
    }
    if let Some(told) = &state.told {
        let _ = put(buffer, area, at, told, look.of(Tone::Warning));
        return None;
    }
    if plots == 0 && !state.plotted.is_empty() && state.mode == Mode::Table {
        let text = "too low for table and plots: Enter shows the plots alone";
        let _ = put(buffer, area, at, text, look.of(Tone::Warning));
        return None;
    }
    let mut x = area.x;
    for (key, does) in hints(state) {
        if usize::from(x) + width(key) + width(does) + 1 > usize::from(area.right()) {
            break;
        }
        x = put(buffer, area, (x, area.y), key, look.of(Tone::Key));
        x = put(buffer, area, (x, area.y), &format!(" {does}  "), look.of(Tone::Faint));
    }
    None
}

/// The keys that are most useful at present.
fn hints(state: &State<'_>) -> Vec<(&'static str, &'static str)> {
    if state.mode == Mode::Notes {
        return vec![("↑ ↓ PgUp PgDn", "scroll"), ("Esc", "back"), ("q", "end")];
    }
    let is_actuator = state.item().is_some_and(|item| item.device.direction == Direction::Actuator);
    let mut hints = vec![("q", "end"), ("?", "keys"), ("↑↓", "choose"), ("Space", "plot")];
    if !state.plotted.is_empty() {
        let held = if state.view.is_frozen() { "go on" } else { "hold" };
        hints.extend([
            ("f", held),
            ("+ -", "time"),
            ("> <", "values"),
            ("← →", "scroll"),
            ("c", "cursor"),
        ]);
        hints.push(("Enter", if state.is_large { "smaller" } else { "larger" }));
    }
    if is_actuator {
        hints.extend([("s", "set"), ("[ ]", "less, more")]);
    }
    hints.extend([(":", "command"), ("/", "find"), ("n", "notes")]);
    hints
}

fn prompt(buffer: &mut Buffer, area: Rect, state: &State<'_>, look: Look) -> Position {
    let text = state.prompt.text();
    let room = usize::from(area.width).saturating_sub(2).max(1);
    let before: String = text.chars().take(state.prompt.cursor).collect();
    // The cursor is seen however long the line is.
    let skipped = (state.prompt.cursor + 1).saturating_sub(room);
    let seen: String = text.chars().skip(skipped).collect();
    let x = put(buffer, area, (area.x, area.y), ":", look.of(Tone::Key));
    let _ = put(buffer, area, (x, area.y), &visible(&seen), look.of(Tone::Plain));
    let written: String = before.chars().skip(skipped).collect();
    let place = x.saturating_add(u16::try_from(width(&written)).unwrap_or(0));
    if area.height > 1 {
        let (told, tone) = match state.prompt.check(&state.boards) {
            Check::Sends { told, .. } => (told, Tone::Good),
            Check::Wrong(why) => (why, Tone::Bad),
            Check::Hint(text) => (text, Tone::Faint),
        };
        let row = area.y + 1;
        let x = put(buffer, area, (area.x, row), &visible(&told), look.of(tone));
        let words = state.prompt.fitting(&state.boards).1;
        if !words.is_empty() {
            let words = words.iter().map(|word| visible(word).into_owned()).collect::<Vec<_>>();
            let text = format!("   Tab: {}", words.join(" "));
            let room = usize::from(area.right().saturating_sub(x));
            let _ = put(buffer, area, (x, row), &cut(&text, room), look.of(Tone::Faint));
        }
    }
    (place.min(area.right().saturating_sub(1)), area.y).into()
}

/// The page of keys.
fn help(buffer: &mut Buffer, area: Rect, state: &mut State<'_>, look: Look) {
    let columns = (area.width / GROUP).clamp(1, 3);
    let mut pages: Vec<Vec<(&str, &str)>> = vec![Vec::new(); columns.into()];
    for (title, keys) in HELP {
        // The next group goes where the column is shortest.
        let Some(shortest) = pages.iter_mut().min_by_key(|page| page.len()) else { return };
        shortest.push((title, ""));
        shortest.extend(keys);
        shortest.push(("", ""));
    }
    let longest = pages.iter().map(Vec::len).max().unwrap_or_default();
    let room = usize::from(area.height.saturating_sub(1)).max(1);
    state.help_top = state.help_top.min(longest.saturating_sub(room));
    for (index, page) in (0..).zip(&pages) {
        let x = area.x + index * (area.width / columns);
        let within = Rect { x, width: (area.width / columns).saturating_sub(1), ..area };
        for (row, (key, does)) in
            (area.y..area.bottom().saturating_sub(1)).zip(page.iter().skip(state.help_top))
        {
            let is_title = does.is_empty();
            let style = look.of(if is_title { Tone::Head } else { Tone::Key });
            let after = put(buffer, within, (within.x, row), key, style);
            let next = after.max(within.x + if is_title { 0 } else { KEYS as u16 });
            let _ = put(buffer, within, (next, row), does, look.of(Tone::Plain));
        }
    }
    let more = if longest > room { "↑ ↓ scroll  " } else { "" };
    let text = format!("{more}any other key: back");
    let _ = put(buffer, area, (area.x, area.bottom() - 1), &text, look.of(Tone::Faint));
}
