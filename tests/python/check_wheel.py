# SPDX-License-Identifier: MIT
"""Tests a wheel as scripts/wheel makes it, in a fresh environment:  check_wheel.py WHEEL

It installs the wheel with what it requires, checks its size and its licences, and lets the installed package simulate,
differentiate and edit there. What that process has opened then is the system's C and C++ library, and else from the wheel.
"""

import importlib.util
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
    "NOTICE": "EPL-1.0", "libeigen3-dev": "MPL", "nlohmann-json3-dev": "Niels Lohmann", "nanobind": "Wenzel Jakob",
}
# Of every licence that NOTICE names, the file that has its text, and how an early and a late sentence of it begin.
BSD = "Redistributions in binary form must reproduce"
WARRANTY_BSD = "IN ANY WAY OUT OF THE USE"
GPL = ("Everyone is permitted to copy and distribute verbatim copies", "END OF TERMS AND CONDITIONS")
TEXTS = {
    "EPL-1.0": ("EPL-1.0", "Eclipse Public License - v 1.0", "This Agreement is governed by the laws of the State of New York"),
    "CeCILL-C": ("CeCILL-C", "CeCILL-C FREE SOFTWARE LICENSE AGREEMENT", "Version 1.0 dated 2006-09-05"),
    "BSD-3-Clause": ("libblas3", BSD, WARRANTY_BSD), "BSD-2-Clause": ("libvalijson-dev", BSD, WARRANTY_BSD),
    "GPL-3.0-or-later": ("GPL-3", *GPL), "LGPL-2.0-or-later": ("LGPL-2", *GPL), "LGPL-2.1-or-later": ("LGPL-2.1", *GPL),
    "GCC Runtime Library Exception 3.1": ("libgfortran5", "GCC RUNTIME LIBRARY EXCEPTION", "Grant of Additional Permission"),
    "Apache-2.0": ("Apache-2.0", "Apache License Version 2.0", "END OF TERMS AND CONDITIONS"),
    "MIT": ("nlohmann-json3-dev", "Permission is hereby granted", "DEALINGS IN THE SOFTWARE"),
    "MPL-2.0": ("libeigen3-dev", "Mozilla Public License Version 2.0", "Incompatible With Secondary Licenses"),
    "BSL-1.0": ("libvalijson-dev", "Boost Software License - Version 1.0", "DEALINGS IN THE SOFTWARE"),
    "bzip2": ("libbz2-1.0", "The origin of this software must not be misrepresented", WARRANTY_BSD),
    "Qhull": ("libqhull-r8.0", "All copyright notices must remain intact", "modified"),
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
# An objective of one's own is left to Ipopt.
def height(motion):
    return carom.Reading(motion.state_at("ball", 0.2).position[2], [carom.Seed("ball", 0.2, position=(0, 0, 1))])
own = carom.Edit(scene)
own.vary(carom.velocity("ball"))
own.nail("ball", 0.3).position(motion.state_at("ball", 0.3).position[0] + 0.1, None, None)
own.minimise("height", height, change_weight=1, until=0.3)
assert own.solve(effort="fast").solved
from carom import _carom
print("handler:", bool(_carom.xla_handler()))
for line in sorted({line.split()[-1] for line in open("/proc/self/maps") if ".so" in line}):
    print("open:", line)
"""


def check_texts(files: zipfile.ZipFile, folder: str) -> None:
    """The text of every licence that NOTICE names for what is shipped is there in full."""
    table = files.read(f"{folder}/NOTICE").decode().split("Tests of the studio's page", 1)[0]
    table = table.replace("(EPL-2.0 since 3.13.3)", "")  # of other versions than that in the wheel
    named = set(re.findall(r"\b(?:[A-Z][A-Za-z]*-[0-9][.0-9]*(?:-Clause|-or-later)?|CeCILL-C|MIT|Zlib|bzip2(?= \()|Qhull(?= \(BSD)|"
                           r"GCC Runtime Library Exception [.0-9]+)(?![-\w])", table))
    named.remove("Zlib")  # the system's zlib is used
    assert named == set(TEXTS), f"in NOTICE or here alone: {sorted(named ^ set(TEXTS))}"
    for licence, (file, *phrases) in TEXTS.items():
        text = " ".join(files.read(f"{folder}/{file}.txt").decode().split())
        for phrase in phrases:
            assert phrase in text, f"{licence}: expected {phrase!r} in {file}.txt"


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
        check_texts(files, metadata.replace("METADATA", "licenses"))
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
        with_headers = importlib.util.find_spec("jaxlib") is not None  # where it was built
        assert f"handler: {with_headers}\n" in use.stdout, use.stdout
        opened = re.findall("^open: (.*)$", use.stdout, re.MULTILINE)
        ours = {pathlib.Path(path).name.split("-")[0] for path in opened if "/carom.libs/" in path}
        assert {"libipopt", "libdmumps_seq", "libode", "libqhull_r", "libtbb", "liblapack"} <= ours, ours
        foreign = [path for path in opened if not path.startswith(folder) and not SYSTEM.search(path)
                   and "/lib-dynload/" not in path]
        assert not foreign, f"not from the wheel: {foreign}"
    print(f"{wheel.name}: {wheel.stat().st_size} bytes, {len(opened)} libraries open")


main()
