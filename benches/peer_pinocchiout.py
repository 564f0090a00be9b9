#!/usr/bin/env python3
"""Compares with pinocchiout, the one free pin solver for STM32 that can be called from a program.

    python3.13 -m venv build/venv313 && build/venv313/bin/pip install pinocchiout==0.3.0
    cargo build --profile dist && build/venv313/bin/python3 benches/peer_pinocchiout.py target/dist/sensedsl

Seeded requests for the free pins of one board, the pins alone for both (`--target none`).
pinocchiout gives any wiring; only its search is timed, its model is made beforehand from our table.
Ours is the time of the whole process, from its start to the proved best wiring as JSON. The cost of
both is the number of usages of the pins taken.
"""

import csv
import io
import json
import multiprocessing
import random
import re
import statistics
import subprocess
import sys
import time

from pinocchiout.data import Stm32Model
from pinocchiout.solver import PinSolver

BOARD = "STM32F407G_DISC1"
# For each kind: what pinocchiout is asked for, and the kind with its properties in our language.
KINDS = {
    "analog": (("adc", ["IN.*"], False), "analog"),
    "i2c": (("i2c", ["SCL", "SDA"], True), "i2c; address = 0x20; register = 1; length = 2; exclusive = true"),
    "icu": (("tim", ["CH[12]"], True), "icu"),
    "uart": (("usart", ["TX", "RX"], True), "uart"),
    "spi": (("spi", ["SCK", "MISO", "MOSI"], True), None),
}
MOST = {"i2c": 2, "uart": 3, "spi": 1, "icu": 6, "analog": 6}


def table(binary):
    """For each pin its usages as (peripheral, signal), and those of them that are free."""
    text = subprocess.run([binary, "boards", BOARD], check=True, capture_output=True, text=True).stdout
    rows = csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#"))
    pins, free = {}, {}
    for row in rows:
        onboard = row.pop("Onboard") or ""
        cells = [cell for head, cell in row.items() if head != "Pin" and cell not in ("", "-")]
        usages = [usage.split("@")[0] for cell in cells for usage in cell.split()]
        pins[row["Pin"]] = [usage.split("_", 1) for usage in usages]
        signals = [usage for usage in pins[row["Pin"]] if len(usage) == 2]
        if onboard.endswith(":bus"):
            free[row["Pin"]] = [usage for usage in signals if usage[0].startswith("I2C")]
        elif not onboard or onboard.endswith(":care"):
            free[row["Pin"]] = signals
    return pins, free


def model(pins):
    """The same as pinocchiout's data."""
    peripherals = {}
    for pin, usages in pins.items():
        for unit, signal in usages:
            kind = re.sub(r"\d+$", "", unit).lower()
            peripherals.setdefault((unit, kind), []).append({"pin": pin, "signal": signal})
    core = Stm32Model.Core(
        peripherals=[
            {"name": unit, "registers": {"kind": {"uart": "usart"}.get(kind, kind)}, "pins": list(taken)}
            for (unit, kind), taken in sorted(peripherals.items())
        ]
    )
    package = Stm32Model.Package(name=BOARD, package="", pins=[{"signals": [pin]} for pin in pins])
    return package, core


def theirs(pins, free, kinds):
    """Seconds of the search, and the cost of the wiring."""
    solver = PinSolver(*model(free))
    refs = []
    for number, kind in enumerate(kinds):
        (peripheral, signals, own), _ = KINDS[kind]
        _, taken = solver.add_peripheral_requirement(
            f"D{number}", None, peripheral, signals, consume_peripheral=own
        )
        refs += taken
    start = time.perf_counter()
    answer = solver.solve()
    seconds = time.perf_counter() - start
    return seconds, sum(len(pins[str(answer[ref])]) for ref in refs)


def ours(binary, pins, kinds):
    """Seconds of the process, and the cost of the wiring."""
    devices = "".join(
        f"sensor D{number} returns uint16 {{ id = {number + 1}; type = {KINDS[kind][1]}; }}\n"
        for number, kind in enumerate(kinds)
    )
    call = [binary, "solve", "-", "--target", "none", "--format", "json", "--quiet"]
    start = time.perf_counter()
    ran = subprocess.run(call, input=f"board {BOARD} {{\n{devices}}}\n", capture_output=True, text=True)
    seconds = time.perf_counter() - start
    if ran.returncode:
        sys.exit(f"{kinds}: {ran.stderr}")
    wires = [wire for device in json.loads(ran.stdout)["boards"][0]["devices"] for wire in device["wires"]]
    return seconds, sum(len(pins[wire["pin"]]) for wire in wires)


def request(number, count):
    draw = random.Random(number)
    kinds = []
    while len(kinds) < count:
        kind = draw.choice([kind for kind in KINDS if KINDS[kind][1]])
        if kinds.count(kind) < MOST[kind]:
            kinds.append(kind)
    return kinds


def main():
    binary = sys.argv[1]
    pins, free = table(binary)
    print("| devices | pinocchiout, search | ours, process | cost of its wiring, ours = 1 |")
    print("| ---: | ---: | ---: | --- |")
    for count in (4, 8, 12):
        runs = []
        for number in range(5):
            kinds = request(1000 * count + number, count)
            # A process each: Z3 remembers the names of the one before.
            with multiprocessing.Pool(1) as pool:
                found = pool.apply(theirs, (pins, free, kinds))
            runs.append(found + ours(binary, pins, kinds))
        times = [statistics.median(run[at] * 1e3 for run in runs) for at in (0, 2)]
        ratios = sorted(run[1] / run[3] for run in runs)
        if ratios[0] < 1:
            sys.exit("a wiring of pinocchiout is better than the best")
        print(f"| {count} | {times[0]:.0f} ms | {times[1]:.1f} ms | {ratios[0]:.2f} to {ratios[-1]:.2f} |")


if __name__ == "__main__":
    main()
