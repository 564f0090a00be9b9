//! Encoders with two tracks: a unit of the pulse counter counts all four edges of a step.

use core::cell::{Cell, RefCell};

use embassy_sync::blocking_mutex::Mutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use esp_hal::gpio::{AnyPin, Flex, InputConfig, Pull};
use esp_hal::pcnt::Pcnt;
use esp_hal::pcnt::channel::{CtrlMode, EdgeMode};
use esp_hal::peripherals::PCNT;

/// A unit begins anew at this many steps, up or down.
const LIMIT: i16 = i16::MAX;

/// The peripheral, which the first encoder sets up for all of them.
static UNITS: Mutex<CriticalSectionRawMutex, RefCell<Option<Pcnt<'static>>>> =
    Mutex::new(RefCell::new(None));

/// A unit that counts the steps of an encoder.
pub struct Counter {
    unit: usize,
    _tracks: [Flex<'static>; 2],
    last: Cell<i16>,
    total: Cell<u16>,
}

impl Counter {
    /// It counts from now on. Tracks that nothing drives are high.
    pub fn new(unit: usize, a: AnyPin<'static>, b: AnyPin<'static>) -> Self {
        let tracks = [a, b].map(|track| {
            let mut pin = Flex::new(track);
            pin.apply_input_config(&InputConfig::default().with_pull(Pull::Up));
            pin.set_input_enable(true);
            pin
        });
        UNITS.lock(|units| {
            let mut units = units.borrow_mut();
            // SAFETY: nothing else of the program takes it.
            let all = units.get_or_insert_with(|| Pcnt::new(unsafe { PCNT::steal() }));
            let [a, b] = &tracks;
            macro_rules! set_up {
                ($own:expr) => {{
                    let unit = &$own;
                    let limits =
                        (unit.set_low_limit(Some(-LIMIT)), unit.set_high_limit(Some(LIMIT)));
                    if !matches!(limits, (Ok(()), Ok(()))) {
                        crate::restart();
                    }
                    unit.clear();
                    unit.channel0.set_ctrl_signal(a.peripheral_input());
                    unit.channel0.set_edge_signal(b.peripheral_input());
                    unit.channel0.set_ctrl_mode(CtrlMode::Reverse, CtrlMode::Keep);
                    unit.channel0.set_input_mode(EdgeMode::Decrement, EdgeMode::Increment);
                    unit.channel1.set_ctrl_signal(b.peripheral_input());
                    unit.channel1.set_edge_signal(a.peripheral_input());
                    unit.channel1.set_ctrl_mode(CtrlMode::Reverse, CtrlMode::Keep);
                    unit.channel1.set_input_mode(EdgeMode::Increment, EdgeMode::Decrement);
                    unit.resume();
                }};
            }
            match unit {
                0 => set_up!(all.unit0),
                1 => set_up!(all.unit1),
                2 => set_up!(all.unit2),
                _ => set_up!(all.unit3),
            }
        });
        Self { unit, _tracks: tracks, last: Cell::new(0), total: Cell::new(0) }
    }

    /// Steps so far; wraps. It must be read before an encoder has made half of the steps that a unit counts.
    pub fn count(&self) -> u16 {
        let now = PCNT::regs().u_cnt(self.unit).read().cnt().bits().cast_signed();
        let steps = i32::from(now) - i32::from(self.last.replace(now));
        let limit = i32::from(LIMIT);
        let steps = match steps {
            steps if steps > limit / 2 => steps - limit,
            steps if steps < -limit / 2 => steps + limit,
            steps => steps,
        };
        let total = self.total.get().wrapping_add(steps as u16);
        self.total.set(total);
        total
    }
}
