// A Pico with the emulator rp2040js: an image, what is on its pins and buses, and what comes of it.
//
// Standard input has one object of JSON (times in microseconds since power came):
//   image          path of a UF2 file, which becomes the flash's bytes as the boot loader would write them
//   until          when the run ends
//   analog         readings of the four channels, 0 to 4095
//   chips          by address of I2C: bytes of registers, counted up while they are read
//   spi            bytes that SPI answers, over and over
//   levels         [time, pin, level]: what pins are driven to
//   ports          [time, number, hex]: characters that come to a UART
//   link           number of the UART that the host is at; over USB without it
//   said           [time, hex]: what the host sends
//   held           [from, to, goesOn]: an I2C part keeps the bus in this time; then transfers go on, or are lost for ever
//   hung           from then on the core does nothing, until a reset
// Standard output has one object:
//   heard          [time, hex]: what the host receives
//   pins           by pin: [time, level], a level of 2 and more for a pin that is not driven
//   written        by number of a UART: bytes that it sent to a device
//   resets         times of the watchdog's resets
import fs from 'node:fs';
import { RP2040, USBCDC } from 'rp2040js';
import { decodeBlock } from 'uf2';

const FLASH = 0x10000000;
// A second-stage boot loader is before the program.
const PROGRAM = 0x100;
const VTOR = 0xd08;
const CYCLE_NS = 8;
const IDLE_NS = 1e6;
const FAMILY = 0xe48bff56;
const UF2_BLOCK = 512;
const SECTOR = 4096;
const CHARACTER_NS = 86_806; // 10 bits at 115,200 baud
const TX_INTERRUPT = 1 << 5;
const CONNECTING = 2; // a state of the emulator's I2C units

const world = JSON.parse(fs.readFileSync(0, 'utf8'));
const image = burnt(fs.readFileSync(world.image));
const answer = { heard: [], pins: {}, written: {}, resets: [] };

/// The flash that a UF2 file leaves, on one that held another program. The boot loader erases a sector before the first
/// block of it, and takes every sixteenth block of the file for the first of one (pico-bootrom: virtual_disk.c).
function burnt(file) {
  const blocks = Array.from({ length: file.length / UF2_BLOCK }, (_, at) =>
    decodeBlock(new Uint8Array(file.subarray(at * UF2_BLOCK, (at + 1) * UF2_BLOCK))));
  const end = Math.max(...blocks.map((block) => block.flashAddress)) + SECTOR - FLASH;
  const flash = new Uint8Array(end - (end % SECTOR)).fill(0x00);
  for (const block of blocks) {
    if (block.boardFamily !== FAMILY || block.totalBlocks !== blocks.length) throw new Error('not for an RP2040');
    const at = block.flashAddress - FLASH;
    if (block.blockNumber % (SECTOR / block.payload.length) === 0) flash.fill(0xff, at - (at % SECTOR), at - (at % SECTOR) + SECTOR);
    // Bits of a flash are only ever cleared.
    block.payload.forEach((byte, index) => { flash[at + index] &= byte; });
  }
  return flash;
}

/// Where the emulator differs from the RP2040's data sheet.
function mend(mcu, clock) {
  // ARMv6-M, A6.7.58, SEV: the next WFE does not wait.
  mcu.logger.info = (_, text) => {
    if (text === 'SEV') mcu.core.eventRegistered = true;
  };
  // 2.19, GPIO: pads take input after a reset.
  for (const pin of mcu.gpio) pin.padValue = 0x56;
  // 4.5, PWM: a divider that is written does not start a slice.
  Object.defineProperty(Object.getPrototypeOf(mcu.pwm.channels[0].timer), 'prescaler', {
    configurable: true,
    get() { return this.prescalerValue; },
    set(value) {
      this.baseValue = this.counter;
      this.baseNanos = this.clock.nanos;
      this.prescalerValue = value;
      this.updated();
    },
  });
  // 4.5, PWM: outputs of a slice leave the inputs of others alone.
  mcu.pwm.gpioOnInput = (index) => {
    if (mcu.pwm.gpioDirection & (1 << index)) return;
    for (const slice of mcu.pwm.channels) {
      if (slice.pinB1 === index || slice.pinB2 === index) slice.gpioBChanged();
    }
  };
  // 2.14, subsystem resets: an I2C unit begins anew.
  const resets = mcu.peripherals[0x4000c];
  const write = resets.writeUint32.bind(resets);
  resets.writeUint32 = (offset, value) => {
    write(offset, value);
    mcu.i2c.filter((_, unit) => offset === 0 && (value & (8 << unit)) !== 0).forEach((unit) => {
      const { onConnect, onWriteByte, onReadByte } = unit;
      Object.assign(unit, new unit.constructor(mcu, unit.name, unit.irq));
      Object.assign(unit, { onConnect, onWriteByte, onReadByte });
      unit.onStart = () => unit.completeStart();
      unit.onStop = () => unit.completeStop();
    });
  };
  // 2.12, chip-level reset: why the chip started.
  mcu.peripherals[0x40064].readUint32 = (offset) => (offset === 8 ? 1 << 8 : 0);
  mcu.pio.forEach(runWithTime);
  keepBuffers(mcu.usbCtrl, mcu.usbDPRAMView);
  mcu.uart.forEach((uart) => sendInTime(mcu, uart, clock));
}

/// 3.5, PIO: machines that are enabled run with the board's time, by their divided clock. A queue has the room of the other
/// one where they are joined.
function runWithTime(pio) {
  pio.run = () => {};
  for (const machine of pio.machines) {
    const write = machine.writeUint32.bind(machine);
    machine.writeUint32 = (offset, value) => {
      write(offset, value);
      const room = machine.shiftCtrl >>> 31 ? 8 : 4;
      if (machine.rxFIFO.size !== room) machine.rxFIFO = new machine.rxFIFO.constructor(room);
    };
    machine.dueNs = 0;
  }
}

function stepMachines(mcu, ns) {
  for (const machine of mcu.pio.flatMap((pio) => pio.machines).filter((one) => one.enabled)) {
    const stepNs = CYCLE_NS * ((machine.clockDivInt || 65_536) + machine.clockDivFrac / 256);
    for (machine.dueNs += ns; machine.dueNs >= stepNs; machine.dueNs -= stepNs) machine.step();
  }
}

/// 4.1, USB: a buffer belongs to the controller until a packet is in it.
function keepBuffers(usb, memory) {
  const AVAILABLE = 1 << 10;
  const updated = usb.DPRAMUpdated.bind(usb);
  const finish = usb.finishRead.bind(usb);
  const firstOut = 0x80 + 4;
  // Endpoint 0 is the host's, which takes no time.
  const isOut = (offset) => offset > firstOut && offset < 0x100 && offset % 8 === 4;
  usb.DPRAMUpdated = (offset, value) => {
    updated(offset, value);
    if (isOut(offset) && (value & AVAILABLE) !== 0) memory.setUint32(offset, value, true);
  };
  usb.finishRead = (endpoint, bytes) => {
    const offset = firstOut + 8 * endpoint;
    memory.setUint32(offset, memory.getUint32(offset, true) & ~AVAILABLE, true);
    finish(endpoint, bytes);
  };
}

/// 4.2, UART: a queue of 32 characters, which interrupts as it becomes an eighth full, and the time of a character.
function sendInTime(mcu, uart, clock) {
  const queue = [];
  const read = uart.readUint32.bind(uart);
  const write = uart.writeUint32.bind(uart);
  const next = clock.createAlarm(() => {
    uart.onByte?.(queue.shift());
    if (queue.length === 4) uart.interruptStatus |= TX_INTERRUPT;
    uart.checkInterrupts();
    if (queue.length > 0) next.schedule(CHARACTER_NS);
  });
  uart.checkInterrupts = () =>
    mcu.setInterrupt(uart.irq, (uart.interruptStatus & uart.interruptMask) !== 0);
  Object.defineProperty(uart, 'flags', {
    get: () =>
      (uart.rxFIFO.full ? 1 << 6 : 0) | (uart.rxFIFO.empty ? 1 << 4 : 0) |
      (queue.length === 0 ? 1 << 7 : 1 << 3) | (queue.length >= 32 ? 1 << 5 : 0),
  });
  // Errors, thresholds and DMA are not there.
  uart.readUint32 = (offset) => ([0x04, 0x34, 0x48].includes(offset) ? 0 : read(offset));
  uart.writeUint32 = (offset, value) => {
    if ([0x04, 0x34, 0x48].includes(offset)) return;
    if (offset !== 0) return write(offset, value);
    if (queue.length >= 32) throw new Error('a character was written to a full queue');
    queue.push(value & 0xff);
    uart.interruptStatus &= ~TX_INTERRUPT;
    uart.checkInterrupts();
    if (queue.length === 1) next.schedule(CHARACTER_NS);
  };
}

/// The host: both ways over USB, or over a UART. Returns what sends bytes.
function connect(mcu, hear) {
  const usb = mcu.usbCtrl;
  const host = new USBCDC(usb);
  const waiting = [];
  let room = 0;
  const push = () => {
    if (room === 0 || waiting.length === 0) return;
    usb.endpointReadDone(host.outEndpoint, new Uint8Array(waiting.splice(0, room)));
    room = 0;
  };
  // A host that has nothing to say does not answer; the emulator's sends empty packets.
  usb.onEndpointRead = (endpoint, size) => {
    if (endpoint !== host.outEndpoint) return;
    room = size;
    push();
  };
  // PSTN subclass 1.2, 6.3.12: the request is to the interface, not to the device.
  host.cdcSetControlLineState = () => {
    host.initialized = true;
    usb.sendSetupPacket(new Uint8Array([0x21, 0x22, 3, 0, 0, 0, 0, 0]));
  };
  host.onSerialData = hear;
  mcu.uart.forEach((uart, number) => {
    uart.onByte = (byte) => (world.link === number ? hear([byte]) : (answer.written[number] ??= []).push(byte));
  });
  return (bytes) => {
    if (Number.isInteger(world.link)) return bytes.forEach((byte) => mcu.uart[world.link].feedByte(byte));
    waiting.push(...bytes);
    push();
  };
}

function attach(mcu, clock, now) {
  mcu.adc.channelValues.splice(0, 4, ...world.analog);
  for (const bus of mcu.i2c) {
    let [chip, register, isFirst] = [undefined, 0, true];
    const held = () => (world.held ?? []).find(([from, to]) => from <= now() && now() < to);
    // The transfer goes on when the part lets go, unless the unit was reset.
    const letGo = clock.createAlarm(() => {
      if (bus.state === CONNECTING) bus.completeConnect(chip !== undefined);
    });
    bus.onConnect = (address) => {
      chip = world.chips[address];
      isFirst = true;
      const [, until, goesOn] = held() ?? [];
      if (until === undefined) bus.completeConnect(chip !== undefined);
      else if (goesOn) letGo.schedule((until - now()) * 1000);
    };
    bus.onWriteByte = (byte) => {
      if (isFirst) register = byte;
      isFirst = false;
      bus.completeWrite(true);
    };
    bus.onReadByte = () => bus.completeRead(chip[register++ % chip.length]);
  }
  for (const bus of mcu.spi) {
    let count = 0;
    bus.onTransmit = () => bus.completeTransmit(world.spi[count++ % world.spi.length]);
  }
  for (const pin of mcu.gpio) {
    pin.addListener((level) => (answer.pins[pin.index] ??= []).push([now(), level]));
  }
}

/// A start of the chip: power came, or the watchdog ended what was before.
function start(began, before) {
  const mcu = new RP2040();
  const { clock } = mcu;
  const now = () => began + Math.floor(clock.micros);
  const quiet = () => {};
  mcu.logger = { debug: quiet, info: quiet, warn: quiet, error: (name, text) => { throw new Error(`${name}: ${text}`); } };
  mcu.onBreak = () => { throw new Error(`the program stopped itself at ${mcu.core.PC.toString(16)}`); };
  mend(mcu, clock);
  attach(mcu, clock, now);
  const say = connect(mcu, (bytes) => answer.heard.push([now(), Buffer.from(bytes).toString('hex')]));
  const watchdog = mcu.peripherals[0x40058];
  if (before !== undefined) {
    mcu.sram.set(before.sram);
    watchdog.reason = 1;
  }
  const board = { mcu, clock, now, say, sram: mcu.sram, isReset: false };
  watchdog.onWatchdogTrigger = () => {
    board.isReset = true;
    // It would begin anew at once.
    watchdog.alarm.enable = false;
  };
  mcu.flash.set(image);
  mcu.ppb.writeUint32(VTOR, FLASH + PROGRAM);
  mcu.core.SP = mcu.readUint32(FLASH + PROGRAM);
  mcu.core.PC = mcu.readUint32(FLASH + PROGRAM + 4) & ~1;
  return board;
}

const events = [
  ...world.levels.map(([at, pin, level]) => [at, (board) => board.mcu.gpio[pin].setInputValue(level !== 0)]),
  ...(world.ports ?? []).map(([at, port, hex]) => [at, (board) => Buffer.from(hex, 'hex').forEach((byte) => board.mcu.uart[port].feedByte(byte))]),
  ...(world.said ?? []).map(([at, hex]) => [at, (board) => board.say([...Buffer.from(hex, 'hex')])]),
].sort(([a], [b]) => a - b);

function pass({ mcu, clock }, ns) {
  clock.tick(ns);
  stepMachines(mcu, ns);
}

let board = start(0);
while (board.now() < world.until) {
  while (events.length > 0 && events[0][0] <= board.now()) events.shift()[1](board);
  const { core } = board.mcu;
  if (core.waiting || board.now() >= (world.hung ?? Infinity)) {
    const toEvent = events.length > 0 ? (events[0][0] - board.now()) * 1000 : IDLE_NS;
    const toAlarm = board.clock.nanosToNextAlarm || IDLE_NS;
    pass(board, Math.max(CYCLE_NS, Math.min(toEvent, toAlarm, IDLE_NS)));
  } else {
    pass(board, core.executeInstruction() * CYCLE_NS);
  }
  if (board.isReset) {
    world.hung = undefined;
    answer.resets.push(board.now());
    const pins = board.mcu.gpio.map((pin) => pin.rawInputValue);
    board = start(board.now(), board);
    pins.forEach((level, pin) => board.mcu.gpio[pin].setInputValue(level));
  }
}
process.stdout.write(`${JSON.stringify(answer)}\n`);
