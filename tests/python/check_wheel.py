# SPDX-License-Identifier: MIT
"""Tests a wheel as scripts/wheel makes it, in a fresh environment:  check_wheel.py WHEEL

It installs the wheel with what it requires, checks its size and its licences, and lets the installed package simulate,
differentiate and edit there. What that process has opened then is the system's C and C++ library, and else from the wheel.
"""

import io
import pathlib
import re
import subprocess
import sys
import tempfile
import venv
import zipfile

from elftools.elf.elffile import ELFFile

LIMIT = 12_000_000  # bytes
SCENES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "scenes"
LICENSES = {  # a phrase that the text of each has
    "coinor-libipopt1v5": "Common Public License", "libmumps-seq-5.5": "CeCILL-C", "libscotch-7.0": "CeCILL-C",
    "libode8": "Russell L. Smith", "libqhull-r8.0": "Barber", "libtbb12": "Apache", "libgfortran5": "GCC Runtime Library",
    "libquadmath0": "GCC Runtime Library", "liblapack3": "University of Tennessee", "libblas3": "University of Tennessee",
    "NOTICE": "EPL-1.0", "libeigen3-dev": "MPL", "nlohmann-json3-dev": "Niels Lohmann", "nanobind": "Wenzel Jakob", "Apache-2.0": "Apache License",
}
# Of the system: what every Python has loaded, or the tags of the wheel promise.
SYSTEM = re.compile(r"/(ld-linux|lib(c|m|dl|rt|util|pthread|gcc_s|stdc\+\+|z|expat|crypto|ssl|uuid|ffi|mvec))"
                    r"[-.\w]*\.so[.\d]*$")

USE = """
import sys
import numpy
import carom
scene = carom.Scene.read(sys.argv[1])
motion = carom.simulate(scene)
assert motion.status == "complete", motion
seed = carom.Seed("ball", motion.end, position=(1, 0, 0))
assert carom.adjoint(motion, seed).reliability.reliable
result = carom.Edit.of(scene).solve()
assert result.solved, result
print(result)
# An equation out of reach is left to Ipopt, whatever came before.
hard = carom.Edit(scene)
hard.vary(carom.velocity("ball", min=-1, max=1))
hard.nail("ball", motion.end).position(100, None, None)
assert not hard.solve(effort="fast").solved
for line in sorted({line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}):
    print("open:", line)
"""


def main() -> None:
    wheel = pathlib.Path(sys.argv[1]).resolve()
    assert "manylinux" in wheel.name, wheel.name
    assert wheel.stat().st_size <= LIMIT, f"{wheel.stat().st_size} bytes, expected at most {LIMIT}"
    with zipfile.ZipFile(wheel) as files:
        metadata, = (name for name in files.namelist() if name.endswith(".dist-info/METADATA"))
        head = files.read(metadata).decode()
        for name, phrase in LICENSES.items():
            file = name if name == "NOTICE" else f"{name}.txt"
            text = files.read(metadata.replace("METADATA", f"licenses/{file}")).decode()
            assert phrase in text, f"{name}: expected {phrase!r}"
            assert f"\nLicense-File: {file}\n" in head, name
        assert re.findall(r"^Requires-Dist: (\w+).*", head, re.MULTILINE) == ["numpy"]
        for name in files.namelist():  # read-only relocations, which an old mold does not give
            if re.fullmatch(r"carom/_\w+[.\w-]*\.so", name):
                segments = ELFFile(io.BytesIO(files.read(name))).iter_segments()
                assert any(segment["p_type"] == "PT_GNU_RELRO" for segment in segments), name
    with tempfile.TemporaryDirectory() as folder:
        venv.create(folder, with_pip=True)
        python = pathlib.Path(folder) / "bin" / "python"
        subprocess.run([python, "-m", "pip", "--quiet", "--disable-pip-version-check", "install", wheel], check=True)
        use = subprocess.run([python, "-I", "-c", USE, SCENES / "bounce.json"], capture_output=True, text=True, cwd=folder)
        assert use.returncode == 0, use.stderr
        opened = re.findall("^open: (.*)$", use.stdout, re.MULTILINE)
        ours = {pathlib.Path(path).name.split("-")[0] for path in opened if "/carom.libs/" in path}
        assert {"libipopt", "libdmumps_seq", "libode", "libqhull_r", "libtbb", "liblapack"} <= ours, ours
        foreign = [path for path in opened if not path.startswith(folder) and not SYSTEM.search(path)
                   and "/lib-dynload/" not in path]
        assert not foreign, f"not from the wheel: {foreign}"
    print(f"{wheel.name}: {wheel.stat().st_size} bytes, {len(opened)} libraries open")


main()
