//! The plants while a board runs: step after step, each from what the board's outputs do.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use sensedsl_job::BoardJob;
use sensedsl_plants::{Battery, Heater, Motor, Servo};

use super::drives::{Drive, Told as Codes};
use super::on_wheels::{BalancerRun, RobotRun};
use super::process::Process;
use super::{
    BatteryPlant, Feed, Goal, HeaterPlant, MotorPlant, Plant, ProcessPlant, ServoPlant, Source,
    Value, What,
};
use crate::arith::number;
use crate::commands::outputs::Outputs;
use crate::world::{Course, World};

/// The length of a step.
const STEP_NS: u64 = 1_000_000;
const STEP_S: f64 = 1e-3;

/// What went wrong with a program of the world.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// The moment.
    pub at_ns: u64,
    /// The name of the plant.
    pub plant: String,
    /// What happened, as a sentence without its end.
    pub why: String,
}

/// An actuator that drives a plant, and what it has done so far.
pub(super) struct Driven {
    drive: Option<Drive>,
    full: f64,
    /// What the actuator does, as it is shown.
    pub(super) course: Course,
    /// Where it stands in the design.
    pub(super) source: Source,
}

impl Driven {
    fn new(job: &BoardJob<'_>, source: &Source) -> Self {
        let drive = Drive::of(job, source.device, source.element);
        let course = Course::new(false, None);
        Self { drive, full: source.full, course, source: source.clone() }
    }

    /// What it does as it is shown; `None` while nobody has set it.
    fn shown(&self, now: &Now<'_>) -> Option<f64> {
        let shown = self.drive.as_ref().filter(|_| !now.is_off)?.shown(now.outputs, now.codes);
        self.course.push(now.at_ns, shown.unwrap_or(0.0));
        shown
    }

    /// The share of full drive.
    fn share(&self, now: &Now<'_>) -> f64 {
        let share = self.shown(now).unwrap_or(0.0) / self.full;
        if share.is_finite() { share } else { 0.0 }
    }
}

/// What the board does in a step, which ends at `next_ns`.
struct Now<'a> {
    at_ns: u64,
    next_ns: u64,
    is_off: bool,
    outputs: &'a Outputs,
    codes: &'a Codes,
}

pub(super) struct MotorRun {
    pub(super) name: String,
    plant: MotorPlant,
    pub(super) driven: Driven,
    pub(super) motor: Motor,
    /// Turns both ways together.
    travel: f64,
    /// The turns of the last step.
    pub(super) turned: f64,
    supply: f64,
}

pub(super) struct ServoRun {
    plant: ServoPlant,
    pub(super) driven: Driven,
    servo: Servo,
}

pub(super) struct HeaterRun {
    name: String,
    plant: HeaterPlant,
    pub(super) driven: Driven,
    heater: Heater,
    share: f64,
    supply: f64,
}

struct BatteryRun {
    plant: BatteryPlant,
    battery: Battery,
}

struct ProcessRun {
    name: String,
    plant: ProcessPlant,
    drives: Vec<Vec<Option<Drive>>>,
    program: Option<Box<dyn Process>>,
    /// The moment that it has gone on to.
    at_ns: u64,
}

/// All plants of a world.
#[derive(Default)]
pub(crate) struct Plants {
    pub(super) now_ns: u64,
    pub(super) motors: Vec<MotorRun>,
    pub(super) servos: Vec<ServoRun>,
    pub(super) robots: Vec<RobotRun>,
    pub(super) balancers: Vec<BalancerRun>,
    pub(super) heaters: Vec<HeaterRun>,
    batteries: Vec<BatteryRun>,
    processes: Vec<ProcessRun>,
    /// Every feed, for those who look at the run.
    pub(super) feeds: Vec<Feed>,
    trouble: Option<Trouble>,
}

/// Plants that a bench and whoever looks at it share.
#[derive(Clone)]
pub(crate) struct SharedPlants(Arc<Mutex<Plants>>);

impl std::fmt::Debug for SharedPlants {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "SharedPlants at {} ns", self.lock().now_ns)
    }
}

impl SharedPlants {
    /// The plants of a world around a board; `None` if it has none.
    pub(crate) fn new(job: &BoardJob<'_>, world: &World) -> Option<Self> {
        if world.plants.is_empty() {
            return None;
        }
        let mut plants = Plants::default();
        for plant in &world.plants {
            plants.add(job, plant);
        }
        for feed in &plants.feeds {
            feed.course.clear();
        }
        plants.tell(0);
        Some(Self(Arc::new(Mutex::new(plants))))
    }

    pub(super) fn lock(&self) -> MutexGuard<'_, Plants> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Goes on to a moment, in whole milliseconds.
    pub(crate) fn advance(&self, until_ns: u64, is_off: bool, outputs: &Outputs, codes: &Codes) {
        let mut plants = self.lock();
        while plants.now_ns + STEP_NS <= until_ns {
            let (at_ns, next_ns) = (plants.now_ns, plants.now_ns + STEP_NS);
            plants.step(&Now { at_ns, next_ns, is_off, outputs, codes });
        }
    }

    /// Gives a plant its program, which says at once what its sensors are at the start.
    pub(crate) fn attach(&self, name: &str, program: Box<dyn Process>) {
        let mut plants = self.lock();
        let found = plants.processes.iter_mut().find(|one| one.name == name);
        let done = found.map(|one| {
            one.program = Some(program);
            let set: Vec<_> =
                one.plant.sets.iter().map(|(name, ..)| (name.clone(), None)).collect();
            one.ask(0, &set)
        });
        if let Some(Err(why)) = done {
            plants.trouble = Some(Trouble { at_ns: 0, plant: name.to_owned(), why });
        }
    }

    /// What went wrong with a program, said once.
    pub(crate) fn trouble(&self) -> Option<Trouble> {
        self.lock().trouble.take()
    }

    /// The actuators that only the board itself can say something of, by their places in the design.
    pub(crate) fn told(&self) -> Vec<sensedsl_model::design::DeviceIndex> {
        let plants = self.lock();
        let is_told = |drive: &&Drive| drive.is_told();
        let own = plants.driven().filter(|one| one.drive.as_ref().filter(is_told).is_some());
        let mut all: Vec<_> = own.map(|one| one.source.device).collect();
        for process in &plants.processes {
            let sets = process.plant.sets.iter().zip(&process.drives);
            let told = sets.filter(|(_, drives)| drives.iter().flatten().any(Drive::is_told));
            all.extend(told.map(|((_, device, _), _)| *device));
        }
        all.sort_unstable();
        all.dedup();
        all
    }
}

impl Plants {
    /// All actuators that drive something.
    pub(super) fn driven(&self) -> impl Iterator<Item = &Driven> {
        let motors = self.motors.iter().map(|one| &one.driven);
        let servos = self.servos.iter().map(|one| &one.driven);
        motors.chain(servos).chain(self.heaters.iter().map(|one| &one.driven))
    }

    fn add(&mut self, job: &BoardJob<'_>, plant: &Plant) {
        let name = plant.name.clone();
        match &plant.what {
            What::Motor(plant) => self.motors.push(MotorRun {
                name,
                driven: Driven::new(job, &plant.source),
                motor: Motor::new(plant.facts),
                plant: plant.clone(),
                travel: 0.0,
                turned: 0.0,
                supply: 1.0,
            }),
            What::Servo(plant) => self.servos.push(ServoRun {
                driven: Driven::new(job, &plant.source),
                servo: Servo::new(plant.facts, plant.start),
                plant: plant.clone(),
            }),
            What::Robot(plant) => self.robots.push(RobotRun::new(name, plant)),
            What::Balancer(plant) => self.balancers.push(BalancerRun::new(name, plant)),
            What::Heater(plant) => self.heaters.push(HeaterRun {
                name,
                driven: Driven::new(job, &plant.source),
                heater: Heater::new(plant.facts, plant.start),
                plant: plant.clone(),
                share: 0.0,
                supply: 1.0,
            }),
            What::Battery(plant) => self.batteries.push(BatteryRun {
                battery: Battery::new(plant.facts, plant.left),
                plant: plant.clone(),
            }),
            What::Process(plant) => {
                let drives = |(_, device, count): &(_, _, usize)| {
                    (0..*count).map(|element| Drive::of(job, *device, element)).collect()
                };
                self.processes.push(ProcessRun {
                    name,
                    drives: plant.sets.iter().map(drives).collect(),
                    plant: plant.clone(),
                    program: None,
                    at_ns: 0,
                });
            }
        }
        self.feeds.extend(plant.feeds());
    }

    fn step(&mut self, now: &Now<'_>) {
        for motor in &mut self.motors {
            motor.step(now);
        }
        for servo in &mut self.servos {
            servo.step(now);
        }
        for heater in &mut self.heaters {
            heater.share = heater.driven.share(now).clamp(0.0, 1.0);
            // Heat goes with the square of the voltage.
            heater.heater.step(STEP_S, heater.share * heater.supply * heater.supply);
        }
        let motors = &self.motors;
        for robot in &mut self.robots {
            robot.step(STEP_S, now.next_ns, motors);
        }
        for balancer in &mut self.balancers {
            balancer.step(STEP_S, motors);
        }
        self.supply();
        self.now_ns = now.next_ns;
        self.tell(now.next_ns);
        for process in &mut self.processes {
            if let Err(why) = process.step(now)
                && self.trouble.is_none()
            {
                let (at_ns, plant) = (now.at_ns, process.name.clone());
                self.trouble = Some(Trouble { at_ns, plant, why });
            }
        }
    }

    /// Batteries give what is drawn, and sag.
    fn supply(&mut self) {
        for BatteryRun { plant, battery } in &mut self.batteries {
            let is_own = |name: &String| plant.supplies.contains(name);
            let motors = self.motors.iter().filter(|one| is_own(&one.name));
            // What a motor gives back while it brakes heats its bridge.
            let turning: f64 = motors.map(MotorRun::drawn).sum();
            let volts = plant.facts.full_volts.max(f64::MIN_POSITIVE);
            let heaters = self.heaters.iter().filter(|one| is_own(&one.name));
            let heating: f64 =
                heaters.map(|one| one.plant.facts.watts / volts * one.share * one.supply).sum();
            battery.step(STEP_S, plant.draws + turning + heating);
            let share = battery.share();
            self.motors.iter_mut().filter(|one| is_own(&one.name)).for_each(|m| m.supply = share);
            self.heaters.iter_mut().filter(|one| is_own(&one.name)).for_each(|h| h.supply = share);
        }
    }

    /// Feeds the sensors with what there is at a moment.
    fn tell(&self, at_ns: u64) {
        let put = |feed: &Option<Feed>, value: f64| {
            if let Some(feed) = feed {
                feed.put(at_ns, value);
            }
        };
        let turn = std::f64::consts::TAU;
        for MotorRun { plant, motor, travel, .. } in &self.motors {
            if let Some(encoder) = &plant.encoder {
                encoder.turned(at_ns, (turn * motor.turns(), turn * travel));
            }
            put(&plant.tachometer, turn * motor.speed());
            put(&plant.current, motor.amperes());
            put(&plant.temperature, motor.celsius());
        }
        for ServoRun { plant, servo, .. } in &self.servos {
            put(&plant.angle, servo.angle());
        }
        for HeaterRun { plant, heater, .. } in &self.heaters {
            plant.temperatures.iter().for_each(|feed| feed.put(at_ns, heater.celsius()));
        }
        for BatteryRun { plant, battery } in &self.batteries {
            put(&plant.voltage, battery.volts());
            put(&plant.current, battery.amperes());
        }
        self.robots.iter().for_each(|robot| robot.tell(at_ns));
        self.balancers.iter().for_each(|balancer| balancer.tell(at_ns));
    }
}

impl MotorRun {
    fn step(&mut self, now: &Now<'_>) {
        let share = self.driven.share(now);
        let share = if self.plant.is_reversed { -share } else { share };
        let before = self.motor.turns();
        self.motor.step(STEP_S, share, self.supply);
        self.turned = self.motor.turns() - before;
        self.travel += self.turned.abs();
    }

    /// The current that its battery gives: that in the motor, for as long as the bridge is on.
    fn drawn(&self) -> f64 {
        let share = self.driven.course.at(u64::MAX) / self.driven.full;
        let share = if share.is_finite() { share.abs().min(1.0) } else { 0.0 };
        self.motor.amperes().abs() * share
    }
}

impl ServoRun {
    fn step(&mut self, now: &Now<'_>) {
        let shown = self.driven.shown(now);
        let goal = shown.map(|shown| match self.plant.goal {
            Goal::Angle(each) => shown * each,
            Goal::Between { angles, ends } => {
                let width = ends.1 - ends.0;
                let share = if width == 0.0 { 0.0 } else { (shown - ends.0) / width };
                angles.0 + (angles.1 - angles.0) * share
            }
        });
        self.servo.step(STEP_S, goal.filter(|goal| goal.is_finite()));
    }
}

impl ProcessRun {
    /// Asks the program for the end of its next step, when the last one is over.
    fn step(&mut self, now: &Now<'_>) -> Result<(), String> {
        if self.program.is_none() || now.next_ns < self.at_ns {
            return Ok(());
        }
        let value = |(name, drives): (&String, &Vec<Option<Drive>>)| {
            let shown = |drive: &Option<Drive>| {
                let drive = drive.as_ref().filter(|_| !now.is_off)?;
                drive.shown(now.outputs, now.codes)
            };
            let all: Option<Vec<f64>> = drives.iter().map(shown).collect();
            let value = all.map(|all| match all.as_slice() {
                [one] => Value::One(*one),
                _ => Value::Many(all),
            });
            (name.clone(), value)
        };
        let names = self.plant.sets.iter().map(|(name, ..)| name);
        let set: Vec<_> = names.zip(&self.drives).map(value).collect();
        self.ask(self.at_ns + self.plant.step_ns, &set)
    }

    /// Goes on to a moment. A program that has failed is let go.
    fn ask(&mut self, at_ns: u64, set: &[(String, Option<Value>)]) -> Result<(), String> {
        let Some(program) = &mut self.program else { return Ok(()) };
        let answer = program.step(number(at_ns) / 1e9, set);
        let taken = answer.and_then(|all| self.take(at_ns, &all));
        if taken.is_err() {
            self.program = None;
        }
        self.at_ns = at_ns;
        taken
    }

    /// Feeds the sensors with an answer, which must have all of them and no others.
    fn take(&self, at_ns: u64, all: &[(String, Value)]) -> Result<(), String> {
        let own = &self.plant.sensors;
        let known = |name: &str| own.iter().any(|(own, _)| own == name);
        if let Some((name, _)) = all.iter().find(|(name, _)| !known(name)) {
            return Err(format!("it answers `{name}`, which is not among its `sensors`"));
        }
        for (name, feeds) in own {
            let value = all.iter().find(|(of, _)| of == name).map(|(_, value)| value);
            let value = value.ok_or_else(|| format!("its answer lacks `{name}`"))?;
            let numbers = match value {
                Value::One(one) => std::slice::from_ref(one),
                Value::Many(all) => all.as_slice(),
            };
            if numbers.len() != feeds.len() {
                let (found, wanted) = (numbers.len(), feeds.len());
                return Err(format!("`{name}` has {wanted} elements, and its answer {found}"));
            }
            if numbers.iter().any(|one| !one.is_finite()) {
                return Err(format!("its answer for `{name}` is not a number"));
            }
            feeds.iter().zip(numbers).for_each(|(feed, one)| feed.put_shown(at_ns, *one));
        }
        Ok(())
    }
}
