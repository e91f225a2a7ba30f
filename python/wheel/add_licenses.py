# SPDX-License-Identifier: MIT
"""Puts the licences of all that is inside a repaired wheel into it:  add_licenses.py WHEEL FOLDER

Each library in carom.libs belongs to a Debian package, whose copyright file goes along, and so do those of the headers that
leave code in the module, and the texts that these files refer to: Debian's, and of what Debian has no text the ones in
python/wheel/licenses, which are those of the SPDX list (npm package spdx-license-list 6.12.0, trailing blanks removed).
The wheel is written into FOLDER.
"""

import importlib.metadata
import pathlib
import re
import subprocess
import sys
import tempfile

# Compiled into the module (NOTICE).
HEADERS = ["libeigen3-dev", "nlohmann-json3-dev", "libvalijson-dev", "libtinygltf-dev"]
COMMON = pathlib.Path("/usr/share/common-licenses")
OTHERS = pathlib.Path(__file__).parent / "licenses"


def package_of(library: pathlib.Path) -> str:
    """The Debian package of a library, whose name auditwheel has given a hash."""
    name = re.sub(r"-[0-9a-f]{8}(?=\.)", "", library.name)
    found = subprocess.run(["dpkg-query", "-S", f"*/{name}"], capture_output=True, text=True)
    packages = {line.split(":")[0] for line in found.stdout.splitlines()}
    if len(packages) != 1:
        sys.exit(f"{library.name}: found the packages {sorted(packages)}, expected one that has {name}")
    return packages.pop()


def texts_of_nanobind() -> dict[str, str]:
    """nanobind's licence, and that of the hash table that it brings, from the head of its source."""
    files = importlib.metadata.files("nanobind") or []
    licence = next(file for file in files if file.name == "LICENSE")
    source = next(file for file in files if file.name == "robin_map.h").read_text()
    return {"nanobind": licence.read_text(), "robin_map": re.search(r"/\*\*?(.*?)\*/", source, re.DOTALL)[1]}


def licenses(libraries: list[pathlib.Path]) -> dict[str, str]:
    """Texts by the names of their files."""
    packages = sorted({package_of(library) for library in libraries} | set(HEADERS))
    texts = {name: (pathlib.Path("/usr/share/doc") / name / "copyright").read_text() for name in packages}
    texts |= texts_of_nanobind()
    common = {name for text in texts.values() for name in re.findall(r"common-licenses/([A-Za-z]+-[0-9.]*[0-9])", text)}
    texts |= {name: (COMMON / name).read_text() for name in sorted(common)}
    return texts | {file.stem: file.read_text() for file in sorted(OTHERS.glob("*.txt"))}


def main() -> None:
    wheel, folder = map(pathlib.Path, sys.argv[1:])
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([sys.executable, "-m", "wheel", "unpack", "--dest", work, wheel], check=True, stdout=subprocess.DEVNULL)
        root, = pathlib.Path(work).iterdir()
        info, = root.glob("*.dist-info")
        metadata = info / "METADATA"
        head, text = metadata.read_text().split("\n\n", 1)
        for name, licence in licenses(sorted((root / "carom.libs").iterdir())).items():
            (info / "licenses" / f"{name}.txt").write_text(licence)
            head += f"\nLicense-File: {name}.txt"
        metadata.write_text(head + "\n\n" + text)
        subprocess.run([sys.executable, "-m", "wheel", "pack", "--dest-dir", folder, root], check=True,
                       stdout=subprocess.DEVNULL)


main()
