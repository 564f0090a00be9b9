#!/usr/bin/env python3
"""Compares the crate `sensedsl-rules` with RTAMT, an independent monitor for signal temporal logic, on random cases.

    python3 tests/rules/compare.py [--cases 10000] [--seed 1] [--jobs 1]

Each case is a random trace and a random formula, a `when` rule or an `eventually` rule. Robustness must agree within
1e-9 of its size, and what holds must have a robustness that is not negative. Where both must differ, by definition, is
left out, and counted:

- Beyond the end. RTAMT cuts an interval that reaches beyond the trace and answers from the rest; here the answer is not
  known there. Compared is where the whole interval lies within the trace.
- The first moment of `rise`. RTAMT takes what was before the trace for false; here nothing has risen then. Compared is
  from the second sample on, of a `rise` of a `rise` from the third, and so on.

Each comparison has a signal: one of constants alone has no samples after the first, and conditions of tests refuse it.

Needs `pip install rtamt` (BSD-3-Clause). Exit status: 0 they agree, 1 they do not, 2 RTAMT or cargo is missing.
"""

import argparse
import math
import multiprocessing
import os
import random
import subprocess
import sys

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
SIGNALS = 3
COMPARISONS = ["<", "<=", ">", ">=", "==", "!="]


def term(chance, depth):
    """A term as both read it: prefix words, and RTAMT's text."""
    if depth == 0 or chance.random() < 0.5:
        if chance.random() < 0.7:
            number = chance.randrange(SIGNALS)
            return [f"s{number}"], f"s{number}"
        value = value_of(chance)
        text = f"{abs(value)!r}"
        return [f"n{value!r}"], text if value >= 0 else f"(0 - {text})"
    operator = chance.choice(["+", "-", "*", "abs"])
    one, one_text = term(chance, depth - 1)
    if operator == "abs":
        return ["abs"] + one, f"abs({one_text})"
    other, other_text = term(chance, depth - 1)
    return [operator] + one + other, f"({one_text} {operator} {other_text})"


def value_of(chance):
    """Often a whole number, so that sides are equal now and then."""
    if chance.random() < 0.6:
        return float(chance.randint(-4, 4))
    return round(chance.uniform(-4, 4), 3)


def formula(chance, depth):
    """A formula: prefix words, RTAMT's text, how far it looks ahead, and how many `rise` stand in each other."""
    if depth == 0 or chance.random() < 0.25:
        how = chance.choice(COMPARISONS)
        one, one_text = term(chance, 2)
        while not any(word.startswith("s") for word in one):
            one, one_text = term(chance, 2)
        other, other_text = term(chance, 1)
        # RTAMT has `==` and `!==`.
        written = {"!=": "!=="}.get(how, how)
        return [how] + one + other, f"({one_text} {written} {other_text})", 0, 0
    what = chance.choice(["not", "and", "or", "implies", "rising", "always", "eventually", "always", "eventually"])
    one, one_text, ahead, back = formula(chance, depth - 1)
    if what == "not":
        return ["not"] + one, f"(not {one_text})", ahead, back
    if what == "rising":
        return ["rising"] + one, f"(rise({one_text}))", ahead, back + 1
    if what in ("always", "eventually"):
        begin = chance.randint(0, 3)
        end = begin + chance.randint(0, 5)
        words = [what, str(begin), str(end)] + one
        return words, f"({what}[{begin}:{end}]({one_text}))", ahead + end, back
    other, other_text, other_ahead, other_back = formula(chance, depth - 1)
    written = {"implies": "->"}.get(what, what)
    text = f"({one_text} {written} {other_text})"
    return [what] + one + other, text, max(ahead, other_ahead), max(back, other_back)


def case(seed):
    """A case: the line for our program, RTAMT's formula, the trace, and from when to when both are compared."""
    chance = random.Random(seed)
    length = chance.randint(8, 40)
    trace = []
    for _ in range(SIGNALS):
        values = [value_of(chance)]
        while len(values) < length:
            values.append(values[-1] if chance.random() < 0.4 else value_of(chance))
        trace.append(values)
    head = [str(SIGNALS), str(length)] + [repr(value) for values in trace for value in values]
    sort = chance.choice("FFWE")
    words, text, ahead, back = formula(chance, 3)
    begin = back
    if sort == "F":
        return " ".join(head + ["F"] + words), text, trace, sort, begin, length - 1 - ahead
    within = chance.randint(0, 6)
    start = chance.randint(begin, length // 2)
    if sort == "E":
        line = head + ["E", str(start), str(within)] + words
        # What is not known in the interval as a whole is left out.
        end = start + within if start + within <= length - 1 - ahead else -1
        return " ".join(line), text, trace, sort, start, end
    then, then_text, then_ahead, then_back = formula(chance, 2)
    begin = max(back, then_back)
    start = chance.randint(begin, length // 2)
    to = chance.randint(start, length - 1)
    line = head + ["W", str(start), str(to), str(within)] + words + then
    text = f"({text} -> (eventually[0:{within}]({then_text})))"
    end = min(to, length - 1 - max(ahead, within + then_ahead))
    return " ".join(line), text, trace, sort, start, end


def of_rtamt(text, trace):
    import rtamt

    spec = rtamt.StlDiscreteTimeSpecification()
    for number in range(SIGNALS):
        spec.declare_var(f"s{number}", "float")
    spec.declare_var("out", "float")
    spec.spec = f"out = {text}"
    spec.parse()
    data = {"time": list(range(len(trace[0])))}
    data.update({f"s{number}": values for number, values in enumerate(trace)})
    return [value for _, value in spec.evaluate(data)]


def is_near(one, other):
    return one == other or abs(one - other) <= 1e-9 * max(1.0, abs(one), abs(other))


def judged(job):
    """What is wrong with one case, and how many values were compared and left out."""
    seed, answer = job
    _, text, trace, sort, begin, end = case(seed)
    length = len(trace[0])
    if end < begin:
        return None, 0, length
    theirs = of_rtamt(text, trace)
    if sort == "F":
        words = answer.split()
        ours = {int(at): (float(value), holds == "1") for at, value, holds in zip(words[::3], words[1::3], words[2::3])}
        for at in range(begin, end + 1):
            if at not in ours:
                return f"seed {seed}: not known at {at}: {text}", 0, 0
            value, holds = ours[at]
            if not is_near(value, theirs[at]):
                return f"seed {seed}: at {at} {value} and {theirs[at]}: {text}", 0, 0
            if value != 0 and holds != (value > 0):
                return f"seed {seed}: at {at} {value}, and it holds: {holds}: {text}", 0, 0
        if max(ours) != end:
            return f"seed {seed}: known until {max(ours)}, not {end}: {text}", 0, 0
        return None, end + 1 - begin, length - (end + 1 - begin)
    window = theirs[begin : end + 1]
    expected = max(window) if sort == "E" else min(window)
    words = answer.split()
    if words[0] == "unknown" or not is_near(float(words[0]), expected):
        return f"seed {seed}: rule {answer}, not {expected}: {text}", 0, 0
    if expected != 0 and (words[1] == "held") != (expected > 0):
        return f"seed {seed}: rule {answer}, and robustness {expected}: {text}", 0, 0
    if words[1] == "violated" and 0 not in window:
        first = end if sort == "E" else begin + next(at for at, value in enumerate(window) if value < 0)
        if int(words[2]) != first:
            return f"seed {seed}: violated at {words[2]}, not {first}: {text}", 0, 0
    return None, 1, 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--program", help="the built example `judge`, so that cargo is not asked")
    args = parser.parse_args()
    try:
        import rtamt  # noqa: F401
    except ImportError as why:
        print(f"SKIPPED: NOTHING WAS COMPARED, because RTAMT is missing ({why}): pip install rtamt", file=sys.stderr)
        return 2
    command = [args.program] if args.program else ["cargo", "run", "-q", "-p", "sensedsl-rules", "--example", "judge"]
    seeds = [args.seed * 10_000_000 + number for number in range(args.cases)]
    lines = "".join(case(seed)[0] + "\n" for seed in seeds)
    try:
        ran = subprocess.run(command, input=lines, text=True, stdout=subprocess.PIPE, cwd=ROOT, check=True)
    except (OSError, subprocess.CalledProcessError) as why:
        print(f"SKIPPED: NOTHING WAS COMPARED: {why}", file=sys.stderr)
        return 2
    answers = ran.stdout.splitlines()
    if len(answers) != len(seeds):
        print(f"{len(answers)} answers to {len(seeds)} cases", file=sys.stderr)
        return 1
    wrong, compared, left = [], 0, 0
    with multiprocessing.Pool(args.jobs) as pool:
        for why, same, out in pool.imap_unordered(judged, zip(seeds, answers), chunksize=50):
            wrong.extend([why] if why else [])
            compared += same
            left += out
    for why in sorted(wrong)[:20]:
        print(why)
    print(
        f"{len(seeds)} cases (seed {args.seed}), {compared} values compared, {left} left out as defined otherwise, "
        f"{len(wrong)} cases differ"
    )
    return 1 if wrong or not compared else 0


if __name__ == "__main__":
    sys.exit(main())
