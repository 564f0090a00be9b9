//! State machines of the PIO as inputs: one decodes an encoder, another one keeps the times of edges. All of a block
//! run one program. They see pins whatever else these do, so the blocks' own driver is not needed.

use core::cell::Cell;
use core::future::poll_fn;
use core::marker::PhantomData;
use core::task::Poll;

use cortex_m::interrupt::free;
use embassy_rp::Peri;
use embassy_rp::gpio::{AnyPin, Input, Pin as _, Pull};
use embassy_rp::interrupt::typelevel::{self, Interrupt};
use embassy_rp::pac;
use embassy_rp::pac::pio::Pio as Registers;
use embassy_rp::pio::program::{Program, pio_asm};
use embassy_sync::waitqueue::AtomicWaker;

use crate::capture::{Edges, Timed};

/// Machines of a block.
const MACHINES: usize = 4;
/// Words that a machine's queue to the processor has.
const QUEUE: usize = 4;
/// Clocks of a step of a decoder. With 14 steps from sample to sample at most, it counts more than a million steps of an
/// encoder a second, and does not see what is much shorter than a microsecond.
const DECODER_CLOCKS: u32 = 8;
/// Fractions of a machine's divider.
const FRACTIONS: u32 = 256;

/// How often a word is looked for that a machine makes in a microsecond.
const PATIENCE: u32 = 1_000;

/// `set y, 0`, `mov x, ~null`, `mov y, ~null` and `mov osr, null`: what machines begin with.
const CLEAR_Y: u16 = 0xE040;
const FILL_X: u16 = 0xA02B;
const FILL_Y: u16 = 0xA04B;
const CLEAR_OSR: u16 = 0xA0E3;

/// A block, by the interrupt that its machines wake tasks with.
pub trait Block: Interrupt {
    /// Its registers.
    const REGISTERS: Registers;
    /// The tasks that wait for its machines.
    fn wakers() -> &'static [AtomicWaker; MACHINES];

    /// Changes which machines interrupt.
    fn wake_for(change: impl FnOnce(u32) -> u32) {
        let enabled = Self::REGISTERS.irqs(0).inte();
        free(|_| enabled.modify(|bits| bits.0 = change(bits.0)));
    }
}

macro_rules! blocks {
    ($($(#[$condition:meta])* $interrupt:ident: $registers:ident;)*) => {
        $(
            $(#[$condition])*
            impl Block for typelevel::$interrupt {
                const REGISTERS: Registers = pac::$registers;
                fn wakers() -> &'static [AtomicWaker; MACHINES] {
                    static WAKERS: [AtomicWaker; MACHINES] = [const { AtomicWaker::new() }; MACHINES];
                    &WAKERS
                }
            }
        )*
    };
}
blocks! {
    PIO0_IRQ_0: PIO0;
    PIO1_IRQ_0: PIO1;
    #[cfg(feature = "pio2")]
    PIO2_IRQ_0: PIO2;
}

/// What a block's interrupt does: it wakes the tasks whose machines have something for them.
pub struct Wake<B: Block>(PhantomData<B>);

impl<B: Block> typelevel::Handler<B> for Wake<B> {
    unsafe fn on_interrupt() {
        let due = B::REGISTERS.irqs(0).ints().read().0;
        B::wake_for(|enabled| enabled & !due);
        for (at, waker) in B::wakers().iter().enumerate() {
            if due & (1 << at) != 0 {
                waker.wake();
            }
        }
    }
}

/// A machine that runs.
struct Machine {
    block: Registers,
    number: usize,
}

/// How a machine is set.
struct Setting<'p> {
    program: &'p Program<32>,
    /// The pin that jumps look at, and the pin that is read.
    pins: [u8; 2],
    /// Clocks of a step, in fractions.
    divider: u32,
    /// What it does first.
    first: &'static [u16],
    /// Whether its queue has the room of the one to the machine as well.
    is_joined: bool,
}

impl Machine {
    fn new(block: Registers, number: usize, setting: &Setting<'_>) -> Self {
        let Setting { program, pins: [jump, read], divider, first, is_joined } = setting;
        for (at, word) in program.code.iter().enumerate() {
            block.instr_mem(at).write(|memory| memory.set_instr_mem(*word));
        }
        let machine = block.sm(number);
        machine.clkdiv().write(|clock| {
            // A divider of 65,536 is written as 0.
            clock.0 = divider.wrapping_mul(FRACTIONS);
        });
        machine.execctrl().write(|control| {
            control.set_jmp_pin(*jump);
            control.set_wrap_top(program.wrap.source);
            control.set_wrap_bottom(program.wrap.target);
        });
        machine.shiftctrl().write(|control| {
            control.set_fjoin_rx(*is_joined);
            control.set_out_shiftdir(true);
        });
        machine.pinctrl().write(|control| control.set_in_base(*read));
        for word in *first {
            machine.instr().write(|instruction| instruction.set_instr(*word));
        }
        // `jmp` to the first instruction of the program's loop.
        machine.instr().write(|jump| jump.set_instr(program.wrap.target.into()));
        block.ctrl().modify(|control| control.set_sm_enable(control.sm_enable() | 1 << number));
        Self { block, number }
    }

    /// A word of its queue, if there is one.
    fn pull(&self) -> Option<u32> {
        let is_empty = self.block.fstat().read().rxempty() & (1 << self.number) != 0;
        (!is_empty).then(|| self.block.rxf(self.number).read())
    }
}

/// A machine that decodes an encoder.
pub struct Decoder {
    machine: Machine,
    _tracks: [Input<'static>; 2],
    /// What it counted before the tracks were known.
    from: u16,
    /// The last word of its queue.
    last: Cell<u16>,
}

impl Decoder {
    /// It counts from now on. Tracks that nothing drives are high.
    pub fn new<B: Block>(
        number: usize,
        a: Peri<'static, AnyPin>,
        b: Peri<'static, AnyPin>,
    ) -> Self {
        // The state of both tracks before and after a sample is a place in the table at the beginning.
        let program = pio_asm!(
            ".origin 0"
            "jmp sample"
            "jmp down"
            "jmp up"
            "jmp sample"
            "jmp up"
            "jmp sample"
            "jmp sample"
            "jmp down"
            "jmp down"
            "jmp sample"
            "jmp sample"
            "jmp up"
            "jmp sample"
            "jmp up"
            "jmp down"
            "jmp sample"
            "down:"
            "jmp y-- sample"
            ".wrap_target"
            "sample:"
            "mov isr, y"
            "push noblock"
            "out isr, 2"
            "in pins, 1"
            "jmp pin high"
            "in null, 1"
            "jmp look"
            "high:"
            "in x, 1"
            "look:"
            "mov osr, isr"
            "mov pc, isr"
            "up:"
            "mov y, ~y"
            "jmp y-- still"
            "still:"
            "mov y, ~y"
            ".wrap"
        );
        let setting = Setting {
            program: &program.program,
            pins: [b.pin(), a.pin()],
            divider: DECODER_CLOCKS * FRACTIONS,
            first: &[CLEAR_Y, FILL_X, CLEAR_OSR],
            is_joined: false,
        };
        let tracks = [a, b].map(|track| Input::new(track, Pull::Up));
        let machine = Machine::new(B::REGISTERS, number, &setting);
        let mut decoder = Self { machine, _tracks: tracks, from: 0, last: Cell::new(0) };
        decoder.from = decoder.count();
        decoder
    }

    /// Steps so far; wraps.
    pub fn count(&self) -> u16 {
        // The queue has what was counted when it had room, so the last word is the first that came since.
        for _ in 0..=QUEUE {
            if let Some(word) = (0..PATIENCE).find_map(|_| self.machine.pull()) {
                self.last.set(word as u16);
            }
        }
        self.last.get().wrapping_sub(self.from)
    }
}

/// A machine that keeps the times of edges.
pub struct Stopwatch<B: Block> {
    machine: Machine,
    _pin: Input<'static>,
    edges: Edges,
    /// The last time that the machine told, and all ticks until then.
    last: u32,
    ticks: u32,
    /// Whether there was an edge. The first one may be none: the machine begins with a low level.
    has_begun: bool,
    _block: PhantomData<B>,
}

/// The greatest time that a machine tells.
const WRAP: u32 = u32::MAX >> 1;

impl<B: Block> Stopwatch<B> {
    /// It runs from now on. `divider`: clocks of half a tick, in 256ths, from 256 on.
    pub fn new(
        _irqs: impl typelevel::Binding<B, Wake<B>>,
        number: usize,
        pin: Peri<'static, AnyPin>,
        divider: u32,
        edges: Edges,
    ) -> Self {
        // X counts down by one each second instruction, whatever way the program takes. At an edge it is handed over
        // with the new level as the last bit.
        let program = pio_asm!(
            ".origin 0"
            "low:"
            "jmp pin rise"
            ".wrap_target"
            "jmp x-- low"
            "jmp low"
            "rise:"
            "jmp x-- rise_time"
            "rise_time:"
            "in x, 31"
            "jmp x-- rise_level"
            "rise_level:"
            "in y, 1"
            "jmp x-- rise_over"
            "rise_over:"
            "push noblock"
            "high:"
            "jmp x-- look"
            "look:"
            "jmp pin high"
            "jmp x-- fall_time"
            "fall_time:"
            "in x, 31"
            "jmp x-- fall_level"
            "fall_level:"
            "in null, 1"
            "jmp x-- fall_over"
            "fall_over:"
            "push noblock"
            ".wrap"
        );
        let setting = Setting {
            program: &program.program,
            pins: [pin.pin(), pin.pin()],
            divider,
            first: &[FILL_X, FILL_Y],
            is_joined: true,
        };
        let pin = Input::new(pin, Pull::None);
        let machine = Machine::new(B::REGISTERS, number, &setting);
        // SAFETY: the handler is bound, and only wakes tasks.
        unsafe { B::enable() };
        let (last, ticks, has_begun) = (0, 0, false);
        Self { machine, _pin: pin, edges, last, ticks, has_begun, _block: PhantomData }
    }

    /// A word of the machine.
    async fn word(&mut self) -> u32 {
        let number = self.machine.number;
        let pulled = poll_fn(|context| {
            if let Some(waker) = B::wakers().get(number) {
                waker.register(context.waker());
            }
            match self.machine.pull() {
                Some(word) => Poll::Ready(word),
                None => {
                    B::wake_for(|enabled| enabled | 1 << number);
                    Poll::Pending
                }
            }
        });
        pulled.await
    }
}

impl<B: Block> Timed for Stopwatch<B> {
    async fn edge(&mut self) -> (u32, bool) {
        loop {
            let word = self.word().await;
            let (time, level) = (WRAP - (word >> 1), word & 1 != 0);
            self.ticks = self.ticks.wrapping_add(time.wrapping_sub(self.last) & WRAP);
            self.last = time;
            let counts = match self.edges {
                Edges::Rising => level,
                Edges::Falling => !level,
                Edges::Both => true,
            };
            let is_known = core::mem::replace(&mut self.has_begun, true);
            if is_known && counts {
                return (self.ticks, level);
            }
        }
    }
}
