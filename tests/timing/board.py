"""An emulated STM32F407 that measures what a generated firmware does: how long converters and buses are busy, the
bytes of the serial link, interrupts, and instructions a thread. `measure.py` compares that with what was computed.

Unicorn is the core; everything else is here, to the level that the drivers of ChibiOS use. Times follow from the registers
that the drivers write (dividers, sampling times), by the reference manual RM0090. An instruction is one clock of the core.
"""

import heapq

from elftools.elf.elffile import ELFFile
from unicorn import UC_ARCH_ARM, UC_HOOK_BLOCK, UC_HOOK_INTR, UC_MODE_MCLASS, UC_MODE_THUMB, Uc
from unicorn import arm_const as arm

CORE_HZ = 168_000_000
PCLK1_HZ, PCLK2_HZ = 42_000_000, 84_000_000
RETURN = 0xE1000000  # where an exception's return goes: nothing can be fetched from there

I2CS = {0x40005400: ("I2C1", 31), 0x40005800: ("I2C2", 33), 0x40005C00: ("I2C3", 72)}
I2C_STREAMS = {"I2C1": ([(1, 0), (1, 5)], [(1, 6), (1, 7)]), "I2C2": ([(1, 2), (1, 3)], [(1, 7)]), "I2C3": ([(1, 2)], [(1, 4)])}
ADCS = {0x40012000: "ADC1", 0x40012100: "ADC2", 0x40012200: "ADC3"}
ADC_STREAMS = {"ADC1": [(2, 4), (2, 0)], "ADC2": [(2, 2), (2, 3)], "ADC3": [(2, 1), (2, 0)]}
DMA_IRQS = {(1, n): irq for n, irq in enumerate([11, 12, 13, 14, 15, 16, 17, 47])}
DMA_IRQS |= {(2, n): irq for n, irq in enumerate([56, 57, 58, 59, 60, 68, 69, 70])}
# Base: name, clock of the timer, its interrupts (update, capture).
TIMERS = {
    0x40010000: ("TIM1", 168_000_000, 25, 27), 0x40000000: ("TIM2", 84_000_000, 28, 28),
    0x40000400: ("TIM3", 84_000_000, 29, 29), 0x40000800: ("TIM4", 84_000_000, 30, 30),
    0x40000C00: ("TIM5", 84_000_000, 50, 50), 0x40010400: ("TIM8", 168_000_000, 44, 46),
    0x40014000: ("TIM9", 168_000_000, 24, 24), 0x40001800: ("TIM12", 84_000_000, 43, 43),
}
SAMPLE = [3, 15, 28, 56, 84, 112, 144, 480]


class Board:
    def __init__(self, elf, capture_hz):
        self.now = 0  # in clocks of the core
        self.events, self.order = [], 0
        self.pending, self.enabled, self.priority = set(), set(), {}
        self.active = []  # exceptions being served
        self.ram = {}  # registers without a model of their own
        self.capture_hz = capture_hz
        self.busy = {}  # unit: clocks
        self.count = {}  # anything that is counted
        self.spent = {}  # thread or interrupt: instructions
        self.tx, self.blocks, self.idle, self.stop, self.fresh = bytearray(), {}, False, False, True
        self.dma = {1: [dict(cr=0, ndtr=0, par=0, m0=0) for _ in range(8)], 2: [dict(cr=0, ndtr=0, par=0, m0=0) for _ in range(8)]}
        self.dma_isr = {1: 0, 2: 0}
        self.i2c = {base: dict(base=base, name=name, irq=irq, sr1=0, sr2=0, cr1=0, cr2=0, ccr=0, oar=0, trise=0, seen=False, rx=False, since=None, shift=False)
                    for base, (name, irq) in I2CS.items()}
        self.adc = {base: dict(name=name, sr=0, cr2=0, smpr=[0, 0], sqr=[0, 0, 0]) for base, name in ADCS.items()}
        self.tim = {base: dict(name=name, hz=hz, up=up, cc=cc, sr=0, dier=0, psc=0, arr=0xFFFFFFFF, cr1=0, ccr=[0] * 4, zero=0, edge=0)
                    for base, (name, hz, up, cc) in TIMERS.items()}
        self.usart = {0x40004400: dict(name="USART2", irq=38, hz=PCLK1_HZ, cr1=0, brr=1, hold=None, shift=False, sr=0xC0),
                      0x40011000: dict(name="USART1", irq=37, hz=PCLK2_HZ, cr1=0, brr=1, hold=None, shift=False, sr=0xC0)}
        self.load(elf)

    # ---- set-up

    def load(self, path):
        self.uc = uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
        uc.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M4)
        uc.mem_map(0x08000000, 1 << 20)
        uc.mem_map(0x10000000, 64 << 10)
        uc.mem_map(0x20000000, 128 << 10)
        uc.mmio_map(0x40000000, 0x80000, self.peripheral_read, None, self.peripheral_write, None)
        uc.mmio_map(0xE0000000, 0x100000, self.core_read, None, self.core_write, None)
        with open(path, "rb") as file:
            elf = ELFFile(file)
            for segment in elf.iter_segments():
                if segment["p_type"] == "PT_LOAD" and segment["p_filesz"]:
                    uc.mem_write(segment["p_paddr"], segment.data())
            self.symbols = [(s["st_value"], s["st_size"], s.name) for s in elf.get_section_by_name(".symtab").iter_symbols()]
        named = {name: (value, size) for value, size, name in self.symbols}
        self.idle_range = range(named["__idle_thread"][0] & ~1, (named["__idle_thread"][0] & ~1) + named["__idle_thread"][1])
        # The linker may have put it into its only caller.
        self.halt = named.get("chSysHalt", (0, 0))[0] & ~1
        self.stacks = [(value, value + size, name) for value, size, name in self.symbols if name.endswith("_stack")]
        self.process = (named["__process_stack_base__"][0], named["__process_stack_end__"][0])
        sp, pc = (int.from_bytes(uc.mem_read(0x08000000 + at, 4), "little") for at in (0, 4))
        uc.reg_write(arm.UC_ARM_REG_MSP, sp)
        uc.reg_write(arm.UC_ARM_REG_SP, sp)
        self.pc = pc & ~1
        uc.hook_add(UC_HOOK_BLOCK, self.block)
        uc.hook_add(UC_HOOK_INTR, self.interrupt)

    # ---- time

    def at(self, clocks, what, *arguments):
        self.order += 1
        heapq.heappush(self.events, (self.now + max(1, int(clocks)), self.order, what, arguments))

    def due(self):
        while self.events and self.events[0][0] <= self.now:
            _, _, what, arguments = heapq.heappop(self.events)
            what(*arguments)

    def instructions(self, address, size):
        code = self.uc.mem_read(address, size)
        at = number = 0
        while at < size:
            at += 4 if code[at + 1] >> 3 in (0b11101, 0b11110, 0b11111) else 2
            number += 1
        return number

    def block(self, uc, address, size, _):
        number = self.blocks.get((address, size))
        if number is None:
            number = self.blocks[address, size] = self.instructions(address, size)
        if not self.fresh and (self.pending or address in self.idle_range or self.events and self.events[0][0] <= self.now):
            # Stopped before the block is executed; it comes here again.
            self.idle = address in self.idle_range
            uc.emu_stop()
            return
        self.fresh = False
        if self.halt and address == self.halt:
            at = uc.reg_read(arm.UC_ARM_REG_R0)
            raise RuntimeError("the kernel halts: " + bytes(uc.mem_read(at, 40)).split(b"\0")[0].decode())
        self.now += number
        self.idle = address in self.idle_range
        if not self.idle:
            who = self.who()
            self.spent[who] = self.spent.get(who, 0) + number

    def who(self):
        if self.active:
            return f"irq {self.active[-1] - 16}" if self.active[-1] >= 16 else "svc"
        sp = self.uc.reg_read(arm.UC_ARM_REG_SP)
        for low, high, name in self.stacks:
            if low < sp <= high:
                return name
        return "reporter" if self.process[0] < sp <= self.process[1] else "start"

    def run(self, seconds):
        end = self.now + int(seconds * CORE_HZ)
        while self.now < end:
            self.due()
            self.deliver()
            if self.idle and not self.pending and not self.active and self.events:
                self.now = max(self.now, min(self.events[0][0], end))
                self.due()
                self.deliver()
                self.idle = False
            self.stop, self.fresh = False, True
            self.uc.emu_start(self.pc | 1, 0xFFFFFFFE, 0, 0)
            if not self.stop:
                self.pc = self.uc.reg_read(arm.UC_ARM_REG_PC) & ~1

    # ---- exceptions

    def deliver(self):
        ready = [irq for irq in self.pending if irq in self.enabled]
        if not ready:
            return
        irq = min(ready, key=lambda irq: (self.priority.get(irq, 0), irq))
        level = self.priority.get(irq, 0)
        if self.uc.reg_read(arm.UC_ARM_REG_PRIMASK) & 1:
            return
        base = self.uc.reg_read(arm.UC_ARM_REG_BASEPRI)
        if base and level >= base:
            return
        if self.active and level >= min(self.priority.get(n - 16, 0) if n >= 16 else 0 for n in self.active):
            return
        self.pending.discard(irq)
        self.count[f"irq {irq}"] = self.count.get(f"irq {irq}", 0) + 1
        self.enter(irq + 16)

    FRAME = [arm.UC_ARM_REG_R0, arm.UC_ARM_REG_R1, arm.UC_ARM_REG_R2, arm.UC_ARM_REG_R3, arm.UC_ARM_REG_R12, arm.UC_ARM_REG_LR]

    def enter(self, number):
        uc = self.uc
        sp = uc.reg_read(arm.UC_ARM_REG_SP)
        values = [uc.reg_read(r) for r in self.FRAME] + [self.pc | 0, uc.reg_read(arm.UC_ARM_REG_XPSR) & 0xFF0FFE00 | 0x01000000]
        padded = sp & 4
        sp = (sp - 32 - padded) & ~7
        values[7] |= 0x200 if padded else 0
        uc.mem_write(sp, b"".join(v.to_bytes(4, "little") for v in values))
        if self.active:
            uc.reg_write(arm.UC_ARM_REG_SP, sp)
        else:
            uc.reg_write(arm.UC_ARM_REG_SP, sp)
            uc.reg_write(arm.UC_ARM_REG_CONTROL, 0)
        self.active.append(number)
        uc.reg_write(arm.UC_ARM_REG_LR, RETURN | 1)
        self.pc = int.from_bytes(uc.mem_read(0x08000000 + 4 * number, 4), "little") & ~1
        self.now += 12

    def leave(self):
        uc = self.uc
        self.active.pop()
        if not self.active:
            uc.reg_write(arm.UC_ARM_REG_CONTROL, 2)
        sp = uc.reg_read(arm.UC_ARM_REG_SP)
        raw = uc.mem_read(sp, 32)
        values = [int.from_bytes(raw[at:at + 4], "little") for at in range(0, 32, 4)]
        for register, value in zip(self.FRAME, values):
            uc.reg_write(register, value)
        uc.reg_write(arm.UC_ARM_REG_SP, sp + 32 + (4 if values[7] & 0x200 else 0))
        uc.reg_write(arm.UC_ARM_REG_XPSR, values[7] & 0xF8000000 | 0x01000000)
        self.pc = values[6] & ~1
        self.now += 12

    def interrupt(self, uc, number, _):
        if uc.reg_read(arm.UC_ARM_REG_PC) & ~1 == RETURN:  # nothing may be fetched from there
            self.stop = True
            uc.emu_stop()
            self.leave()
            return
        if number != 2:
            raise RuntimeError(f"exception {number} at {uc.reg_read(arm.UC_ARM_REG_PC):x}")
        self.pc = uc.reg_read(arm.UC_ARM_REG_PC) & ~1
        self.stop = True
        uc.emu_stop()
        self.enter(11)

    # ---- the core's own registers

    def core_read(self, uc, offset, size, _):
        if offset == 0x1004:
            self.now += 10  # a loop that waits for it
            return self.now & 0xFFFFFFFF
        if offset == 0xED04:
            return 0x800 if len(self.active) <= 1 else 0
        return self.ram.get(0xE0000000 + offset, 0)

    def core_write(self, uc, offset, size, value, _):
        bits = [n for n in range(32) if value >> n & 1]
        if 0xE100 <= offset < 0xE120:
            self.enabled |= {(offset - 0xE100) * 8 + n for n in bits}
        elif 0xE180 <= offset < 0xE1A0:
            self.enabled -= {(offset - 0xE180) * 8 + n for n in bits}
        elif 0xE280 <= offset < 0xE2A0:
            self.pending -= {(offset - 0xE280) * 8 + n for n in bits}
        elif 0xE400 <= offset < 0xE500:
            for n in range(size):
                self.priority[offset - 0xE400 + n] = value >> 8 * n & 0xFF
        else:
            self.ram[0xE0000000 + offset] = value

    # ---- peripherals

    def find(self, units, address, size):
        return next(((unit, address - base) for base, unit in units.items() if 0 <= address - base < size), (None, 0))

    def peripheral_read(self, uc, offset, size, _):
        address = 0x40000000 + offset
        for units, width, read in self.models(True):
            unit, at = self.find(units, address & ~3 if size == 4 else address, width)
            if unit is not None:
                return read(unit, at) & 0xFFFFFFFF
        if address in (0x40026000, 0x40026400, 0x40026004, 0x40026404):
            return self.dma_isr[2 if address & 0x400 else 1] >> (32 if address & 4 else 0) & 0xFFFFFFFF
        if address & ~0x4FF == 0x40026000 or address & ~0x4FF == 0x40026400:
            unit = 2 if address >= 0x40026400 else 1
            at = (address & 0x3FF) - 0x10
            stream = self.dma[unit][at // 0x18]
            return stream[["cr", "ndtr", "par", "m0", "m0", "par"][at % 0x18 // 4]]
        value = self.ram.get(address, 0)
        if address == 0x40023800:  # RCC_CR: what is on is ready
            value = value | (value & 1) << 1 | (value & 0x10000) << 1 | (value & 0x1000000) << 1 | 3
        elif address == 0x40023808:
            value = value & ~12 | (value & 3) << 2
        elif address == 0x40007004:
            value |= 0x4000
        elif address in (0x40023870, 0x40023874):
            value |= (value & 1) << 1
        return value

    def peripheral_write(self, uc, offset, size, value, _):
        address = 0x40000000 + offset
        for units, width, write in self.models(False):
            unit, at = self.find(units, address, width)
            if unit is not None:
                write(unit, at, value)
                return
        if 0x40026000 <= address < 0x40026800:
            self.dma_write(2 if address >= 0x40026400 else 1, address & 0x3FF, value)
            return
        if size < 4:
            whole = address & ~3
            shift = 8 * (address & 3)
            mask = ((1 << 8 * size) - 1) << shift
            value = self.ram.get(whole, 0) & ~mask | value << shift
            address = whole
        self.ram[address] = value

    def models(self, read):
        if read:
            return ((self.i2c, 0x28, self.i2c_read), (self.adc, 0x50, self.adc_read), (self.tim, 0x54, self.tim_read), (self.usart, 0x1C, self.usart_read))
        return ((self.i2c, 0x28, self.i2c_write), (self.adc, 0x50, self.adc_write), (self.tim, 0x54, self.tim_write), (self.usart, 0x1C, self.usart_write))

    # ---- DMA

    def dma_write(self, unit, at, value):
        if at in (8, 12):
            self.dma_isr[unit] &= ~(value << (32 if at == 12 else 0))
        elif at >= 0x10:
            stream = self.dma[unit][(at - 0x10) // 0x18]
            name = ["cr", "ndtr", "par", "m0", None, None][(at - 0x10) % 0x18 // 4]
            if name:
                started = name == "cr" and value & 1 and not stream["cr"] & 1
                stream[name] = value
                if started:
                    for i2c in self.i2c.values():
                        self.i2c_kick(i2c)

    def stream(self, places):
        return next(((unit, n, self.dma[unit][n]) for unit, n in places if self.dma[unit][n]["cr"] & 1), None)

    def dma_done(self, unit, n):
        stream = self.dma[unit][n]
        stream["cr"] &= ~1
        shift = [0, 6, 16, 22][n % 4] + (32 if n >= 4 else 0)
        self.dma_isr[unit] |= 0x20 << shift
        if stream["cr"] & 0x10:
            self.pending.add(DMA_IRQS[unit, n])

    def dma_move(self, place, bytes_):
        unit, n, stream = place
        self.uc.mem_write(stream["m0"], bytes_)
        stream["m0"] += len(bytes_)
        stream["ndtr"] -= 1
        if stream["ndtr"] == 0:
            self.dma_done(unit, n)

    # ---- I2C

    def i2c_clock(self, i2c):
        """Clocks of the core in one of the bus."""
        ccr = i2c["ccr"]
        steps = 2 if not ccr & 0x8000 else 25 if ccr & 0x4000 else 3
        return steps * (ccr & 0xFFF) * CORE_HZ // PCLK1_HZ

    def i2c_event(self, i2c):
        if i2c["cr2"] & 0x200 and i2c["sr1"] & 0b10111:
            self.pending.add(i2c["irq"])

    def i2c_read(self, i2c, at):
        if at == 0x14:
            i2c["seen"] = bool(i2c["sr1"] & 2)
            return i2c["sr1"]
        if at == 0x18:
            value = i2c["sr2"]
            if i2c["seen"] and i2c["sr1"] & 2:
                i2c["sr1"] &= ~2
                i2c["seen"] = False
                self.i2c_kick(i2c)
            return value
        return {0: i2c["cr1"], 4: i2c["cr2"], 8: i2c["oar"], 0x1C: i2c["ccr"], 0x20: i2c["trise"]}.get(at, 0)

    def i2c_write(self, i2c, at, value):
        bit = self.i2c_clock(i2c)
        if at == 0:
            started, stopped = value & 0x100 and not i2c["cr1"] & 0x100, value & 0x200 and not i2c["cr1"] & 0x200
            i2c["cr1"] = value
            if started:
                if i2c["since"] is None:
                    i2c["since"] = self.now
                i2c["sr1"] &= ~4
                self.at(bit, self.i2c_start, i2c)
            if stopped:
                i2c["sr1"] &= ~4
                self.at(bit, self.i2c_stop, i2c)
        elif at == 4:
            i2c["cr2"] = value
            self.i2c_event(i2c)
        elif at == 0x10 and i2c["sr1"] & 1:
            i2c["sr1"] &= ~1
            i2c["rx"] = bool(value & 1)
            self.count[i2c["name"]] = self.count.get(i2c["name"], 0) + 1
            self.at(9 * bit, self.i2c_address, i2c)
        elif at in (8, 0x1C, 0x20):
            i2c[{8: "oar", 0x1C: "ccr", 0x20: "trise"}[at]] = value

    def i2c_start(self, i2c):
        i2c["cr1"] &= ~0x100
        i2c["sr1"], i2c["sr2"] = 1, 3
        self.i2c_event(i2c)

    def i2c_stop(self, i2c):
        i2c["cr1"] &= ~0x200
        i2c["sr1"], i2c["sr2"] = 0, 0
        if i2c["since"] is not None:
            self.busy[i2c["name"]] = self.busy.get(i2c["name"], 0) + self.now - i2c["since"]
            i2c["since"] = None

    def i2c_address(self, i2c):
        i2c["sr1"] |= 2 if i2c["rx"] else 0x82
        i2c["sr2"] = 3 | (0 if i2c["rx"] else 4)
        self.i2c_event(i2c)

    def i2c_kick(self, i2c):
        """The next byte, where the DMA is ready for one."""
        if i2c["shift"] or i2c["since"] is None or i2c["sr1"] & 3 or not i2c["sr2"] & 2 or i2c["cr1"] & 0x300:
            return
        streams = I2C_STREAMS[i2c["name"]][0 if i2c["rx"] else 1]
        place = self.stream(streams)
        if place is None or place[2]["par"] != i2c["base"] + 0x10:
            return
        i2c["shift"] = True
        if not i2c["rx"]:  # taken from memory at once, on the wire for nine clocks
            i2c["sr1"] &= ~4
            unit, n, stream = place
            stream["m0"] += 1
            stream["ndtr"] -= 1
            if stream["ndtr"] == 0:
                self.dma_done(unit, n)
        self.at(9 * self.i2c_clock(i2c), self.i2c_byte, i2c)

    def i2c_byte(self, i2c):
        i2c["shift"] = False
        self.count[i2c["name"]] = self.count.get(i2c["name"], 0) + 1
        streams = I2C_STREAMS[i2c["name"]][0 if i2c["rx"] else 1]
        place = self.stream(streams)
        if i2c["rx"]:
            if place:
                self.dma_move(place, b"\x12")
        elif place is None:
            i2c["sr1"] |= 4 | 0x80
            self.i2c_event(i2c)
        self.i2c_kick(i2c)

    # ---- converters

    def adc_read(self, adc, at):
        return {0: adc["sr"], 8: adc["cr2"], 0xC: adc["smpr"][0], 0x10: adc["smpr"][1], 0x2C: adc["sqr"][0], 0x30: adc["sqr"][1], 0x34: adc["sqr"][2]}.get(at, 0)

    def adc_write(self, adc, at, value):
        if at in (0xC, 0x10):
            adc["smpr"][(at - 0xC) // 4] = value
        elif at in (0x2C, 0x30, 0x34):
            adc["sqr"][(at - 0x2C) // 4] = value
        elif at == 0:
            adc["sr"] &= value
        elif at == 8:
            adc["cr2"] = value & ~(1 << 30)
            if value >> 30 & 1:
                self.adc_start(adc)

    def adc_start(self, adc):
        unit, n, stream = self.stream(ADC_STREAMS[adc["name"]])
        sqr1, sqr2, sqr3 = adc["sqr"]
        channels = (sqr1 >> 20 & 15) + 1
        order = [(sqr3 >> 5 * i & 31) if i < 6 else (sqr2 >> 5 * (i - 6) & 31) if i < 12 else (sqr1 >> 5 * (i - 12) & 31) for i in range(channels)]
        divider = 2 * ((self.ram.get(0x40012304, 0) >> 16 & 3) + 1)
        cycles = sum(SAMPLE[(adc["smpr"][0] >> 3 * (c - 10) if c >= 10 else adc["smpr"][1] >> 3 * c) & 7] + 12 for c in order)
        clocks = cycles * (stream["ndtr"] // channels) * divider * CORE_HZ // PCLK2_HZ
        self.count[adc["name"]] = self.count.get(adc["name"], 0) + stream["ndtr"]
        self.at(clocks, self.adc_end, adc, unit, n, self.now)

    def adc_end(self, adc, unit, n, since):
        stream = self.dma[unit][n]
        self.uc.mem_write(stream["m0"], b"\x34\x02" * stream["ndtr"])
        stream["ndtr"] = 0
        self.busy[adc["name"]] = self.busy.get(adc["name"], 0) + self.now - since
        self.dma_done(unit, n)

    # ---- timers

    def tick(self, tim):
        return (tim["psc"] + 1) * CORE_HZ // tim["hz"]

    def tim_count(self, tim):
        return (self.now - tim["zero"]) // self.tick(tim)

    def tim_read(self, tim, at):
        if at == 0x24:
            return self.tim_count(tim)
        if 0x34 <= at < 0x44:
            return tim["ccr"][(at - 0x34) // 4]
        return {0: tim["cr1"], 0xC: tim["dier"], 0x10: tim["sr"], 0x28: tim["psc"], 0x2C: tim["arr"]}.get(at, 0)

    def tim_write(self, tim, at, value):
        if at == 0x10:
            tim["sr"] &= value
        elif at == 0x28:
            tim["psc"] = value
        elif at == 0x2C:
            tim["arr"] = value & (0xFFFFFFFF if tim["name"] in ("TIM2", "TIM5") else 0xFFFF)
        elif at == 0x14:
            tim["zero"] = self.now
        elif at == 0xC:
            tim["dier"] = value
            self.tim_raise(tim)
            self.tim_compare(tim)
        elif at == 0:
            fresh = value & 1 and not tim["cr1"] & 1
            tim["cr1"] = value
            if fresh and tim["name"] in self.capture_hz:
                tim["slave"] = True
                self.at(CORE_HZ // self.capture_hz[tim["name"]], self.edge, tim)
        elif 0x34 <= at < 0x44:
            tim["ccr"][(at - 0x34) // 4] = value
            self.tim_compare(tim)
        else:
            self.ram[id(tim) + at] = value

    def tim_raise(self, tim):
        if tim["sr"] & tim["dier"] & 1:
            self.pending.add(tim["up"])
        if tim["sr"] & tim["dier"] & 0x1E:
            self.pending.add(tim["cc"])

    def tim_compare(self, tim):
        if tim["name"] not in self.capture_hz and tim["dier"] & 2:
            wait = (tim["ccr"][0] - self.tim_count(tim)) & 0xFFFFFFFF
            self.at(wait * self.tick(tim) - (self.now - tim["zero"]) % self.tick(tim), self.compared, tim, tim["ccr"][0])

    def compared(self, tim, at):
        if tim["ccr"][0] == at and tim["dier"] & 2:
            tim["sr"] |= 2
            self.tim_raise(tim)

    def edge(self, tim):
        """An active edge, and its end after a quarter of the period."""
        period = CORE_HZ // self.capture_hz[tim["name"]]
        name = f"edges {tim['name']}"
        self.count[name] = self.count.get(name, 0) + 1
        tim["ccr"][0] = period // self.tick(tim)
        tim["sr"] |= 2
        self.tim_raise(tim)
        self.at(period // 4, self.width, tim)
        # The edge has set the counter to zero, and the next one does it again.
        for number in range(1, (period - 1) // ((tim["arr"] + 1) * self.tick(tim)) + 1):
            self.at(number * (tim["arr"] + 1) * self.tick(tim), self.overflowed, tim)
        self.at(period, self.edge, tim)

    def overflowed(self, tim):
        tim["sr"] |= 1
        self.tim_raise(tim)

    def width(self, tim):
        tim["ccr"][1] = tim["ccr"][0] // 4
        tim["sr"] |= 4
        self.tim_raise(tim)

    # ---- serial ports

    def usart_read(self, usart, at):
        return {0: usart["sr"], 8: usart["brr"], 0xC: usart["cr1"]}.get(at, 0)

    def usart_write(self, usart, at, value):
        if at == 4:
            if usart["shift"]:
                usart["hold"] = value
                usart["sr"] &= ~0xC0
            else:
                self.usart_shift(usart, value)
        elif at == 8:
            usart["brr"] = value
        elif at == 0xC:
            usart["cr1"] = value
            self.usart_raise(usart)

    def usart_shift(self, usart, value):
        usart["shift"] = True
        usart["sr"] = usart["sr"] & ~0x40 | 0x80
        self.tx.append(value & 0xFF)
        clocks = 10 * usart["brr"] * CORE_HZ // usart["hz"]
        self.busy["link"] = self.busy.get("link", 0) + clocks
        self.at(clocks, self.usart_sent, usart)
        self.usart_raise(usart)

    def usart_sent(self, usart):
        usart["shift"] = False
        if usart["hold"] is None:
            usart["sr"] |= 0xC0
            self.usart_raise(usart)
        else:
            value, usart["hold"] = usart["hold"], None
            self.usart_shift(usart, value)

    def usart_raise(self, usart):
        if usart["sr"] & usart["cr1"] & 0xC0:
            self.pending.add(usart["irq"])
