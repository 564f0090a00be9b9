#!/usr/bin/env python3
"""Reads the drivers of the library and the vectors beside this file, and holds the ones to the others.

In: `drivers/*.sense` and `*.txt` here. Out: what disagrees, one line each; nothing and status 0 when all is well.
Figures that `language.py` and the tool get wrong in the same way are not found, everything else is.
"""

import pathlib
import re
import struct
import sys

sys.dont_write_bytecode = True
from language import (  # noqa: E402
    NOTHING, SIZES, Parser, answered, asked, bosch, bytes_of, decode, field, get, hx711, judged, messages, ntc, number, sensirion, told, tsl2561)

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]


# A case of a vector file.

class Case:
    """What stands between two `case` lines: what the part gives, and what is to come of it."""

    def __init__(self, driver, name, lines):
        self.driver, self.name = driver, name
        self.image, self.after, self.plain, self.exchanges = {}, {}, None, {}
        self.frames, self.asked = {}, {}
        self.stream, self.input, self.wrong, self.type = None, None, None, None
        self.expects, self.shown, self.commands, self.seen = [], [], [], set()
        self.kept = {}
        for line in lines:
            self.line(line)

    def line(self, line):
        head, _, rest = line.partition(":")
        words = head.split()
        if words[0] == "type":
            self.type = words[1]
        elif words[0] == "register":
            self.fill(self.image, words[1], rest)
        elif words[:2] == ["wrong", "identity"]:
            self.wrong = (int(words[2], 16), bytes.fromhex(rest))
        elif words[0] == "after":
            trigger = bytes.fromhex("".join(words[1:]).partition("register")[0])
            image, plain = self.after.setdefault(trigger, ({}, None))
            if "register" in words:
                self.fill(image, words[-1], rest)
            else:
                self.after[trigger] = (image, bytes.fromhex(rest))
        elif words[0] == "read":
            self.plain = bytes.fromhex(rest)
        elif words[0] == "exchange":
            self.exchanges[bytes.fromhex("".join(words[1:]))] = bytes.fromhex(rest)
        elif words[0] == "asked":
            self.asked[bytes.fromhex("".join(words[1:]))] = bytes.fromhex(rest)
        elif words[0] == "asked_text":
            texts = [one.encode().decode("unicode_escape").encode("latin-1") for one in re.findall(r'"((?:[^"\\]|\\.)*)"', line)]
            self.asked[texts[0]] = texts[1]
        elif words[0] == "bytes":
            self.stream = (self.stream or b"") + bytes.fromhex("".join(words[1:]))
        elif words[0] == "frame" and not self.commands:
            self.frames[words[1]] = bytes.fromhex(rest)
        elif words[0] == "text":
            text = line.partition('"')[2].rpartition('"')[0]
            self.stream = (self.stream or b"") + text.encode().decode("unicode_escape").encode("latin-1")
        elif words[0] in ("analog", "level", "counts", "pulse", "frequency", "edges"):
            values = [int(word) for word in words if re.fullmatch(r"-?\d+", word)]
            self.input = (words[0], values)
        elif words[0] == "expect":
            if "=" in line:
                name, _, values = line[6:].partition("=")
                values, _, slack = values.partition("+-")
                self.expects.append((name.strip(), [int(v) for v in values.split()], int(slack or 0)))
            else:
                self.expects.append((words[1], rest.strip() or words[-1], 0))
        elif words[0] == "shown":
            name, _, values = line[5:].partition("=")
            self.shown.append((name.strip(), values.split()))
        elif words[0] == "command":
            name, _, values = line[7:].partition("=")
            self.commands.append([name.strip(), [int(v) for v in values.split()], []])
        elif words[0] in ("written", "width", "frame", "goes") or len(words) > 2 and words[1] == "=":
            self.commands[-1][2].append(line)
        else:
            raise SyntaxError(line)

    @staticmethod
    def fill(image, register, rest):
        image["alone", int(register, 16)] = bytes.fromhex(rest)
        for place, byte in enumerate(bytes.fromhex(rest)):
            image[int(register, 16) + place] = byte

    def registers(self, image, first, count):
        return bytes(image[first + place] for place in range(count))

    def identity(self):
        """Whether the part is the one that it should be. A case that is silent on it has the right one."""
        wanted = self.driver["properties"].get("identity")
        if not wanted:
            return True
        first, wanted = wanted[0], wanted[1:]
        mask = self.driver["properties"].get("identity_mask", [0xFF] * len(wanted))
        is_alone = self.driver["properties"].get("burst") == "false"
        own = enumerate(self.image.get(("alone", first), b""))
        given = {first + i: byte for i, byte in own} if is_alone else self.image
        image = {**{first + i: byte for i, byte in enumerate(wanted)}, **given}
        if self.wrong:
            image.update({self.wrong[0] + i: byte for i, byte in enumerate(self.wrong[1])})
        found = self.registers(image, first, len(wanted))
        return all((a ^ b) & m == 0 for a, b, m in zip(found, wanted, mask))

    def raw(self, part):
        """The bytes of a reading from a bus."""
        driver = self.driver
        exchange = get(part, driver, "exchange")
        if exchange:
            return self.exchanges[bytes_of(exchange)]
        image, plain = self.image, self.plain
        trigger = get(part, driver, "trigger")
        if trigger and bytes_of(trigger) in self.after:
            more, plain = self.after[bytes_of(trigger)]
            image = {**image, **more}
        elif self.after and trigger:
            raise KeyError(f"after {bytes_of(trigger).hex(' ')}")
        length = get(part, driver, "length", part["count"] * SIZES.get(part["type"], 1))
        register = get(part, driver, "register")
        first = get(part, driver, "byte", 0)
        if register is not None and get(part, driver, "burst") == "false":
            return image["alone", register][first:first + length]
        if register is not None:
            return self.registers(image, register + first, length)
        if get(part, driver, "crc"):
            whole = b""
            for at in range(0, len(plain), 3):
                if sensirion(plain[at:at + 2]) != plain[at + 2] and first <= len(whole) < first + length:
                    return None
                whole += plain[at:at + 2]
            plain = whole
        return plain[first:first + length]

    def value(self, part):
        """A reading: its elements, `invalid`, `wrong identity` or `nothing`."""
        driver = self.driver
        if not self.identity():
            return "wrong identity"
        if "request" in part["properties"]:
            return self.answer(part)
        if self.stream is not None:
            value = "nothing"
            for body in messages(driver, self.stream):
                if body is None:
                    value = "invalid" if value == "nothing" else value
                elif "field" in part["properties"]:
                    found = field(part, driver, body)
                    value = value if found is NOTHING else found
                else:
                    first = part["properties"].get("byte", 0)
                    default = part["count"] * SIZES[part["type"]]
                    value = decode(part, driver, body[first:first + part["properties"].get("length", default)])
            return value if isinstance(value, str) else judged(part, driver, value)
        if self.frames:
            return self.received(part)
        if self.input:
            return judged(part, driver, self.captured(part))
        formula = driver["properties"].get("compensate")
        raw = self.raw(part)
        if raw is None:
            return "invalid"
        if formula in ("bmp280", "bme280"):
            image = b"".join(self.registers(self.image, *one) for one in driver["properties"]["calibration"])
            return self.output(part, bosch(image, raw, formula == "bme280"))
        if formula == "tsl2561":
            return self.output(part, tsl2561(raw))
        if formula == "hx711":
            value = self.output(part, hx711(raw))
            return value if value == "invalid" else judged(part, driver, value)
        return judged(part, driver, decode(part, driver, raw))

    def answer(self, part):
        """A reading that is asked for: silence is a fault, as is an answer that is damaged."""
        request = asked(part, self.driver)[0]
        if request not in self.asked:
            return "nothing"
        body = answered(part, self.driver, self.asked[request])
        if body is NOTHING:
            return "wrong identity"
        if body is None:
            return "invalid"
        if str(get(part, self.driver, "format")) == "decimal":
            value = number(body.decode("latin-1"), get(part, self.driver, "decimals", 0))
            return "invalid" if value is None else [value]
        first = part["properties"].get("byte", 0)
        length = part["properties"].get("length", part["count"] * SIZES[part["type"]])
        return judged(part, self.driver, decode(part, self.driver, body[first:first + length]))

    @staticmethod
    def output(part, values):
        name = part["properties"].get("output", part["name"])
        return [values[name]] if name in values else "invalid"

    # Frames of CAN.

    def frame_name(self, part):
        number, long = get(part, self.driver, "frame"), get(part, self.driver, "extended")
        return f"{number:08X}" if number > 0x7FF or long == "true" else f"{number:03X}"

    def place(self, part):
        """Where a value begins in its frame, and its bytes there."""
        return get(part, self.driver, "byte", 0), part["count"] * SIZES[part["type"]]

    def received(self, part):
        first, length = self.place(part)
        data = self.frames.get(self.frame_name(part), b"")[first:first + length]
        return judged(part, self.driver, decode(part, self.driver, data)) if len(data) == length else "nothing"

    def sent(self, part, values):
        own = [one for one in self.driver["parts"].values()
               if one["what"] == "command" and self.frame_name(one) == self.frame_name(part)]
        length = get(part, self.driver, "length", max(sum(self.place(one)) for one in own))
        first, width = self.place(part)
        order = "little" if get(part, self.driver, "order") == "little" else "big"
        width //= part["count"]
        if part["type"] == "float32":
            values = [int.from_bytes(struct.pack(">f", value), "big") for value in values]
        data = b"".join((value & (1 << 8 * width) - 1).to_bytes(width, order) for value in values)
        return [f"frame {self.frame_name(part)}: {data.rjust(first + len(data), bytes(1)).ljust(length, bytes(1)).hex(' ').upper()}"]

    def wires(self, part):
        """Kind and properties of what the value goes over."""
        over = self.driver["parts"].get(part["properties"].get("via"))
        return (over["type"], over["properties"]) if over else (self.driver["kind"], self.driver["properties"])

    def captured(self, part):
        what, values = self.input
        give = self.wires(part)[1].get
        if what == "analog" and give("compensate") == "ntc":
            out = ntc(give("parameters"), values[0])
            return [out["temperature"]] if out else [10**9]
        if what == "pulse":
            tick = give("resolution", 1e-6)
            tick = 1 / tick if getattr(tick, "unit", "s").endswith("Hz") else tick
            return [round(values[0] * 1e-6 / tick)]
        if what == "level":
            return [values[0] ^ (give("active") == "low")]
        if what == "edges":
            starts = [i for i, value in enumerate(values) if value > 2700]
            channels = values[starts[0] + 1:starts[1]]
            return channels[:part["count"]] if len(channels) >= part["count"] else [10**9]
        return values

    # What a host shows, and what a command does.

    def visible(self, part, value):
        give = lambda name, default: get(part, self.driver, name, default)
        scale = give("scale", 1)
        upper, lower = give("divider", [0, 1])
        shown = value * scale * (upper + lower) / lower + give("offset", 0)
        curve = give("curve", None)
        if not curve:
            return shown
        if not curve[0][0] < shown < curve[-1][0]:
            return curve[0][1] if shown <= curve[0][0] else curve[-1][1]
        for (x0, y0), (x1, y1) in zip(curve, curve[1:]):
            if shown <= x1:
                return y0 + (y1 - y0) * (shown - x0) / (x1 - x0)

    def effects(self, part, values):
        """What a command makes of its connections: lines as they stand in the file."""
        driver = self.driver
        via = part["properties"].get("via")
        if isinstance(via, list) and part["properties"].get("drive") == "direction_pins":
            value = values[0]
            return [f"{via[0]} = {abs(value)}", f"{via[1]} = {int(value > 0)}", f"{via[2]} = {int(value < 0)}"]
        if isinstance(via, list) and part["properties"].get("drive") == "direction_pin":
            return [f"{via[0]} = {abs(values[0])}", f"{via[1]} = {int(values[0] < 0)}"]
        if isinstance(via, list):
            return [f"{via[0]} = {max(values[0], 0)}", f"{via[1]} = {max(-values[0], 0)}"]
        kind, properties = self.wires(part)
        if kind == "can":
            return self.sent(part, values)
        if kind == "pwm":
            give = properties.get
            low, high = give("min", 0), give("max", 1 / give("frequency"))
            return [f"width us {round((low + (high - low) * values[0] / 10000) * 1e6)}"]
        if driver["kind"] == "stepper":
            return [f"goes {values[0]}"]
        if kind == "digital":
            return [f"pin = {values[0] ^ (properties.get('active') == 'low')}"]
        if driver["kind"] == "uart" and str(get(part, driver, "format")) == "decimal":
            return [f"written {told(part, driver, str(values[0]).encode()).hex(' ').upper()}"]
        if get(part, driver, "encoding"):
            return [f"written {self.shown_bytes(part, values).hex(' ').upper()}"]
        length = get(part, driver, "length", part["count"] * SIZES[part["type"]])
        width = length // part["count"]
        high, low = get(part, driver, "bits", (8 * width - 1, 0))
        order = "little" if get(part, driver, "order") == "little" else "big"
        data = b"".join(((v & (1 << high - low + 1) - 1) << low).to_bytes(width, order) for v in values)
        if driver["kind"] == "uart":
            return [f"written {told(part, driver, data).hex(' ').upper()}"]
        register = get(part, driver, "register")
        size = driver["properties"].get("register_size", 1)
        head = b"" if register is None else register.to_bytes(size, "big")
        if part["count"] == 1 and len(data) <= 8:
            data = self.joined(head, data, int.from_bytes(data, order), (1 << high + 1) - (1 << low), order)
        return [f"written {(head + data).hex(' ').upper()}"]

    def shown_bytes(self, part, values):
        """The bytes of a strip of LEDs, or of a line of text."""
        encoding = str(get(part, self.driver, "encoding"))
        if encoding == "text":
            return bytes_of(get(part, self.driver, "start")) + b"".join(letter(value) for value in values)
        order = str(get(part, self.driver, "colours") or ("bgr" if encoding == "apa102" else "grb"))
        colours = [[(value >> 8 * "bgrw".index(one)) & 0xFF for one in order] for value in values]
        if encoding == "apa102":
            leds = [bytes([0xE0 | ((value >> 24) & 31 or 31), *own]) for value, own in zip(values, colours)]
            return bytes(4) + b"".join(leds) + bytes(4 + -(-len(values) // 16))
        # Of a WS2812B a bit is 1.2 us of 2.5 MHz, of an SK6812 1.2 us of 3.33 MHz.
        pulse = {"ws2812": ("100", "110"), "sk6812": ("1000", "1100")}[encoding]
        bits = "".join(f"{byte:08b}" for own in colours for byte in own)
        sent = "".join(pulse[int(bit)] for bit in bits)
        return bytes(1) + int(sent, 2).to_bytes(len(sent) // 8, "big") + bytes(40 * len(pulse[0]))

    def joined(self, head, data, value, own, order):
        """The value among the bits of its register that others have, as they were written last."""
        steps = [bytes(one) for one in self.driver["properties"].get("init", []) if isinstance(one, list)]
        before = [one[len(head):] for one in steps if one[:len(head)] == head and len(one) == len(head + data)]
        start = self.kept.get((head, len(data)), int.from_bytes((before or [bytes(len(data))])[-1], order))
        self.kept[head, len(data)] = start & ~own | value
        return self.kept[head, len(data)].to_bytes(len(data), order)

    def part(self, name):
        if name != "value":
            return self.driver["parts"][name]
        kind, _, count = (self.type or "uint16").partition("[")
        return {"name": name, "type": kind, "count": int(count[:-1] or 1) if count else 1, "properties": {}}

    def run(self):
        told = []
        for name, wanted, slack in self.expects:
            if name == "identity":
                if self.identity():
                    told.append("the identity is right")
                continue
            value = self.value(self.part(name))
            if isinstance(value, list) and value == [10**9]:
                value = "invalid"
            self.seen.add(name)
            same = value == wanted if isinstance(wanted, str) or isinstance(value, str) else (
                len(value) == len(wanted) and all(abs(a - b) <= slack for a, b in zip(value, wanted)))
            if not same:
                told.append(f"{name}: {value}, not {wanted}")
        for name, wanted in self.shown:
            part = self.part(name)
            values = self.value(part)
            if isinstance(values, str):
                told.append(f"{name} is shown, and is {values}")
                continue
            for text, raw in zip(wanted, values, strict=True):
                shown, slack = self.visible(part, raw), 0.5000001 * 10 ** -len(text.partition(".")[2])
                if abs(shown - float(text)) > slack:
                    told.append(f"{name} is shown as {shown}, not {text}")
        for name, values, lines in self.commands:
            self.seen.add(name)
            effects = self.effects(self.part(name), values)
            if effects != lines:
                told.append(f"{name} = {values}: {effects}, not {lines}")
        return told


DRAWING = (ROOT / "crates/twin/src/parts/letters.txt").read_text().split("\n\n")


def letter(code):
    """Six columns of a letter as it is drawn, the dot at the top in the lowest bit."""
    for block in DRAWING:
        codes, *rows = block.split("\n")
        if f"{code:02X}" in codes.split():
            left = 6 * codes.split().index(f"{code:02X}")
            columns = ["".join(row[left + x] for row in reversed(rows[:7])) for x in range(5)]
            return bytes(int(dots.replace("#", "1").replace(".", "0"), 2) for dots in columns) + bytes(1)
    return bytes(6)


def read(path, driver):
    lines, name = [], path.stem
    for line in path.read_text().splitlines():
        line = line.split("#")[0].strip() if '"' not in line else line.strip()
        if line.startswith("case"):
            if lines:
                yield Case(driver, name, lines)
            lines, name = [], line[5:]
        elif line:
            lines.append(line)
    if lines:
        yield Case(driver, name, lines)


def uncovered(driver, cases):
    """What the vectors of a driver leave out."""
    seen = set().union(*(case.seen for case in cases))
    parts = {name for name, part in driver["parts"].items() if part["what"] != "connection"} or {"value"}
    for name in sorted(parts - seen):
        yield f"nothing is expected of {name}"
    if "identity" in driver["properties"] and not any(case.wrong for case in cases):
        yield "no wrong identity"
    rules = [part["name"] for part in driver["parts"].values() if "invalid" in part["properties"]]
    rules += ["value"] * ("invalid" in driver["properties"])
    for name in rules:
        if not any(one == name and wanted == "invalid" for case in cases for one, wanted, _ in case.expects):
            yield f"{name} is never invalid"


def main():
    drivers = {}
    for path in sorted((ROOT / "crates/model/drivers").glob("*.sense")):
        for driver in Parser(path.read_text(), path.name).drivers():
            if driver["name"] in drivers:
                print(f"{path.name}: {driver['name']} twice")
            drivers[driver["name"]] = driver
    told = count = 0
    for path in sorted(HERE.glob("*.txt")):
        if path.stem not in drivers:
            print(f"{path.name}: no such driver")
            told += 1
    for name, driver in drivers.items():
        path = HERE / f"{name}.txt"
        if not path.exists():
            print(f"{name}: no vectors")
            told += 1
            continue
        cases = list(read(path, driver))
        for case in cases:
            count += len(case.expects) + len(case.shown) + len(case.commands)
            for line in case.run():
                print(f"{name}: {case.name}: {line}")
                told += 1
        for line in uncovered(driver, cases):
            print(f"{name}: {line}")
            told += 1
    readings = sum(part["what"] != "connection" for one in drivers.values() for part in one["parts"].values())
    print(f"{len(drivers)} drivers, {readings} readings and commands, {count} statements, {told} wrong")
    return told > 0


if __name__ == "__main__":
    sys.exit(main())
