# SPDX-License-Identifier: MIT
"""Solves the tasks of edits_bench by SLSQP from many starts, over carom's rows and exact gradients.

    slsqp.py EDITS_BENCH TASKS [--starts N] [--seconds S] [--csv FILE] [--offer]

TASKS: "300-395,480". The first start is the task's own; the others are drawn about it, by a little and by a lot. Of all
that meet the task the smallest change counts. Motions that lack a row (an impact does not come) cannot be a start, and
end a descent. With --offer the file of the best known changes gets what is smaller, with --hidden the hidden throw is
the second start: for that file alone, not to compare."""

import argparse
import json
import subprocess
import time
import warnings

import numpy as np
from scipy.optimize import minimize

FAR = 1e3  # stands for rows that a motion lacks


class Bench:
    def __init__(self, program):
        self.process = subprocess.Popen([program, "--serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.evaluations = 0

    def ask(self, request, *numbers):
        print(request, *(repr(float(x)) for x in numbers), file=self.process.stdin, flush=True)
        return json.loads(self.process.stdout.readline())

    def close(self):
        self.process.stdin.close()
        self.process.wait()


class Problem:
    """One task: changes y, with the rows at the last y that was asked for."""

    def __init__(self, bench, index):
        self.bench = bench
        self.facts = bench.ask(f"task {index}")
        self.numbers = self.facts["numbers"]
        self.controls = self.numbers - self.facts["times"]
        bound = [-np.inf, np.inf]
        self.lower, self.upper, self.row_lower, self.row_upper = (
            np.array([bound[side] if x is None else x for x in self.facts[name]], dtype=float)
            for name, side in (("lower", 0), ("upper", 1), ("row_lower", 0), ("row_upper", 1)))
        self.equal = self.row_lower == self.row_upper
        self.at = None

    def rows(self, y):
        y = np.clip(y, self.lower, self.upper)
        if not np.all(np.isfinite(y)):  # SLSQP makes such steps where gradients vanish
            return {"available": False}
        if self.at is None or not np.array_equal(y, self.at):
            self.at = y.copy()
            self.answer = self.bench.ask("rows", *y)
            self.bench.evaluations += 1
        return self.answer

    def equations(self, y):
        answer = self.rows(y)
        if not answer["available"]:
            return np.full(self.equal.sum(), FAR)
        return np.array(answer["rows"], dtype=float)[self.equal] - self.row_lower[self.equal]

    def equation_rates(self, y):
        answer = self.rows(y)
        if not answer["available"]:
            return np.zeros((self.equal.sum(), self.numbers))
        return np.array(answer["jacobian"], dtype=float)[self.equal]

    def ranges(self, y):
        answer = self.rows(y)
        below, above = self._sides()
        if not answer["available"]:
            return np.full(below.sum() + above.sum(), -FAR)
        values = np.array(answer["rows"], dtype=float)
        return np.concatenate([(values - self.row_lower)[below], (self.row_upper - values)[above]])

    def range_rates(self, y):
        answer = self.rows(y)
        below, above = self._sides()
        if not answer["available"]:
            return np.zeros((below.sum() + above.sum(), self.numbers))
        rates = np.array(answer["jacobian"], dtype=float)
        return np.concatenate([rates[below], -rates[above]])

    def _sides(self):
        return ~self.equal & np.isfinite(self.row_lower), ~self.equal & np.isfinite(self.row_upper)

    def descend(self, start):
        def cost(y):
            return 0.5 * float(y[:self.controls] @ y[:self.controls])

        def cost_rate(y):
            rate = y.copy()
            rate[self.controls:] = 0
            return rate

        constraints = []
        if self.equal.any():
            constraints.append({"type": "eq", "fun": self.equations, "jac": self.equation_rates})
        if not self.equal.all():
            constraints.append({"type": "ineq", "fun": self.ranges, "jac": self.range_rates})
        found = minimize(cost, start, jac=cost_rate, method="SLSQP", constraints=constraints,
                         bounds=list(zip(self.lower, self.upper)), options={"maxiter": 100, "ftol": 1e-13})
        return np.clip(found.x, self.lower, self.upper)


def starts(problem, count, dice, hidden, known):
    """Smaller than the smallest change that is known by now: `known()`."""
    yield np.clip(np.zeros(problem.numbers), problem.lower, problem.upper)
    if hidden:
        yield np.array(problem.facts["hidden_changes"])
    for i in range(1, count):
        reach = min(10.0 ** dice.uniform(-1.5, 0.7), np.sqrt(2 * known()))
        y = dice.normal(size=problem.numbers)
        yield np.clip(reach * y / np.linalg.norm(y), problem.lower, problem.upper)


def solve(problem, count, seconds, dice, hidden):
    """Smallest change that is met, when each smaller one was found, and how many starts had their rows."""
    began = time.perf_counter()
    best, best_y, history, tried = np.inf, None, [], 0
    for start in starts(problem, count, dice, hidden, lambda: best):
        if time.perf_counter() - began > seconds:
            break
        if not problem.rows(start)["available"]:
            continue
        tried += 1
        try:
            y = problem.descend(start)
        except ValueError:  # numbers that are not finite
            continue
        if not np.all(np.isfinite(y)):
            continue
        judged = problem.bench.ask("judge", *y)
        if judged["met"] and judged["objective"] < best:
            best, best_y = judged["objective"], y
            history.append((time.perf_counter() - began, best))
    return best, best_y, history, tried, time.perf_counter() - began


def numbers_of(text):
    for part in text.split(","):
        first, _, last = part.partition("-")
        yield from range(int(first), int(last or first) + 1)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("tasks")
    parser.add_argument("--starts", type=int, default=64)
    parser.add_argument("--seconds", type=float, default=5)
    parser.add_argument("--csv")
    parser.add_argument("--history", help="one line a smaller change that was found")
    parser.add_argument("--offer", action="store_true")
    parser.add_argument("--hidden", action="store_true")
    options = parser.parse_args()
    warnings.filterwarnings("ignore", "Values in x were outside bounds")
    bench = Bench(options.program)
    met, found, lines = 0, ["task,seconds,objective"], ["task,met,objective,best_known,first_s,seconds,descents,evaluations"]
    for index in numbers_of(options.tasks):
        bench.evaluations = 0
        problem = Problem(bench, index)
        best, y, history, tried, seconds = solve(problem, options.starts, options.seconds, np.random.default_rng(index),
                                                options.hidden)
        if y is not None:
            met += 1
            if options.offer:
                bench.ask("offer slsqp", *y)
        found += [f"{index},{at:.4f},{objective:.9g}" for at, objective in history]
        first = history[0][0] if history else float("nan")
        lines.append(f"{index},{int(y is not None)},{best:.9g},{problem.facts['best']:.9g},{first:.4f},{seconds:.4f},"
                     f"{tried},{bench.evaluations}")
        print(lines[-1], flush=True)
    bench.close()
    print(f"met {met} of {len(lines) - 1}")
    for file, text in ((options.csv, lines), (options.history, found)):
        if file:
            with open(file, "w") as out:
                out.write("\n".join(text) + "\n")


if __name__ == "__main__":
    main()
