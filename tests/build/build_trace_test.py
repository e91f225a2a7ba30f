# SPDX-License-Identifier: MIT
"""The sums of scripts/build_trace over two small traces made up here, and what it says where there is nothing to sum."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "build_trace"


def event(name, start, time, detail=None):
    row = {"ph": "X", "tid": 1, "name": name, "ts": start, "dur": time}
    return row if detail is None else row | {"args": {"detail": detail}}


# Seconds are of a million; every trace: 10 s, of which 6 are before and 3 after the intermediate code.
def trace(header):
    second = 1000000
    rows = [("ExecuteCompiler", 0, 10), ("Frontend", 0, 6),
            ("Source", 0, 3, header), ("Source", 1, 1, "inner.h"), ("Source", 1, 0.5, header),
            ("InstantiateClass", 2, 1, "Matrix<int, List<2>>"),
            ("PerformPendingInstantiations", 3, 2),
            ("InstantiateFunction", 3, 2, "apply<int>"), ("InstantiateFunction", 3, 1, "operator<<<int>"),
            ("InstantiateClass", 4, 0.5, "Matrix<int>"),
            ("CodeGen Function", 5, 0.5, "apply<int>"),
            ("Optimizer", 6, 2), ("InlinerPass", 6, 0.5), ("PassManager", 7, 1, "_Z5applyv"), ("GVNPass", 7, 0.5, "_Z5applyv"),
            ("CodeGenPasses", 8, 1), ("OptModule", 8, 1, "_Zero.cpp"), ("OptFunction", 8, 0.5, "_Z5applyv"),
            ("Total Source", 0, 3), ("Total Frontend", 0, 6)]
    events = [event(name, start * second, time * second, *detail) for name, start, time, *detail in rows]
    return {"traceEvents": events + [{"ph": "M", "name": "process_name", "args": {"name": "clang"}}]}


class BuildTrace(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = pathlib.Path(self.folder.name) / "part" / "CMakeFiles" / "library.dir" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def run_program(self, *arguments):
        return subprocess.run([sys.executable, str(PROGRAM), *arguments], capture_output=True, text=True)

    def read(self, *arguments):
        answer = self.run_program("--read", self.folder.name, *arguments)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        return answer.stdout

    def rows(self, text, title):
        lines = text.split("\n\n" + title, 1)[1].split("\n\n")[0].splitlines()[2:]
        return [line.split(None, 3) for line in lines]

    def test_sums(self):
        self.write("sub/one.cpp.json", json.dumps(trace("one.h")))
        self.write("two.cpp.json", json.dumps(trace("two.h")))
        self.write("no_trace.json", "{}")
        text = self.read()
        head = [line.split(None, 3) for line in text.split("\n\n")[0].splitlines()]
        self.assertEqual(" ".join(head[0]), "2 objects, 20.0 s")
        self.assertEqual([(row[0], row[3]) for row in head[1:]], [
            ("5.00", "parsing"), ("3.00", "instantiating classes"), ("3.00", "instantiating functions"),
            ("1.00", "writing intermediate code"), ("4.00", "optimising"), ("2.00", "generating code"), ("2.00", "other")])
        self.assertEqual(sorted(line.split() for line in text.split("\n\nobjects\n")[1].split("\n\n")[0].splitlines()[1:]),
                         [["10.00", "part/sub/one.cpp"], ["10.00", "part/two.cpp"]])
        self.assertEqual(sorted(self.rows(text, "headers")),
                         [["2.00", "2", "2", "inner.h"], ["3.00", "1", "1", "one.h"], ["3.00", "1", "1", "two.h"]])
        self.assertEqual(sorted(self.rows(text, "templates")), [
            ["1.00", "2", "2", "apply"], ["2.00", "2", "2", "operator<<"], ["3.00", "4", "2", "class Matrix"]])
        self.assertEqual(sorted(self.rows(text, "instantiations")), [
            ["2.00", "2", "2", "class Matrix<int, List<2>>"], ["4.00", "2", "2", "apply<int>"]])
        [function] = self.rows(text, "functions")
        self.assertEqual(function[:3], ["3.00", "4", "2"])
        self.assertIn(function[3], ("apply()", "_Z5applyv"))  # as there is a demangler or not

    def test_lists_are_as_long_as_asked_for(self):
        self.write("one.cpp.json", json.dumps(trace("one.h")))
        self.assertEqual(len(self.rows(self.read("--top", "1"), "templates")), 1)
        self.assertEqual(self.rows(self.read(), "instantiations"), [])  # no other object repeats them

    def test_errors(self):
        answer = self.run_program("--read", self.folder.name)
        self.assertEqual(answer.returncode, 1)
        self.assertIn("no traces below", answer.stderr)
        answer = self.run_program("--read", self.folder.name + "/nothing")
        self.assertIn("there is no folder", answer.stderr)
        self.write("cut.cpp.json", '{"traceEvents": [')
        answer = self.run_program("--read", self.folder.name)
        self.assertEqual(answer.returncode, 1)
        self.assertIn("cut.cpp.json is not a trace of clang", answer.stderr)
        self.assertEqual(self.run_program("--read", self.folder.name, "carom").returncode, 2)

    def test_only_clang(self):
        answer = subprocess.run([sys.executable, str(PROGRAM)], capture_output=True, text=True, env={"CXX": "g++", "PATH": ""})
        self.assertEqual(answer.returncode, 1)
        self.assertIn("only clang traces its time", answer.stderr)


if __name__ == "__main__":
    unittest.main()
