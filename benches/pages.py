#!/usr/bin/env python3
"""Checks our answers against a model of its own, written from the pages.

    python3 -m venv build/venv && build/venv/bin/pip install ortools
    build/venv/bin/python3 benches/pages.py target/dist/sensedsl [NUMBER [FIRST [chibios|none|units|parts|parts_none]]]

The model knows what docs/language.md and docs/board-tables.md say, reads the tables that `sensedsl boards` and
`sensedsl parts --table` print, and the files of `silicon/` and `targets/`; it shares no code and no problem with the
program. Seeded designs with devices of every kind go to both: they must agree whether there is a wiring, and on the
unmet wishes, the shared pins and the cost of the best. `units` draws soft rules for units, for the pins alone; `parts`
and `parts_none` draw chips of `drivers/` and arrays with what ties them. Ends with status 1 on a disagreement.
"""

import csv
import io
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import tomllib

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PLACES = [
    ("NUCLEO_F072RB", 1), ("STM32F042K6T6", 0), ("BLUEPILL_F103C8", 1), ("STM32F103RBT6", 0), ("STM32F407VGT6", 0),
    ("NUCLEO_F401RE", 1), ("STM32G071RBT6", 0), ("STM32G031K8T6", 0), ("NUCLEO_G474RE", 1), ("STM32G431KBT6", 0),
    ("STM32H743VIT6", 0), ("STM32L432KCU6", 0), ("STM32L476RGT6", 0), ("RASPBERRYPI_PICO", 1), ("ARDUINO_UNO_R3", 1),
    ("ARDUINO_MEGA_2560", 1), ("ARDUINO_NANO", 1), ("RASPBERRYPI_PICO_2", 1),
]
# Boards whose pins have headers and positions, for arrays.
MORE_PLACES = [("NUCLEO_F446RE", 1), ("NUCLEO_L476RG", 1), ("NUCLEO_F091RC", 1), ("NUCLEO_F303RE", 1), ("NUCLEO_F429ZI", 1)]
DESCRIBING = {"pin", "position", "side", "header", "label", "voltage", "onboard", "note", "af"}
WIRES = {"i2c": ["SCL", "SDA"], "spi": ["SCK", "MISO", "MOSI"], "uart": ["TX", "RX"], "can": ["RX", "TX"]}
# What data sheets of other makers call what STM32 calls otherwise; an OC pin of AVR is an output alone.
PLAIN = [
    (r"PWM(\d+)_A", r"PWM\1_CH1"), (r"PWM(\d+)_B", r"PWM\1_CH2"), (r"(SPI[01])_RX", r"\1_MISO"), (r"(SPI[01])_TX", r"\1_MOSI"),
    (r"OC(\d)A", r"TC\1_OUT1"), (r"OC(\d)B", r"TC\1_OUT2"), (r"OC(\d)C", r"TC\1_OUT3"), (r"ICP(\d)", r"TC\1_IN1"),
]
BUSES = {"i2c": r"(I2C\d+|TWI\d*)_(SCL|SDA)", "spi": r"(SPI\d*)_(SCK|MISO|MOSI)", "uart": r"((?:USART|UART|LPUART)\d+)_(TX|RX)",
         "can": r"((?:FD)?CAN\d*)_(RX|TX)"}


def toml(path):
    with open(os.path.join(ROOT, path), "rb") as file:
        return tomllib.load(file)


SILICON = [toml(f"crates/board/silicon/{name}") for name in sorted(os.listdir(os.path.join(ROOT, "crates/board/silicon"))) if name.endswith(".toml")]
TARGETS = [toml(f"crates/board/targets/chibios-21.11/{name}") for name in sorted(os.listdir(os.path.join(ROOT, "crates/board/targets/chibios-21.11")))]


def begins(mcu, start):
    return len(mcu) >= len(start) and all(s in ("?", m) for s, m in zip(start.upper(), mcu.upper()))


class Profile:
    """What the drivers of a target can do on an MCU."""

    def __init__(self, data, line):
        self.data, self.line, self.units = data, line["name"], set(line["units"].split())

    @staticmethod
    def of(mcu):
        for data in TARGETS:
            for line in data["line"]:
                if any(begins(mcu, start) for start in line["parts"]):
                    return Profile(data, line)
        return None

    def unit(self, group, name):
        entry = self.data.get(group, {})
        name = "CAN1" if name == "CAN" else name
        for unit in entry.get("units", []):
            if unit["name"] == name and name in self.units and self.line in unit.get("lines", [self.line]):
                return {**entry.get("rules", {}), **unit}
        return None

    def requests(self, group, name):
        unit = self.unit(group, name) or {}
        listed = {m["name"]: m["streams"] for m in self.data.get("multiplexer", []) if self.line in m.get("lines", [self.line])}
        both = [("dma",), ("rx",), ("tx",)]
        # The unit's own key names its streams.
        name = "CAN1" if name == "CAN" else name
        own = next((u for u in self.data.get(group, {}).get("units", []) if u["name"] == name and self.line in u.get("lines", [self.line])), {})
        found = [own[key] for (key,) in both if key in own] if unit else []
        return [listed[one] if isinstance(one, str) else one for one in found]


class Board:
    """A table as printed, and what the silicon says of its pins."""

    def __init__(self, binary, place, built_in, target):
        call = ["boards", place.replace("_", "-")] if built_in else ["parts", "--table", place]
        text = subprocess.run([binary, *call], capture_output=True, text=True, check=True).stdout
        head = [line for line in text.splitlines() if line.startswith("#")]
        self.mcu = next(line.split("=")[1].strip() for line in head if line.startswith("# mcu"))
        rows = list(csv.DictReader(io.StringIO("\n".join(l for l in text.splitlines() if not l.startswith("#")))))
        self.profile = Profile.of(self.mcu) if target != "none" else None
        silicon = next((s for s in SILICON if any(begins(self.mcu, p) for p in s["parts"])), {})
        self.timers = silicon.get("timers", {})
        roles = {}
        for entry in silicon.get("pins", []):
            if any(begins(self.mcu, part) for part in entry["parts"]):
                roles.update({name: entry["role"] for name in entry["names"]})
        if self.profile:
            roles.update({name: "debug" for name in self.profile.data.get("debug", {}).get("pins", [])})
        analog = [name for entry in silicon.get("analog", []) if any(begins(self.mcu, part) for part in entry["parts"]) for name in entry["names"]]
        bare = "Onboard" not in rows[0]
        self.pins, withheld, places = {}, set(), {}
        for row in rows:
            name, onboard = row["Pin"], (row.get("Onboard") or "").strip()
            usages = [u for column, cell in row.items() if column.lower() not in DESCRIBING for u in (cell or "").split() if u != "-"]
            onboard = "" if onboard == "-" else onboard
            how = onboard.rsplit(":", 1)[1] if ":" in onboard else "taken" if onboard else ""
            role = roles.get(name)
            place = ((row.get("Header") or ""), (row.get("Position") or "").strip())
            place = place if place[1] not in ("", "-") else None
            if how == "taken" or role in ("debug", "reset", "boot"):
                withheld.add(name)
            shared = bool(onboard) or (bare and role == "oscillator")
            header, side = ((row.get(column) or "").strip() for column in ("Header", "Side"))
            where = {"header": header.upper().strip("-"), "side": side.upper().strip("-"), "position": place and place[1]}
            self.pins[name] = where | {"usages": usages, "cost": len(usages), "shared": shared, "bus": how == "bus", "analog": name in analog, "place": place}
            if place:
                places.setdefault(place, []).append(name)
        self.pads = {place: names for place, names in places.items() if len(names) > 1}
        for names in self.pads.values():
            if withheld & set(names):
                withheld |= set(names)
        for name in withheld:
            del self.pins[name]

    def signals(self):
        """Pin, signal and blocks of each usage that is offered."""
        for pin, facts in self.pins.items():
            for usage in facts["usages"]:
                name, _, blocks = usage.partition("#")
                name, _, _ = name.partition("@")
                blocks = blocks.partition("@")[0]
                # An MCU with one unit may leave its number out.
                name = re.sub(r"^(ADC|DAC)_(?=IN|OUT)", r"\g<1>1_", re.sub(r"^(ADC\d*)_INP", r"\1_IN", name.upper().replace("-", "_")))
                for spelled, plain in PLAIN:
                    name = re.sub(f"^{spelled}$", plain, name)
                yield pin, name, frozenset(map(int, blocks.split("|"))) if blocks else None


class Model:
    """One board and its parts as constraints: a part is a device, a chip of several connections, or an array."""

    def __init__(self, board, parts, rules):
        from ortools.sat.python import cp_model

        self.board, self.cp, self.sat = board, cp_model.CpModel(), cp_model
        # Pin and signal to {holder: its variables}; claims of other things to the same.
        self.held, self.units, self.blocks, self.broken, self.loose = {}, {}, {}, {}, []
        self.signal_list = list(board.signals())
        self.possible = True
        number = 0
        for index, part in enumerate(parts):
            own, made = [r for r in rules if r[0] in (None, index)], []
            for device in part["wires"]:
                # What it takes: its wires with their options, and the units that could serve it, each with its variables.
                self.taken, self.served, self.violating = {}, {}, {}
                self.device(number, device, own)
                made.append((list(self.taken.values()), self.served, self.violating))
                number += 1
            self.count_broken(index, part, own, made)
            for tie, soft in part["ties"]:
                self.tie(tie, soft, made)
        self.finish()

    def new(self):
        return self.cp.new_bool_var("")

    def hold(self, thing, holder, var):
        self.held.setdefault(thing, {}).setdefault(holder, []).append(var)

    def wire(self, number, role, options, unit_var, bus=None):
        """One of the options (pin, signal, blocks) if the unit is taken; returns their variables."""
        taken = []
        for pin, signal, blocks in options:
            var = self.new()
            taken.append((pin, signal, var))
            holder = (bus, role, signal) if bus else number
            self.hold(("pin", pin), holder, var)
            if signal:
                self.hold(("signal", signal), (bus, role, pin) if bus else number, var)
                if bus:
                    self.hold(("wire", bus, role), pin, var)
            pad = self.board.pins[pin]["place"]
            if pad in self.board.pads:
                self.hold(("pad", pad), pin, var)
            if blocks is not None:
                unit = signal.split("_")[0]
                self.blocks.setdefault(unit, []).append((blocks, var))
        self.cp.add(sum(v for *_, v in taken) == unit_var)
        self.taken.setdefault(role, []).extend(taken)
        return taken

    def fitting(self, pattern):
        return [(p, s, b, m) for p, s, b in self.signal_list for m in [re.fullmatch(pattern, s)] if m]

    def gpio(self):
        return [(pin, None, None) for pin, facts in self.board.pins.items() if not facts["bus"] and not facts["analog"]]

    def free(self, options):
        return [o for o in options if not self.board.pins[o[0]]["bus"]]

    def violate(self, rules, unit, var):
        """`unit` is the set of units that can serve; the wire violates by what all or none of them is."""
        units = unit if isinstance(unit, set) else {unit}
        for one in units:
            self.served.setdefault(one, []).append(var)
        for index, (_, kind, wanted) in enumerate(rules):
            hit = wanted not in units if kind == "prefer" else units == {wanted}
            if hit:
                self.violating.setdefault(index, []).append(var)

    def count_broken(self, number, part, rules, made):
        """Each rule counts once for a part; of a chip those connections count that could have the unit, if any could."""
        for index, (_, _, wanted) in enumerate(rules):
            could = [served for _, served, _ in made if wanted in served]
            for _, served, violating in made:
                if part["array"] or not could or wanted in served:
                    self.broken.setdefault((number, index), []).extend(violating.get(index, []))

    def tie(self, tie, soft, made):
        """All elements on one unit, header or side, or each behind the one before it along a header."""
        kept = self.new() if soft else self.cp.new_constant(1)
        if soft:
            self.loose.append(kept)
        what = {"sequence": "header"}.get(tie, tie)
        if what == "unit":
            chosen = {unit: self.new() for _, served, _ in made for unit in served}
            for _, served, _ in made:
                each = {}
                for unit, lits in served.items():
                    for lit in lits:
                        each.setdefault(lit.index, (lit, []))[1].append(chosen[unit])
                for lit, units in each.values():
                    self.cp.add(lit <= 1 - kept + sum(units))
        else:
            facts = self.board.pins
            chosen = {facts[pin][what]: self.new() for wires, _, _ in made for wire in wires for pin, *_ in wire}
            chosen.pop("", None)
            for wires, _, _ in made:
                for pin, _, var in (option for wire in wires for option in wire):
                    self.cp.add(var <= 1 - kept + chosen.get(facts[pin][what], 0))
        self.cp.add(sum(chosen.values()) <= 1)
        if tie == "sequence":
            facts = self.board.pins
            order = sorted({facts[p]["position"] for p in facts if facts[p]["position"]}, key=natural)
            for wires, _, _ in made:
                for pin, _, var in (option for wire in wires for option in wire):
                    if not facts[pin]["position"]:
                        self.cp.add(var <= 1 - kept)
            ranks = [[sum(order.index(facts[p]["position"]) * var for p, _, var in wire if facts[p]["position"]) for wire in wires] for wires, _, _ in made]
            for before, behind in zip(ranks, ranks[1:]):
                for one in before:
                    for other in behind:
                        self.cp.add(one + 1 <= other).only_enforce_if(kept)

    def device(self, number, device, rules):
        kind, profile = device["kind"], self.board.profile
        choices = []
        one = self.cp.new_constant(1)
        if kind in BUSES:
            by_unit = {}
            for pin, signal, blocks, match in self.fitting(BUSES[kind]):
                if kind == "uart" and self.board.pins[pin]["bus"]:
                    continue
                by_unit.setdefault(match[1], {}).setdefault(match[2], []).append((pin, signal, blocks))
            group = {"i2c": "i2cs", "spi": "spis", "uart": "serials", "can": "cans"}[kind]
            for unit, wires in by_unit.items():
                if profile and not profile.unit(group, unit):
                    continue
                if set(wires) != set(WIRES[kind]):
                    continue
                var = self.new()
                choices.append(var)
                bus = None if kind == "uart" else unit
                for role in WIRES[kind]:
                    self.wire(number, role, wires[role], var, bus)
                if kind == "spi":
                    self.wire(number, "CS", self.gpio(), var)
                if kind == "uart":
                    self.hold(("unit", unit), number, var)
                if kind == "i2c":
                    self.hold(("address", unit, device["address"]), number, var)
                self.use(group, unit, var)
                self.violate(rules, unit, var)
        elif kind in ("icu", "pwm", "encoder"):
            choices = self.timer(number, kind, device, rules)
        elif kind == "digital":
            taken = self.wire(number, "IO", self.gpio(), one)
            if device.get("edge") and profile and profile.data["exti"]["rule"] == "one port per number":
                for pin, _, var in taken:
                    self.hold(("exti", re.match(r"P[A-Z](\d+)", pin)[1]), number, var)
            choices = [one]
        elif kind == "analog":
            options = []
            for pin, signal, blocks, match in self.fitting(r"ADC(\d+)_IN(\d+)"):
                units = {f"ADC{digit}" for digit in match[1]}
                serving = {u for u in units if self.samples(u, int(match[2]))}
                if serving and not self.board.pins[pin]["bus"]:
                    options.append((pin, signal, blocks, units, serving))
            taken = self.wire(number, "IN", [o[:3] for o in options], one)
            for (_, _, var), (*_, units, serving) in zip(taken, options):
                self.violate(rules, units, var)
                if profile:
                    # It is the converter that elements have in common.
                    chosen = self.convert(var, serving)
                    for unit in units:
                        self.served[unit] = [lit for lit in self.served[unit] if lit.index != var.index] + [v for u, v in chosen if u == unit]
            choices = [one]
        else:
            options = []
            for pin, signal, blocks, match in self.fitting(r"(DAC\d+)_OUT(\d+)"):
                unit = profile.unit("dacs", match[1]) if profile else None
                if not profile or unit and int(match[2]) <= unit["outputs"]:
                    options.append((pin, signal, blocks))
            for (_, signal, var) in self.wire(number, "OUT", self.free(options), one):
                self.violate(rules, signal.split("_")[0], var)
            choices = [one]
        self.cp.add(sum(choices) == 1)

    def samples(self, unit, channel):
        profile = self.board.profile
        if not profile:
            return True
        unit = profile.unit("adcs", unit)
        return bool(unit) and unit["inputs"][0] <= channel <= unit["inputs"][1]

    def convert(self, var, serving):
        chosen = []
        for unit in sorted(serving):
            chosen.append((unit, self.new()))
            self.use("adcs", *chosen[-1])
        self.cp.add(sum(one for _, one in chosen) == var)
        return chosen

    def channels(self, kind, unit):
        """The channels that serve the kind, and whether the timer is there."""
        ability = self.board.timers.get({"icu": "capture", "encoder": "encoder"}.get(kind, ""), None)
        able = set(range(1, 9)) if kind == "pwm" else {1, 2}
        if ability is not None:
            able = set(ability["channels"]) if kind == "icu" else able & set(ability["channels"])
            able &= {1, 2}
        profile = self.board.profile
        if profile:
            timer = profile.unit("timers", unit)
            if not timer:
                return set()
            if kind == "encoder":
                return able if timer.get("encoder") else set()
            return able & set(timer.get(kind) or [])
        return able

    def timer(self, number, kind, device, rules):
        by_unit = {}
        for pin, signal, blocks, match in self.fitting(r"((?:TIM|PWM|TC)\d+)_(CH|IN|OUT)(\d+)"):
            if match[2] == {"pwm": "IN", "icu": "OUT", "encoder": "OUT"}[kind]:
                continue
            if int(match[3]) in self.channels(kind, match[1]) and not self.board.pins[pin]["bus"]:
                by_unit.setdefault(match[1], {}).setdefault(int(match[3]), []).append((pin, signal, blocks))
        choices = []
        for unit, wires in by_unit.items():
            if kind == "encoder" and set(wires) != {1, 2}:
                continue
            var = self.new()
            choices.append(var)
            if kind == "encoder":
                self.wire(number, "A", wires[1], var)
                self.wire(number, "B", wires[2], var)
            else:
                self.wire(number, "IO", [o for options in wires.values() for o in options], var)
            if self.board.profile:
                holder = ("frequency", device["frequency"]) if kind == "pwm" else number
                self.hold(("unit", unit), holder, var)
            self.violate(rules, unit, var)
        return choices

    def use(self, group, unit, var):
        if self.board.profile:
            self.units.setdefault((group, unit), []).append(var)

    def any_of(self, lits):
        used = self.new()
        for lit in lits:
            self.cp.add(lit <= used)
        return used

    def finish(self):
        pins = {}
        for thing, holders in self.held.items():
            used = [self.any_of(lits) if len(lits) > 1 else lits[0] for lits in holders.values()]
            # The wires of one device differ: on a pin each stands for itself.
            if thing[0] in ("pin", "signal"):
                for holder, lits in holders.items():
                    if isinstance(holder, int) and len(lits) > 1:
                        self.cp.add(sum(lits) <= 1)
            self.cp.add(sum(used) <= 1)
            if thing[0] == "pin":
                pins[thing[1]] = sum(used)
        for wanted in self.blocks.values():
            chosen = {b: self.new() for blocks, _ in wanted for b in blocks}
            self.cp.add(sum(chosen.values()) == 1)
            for blocks, var in wanted:
                self.cp.add(var <= sum(chosen[b] for b in blocks))
        streams = {}
        for (group, unit), lits in self.units.items():
            used = self.any_of(lits)
            for request in self.board.profile.requests(group, unit):
                served = []
                for stream in request:
                    served.append(self.new())
                    streams.setdefault(stream, []).append(served[-1])
                self.cp.add(sum(served) == used)
        for lits in streams.values():
            self.cp.add(sum(lits) <= 1)
        facts = self.board.pins
        shared = 1 + sum(f["cost"] for f in facts.values())
        rule = shared * (1 + len(facts))
        self.factors = (rule, shared)
        weight = sum(u * (facts[p]["cost"] + shared * facts[p]["shared"]) for p, u in pins.items())
        broken = sum(self.any_of(lits) for lits in self.broken.values()) + sum(1 - kept for kept in self.loose)
        self.cp.minimize(weight + rule * broken)

    def solve(self):
        solver = self.sat.CpSolver()
        solver.parameters.num_workers = 1
        solver.parameters.max_time_in_seconds = 30
        status = solver.solve(self.cp)
        if status == self.sat.INFEASIBLE:
            return None
        if status != self.sat.OPTIMAL:
            return "stopped"
        rule, shared = self.factors
        value = round(solver.objective_value)
        return [value // rule, value % rule // shared, value % shared]


KINDS = {
    "analog": ("sensor", "uint16", ""), "i2c": ("sensor", "uint16", "address = {address};"), "icu": ("sensor", "uint16", ""),
    "encoder": ("sensor", "int16", ""), "digital": ("sensor", "bool", ""), "uart": ("sensor", "uint16", ""),
    "spi": ("sensor", "uint16", ""), "pwm": ("actuator", "uint16", "frequency = {frequency};"), "dac": ("actuator", "uint16", ""),
    "can": ("sensor", "uint16", "frame = {frame};"),
}


def natural(text):
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", text)]


def library():
    """The chips of `drivers/` that are drawn: their connections, and for each value which of them it uses."""
    text = "\n".join(re.sub(r"//.*", "", open(os.path.join(ROOT, "drivers", name), encoding="utf-8").read())
                     for name in sorted(os.listdir(os.path.join(ROOT, "crates/model/drivers"))) if name.endswith(".sense"))
    found = {}
    for name in CHIPS:
        kind, body = re.search(rf"^driver {name}(?: for (\w+))? {{\n(.*?)^}}", text, re.M | re.S).groups()
        hertz = lambda block: int(match[1]) * 1000 if (match := re.search(r"frequency = (\d+) kHz", block)) else 0
        connections = {n: (k, hertz(block)) for n, k, block in re.findall(r"connection (\w+) for (\w+) {(.*?)}", body, re.S)}
        values = []
        for direction, value, type_, block in re.findall(r"(reading|command) (\w+) \w+ ([\w\[\]]+) {(.*?)}", body, re.S):
            via = re.search(r"via = \[?([\w, ]+)\]?;", block)
            values.append((direction, value, type_, via[1].split(", ") if via else [None]))
        found[name] = (connections or {None: (kind, 0)}, values)
    return found


CHIPS = ["mpu6050", "bme280", "mcp3008", "nmea_gps", "tb6612", "gearmotor_tb6612", "drv8833", "l298n"]
ARRAYS = {"analog": ("sensor", "uint16"), "digital": ("actuator", "bool"), "edges": ("sensor", "bool"), "pwm": ("actuator", "uint16"),
          "icu": ("sensor", "uint32"), "encoder": ("sensor", "int32"), "dac": ("actuator", "uint16")}


def chip(rng, number, first, library):
    """Text, part and how many identifiers it takes."""
    name = rng.choice(CHIPS)
    connections, values = library[name]
    whole = rng.random() < 0.5
    wanted = values if whole else rng.sample(values, rng.randint(1, min(2, len(values))))
    inner, own = "", ""
    if not whole:
        for at, (direction, value, type_, _) in enumerate(wanted):
            head = f"sensor Of{number}_{at} returns" if direction == "reading" else f"actuator Of{number}_{at} accepts"
            inner += f" {head} {type_} {{ id = {first + at}; reading = {value}; }}"
    device = {"address": rng.choice([0x68, 0x69]), "edge": False, "frame": 0}
    if [kind for kind, _ in connections.values()] == ["i2c"]:
        own = f" address = {device['address']};"
    # A connection that no value uses is wired whatever is wanted.
    used = {via for *_, vias in values for via in vias}
    now = {via for *_, vias in wanted for via in vias}
    wires = [device | {"kind": k, "frequency": hertz} for n, (k, hertz) in connections.items() if n in now or n not in used]
    id_ = f" id = {first};" if whole else ""
    return f"    chip Chip{number} {{ driver = {name};{id_}{own} RULES{inner} }}\n", wires, len(wanted)


def array(rng, number, first):
    """Text with ties, wires and ties."""
    kind = rng.choice(list(ARRAYS))
    direction, value = ARRAYS[kind]
    length = rng.randint(1, {"encoder": 2, "icu": 3, "dac": 2}.get(kind, 6))
    edge, kind = kind == "edges", "digital" if kind == "edges" else kind
    hertz = rng.choice([50, 1000])
    more = " edge = both;" if edge else f" frequency = {hertz} Hz;" if kind == "pwm" else ""
    ties = []
    for tie in rng.sample(["unit", "header", "side", "sequence"], rng.choice([0, 1, 1, 2])):
        if tie == "unit" and kind == "digital":
            continue
        soft = rng.random() < 0.6
        if not soft and tie != "sequence" and any(not s and t != "sequence" for t, s in ties):
            continue
        ties.append((tie, soft))
        more += (" prefer" if soft else "") + (" sequence = header;" if tie == "sequence" else f" together = {tie};")
    takes = "returns" if direction == "sensor" else "accepts"
    wires = [{"kind": kind, "edge": edge, "frequency": hertz, "address": 0, "frame": 0} for _ in range(length)]
    return f"    {direction} Array{number} {takes} {value}[{length}] {{ id = {first}; type = {kind};{more} RULES }}\n", wires, ties


def parts_design(rng, place, board, with_rules):
    """Chips and arrays beside plain devices."""
    text, parts, rules = f"board Bench on {place} {{\n    link {{ transport = none; }}\n", [], []
    names, known, first = units_of(board), library(), 1
    for number in range(rng.randint(1, 5 if len(board.pins) > 30 else 3)):
        draw, ties, is_array = rng.random(), [], False
        if draw < 0.4:
            one, wires, ids = chip(rng, number, first, known)
        elif draw < 0.85:
            (one, wires, ties), ids, is_array = array(rng, number, first), 1, True
        else:
            kind = rng.choice(["icu", "digital", "analog", "spi", "uart"])
            wires, ids = [{"kind": kind, "edge": False, "address": 0, "frequency": 0, "frame": 0}], 1
            one = f"    sensor Dev{number} returns {KINDS[kind][1]} {{ id = {first}; type = {kind}; RULES }}\n"
        own = ""
        if with_rules and names and rng.random() < 0.5:
            rules.append((number, rng.choice(["prefer", "avoid"]), rng.choice(names)))
            own = f"{rules[-1][1]} unit = {rules[-1][2]};"
        text += one.replace("RULES", own)
        parts.append({"wires": wires, "ties": ties, "array": is_array})
        first += ids
    return text + "}\n", parts, rules


def units_of(board):
    """The units that the board's pins name."""
    names = set()
    for _, signal, _ in board.signals():
        if match := re.fullmatch(r"ADC(\d+)_IN\d+", signal):
            names |= {f"ADC{digit}" for digit in match[1]}
        elif match := re.fullmatch(r"((?:I2C|SPI|USART|UART|LPUART|FDCAN|CAN|TIM|DAC|PWM|TC)\d+|TWI|SPI)_(?:SCL|SDA|SCK|MISO|MOSI|TX|RX|CH\d|IN\d|OUT\d)", signal):
            names.add(match[1])
    return sorted(names)


def design(rng, place, board, units):
    """Text, devices and rules (device or none for the board, kind, unit)."""
    served = [k for k in KINDS if rng.random() < 0.75]
    devices, rules, text = [], [], f"board Bench on {place} {{\n    link {{ transport = none; }}\n"
    names = units_of(board)
    if units and names and rng.random() < 0.5:
        rules.append((None, rng.choice(["prefer", "avoid"]), rng.choice(names)))
        text += f"    {rules[-1][1]} unit = {rules[-1][2]};\n"
    for number in range(rng.randint(1, 12 if len(board.pins) > 30 else 7)):
        kind = rng.choice(served or ["digital"])
        device = {"kind": kind, "address": 0x20 + number % rng.choice([2, 16]), "frequency": rng.choice([50, 1000]),
                  "frame": 16 + number, "edge": kind == "digital" and rng.random() < 0.4}
        direction, value, more = KINDS[kind]
        if kind == "digital" and not device["edge"] and rng.random() < 0.5:
            direction = "actuator"
        more = more.format(**device) + (" edge = rising;" if device["edge"] else "")
        if units and names and rng.random() < 0.7:
            rules.append((number, rng.choice(["prefer", "avoid"]), rng.choice(names)))
            more += f" {rules[-1][1]} unit = {rules[-1][2]};"
        takes = "returns" if direction == "sensor" else "accepts"
        text += f"    {direction} Dev{number} {takes} {value} {{ id = {number + 1}; type = {kind}; {more} }}\n"
        devices.append({"wires": [device], "ties": [], "array": False})
    return text + "}\n", devices, rules


def ours(binary, text, target, folder):
    path = os.path.join(folder, "bench.sense")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    call = [binary, "solve", path, "--format", "json", "--timeout", "20", *(["--target", "none"] if target == "none" else [])]
    done = subprocess.run(call, capture_output=True, text=True, check=False)
    errors = re.findall(r"error\[(E\d+)\]", done.stderr)
    if done.returncode == 0:
        answer = json.loads(done.stdout)
        if answer["status"] != "optimal":
            return "stopped", errors
        return [answer["violated"], answer["shared"], answer["cost"]], errors
    return "stopped" if "E0404" in errors else None, errors


def main():
    binary = os.path.abspath(sys.argv[1])
    number, first = (int(sys.argv[i]) if len(sys.argv) > i else d for i, d in ((2, 300), (3, 0)))
    what = sys.argv[4] if len(sys.argv) > 4 else "chibios"
    target = "none" if what in ("units", "parts_none") else "chibios" if what == "parts" else what
    places = PLACES + MORE_PLACES if what.startswith("parts") else PLACES
    boards, wrong, none, stopped, families = {}, [], 0, 0, set()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + number):
            rng = random.Random(seed)
            place, built_in = places[seed % len(places)]
            if place not in boards:
                boards[place] = Board(binary, place, built_in, target)
            board = boards[place]
            families.add(board.mcu[:9])
            if what.startswith("parts"):
                text, devices, rules = parts_design(rng, place, board, what == "parts_none")
            else:
                text, devices, rules = design(rng, place, board, what == "units")
            answer, errors = ours(binary, text, target, folder)
            theirs = Model(board, devices, rules).solve()
            none += theirs is None
            stopped += "stopped" in (answer, theirs)
            if "stopped" not in (answer, theirs) and answer != theirs:
                wrong.append(f"{seed} {place}: we {answer} {errors}, the pages {theirs}\n{text}")
    print(f"{number} designs ({what}) on {len(families)} MCUs, {none} without a wiring, {stopped} stopped, {len(wrong)} disagreements")
    for mistake in wrong:
        print(f"- {mistake}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
