"""Compares what `sensedsl explain timing` computes with what an emulated board does. Needs python3 with unicorn and
pyelftools, arm-none-eabi-gcc, and CHIBIOS, a ChibiOS 21.11 tree.

    python3 tests/timing/measure.py target/debug/sensedsl [FOLDER] [DESIGN ...]

Builds each design of tests/timing/designs, runs its production firmware for a second of its own time, and prints a
table. Ends with 1 when a figure is more than 20 % off.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

from board import CORE_HZ, TIMERS, Board

WARM_UP_S, MEASURED_S = 0.1, 1.0
OFF_MAX = 0.2
# What is connected to captures: active edges a second, by design and device.
EDGES_HZ = {"fig2": {"WheelEncoder": 120}, "car": {"Wheel": 2000, "Echo": 10}}
# Below that share of a second a figure is a handful of events in the time measured.
SHARE_MIN = 0.0002


def build(binary, file, folder):
    subprocess.run([binary, "generate", file, "-o", folder, "-q"], check=True)
    board = next((folder / "firmware").iterdir())
    make = ["make", "-s", "-j2", "-C", board, f"CHIBIOS={os.environ['CHIBIOS']}", "UP_MODE=production"]
    subprocess.run(make, check=True, stdout=subprocess.DEVNULL)
    return board / "build/production/sense.elf"


def measured(elf, edges_hz):
    board = Board(elf, edges_hz)
    board.run(WARM_UP_S)
    before = dict(board.busy), dict(board.spent), dict(board.count), len(board.tx)
    board.run(MEASURED_S)
    change = lambda now, then: {name: (now[name] - then.get(name, 0)) / MEASURED_S for name in now}
    busy, spent = change(board.busy, before[0]), change(board.spent, before[1])
    return {name: clocks / CORE_HZ for name, clocks in busy.items()}, sum(spent.values()), change(board.count, before[2])


def figures(computed, found):
    """Name, unit, computed, measured."""
    busy, instructions, counts = found
    units = {}
    for row in computed["rows"]:
        if row["part"] in ("adc", "bus"):
            units[row["name"]] = units.get(row["name"], 0) + row["busy_ns_a_second"]
    for name, busy_ns in units.items():
        yield name, "busy", busy_ns / 1e9, busy.get(name, 0)
    link = next(row for row in computed["rows"] if row["part"] == "link")
    yield link["name"], "busy", link["busy_ns_a_second"] / 1e9, busy.get("link", 0)
    for row in computed["rows"]:
        if row["part"] == "irq" and row["a_second"]:
            vectors = next({up, cc} for name, _, up, cc in TIMERS.values() if name == row["name"])
            yield row["name"], "interrupts", row["a_second"], sum(counts.get(f"irq {irq}", 0) for irq in vectors)
    wanted = sum(row["a_second"] for row in computed["rows"] if row["part"] == "thread")
    yield "processor", "instructions", wanted, instructions


def main():
    binary = pathlib.Path(sys.argv[1]).resolve()
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else tempfile.mkdtemp())
    designs = sorted((pathlib.Path(__file__).parent / "designs").glob("*.sense"))
    designs = [file for file in designs if not sys.argv[3:] or file.stem in sys.argv[3:]]
    worst = 0.0
    print("| design | part | computed | measured | off |\n| --- | --- | --- | --- | --- |")
    for file in designs:
        timing = subprocess.run([binary, "explain", "timing", file, "--format", "json", "-q"], check=True, capture_output=True)
        computed = json.loads(timing.stdout)["boards"][0]
        captures = {row["devices"][0]: row["name"] for row in computed["rows"] if row["part"] == "irq"}
        edges_hz = {captures[device]: hz for device, hz in EDGES_HZ.get(file.stem, {}).items()}
        found = measured(build(binary, file, folder / file.stem), edges_hz)
        for name, unit, wanted, got in figures(computed, found):
            off = wanted / got - 1 if got else float("inf")
            small = unit == "busy" and max(wanted, got) < SHARE_MIN
            worst = max(worst, 0.0 if small else abs(off))
            shown = (f"{wanted:,.0f} {unit}", f"{got:,.0f}") if unit != "busy" else (f"{100 * wanted:.3f} % busy", f"{100 * got:.3f} %")
            print(f"| `{file.stem}` | {name} | {shown[0]} | {shown[1]} | {100 * off:+.1f} % |", flush=True)
    print(f"\nAt most {100 * worst:.1f} % off.")
    sys.exit(worst > OFF_MAX)


if __name__ == "__main__":
    main()
