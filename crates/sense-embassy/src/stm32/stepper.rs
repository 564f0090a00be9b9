//! Stepper motors: a timer makes one pulse and stops, and its interrupt counts the step and begins the next interval.
//!
//! However late the interrupt is, there is one pulse for each step that is counted: a late one makes the motor slower.

use core::cell::RefCell;

use embassy_stm32::gpio::Output;
use embassy_stm32::pac::timer::TimGp16;
use embassy_stm32::pac::timer::vals::{Ocm, Urs};
use embassy_stm32::rcc;
use embassy_stm32::timer::GeneralInstance4Channel;
use embassy_stm32::timer::simple_pwm::SimplePwm;
use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use sense_rt::{MotorConfig, Scalar, Stepper, TICK_HZ_MAX};

/// A period of the counter, and a compare value that it does not reach: it counts, and there is no pulse.
const LONG_PERIOD: u16 = 0xFFFE;
const NO_PULSE: u16 = 0xFFFF;
/// The microseconds from the level of the direction to the pulse that it is for, and from one pulse to the next.
const SETUP_US: u32 = 1;

/// What a motor is made of.
pub struct Plan {
    /// The channel of its timer, from 1.
    pub channel: usize,
    /// The shortest pulse.
    pub pulse_us: u32,
    /// The direction.
    pub dir: Output<'static>,
    /// Its level while the position grows.
    pub is_forward_high: bool,
    /// What lets current into the motor, and the level that does.
    pub enable: Option<(Output<'static>, bool)>,
    /// What it can do; the timer's clock decides the tick.
    pub config: MotorConfig,
}

/// A motor at work.
pub struct Motor {
    timer: TimGp16,
    plan: Plan,
    pulse_ticks: u32,
    stepper: Stepper,
}

/// A motor that its interrupt and the reporter share; it is a `static`.
pub type SharedMotor = Mutex<CriticalSectionRawMutex, RefCell<Option<Motor>>>;

/// A motor before its start.
#[must_use]
pub const fn new() -> SharedMotor {
    Mutex::new(RefCell::new(None))
}

fn with(motor: &SharedMotor, task: impl FnOnce(&mut Motor)) {
    motor.lock(|cell| {
        if let Some(motor) = &mut *cell.borrow_mut() {
            task(motor);
        }
    });
}

/// Takes the timer with its pin. Its interrupt must be enabled afterwards.
pub fn start<T: GeneralInstance4Channel>(
    motor: &SharedMotor,
    mut timer: SimplePwm<'static, T>,
    mut plan: Plan,
) {
    let channel = plan.channel - 1;
    match channel {
        0 => timer.ch1().enable(),
        1 => timer.ch2().enable(),
        2 => timer.ch3().enable(),
        _ => timer.ch4().enable(),
    }
    // SAFETY: the pointer is that of the timer's registers, of which all such timers have these.
    let registers = unsafe { TimGp16::from_ptr(T::regs()) };
    // The pin and the clock stay with it for good.
    core::mem::forget(timer);
    let clock_hz = rcc::frequency::<T>().0;
    let divider = clock_hz.div_ceil(TICK_HZ_MAX).max(1);
    plan.config.tick_hz = clock_hz / divider;
    let pulse_ticks = (plan.pulse_us * (plan.config.tick_hz / 1_000)).div_ceil(1_000);
    registers.cr1().write(|control| control.set_urs(Urs::COUNTER_ONLY));
    registers.ccmr_output(channel / 2).write(|mode| {
        // Compare values count at once.
        mode.set_ocm(channel % 2, Ocm::FORCE_INACTIVE);
    });
    registers.psc().write_value((divider - 1) as u16);
    registers.arr().write(|limit| limit.set_arr(LONG_PERIOD));
    registers.ccr(channel).write(|compare| compare.set_ccr(NO_PULSE));
    // The divider counts from an update on.
    registers.egr().write(|event| event.set_ug(true));
    registers.ccmr_output(channel / 2).write(|mode| mode.set_ocm(channel % 2, Ocm::PWM_MODE2));
    registers.sr().write(|flags| flags.0 = 0);
    registers.dier().write(|causes| causes.set_uie(true));
    let own = Motor { timer: registers, plan, pulse_ticks, stepper: Stepper::NEW };
    motor.lock(|cell| *cell.borrow_mut() = Some(own));
}

/// The timer's period is over, or another cause of its interrupt is there.
pub fn on_step(motor: &SharedMotor) {
    with(motor, |motor| {
        if motor.timer.sr().read().uif() {
            // Flags that are written as 1 stay as they are.
            motor.timer.sr().write(|flags| {
                flags.0 = u32::MAX;
                flags.set_uif(false);
            });
            motor.advance();
        }
    });
}

/// Sets the host's value; the first one lets current into the motor.
pub fn set(motor: &SharedMotor, scalar: Scalar, element: &[u8]) {
    with(motor, |motor| {
        if let Some((pin, level)) = &mut motor.plan.enable {
            pin.set_level((*level).into());
        }
        motor.stepper.command(&motor.plan.config, scalar, element);
        if !motor.stepper.is_under_way() {
            motor.advance();
        }
    });
}

/// Decelerates to a stop.
pub fn stop(motor: &SharedMotor) {
    with(motor, |motor| motor.stepper.stop());
}

/// The steps that were made.
pub fn position(motor: &SharedMotor) -> i32 {
    motor.lock(|cell| cell.borrow().as_ref().map_or(0, |motor| motor.stepper.position()))
}

impl Motor {
    /// Begins the next interval. The counter runs meanwhile, so that the time that this takes is part of the interval.
    fn advance(&mut self) {
        let (timer, channel) = (self.timer, self.plan.channel - 1);
        timer.ccr(channel).write(|compare| compare.set_ccr(NO_PULSE));
        timer.arr().write(|limit| limit.set_arr(LONG_PERIOD));
        self.run(true);
        let ticks = self.stepper.advance(&self.plan.config);
        if ticks == 0 {
            self.run(false);
            timer.cnt().write(|count| count.set_cnt(0));
            return;
        }
        let is_high = self.stepper.is_backward() != self.plan.is_forward_high;
        self.plan.dir.set_level(is_high.into());
        let setup = SETUP_US * self.plan.config.tick_hz / 1_000_000 + 1;
        let least = u32::from(timer.cnt().read().cnt()) + setup + self.pulse_ticks;
        let ticks = ticks.max(least);
        if self.stepper.is_step() {
            let begins = (ticks - self.pulse_ticks) as u16;
            timer.ccr(channel).write(|compare| compare.set_ccr(begins));
        }
        timer.arr().write(|limit| limit.set_arr((ticks - 1) as u16));
    }

    /// Lets the counter run until the end of its period, or holds it.
    fn run(&self, runs: bool) {
        self.timer.cr1().write(|control| {
            control.set_urs(Urs::COUNTER_ONLY);
            control.set_opm(true);
            control.set_cen(runs);
        });
    }
}
