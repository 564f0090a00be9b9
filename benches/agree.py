#!/usr/bin/env python3
"""Has general solvers check our answers to seeded problems of all sorts.

    python3 -m venv build/venv && build/venv/bin/pip install ortools highspy clingo
    cargo run --release -p sensedsl-solve --features problems --example agreement -- 1000 > build/agreement.jsonl
    build/venv/bin/python3 benches/agree.py build/agreement.jsonl

Of each problem CP-SAT and HiGHS find the least objective; of the first 200 answers CP-SAT finds the
pins that come first, wire by wire; of the first 100 conflicts it checks that they are conflicts and
that they are minimal; of the first 50 counts clingo counts. Ends with status 1 on a disagreement.
"""

import json
import multiprocessing
import sys
from concurrent.futures import ProcessPoolExecutor

import compare

PINS, CONFLICTS, COUNTS = 200, 100, 50
# Pins are compared of problems with at most so many devices.
SMALL = 10
# clingo lists what it counts.
COUNTED = 100_000


class Wires(compare.Model):
    """The problem with the variables of each wire kept: device, role position, pin."""

    def __init__(self, problem):
        self.wires = []
        super().__init__(problem)

    def roles(self, pins, held, rules, number, x, roles):
        before = self.count
        super().roles(pins, held, rules, number, x, roles)
        var = before
        for position, role in enumerate(roles):
            for candidate in role:
                self.wires.append((number, position, candidate[0], var))
                var += 1


def cp_model(model):
    from ortools.sat.python import cp_model as cp_sat

    cp = cp_sat.CpModel()
    x = [cp.new_bool_var("") for _ in range(model.count)]
    for terms, least, most in model.rows:
        total = sum(factor * x[var] for var, factor in terms)
        if least is not None:
            cp.add(total >= least)
        if most is not None:
            cp.add(total <= most)
    solver = cp_sat.CpSolver()
    solver.parameters.num_workers = 1
    solver.parameters.max_time_in_seconds = compare.LIMIT_S
    return cp_sat, cp, x, solver


def least_pins(problem, weight):
    """The pins of the best answers that come first, wire by wire."""
    model = Wires(problem)
    cp_sat, cp, x, solver = cp_model(model)
    cp.add(sum(factor * x[var] for var, factor in model.cost.items()) == weight)
    found = []
    for number in range(len(problem["devices"])):
        pins = []
        for position in range(max(len(a["roles"]) for a in problem["devices"][number])):
            here = [(pin, var) for n, p, pin, var in model.wires if (n, p) == (number, position)]
            # No such wire comes before any pin.
            total = sum((pin + 1) * x[var] for pin, var in here)
            cp.minimize(total)
            status = solver.solve(cp)
            if status != cp_sat.OPTIMAL:
                return None if status == cp_sat.INFEASIBLE else "stopped"
            value = round(solver.objective_value)
            cp.add(total == value)
            if value:
                pins.append(value - 1)
        found.append(pins)
    return found


def feasible(problem, devices):
    few = dict(problem, devices=[problem["devices"][d] for d in devices])
    model = compare.Model(few)
    model.cost = {}
    status = compare.cp_sat(model)[0]
    return None if status == "stopped" else status == "optimal"


def minimal(problem, conflict):
    whole = feasible(problem, conflict)
    if whole is not False:
        return "is no conflict" if whole else "was not checked in time"
    for device in conflict:
        if not feasible(problem, [d for d in conflict if d != device]):
            return f"is not minimal: {device}"
    return None


def clingo_count(problem):
    """The number of answers: they differ in their wires."""
    import clingo as asp

    model = Wires(problem)
    rules = compare.asp_rules(model) + [f"#project x({var})." for *_, var in model.wires]
    control = asp.Control(["--project=project", "0"], logger=lambda *_: None)
    control.add("base", [], "\n".join(rules))
    control.ground([("base", [])])
    number = 0
    with control.solve(yield_=True) as handle:
        for _ in handle:
            number += 1
    return number


def main():
    spawn = multiprocessing.get_context("spawn")
    pools = {name: ProcessPoolExecutor(1, spawn) for name in ("CP-SAT", "HiGHS", "clingo")}
    peers = [("CP-SAT", compare.cp_sat), ("HiGHS", compare.highs)]
    wrong = []
    done = {"problems": 0, "infeasible": 0, "stopped": 0, "pins": 0, "conflicts": 0, "counts": 0}
    with open(sys.argv[1], encoding="utf-8") as lines:
        for text in lines:
            line = json.loads(text)
            problem, status, seed = line["problem"], line["status"], line["seed"]
            done["problems"] += 1
            done["infeasible"] += status == "infeasible"
            if status == "stopped":
                done["stopped"] += 1
                continue
            model = compare.Model(problem)
            ours = model.weight(line["objective"]) if status == "optimal" else None
            for name, peer in peers:
                theirs, weight, _ = pools[name].submit(peer, model).result()
                if theirs == "stopped":
                    done[f"{name} stopped"] = done.get(f"{name} stopped", 0) + 1
                elif (theirs, weight) != (status, ours):
                    wrong.append(f"{seed}: {name} {theirs} {weight}, we {status} {ours}")
            small = len(problem["devices"]) <= SMALL
            if status == "optimal" and small and done["pins"] < PINS:
                done["pins"] += 1
                least = pools["CP-SAT"].submit(least_pins, problem, ours).result()
                if least == "stopped":
                    done["pins"] -= 1
                elif least != line["detail"]:
                    wrong.append(f"{seed}: pins {least}, ours {line['detail']}")
            if status == "infeasible" and done["conflicts"] < CONFLICTS:
                done["conflicts"] += 1
                fault = pools["CP-SAT"].submit(minimal, problem, line["detail"]).result()
                if fault:
                    wrong.append(f"{seed}: {line['detail']} {fault}")
            counted = line["count"]
            if counted is not None and counted < COUNTED and done["counts"] < COUNTS:
                done["counts"] += 1
                theirs = pools["clingo"].submit(clingo_count, problem).result()
                if theirs != counted:
                    wrong.append(f"{seed}: clingo counts {theirs}, we {counted}")
            print(seed, done, len(wrong), file=sys.stderr)
    print(", ".join(f"{name} {number}" for name, number in done.items()))
    print(f"{len(wrong)} disagreements")
    for mistake in wrong:
        print(f"- {mistake}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
