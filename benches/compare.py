#!/usr/bin/env python3
"""Compares the solver with general ones on the same seeded problems, in one run.

    python3 -m venv build/venv && build/venv/bin/pip install ortools highspy clingo
    cargo run --release -p sensedsl-solve --features problems --example instances > build/instances.jsonl
    build/venv/bin/python3 benches/compare.py build/instances.jsonl > build/benchmarks.md

Each line of the input is a problem with our answer and our time: proof, least objective and
tie-break included, best of up to five runs. The others are asked for the least objective alone,
building their model not counted, best of up to three runs; one thread each. Every answer is compared with ours: a
disagreement ends the program with status 1.
"""

import json
import multiprocessing
import statistics
import sys
import time
from concurrent.futures import ProcessPoolExecutor

# For CP-SAT, and for the others, of which many would need all of it.
LIMIT_S, OTHERS_LIMIT_S = 20.0, 5.0
# Best of so many runs, where one is as quick as that.
RUNS, QUICK_S = 3, 0.2


class Model:
    """The problem as 0-1 variables and linear rows, the same for all solvers."""

    def __init__(self, problem):
        self.count = 0
        self.rows = []  # (terms, least, most): terms are (variable, factor)
        self.cost = {}
        self.build(problem)

    def var(self):
        self.count += 1
        return self.count - 1

    def row(self, terms, least, most):
        self.rows.append((terms, least, most))

    def implies(self, lit, other):
        self.row([(other, 1), (lit, -1)], 0, None)

    def build(self, problem):
        pins, held, users, rules, boards = {}, {}, {}, {}, {}
        for number, alternatives in enumerate(problem["devices"]):
            chosen = [self.var() for _ in alternatives]
            self.row([(x, 1) for x in chosen], 1, 1)
            for x, alternative in zip(chosen, alternatives):
                self.claims(held, number, x, alternative["claims"])
                for rule in alternative["violates"]:
                    rules.setdefault(rule, []).append(x)
                for user in alternative["dma"]:
                    users.setdefault(user, []).append(x)
                if problem["spares"][alternative["board"]]:
                    boards.setdefault(alternative["board"], []).append(x)
                self.roles(pins, held, rules, number, x, alternative["roles"])
        self.exclusive(held)
        used = self.exclusive(pins)
        self.dma(problem, users)
        self.objective(problem, used, rules, boards)

    def roles(self, pins, held, rules, number, x, roles):
        own = {}
        for role in roles:
            wires = []
            for pin, holder, _, claims, violates in role:
                y = self.var()
                wires.append(y)
                own.setdefault(pin, []).append(y)
                pins.setdefault(pin, {}).setdefault((holder, number if holder < 0 else None), []).append(y)
                self.claims(held, number, y, claims)
                for rule in violates:
                    rules.setdefault(rule, []).append(y)
            self.row([(y, 1) for y in wires] + [(x, -1)], 0, 0)
        for wires in own.values():  # the pins of one device differ
            if len(wires) > 1:
                self.row([(y, 1) for y in wires], None, 1)

    def claims(self, held, number, lit, claims):
        for resource, holder in claims:
            key = (holder, number if holder < 0 else None)
            held.setdefault(resource, {}).setdefault(key, []).append(lit)

    def exclusive(self, things):
        """One holder for each thing; returns for each thing the terms that say it is held."""
        used = {}
        for thing, holders in things.items():
            terms = []
            for lits in holders.values():
                if len(lits) == 1:
                    terms.append((lits[0], 1))
                    continue
                u = self.var()
                terms.append((u, 1))
                for lit in lits:
                    self.implies(lit, u)
            if len(terms) > 1:
                self.row(terms, None, 1)
            used[thing] = terms
        return used

    def dma(self, problem, users):
        streams = {}
        for user, lits in users.items():
            v = self.var()
            for lit in lits:
                self.implies(lit, v)
            for request in problem["dma"][user]:
                terms = []
                for stream in request:
                    z = self.var()
                    terms.append((z, 1))
                    streams.setdefault(stream, []).append((z, 1))
                self.row(terms + [(v, -1)], 0, 0)
        for terms in streams.values():
            self.row(terms, None, 1)

    def objective(self, problem, used, rules, boards):
        spare_factor = 1
        cost_factor = len(problem["spares"]) + 1
        shared_factor = cost_factor * (sum(problem["pins"]) + 1)
        rule_factor = shared_factor * (sum(problem["shared"]) + 1)
        self.factors = (rule_factor, shared_factor, cost_factor, spare_factor)
        for pin, terms in used.items():
            factor = cost_factor * problem["pins"][pin] + shared_factor * problem["shared"][pin]
            for var, _ in terms:
                self.add(var, factor)
        for lits, factor in [(l, rule_factor) for l in rules.values()] + [(l, spare_factor) for l in boards.values()]:
            w = self.var()
            for lit in lits:
                self.implies(lit, w)
            self.add(w, factor)

    def add(self, var, factor):
        self.cost[var] = self.cost.get(var, 0) + factor

    def weight(self, objective):
        return sum(part * factor for part, factor in zip(objective[1:], self.factors))


def cp_sat(model):
    from ortools.sat.python import cp_model

    cp = cp_model.CpModel()
    x = [cp.new_bool_var("") for _ in range(model.count)]
    for terms, least, most in model.rows:
        total = sum(factor * x[var] for var, factor in terms)
        if least is not None and least == most:
            cp.add(total == least)
        elif least is not None:
            cp.add(total >= least)
        else:
            cp.add(total <= most)
    cp.minimize(sum(factor * x[var] for var, factor in model.cost.items()))
    solver = cp_model.CpSolver()
    solver.parameters.num_workers = 1
    solver.parameters.linearization_level = 2
    solver.parameters.max_time_in_seconds = LIMIT_S
    start = time.perf_counter()
    status = solver.solve(cp)
    spent = time.perf_counter() - start
    if status == cp_model.OPTIMAL:
        return "optimal", round(solver.objective_value), spent
    return ("infeasible" if status == cp_model.INFEASIBLE else "stopped"), None, spent


def highs(model):
    import highspy

    solver = highspy.Highs()
    solver.setOptionValue("output_flag", False)
    solver.setOptionValue("threads", 1)
    solver.setOptionValue("time_limit", OTHERS_LIMIT_S)
    solver.setOptionValue("mip_rel_gap", 0.0)
    solver.setOptionValue("mip_abs_gap", 0.5)
    infinite = highspy.kHighsInf
    for var in range(model.count):
        solver.addVar(0.0, 1.0)
        solver.changeColIntegrality(var, highspy.HighsVarType.kInteger)
        solver.changeColCost(var, float(model.cost.get(var, 0)))
    for terms, least, most in model.rows:
        merged = {}
        for var, factor in terms:
            merged[var] = merged.get(var, 0) + factor
        solver.addRow(
            -infinite if least is None else float(least),
            infinite if most is None else float(most),
            len(merged),
            list(merged),
            [float(factor) for factor in merged.values()],
        )
    start = time.perf_counter()
    solver.run()
    spent = time.perf_counter() - start
    status = solver.getModelStatus()
    if status == highspy.HighsModelStatus.kOptimal:
        return "optimal", round(solver.getObjectiveValue()), spent
    infeasible = status == highspy.HighsModelStatus.kInfeasible
    return ("infeasible" if infeasible else "stopped"), None, spent


def asp_rules(model):
    def literal(var, factor):
        return f"x({var})" if factor > 0 else f"not x({var})"

    rules = [f"{{x(0..{model.count - 1})}}."]
    for terms, least, most in model.rows:
        # A factor of -1 is 1 less the opposite literal.
        shift = sum(1 for _, factor in terms if factor < 0)
        body = "; ".join(f"1,{i}: {literal(var, factor)}" for i, (var, factor) in enumerate(terms))
        if least is not None:
            rules.append(f":- #sum {{ {body} }} < {least + shift}.")
        if most is not None:
            rules.append(f":- #sum {{ {body} }} > {most + shift}.")
    return rules


def clingo(model):
    import clingo as asp

    rules = asp_rules(model)
    rules += [f"#minimize {{ {factor},{var}: x({var}) }}." for var, factor in model.cost.items()]
    control = asp.Control(["--opt-mode=opt", "1"], logger=lambda *_: None)
    control.add("base", [], "\n".join(rules))
    control.ground([("base", [])])
    best = []
    start = time.perf_counter()
    with control.solve(async_=True, on_model=lambda found: best.append(found.cost[0] if found.cost else 0)) as handle:
        done = handle.wait(OTHERS_LIMIT_S)
        if not done:
            handle.cancel()
        result = handle.get()
    spent = time.perf_counter() - start
    if not done or not result.exhausted:
        return "stopped", None, spent
    return ("optimal", best[-1], spent) if best else ("infeasible", None, spent)


PEERS = [("CP-SAT", cp_sat), ("HiGHS", highs), ("clingo", clingo)]


def measured(line, peers):
    """Our row, and for each peer its time; the disagreements that were found."""
    model = Model(line["problem"])
    ours = model.weight(line["objective"]) if line["status"] == "optimal" else None
    times, wrong = {}, []
    for name, peer, process in peers:
        status, weight, spent = process.submit(peer, model).result()
        for _ in range(RUNS - 1):
            if spent < QUICK_S:
                spent = min(spent, process.submit(peer, model).result()[2])
        times[name] = None if status == "stopped" else spent * 1e6
        known = "stopped" not in (status, line["status"])
        if known and (status, weight) != (line["status"], ours):
            wrong.append(f"{line['family']} {line['devices']} {line['seed']}: {name} {status} {weight}, we {line['status']} {ours}")
    return times, wrong


def ratio_text(ratios, stopped):
    if not ratios:
        return f"- ({stopped} stopped)"
    text = f"1/{1 / statistics.median(ratios):.3g} (worst 1/{1 / max(ratios):.3g})"
    return text + (f", {stopped} stopped" if stopped else "")


def main():
    # A process each: CP-SAT and HiGHS bring libraries of one name.
    spawn = multiprocessing.get_context("spawn")
    peers = [(name, peer, ProcessPoolExecutor(1, spawn)) for name, peer in PEERS if name not in sys.argv[2:]]
    families, wrong, compared = {}, [], 0
    with open(sys.argv[1], encoding="utf-8") as lines:
        for text in lines:
            line = json.loads(text)
            times, mistakes = measured(line, peers)
            wrong += mistakes
            compared += 1
            families.setdefault((line["family"], line["devices"]), []).append((line, times))
            print(f"{line['family']} {line['devices']} {line['seed']}", file=sys.stderr)
    print("# Benchmarks\n")
    print("Made by `benches/compare.py`, which says how. Seeded problems on made-up boards; ours with proof and")
    print("tie-break, the others for the least objective alone, one thread each, in one run on one machine. A")
    print("ratio is our time over theirs: 1/50 is fifty times faster. Times are medians.\n")
    print("| family | devices | ours | ours, slowest | " + " | ".join(name for name, *_ in peers) + " |")
    print("| --- | ---: | ---: | ---: | " + " | ".join("---" for _ in peers) + " |")
    for (family, devices), runs in families.items():
        mine = [line["micros"] for line, _ in runs]
        stopped = sum(line["status"] == "stopped" for line, _ in runs)
        cells = []
        for name, *_ in peers:
            pairs = [(line["micros"], times[name]) for line, times in runs if times[name] and line["status"] != "stopped"]
            cells.append(ratio_text([a / b for a, b in pairs], sum(times[name] is None for _, times in runs)))
        slowest = f"{max(mine) / 1000:.3g} ms" + (f" ({stopped} stopped)" if stopped else "")
        print(f"| {family} | {devices} | {statistics.median(mine) / 1000:.3g} ms | {slowest} | " + " | ".join(cells) + " |")
    print(f"\n{compared} problems compared, {len(wrong)} disagreements.")
    for mistake in wrong:
        print(f"- {mistake}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
