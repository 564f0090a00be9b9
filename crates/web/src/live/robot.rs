//! A simulated board: the job of the firmware, done here in virtual time, with a world on its pins, and the code of its
//! controllers where somebody runs it.

use sensedsl_diagnostics::{Diagnostic, SourceMap, render};
use sensedsl_host::Board;
use sensedsl_job::{BoardJob, JobConnection};
use sensedsl_model::design::{ConnectionIndex, DeviceIndex};
use sensedsl_model::kind::Role;
use sensedsl_model::normal_path;
use sensedsl_twin::bench::Bench;
use sensedsl_twin::soft::{SoftBoard, StandIns};
use sensedsl_twin::world::{self, Scene, World};
use sensedsl_wire::{Direction, Scalar};
use serde_json::{Value, json};

use super::Outside;
use crate::request::Request;

const MS_NS: u64 = 1_000_000;
/// The seed of a world that has none: a page shows the same each time.
const SEED: u64 = 1;
/// How often it is noted where a robot is.
const POSE_EVERY_MS: u64 = 10;

/// A simulated board.
pub(super) struct Robot {
    board: SoftBoard,
    /// The sensors by name.
    sensors: Vec<(String, DeviceIndex)>,
    /// The wires of each actuator, in the order of the schema.
    wires: Vec<Vec<ConnectionIndex>>,
    /// Whether the code of its controllers runs.
    pub(super) has_code: bool,
    /// The controllers that the world stands in for.
    pub(super) stand_ins: Vec<String>,
    /// The plants whose programs nobody runs.
    pub(super) idle: Vec<String>,
    poses: Vec<Vec<[f64; 4]>>,
}

impl Robot {
    /// A board whose sensors measure a world; none if something is wrong. Mistakes of the world are told in JSON, as the
    /// page has its text, those of the design's code in `reported`.
    pub(super) fn new(
        job: &BoardJob<'_>,
        of: &Request,
        (path, outside): (Option<&str>, Option<&dyn Outside>),
        reported: &mut Vec<Diagnostic>,
    ) -> (Option<Self>, Vec<Value>) {
        let (world, told) = read(job, of, path);
        let Some(world) = world else { return (None, told) };
        let mut bench = Bench::new(job, &world, world.seed.unwrap_or(SEED));
        let mut code = None;
        if let Some(outside) = outside {
            outside.attach(&mut bench, &world, path.unwrap_or_default());
            code = match outside.code(&of.path, job) {
                Ok(code) => code,
                Err(why) => {
                    reported.push(*why);
                    return (None, told);
                }
            };
        }
        let has_code = code.is_some();
        let stand_ins = if has_code { Vec::new() } else { stood_in(job, &world) };
        if !stand_ins.is_empty() {
            code = Some(Box::new(StandIns::new(job, &world.stand_ins)));
        }
        let programs =
            world.plants.iter().filter(|one| outside.is_none() && one.command().is_some());
        let idle = programs.map(|one| one.name.clone()).collect();
        let mut board = SoftBoard::new(job, bench);
        if let Some(code) = code {
            board = board.with_code(code);
        }
        board.link_open(true);
        let is_sensor =
            |one: &&sensedsl_job::JobDevice<'_>| one.device.direction == Direction::Sensor;
        let sensors = job.devices.iter().filter(is_sensor);
        let sensors = sensors.map(|one| (one.name().to_owned(), one.index)).collect();
        let wires = (0..job.devices.len()).map(|device| wires(job, device)).collect();
        (Some(Self { board, sensors, wires, has_code, stand_ins, idle, poses: Vec::new() }), told)
    }

    pub(super) fn now_ms(&self) -> u64 {
        self.board.now_ns() / MS_NS
    }

    /// Runs for a millisecond; the bytes that have arrived at the host.
    pub(super) fn step(&mut self) -> Vec<u8> {
        self.board.run_until(self.board.now_ns() + MS_NS);
        let _ = self.board.received();
        if self.now_ms().is_multiple_of(POSE_EVERY_MS) {
            self.stand();
        }
        self.board.link_read()
    }

    /// The host sends bytes.
    pub(super) fn write(&mut self, bytes: &[u8]) {
        if !bytes.is_empty() {
            self.board.link_write(bytes);
        }
    }

    /// Holds a quantity of the world, or gives it back; whether the board has such a sensor.
    pub(super) fn steer(&mut self, device: &str, element: usize, shown: Option<f64>) -> bool {
        let found = self.sensors.iter().find(|(name, _)| name == device);
        if let Some((_, index)) = found {
            self.board.hold(*index, element, shown);
        }
        found.is_some()
    }

    /// What has stopped since the last call, a sentence for each.
    pub(super) fn stopped(&mut self) -> Vec<String> {
        let moment = |ns: u64| format!("{:.3} s", sensedsl_twin::bench::seconds(ns));
        let code = self.board.code_ended();
        let code = code.map(|(at_ns, why)| {
            format!("the controllers' code stopped after {}: {why}", moment(at_ns))
        });
        let trouble = self.board.bench().trouble();
        let trouble = trouble.map(|one| {
            format!("the program of {} stopped after {}: {}", one.plant, moment(one.at_ns), one.why)
        });
        code.into_iter().chain(trouble).collect()
    }

    /// The maps that robots of the world drive on, each with the robot's name.
    pub(super) fn maps(&self, job: &BoardJob<'_>) -> Value {
        let story = self.board.bench().story(job.design);
        let floors = story.iter().flat_map(|story| &story.floors);
        let all = floors.map(|floor| {
            let strokes = floor.map.strokes();
            let strokes = strokes.iter().map(|stroke| {
                let pieces = stroke.pieces.iter().map(|(from, to)| [from.x, from.y, to.x, to.y]);
                json!({
                    "pieces": pieces.collect::<Vec<_>>(),
                    "width": stroke.width_m,
                    "is_wall": stroke.is_wall,
                })
            });
            json!({
                "name": floor.name,
                "size": [floor.map.size.0, floor.map.size.1],
                "body": floor.body_m,
                "strokes": strokes.collect::<Vec<_>>(),
            })
        });
        Value::Array(all.collect())
    }

    /// Where each robot has been since the last call, and is now: metres to the right and upwards, then the direction
    /// that it looks in.
    pub(super) fn poses(&mut self) -> Vec<Vec<[f64; 4]>> {
        self.stand();
        std::mem::take(&mut self.poses)
    }

    /// Notes where each robot is.
    fn stand(&mut self) {
        let stands = self.board.bench().stands();
        self.poses.resize(stands.len(), Vec::new());
        for (all, one) in self.poses.iter_mut().zip(stands) {
            all.push([one.at.0, one.at.1, one.looks.0, one.looks.1]);
        }
    }

    /// What the plants of the world came to, in words.
    pub(super) fn figures(&self) -> Vec<String> {
        self.board.bench().figures()
    }

    /// What each actuator is set to, and what its wires do.
    pub(super) fn outputs(&self, host: &Board) -> Value {
        let actuators = host.devices.iter().enumerate();
        let actuators = actuators.filter(|(_, one)| one.direction == Direction::Actuator);
        let all = actuators.filter_map(|(index, device)| {
            let bytes = self.board.applied(index)?;
            let size = device.value.scalar.size_bytes();
            let value: Option<Vec<Scalar>> =
                bytes.chunks_exact(size).map(|one| device.value.scalar.read(one)).collect();
            let numbers: Vec<f64> = value?.into_iter().map(|raw| device.shown(raw)).collect();
            Some(json!([index, numbers, self.hardware(index)]))
        });
        Value::Array(all.collect())
    }

    /// What the wires of an actuator do, in words.
    fn hardware(&self, device: usize) -> String {
        let outputs = self.board.bench().outputs();
        let wire = |at: &ConnectionIndex| {
            if let Some((period_ns, width_ns)) = outputs.pulses(*at) {
                return Some(format!("{} us of {} us", width_ns / 1_000, period_ns / 1_000));
            }
            if let Some(millivolts) = outputs.millivolts(*at) {
                return Some(format!("{millivolts:.0} mV"));
            }
            let level = outputs.level(*at, Role::Out)?;
            Some(if level { "high" } else { "low" }.to_owned())
        };
        let all: Vec<String> =
            self.wires.get(device).into_iter().flatten().filter_map(wire).collect();
        all.join(", ")
    }
}

/// The world of one of the page's texts, or the usual one, with what it names; none if it has mistakes.
fn read(job: &BoardJob<'_>, of: &Request, path: Option<&str>) -> (Option<World>, Vec<Value>) {
    let devices: Vec<DeviceIndex> = job.devices.iter().map(|one| one.index).collect();
    let path = path.unwrap_or_default();
    let text = of.files.get(path).map_or("", String::as_str);
    let beside = |name: &str| {
        let path = match path.rsplit_once('/') {
            Some((folder, _)) => normal_path(&format!("{folder}/{name}")),
            None => normal_path(name),
        };
        of.files.get(&path).cloned().ok_or_else(|| "it is not among the open files".to_owned())
    };
    let scene = Scene {
        design: job.design,
        devices: &devices,
        transport: job.board.link.transport,
        seed: None,
        samples: &beside,
    };
    let mut sources = SourceMap::default();
    let file = sources.add(path, text);
    let (world, wrong) = world::read(file, text, &scene);
    let told = wrong.iter().map(|one| render::json_value(one, &sources)).collect();
    ((!sensedsl_session::has_errors(&wrong)).then_some(world), told)
}

/// The names of the controllers that a world stands in for.
fn stood_in(job: &BoardJob<'_>, world: &World) -> Vec<String> {
    let devices = world.stand_ins.iter().filter_map(|one| job.design.device(one.controller));
    devices.map(|one| one.name.value.clone()).collect()
}

/// The connections of a device.
fn wires(job: &BoardJob<'_>, device: usize) -> Vec<ConnectionIndex> {
    let is_of = |one: &&JobConnection<'_>| one.devices.contains(&device);
    job.connections.iter().filter(is_of).map(|one| one.index).collect()
}
