//! What the plants of a world came to: figures for people, and the picture that `--picture` asks for.

use anyhow::Result;
use sensedsl_report::run::{Floor, Line, Plot, RunPicture, Stroke, svg};
use sensedsl_twin::bench::{Bench, seconds};
use sensedsl_twin::plants::{Story, Told};

use super::simulation::Simulation;
use crate::files::write_whole;

/// The moments at which a course is looked at.
const COLUMNS: u64 = 800;

/// Prints the figures, and writes the picture if it is asked for.
pub(super) fn tell(scenery: &Simulation<'_>, bench: &Bench) -> Result<()> {
    let story = bench.story(scenery.job.design);
    for line in story.iter().flat_map(|story| &story.figures) {
        if scenery.args.stdout {
            scenery.terminal.aside(line)?;
        } else {
            scenery.terminal.note(&format!("{line}\n"))?;
        }
    }
    let Some(path) = &scenery.args.picture else { return Ok(()) };
    let Some(story) = story else {
        let what = "the world has no plants: there is nothing to draw";
        scenery.terminal.aside(what)?;
        return Ok(());
    };
    write_whole(path, svg(&picture(&scenery.job.board.name.value, &story)).as_bytes())
}

fn picture(board: &str, story: &Story) -> RunPicture {
    let floors = story.floors.iter().map(|floor| Floor {
        name: floor.name.clone(),
        size: floor.map.size,
        strokes: floor
            .map
            .strokes()
            .into_iter()
            .map(|stroke| Stroke {
                pieces: stroke
                    .pieces
                    .iter()
                    .map(|(from, to)| ((from.x, from.y), (to.x, to.y)))
                    .collect(),
                width: stroke.width_m,
                is_wall: stroke.is_wall,
            })
            .collect(),
        path: floor.path.iter().map(|(at_ns, x, y)| (seconds(*at_ns), *x, *y)).collect(),
        body: floor.body_m,
        looks: floor.looks,
    });
    RunPicture {
        title: format!("{board}, {:.1} s", seconds(story.end_ns)),
        notes: story.figures.clone(),
        seconds: seconds(story.end_ns),
        floors: floors.collect(),
        plots: plots(story),
    }
}

/// A plot for each device; the elements of an array share one.
fn plots(story: &Story) -> Vec<Plot> {
    let mut all: Vec<Plot> = Vec::new();
    let mut courses: Vec<&Told> = story.courses.iter().collect();
    // Stable: elements in their order, wherever several plants have shared an array out.
    courses.sort_by_key(|told| told.element);
    let place = |told: &Told| {
        let is_same = |one: &&Told| one.name == told.name && one.is_actuator == told.is_actuator;
        story.courses.iter().position(|one| is_same(&one))
    };
    courses.sort_by_key(|told| place(told));
    for told in courses {
        let name = &told.name;
        let element = told.element.map(|place| format!("[{place}]")).unwrap_or_default();
        let line = Line { name: element, points: looked_at(told, story.end_ns) };
        match all.iter_mut().find(|plot| plot.name == *name && plot.is_set == told.is_actuator) {
            Some(plot) => plot.lines.push(line),
            None => all.push(Plot {
                name: name.clone(),
                unit: told.unit.clone(),
                is_set: told.is_actuator,
                is_switch: told.is_switch,
                lines: vec![line],
            }),
        }
    }
    all
}

/// The least and the greatest value in each piece of the run.
fn looked_at(told: &Told, end_ns: u64) -> Vec<(f64, f64, f64)> {
    let piece_ns = (end_ns / COLUMNS).max(1);
    let column = |column: u64| {
        let from_ns = column * piece_ns;
        let (least, greatest) = told.course.range(from_ns, (from_ns + piece_ns).min(end_ns));
        (seconds(from_ns), least, greatest)
    };
    (0..COLUMNS.min(end_ns)).map(column).collect()
}
