#!/usr/bin/env python3
"""Measures the whole process on designs with boards of different size.

    cargo build --profile dist -p sensedsl
    cargo run --release -p sensedsl-wiring --features problems --example mixed > build/mixed.jsonl
    python3 benches/mixed.py build/mixed.jsonl [target/dist/sensedsl]

Each line of the input is a design as text, made by `crates/wiring/tests/support/mixed.rs` from a seed. The
files are written to a folder of their own and solved for the design's target, explanation and repairs
included; what counts is the processor time of the process, best of three. The same lines go to
`benches/compare.py`, which puts the pin problems to other solvers.
"""

import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile

RUNS = 3


def processor_s(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 1):
        sys.exit(f"{command} ended with status {done.returncode}")
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main():
    binary = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "target/dist/sensedsl")
    families = {}
    with open(sys.argv[1], encoding="utf-8") as lines, tempfile.TemporaryDirectory() as folder:
        for number, text in enumerate(lines):
            line = json.loads(text)
            place = os.path.join(folder, str(number))
            os.mkdir(place)
            for name, content in [("mixed.sense", line["sense"]), *line["tables"].items()]:
                with open(os.path.join(place, name), "w", encoding="utf-8") as file:
                    file.write(content)
            command = [binary, "solve", "--target", line["target"], os.path.join(place, "mixed.sense")]
            spent = min(processor_s(command) for _ in range(RUNS))
            families.setdefault(line["family"], []).append((spent, line["seed"], line["status"]))
    print("| family | designs | without an answer | process, median | slowest (seed) |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for family, runs in families.items():
        worst = max(runs)
        infeasible = sum(status == "infeasible" for _, _, status in runs)
        median = statistics.median(spent for spent, _, _ in runs)
        print(f"| {family} | {len(runs)} | {infeasible} | {median * 1e3:.0f} ms | {worst[0] * 1e3:.0f} ms ({worst[1]}) |")


if __name__ == "__main__":
    main()
