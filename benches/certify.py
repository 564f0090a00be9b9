#!/usr/bin/env python3
"""Solves, proves and verifies seeded designs as a user does, and times CP-SAT on the same problems in the same run.

    cargo build --profile dist -p sensedsl
    cargo run --release -p sensedsl-wiring --features problems --example mixed -- "robots of 40 devices" > build/40.jsonl
    python3 -m venv build/venv && build/venv/bin/pip install ortools
    build/venv/bin/python3 benches/certify.py build/40.jsonl [target/release] > build/certified.jsonl

Each line of the input is a design with our answer and the solver's own time (best of up to five runs). The program
`sensedsl solve --proof` writes its certificate, `sensedsl-verify` reads it; what counts is the processor time of the
process. CP-SAT has one thread and is asked where we took 0.25 s or more, and on every tenth design: for the least
objective, or, where there is no wiring, for a minimal conflict by a deletion filter over the devices (each is left out,
and stays out where the others still do not fit). Lines out: one a design; the summary goes to the standard error.
"""

import json
import os
import resource
import subprocess
import sys
import tempfile
import time

import compare

SLOW_S, EACH = 0.25, 10
# A filter stops there.
FILTER_S = 60.0


def processor_s(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def certified(line, folder, programs):
    """The processor times with and without a certificate, its size, and whether it was accepted."""
    file, proof = os.path.join(folder, "mixed.sense"), os.path.join(folder, "proof.json")
    with open(file, "w", encoding="utf-8") as text:
        text.write(line["sense"])
    if os.path.exists(proof):
        os.remove(proof)
    solve = [os.path.join(programs, "sensedsl"), "solve", "--target", line["target"], "--timeout", "60", file]
    _, plain_s = processor_s(solve)
    done, proved_s = processor_s([*solve, "--proof", proof])
    row = {"plain_s": round(plain_s, 3), "proved_s": round(proved_s, 3), "accepted": False, "bytes": 0}
    if os.path.exists(proof):
        row["bytes"] = os.path.getsize(proof)
        verdict, row["verified_s"] = processor_s([os.path.join(programs, "sensedsl-verify"), proof])
        row["accepted"] = verdict.returncode == 0
    if not row["accepted"]:
        row["said"] = done.stderr.strip().splitlines()[:1]
    return row


def feasible(problem, devices):
    """Whether these devices fit together, nothing where CP-SAT does not say, and its time."""
    part = dict(problem, devices=[problem["devices"][device] for device in devices])
    model = compare.Model(part)
    model.cost = {}
    status, _, spent = compare.cp_sat(model)
    return {"optimal": True, "infeasible": False}.get(status), spent


def deletion_filter(problem):
    """A minimal conflict, nothing where it takes too long, and CP-SAT's time for it."""
    kept, total = list(range(len(problem["devices"]))), 0.0
    for device in list(kept):
        others = [other for other in kept if other != device]
        fits, spent = feasible(problem, others)
        total += spent
        if fits is None or total > FILTER_S:
            return None, total
        if not fits:
            kept = others
    return kept, total


def peer(line):
    problem = line["problem"]
    if line["status"] == "infeasible":
        conflict, spent = deletion_filter(problem)
        return {"cp_sat": "conflict" if conflict else "stopped", "cp_sat_s": round(spent, 3)}
    model = compare.Model(problem)
    status, weight, spent = compare.cp_sat(model)
    row = {"cp_sat": status, "cp_sat_s": round(spent, 3)}
    if status == "optimal" and line["status"] == "optimal":
        row["agree"] = weight == model.weight(line["objective"])
    return row


def at(values, share):
    return sorted(values)[min(int(len(values) * share), len(values) - 1)] if values else 0.0


def summary(rows):
    def say(text):
        print(text, file=sys.stderr)

    for status in ("optimal", "infeasible", "stopped"):
        some = [row for row in rows if row["status"] == status]
        spent = [row["solver_s"] for row in some]
        say(f"{status}: {len(some)}, solver alone p50 {at(spent, 0.5):.4f} p99 {at(spent, 0.99):.3f} most {at(spent, 1):.3f}")
        proved = [row["proved_s"] for row in some]
        say(f"  accepted {sum(row['accepted'] for row in some)}, with certificate p50 {at(proved, 0.5):.3f} most {at(proved, 1):.3f}")
    spent = [row["solver_s"] for row in rows]
    say(f"all: {len(rows)}, p99 {at(spent, 0.99):.3f} s, above 0.5 s {sum(s > 0.5 for s in spent)}")
    say(f"above 2 s with a certificate: {[row['seed'] for row in rows if row['proved_s'] > 2]}")
    say(f"above 2 x + 0.2 s: {[row['seed'] for row in rows if row['proved_s'] > 2 * row['plain_s'] + 0.2]}")
    say(f"not accepted: {[(row['seed'], row.get('said')) for row in rows if not row['accepted']]}")
    asked = [row for row in rows if "cp_sat" in row]
    say(f"CP-SAT asked {len(asked)}, disagreements {[row['seed'] for row in asked if row.get('agree') is False]}")
    twice = [row for row in asked if row["solver_s"] > 0.5 and row["solver_s"] > 2 * row["cp_sat_s"]]
    say(f"above 0.5 s and twice CP-SAT: {[(row['seed'], row['solver_s'], row['cp_sat_s']) for row in twice]}")
    ratios = [row["solver_s"] / row["cp_sat_s"] for row in asked if row["status"] == "infeasible"]
    say(f"minimal conflicts, ours over the filter: {len(ratios)}, p50 {at(ratios, 0.5):.3f} p90 {at(ratios, 0.9):.3f} most {at(ratios, 1):.2f}")


def main():
    programs = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "target/release")
    rows, began = [], time.time()
    with open(sys.argv[1], encoding="utf-8") as lines, tempfile.TemporaryDirectory() as folder:
        for number, text in enumerate(lines):
            line = json.loads(text)
            row = {key: line[key] for key in ("seed", "devices", "status")}
            row["solver_s"] = round(min(line["micros"], 6e7) / 1e6, 5)
            row |= certified(line, folder, programs)
            if row["solver_s"] >= SLOW_S or number % EACH == 0 or line["status"] == "infeasible":
                row |= peer(line)
            rows.append(row)
            print(json.dumps(row), flush=True)
    summary(rows)
    print(f"{time.time() - began:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
