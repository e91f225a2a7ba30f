# SPDX-License-Identifier: MIT
"""Ipopt, as the package opens it: with carom's elementary functions in place of the C library's, as in the command."""

import json
import os
import re
import subprocess
import sys

import pytest
from conftest import SCENES

import carom

SCENE = SCENES / "meeting.json"  # whose search calls Ipopt
SOLVE = f"""
import carom
result = carom.Edit.of(carom.Scene.read({str(SCENE)!r})).solve()
print(result.status, *[number.after.hex() for number in result.changed])
"""


def solved(**environment):
    run = subprocess.run([sys.executable, "-c", SOLVE], capture_output=True, text=True, env=dict(os.environ, **environment))
    assert run.returncode == 0, run.stderr
    return run


def test_ipopt_has_our_elementary_functions():
    bindings = solved(LD_DEBUG="bindings").stderr
    for library, function in [("libipopt", "log"), ("libipopt", "pow"), ("libdmumps", "log"), ("liblapack", "log")]:
        found = re.findall(rf"binding file \S*/{library}\S* \[0\] to (\S+) \[0\]: normal symbol `{function}'", bindings)
        assert found, f"{library} asked for no {function}: has the scene stopped calling Ipopt?"
        assert all(path.endswith("/carom/_ipopt.so") for path in found), (library, function, found)


def test_an_edit_has_the_bits_of_the_command():
    answer = solved().stdout
    assert answer == solved(GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX2,-FMA").stdout
    command = os.environ.get("CAROM_COMMAND")
    if not command:
        pytest.skip("the command is not built")
    run = subprocess.run([command, "edit", SCENE, "--json"], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    changes = json.loads(run.stdout)["changed"]
    assert answer.split()[1:] == [float(number["after"]).hex() for number in changes]


def test_a_library_is_named_before_it_is_opened():
    scene = carom.Scene.read(SCENE)
    carom.Edit.of(scene).solve()
    with pytest.raises(carom.InputError, match="open already"):
        carom._carom.set_solver_library("elsewhere.so")
