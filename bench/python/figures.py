# SPDX-License-Identifier: MIT
"""What calling carom from Python costs, and how soon Ctrl-C is answered.

    build/venv/bin/python bench/python/figures.py build/release [FIGURE]...

with the build folder, in which the package and row_bench were built (scripts/build release carom_stub carom_row_bench).
Writes bench/python/figures.csv, without names of figures; run it on a machine that does nothing else: times are of the clock.
"""

import csv
import gc
import json
import os
import pathlib
import random
import resource
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator

HERE = pathlib.Path(__file__).resolve().parent
BUILD = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release").resolve()
sys.path.insert(0, str(BUILD / "python"))
sys.path.insert(0, str(HERE.parents[1] / "tests" / "python"))

import numpy as np  # noqa: E402

import carom  # noqa: E402
from test_interrupt import crowd_of  # noqa: E402

# Three bounces in 1.6 s.
BALL = {
    "carom": 1,
    "duration": 1.6,
    "materials": {"rubber": {"elasticity": 0.8, "friction": 0.5}},
    "bodies": [
        {"name": "floor", "fixed": True, "material": "rubber", "shape": {"plane": {"normal": [0, 0, 1], "offset": 0}}},
        {"name": "ball", "material": "rubber", "mass": 0.06, "shape": {"sphere": {"radius": 0.03}},
         "position": [0, 0, 0.5], "velocity": [2, 0, 1], "angular_velocity": [0, 10, 0]},
    ],
}
# It tumbles and meets the floor four times in 0.6 s: a simulation of 36 us.
BOX = {
    **BALL,
    "duration": 0.6,
    "bodies": [BALL["bodies"][0],
               {"name": "box", "material": "rubber", "mass": 0.06, "shape": {"box": {"size": [0.03, 0.05, 0.08]}},
                "position": [0, 0, 0.3], "velocity": [2, 0, 1], "angular_velocity": [1, 10, 3]}],
}
SCENES = HERE.parents[1] / "examples" / "scenes"

Row = tuple[str, float, str, str]  # what, how much, of which unit, wanted


def least(call: Callable[[], object], calls: int, rounds: int = 7) -> float:
    """The least time of a call, s, of the processor: other processes count little."""
    best = float("inf")
    for _ in range(rounds):
        began = time.process_time()
        for _ in range(calls):
            call()
        best = min(best, (time.process_time() - began) / calls)
    return best


def rows_of_a_ball() -> Iterator[Row]:
    scene = carom.Scene(BALL)
    assert carom.simulate(scene).impacts == 3
    seed = carom.Seed("ball", 1.6, position=(1, 0, 0))
    of_cpp, of_python = float("inf"), float("inf")
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "ball.json"
        path.write_text(json.dumps(BALL))
        for _ in range(5):  # in turns: both see the same machine
            run = subprocess.run([BUILD / "charts" / "row_bench", path, "ball", "7"], capture_output=True, text=True, check=True)
            of_cpp = min(of_cpp, float(run.stdout))
            of_python = min(of_python, least(lambda: carom.adjoint(carom.simulate(scene), seed), 2000) * 1e6)
    yield "simulation and adjoint row of a ball with three bounces, C++", of_cpp, "us", ""
    yield "the same, Python", of_python, "us", ""
    yield "more in Python", of_python - of_cpp, "us", "<= 2.5"


def samples() -> Iterator[Row]:
    motion = carom.simulate(carom.Scene(BALL))
    times = np.linspace(0, 1.6, 1000)
    yield "sample of 1000 times", least(lambda: motion.sample("ball", times), 200) * 1e6, "us", "<= 100"


def scenes() -> Iterator[Row]:
    yield "scene of two bodies from a dict", least(lambda: carom.Scene(BALL), 300) * 1e6, "us", ""
    code = "import numpy, time; began = time.process_time(); import carom; print(time.process_time() - began)"
    environment = dict(os.environ, PYTHONPATH=str(BUILD / "python"))
    took = [float(subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True).stdout)
            for _ in range(7)]
    yield "import after NumPy", min(took) * 1e3, "ms", "<= 10"


class Workers:
    """Two threads, or two processes, that do their work each time they are told to, and say how long it took."""

    def __init__(self, work: Callable[[], None], fork: bool) -> None:
        self.tell, self.told = [], []
        for _ in range(2):
            begin, done = os.pipe(), os.pipe()
            self.tell.append(begin[1])
            self.told.append(done[0])
            if not fork:
                threading.Thread(target=self.serve, args=(work, begin[0], done[1])).start()
            elif os.fork() == 0:
                self.serve(work, begin[0], done[1])
                os._exit(0)

    @staticmethod
    def serve(work: Callable[[], None], begin: int, done: int) -> None:
        while os.read(begin, 1) == b"b":
            others = -resource.getrusage(resource.RUSAGE_THREAD).ru_nivcsw
            began = time.perf_counter()
            work()
            ended = time.perf_counter()
            others += resource.getrusage(resource.RUSAGE_THREAD).ru_nivcsw
            os.write(done, struct.pack("ddq", began, ended, others))

    def took(self, count: int) -> tuple[float, float]:
        """That many at a time: how much else came between, or how late one began, and the time of one of them."""
        for k in range(count):
            os.write(self.tell[k], b"b")
        runs = [struct.unpack("ddq", os.read(self.told[k], 24)) for k in range(count)]
        took = sum(ended - began for began, ended, _ in runs) / count
        apart = max(began for began, *_ in runs) - min(began for began, *_ in runs)
        return sum(others for *_, others in runs) + apart / took, took

    def end(self) -> None:
        for tell in self.tell:
            os.write(tell, b"e")


def threads() -> Iterator[Row]:
    """How many times as many calls two threads make: by bursts of milliseconds, as the machine does other things as well, and
    the medians of those that least came between. Two processes, in turns with them, do what the machine can."""
    scene, box, crowd = carom.Scene(BALL), carom.Scene(BOX), carom.Scene(crowd_of(3))
    seed = carom.Seed("ball", 1.6, position=(1, 0, 0))
    for what, calls, call in (
            ("simulations of a ball with a row", 200, lambda: carom.adjoint(carom.simulate(scene), seed)),
            ("simulations of a box", 80, lambda: carom.simulate(box)),
            ("simulations of a crowd", 1, lambda: carom.simulate(crowd, impact_limit=1500))):

        def work(calls: int = calls, call: Callable[[], object] = call) -> None:
            for _ in range(calls):
                call()

        of_processes, of_threads = Workers(work, fork=True), Workers(work, fork=False)
        took: dict[tuple[str, int], list[tuple[float, float]]] = {}
        for _ in range(300):
            for name, workers in (("threads", of_threads), ("processes", of_processes)):
                for count in (1, 2):
                    time.sleep(0.002)  # after which the system lets it run for a while
                    took.setdefault((name, count), []).append(workers.took(count))
        for name in ("threads", "processes"):
            one, two = (statistics.median(once for _, once in sorted(took[name, count])[:30]) for count in (1, 2))
            yield f"{what}, two {name} beside one", 2 * one / two, "times", ">= 1.9" if name == "threads" else ""
        waits = -resource.getrusage(resource.RUSAGE_SELF).ru_nvcsw
        began = time.process_time()
        for _ in range(50):
            of_threads.took(1), of_threads.took(1)
        alone = time.process_time() - began
        waits += resource.getrusage(resource.RUSAGE_SELF).ru_nvcsw
        both = -resource.getrusage(resource.RUSAGE_SELF).ru_nvcsw
        began = time.process_time()
        for _ in range(50):
            of_threads.took(2)
        together = time.process_time() - began
        both += resource.getrusage(resource.RUSAGE_SELF).ru_nvcsw
        yield f"{what}, processor time of two threads at a time beside one after the other", together / alone, "times", ""
        yield f"{what}, waits of two threads for each other", max(0, both - waits) / (100 * calls), "a call", ""
        of_processes.end()
        of_threads.end()


def answers(call: Callable[[], object], longest: float, tries: int, draw: random.Random) -> list[float]:
    """From Ctrl-C, pressed at some time, to KeyboardInterrupt, ms."""
    found: list[float] = []
    while len(found) < tries:
        pressed: list[float] = []

        def press(after: float = draw.uniform(0.02, longest), pressed: list[float] = pressed) -> None:
            time.sleep(after)
            pressed.append(time.perf_counter())
            os.kill(os.getpid(), signal.SIGINT)

        presser = threading.Thread(target=press)
        try:
            presser.start()
            call()
            presser.join()  # it came too late: between two calls
            time.sleep(1)
        except KeyboardInterrupt:
            took = (time.perf_counter() - pressed[0]) * 1e3
            if presser.is_alive() or took < 900:
                found.append(took)
            presser.join()
    return found


def interrupts() -> Iterator[Row]:
    draw = random.Random(1)
    for count in (3, 8):
        crowd = carom.Scene(crowd_of(count))
        took = answers(lambda crowd=crowd: carom.simulate(crowd, impact_limit=10**9, record_events=False), 0.5, 12, draw)
        yield f"Ctrl-C in a simulation of {count**3} balls, median", statistics.median(took), "ms", ""
        yield f"Ctrl-C in a simulation of {count**3} balls, longest", max(took), "ms", "<= 100"
    for name in ("die-at-rest", "dice", "falling-rod", "box-over-edge", "mug", "hat-on-coatrack", "bowling", "pen_500"):
        scene = carom.Scene.read(SCENES / f"{name}.json")
        began = time.perf_counter()
        timer = threading.Timer(2, os.kill, [os.getpid(), signal.SIGINT])
        try:
            timer.start()
            carom.Edit.of(scene).solve(effort="thorough")
        except KeyboardInterrupt:
            pass
        timer.cancel()
        whole = time.perf_counter() - began
        took = answers(lambda scene=scene: carom.Edit.of(scene).solve(effort="thorough"), 0.8 * whole, 12, draw)
        yield f"Ctrl-C in the edit {name}, median", statistics.median(took), "ms", ""
        yield f"Ctrl-C in the edit {name}, longest", max(took), "ms", "<= 200"


def leaks() -> Iterator[Row]:
    scene = carom.Scene(BALL)
    seed = carom.Seed("ball", 1.6, position=(1, 0, 0))
    edit = carom.Edit(scene)
    edit.vary(carom.velocity("ball"))
    edit.nail("ball", 1.0).position(2, 0, None)
    program = edit.evaluator()

    def resident() -> int:
        gc.collect()
        return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024

    def work(count: int) -> None:
        for _ in range(count):
            motion = carom.simulate(scene)
            carom.adjoint(motion, seed)
            motion.sample("ball", [0.5, 1.0])
            program.at(program.start).jacobian()

    work(2000)
    before = resident()
    work(10000)
    yield "memory after 10000 simulations, rows, samples and evaluations", resident() - before, "kB", "<= 0"


FIGURES = {"rows": rows_of_a_ball, "samples": samples, "scenes": scenes, "threads": threads, "interrupts": interrupts, "leaks": leaks}


def processor() -> str:
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return "unknown"


def main() -> None:
    named = sys.argv[2:]
    rows: list[Row] = []
    for name, figure in FIGURES.items():
        if named and name not in named:
            continue
        for row in figure():
            rows.append(row)
            what, value, unit, wanted = row
            print(f"{what:64} {value:10.3f} {unit:6} {wanted}", flush=True)
    if named:
        return
    with open(HERE / "figures.csv", "w", newline="") as out:
        out.write(f"# {processor()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}, Python {sys.version.split()[0]}, "
                  f"NumPy {np.__version__}, carom {carom.__version__}, {time.strftime('%Y-%m-%d')}\n")
        table = csv.writer(out, lineterminator="\n")
        table.writerow(("figure", "value", "unit", "wanted"))
        table.writerows((what, f"{value:.4g}", unit, wanted) for what, value, unit, wanted in rows)


if __name__ == "__main__":
    main()
