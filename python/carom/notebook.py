# SPDX-License-Identifier: MIT
"""A motion as a page that plays it in a notebook or in any browser, as `carom export -o motion.html` writes it."""

import html
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

from carom._carom import Motion
from carom.errors import InputError


class Page:
    """A page that plays a motion: view, time line, ghosts, impacts, nails and numbers. A notebook shows it in a frame."""

    def __init__(self, text: str, height: int) -> None:
        self.text = text  #: the HTML text, which needs no network
        self.height = height  #: of the frame, pixels

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the text into a file."""
        pathlib.Path(path).write_text(self.text, encoding="utf-8")

    def _repr_html_(self) -> str:
        return (f'<iframe srcdoc="{html.escape(self.text)}" sandbox="allow-scripts" width="100%" height="{self.height}" '
                'style="border: 0"></iframe>')

    def __repr__(self) -> str:
        return f"<Page of {len(self.text)} characters>"


def _command(command: str | os.PathLike[str] | None) -> str:
    found = command or os.environ.get("CAROM_COMMAND") or shutil.which("carom")
    if not found:
        raise FileNotFoundError("a page is made by the command carom, which was not found: put it on the PATH, or name it in "
                                "`command` or in the environment variable CAROM_COMMAND")
    return os.fspath(found)


def _written(motion: Motion, path: pathlib.Path) -> pathlib.Path:
    """The scene of a motion as a file, for as long as the motion was asked for."""
    motion.scene.write(path)
    document = json.loads(path.read_text(encoding="utf-8"))
    if document.get("duration") != motion.duration:
        path.write_text(json.dumps(document | {"duration": motion.duration}), encoding="utf-8")
    return path


def page(motion: Motion, *, before: Motion | None = None, height: int = 480,
         command: str | os.PathLike[str] | None = None) -> Page:
    """The page of a motion, with the motion `before` behind it. The command carom simulates their scenes again, to the same
    bits, and makes the page; it needs three.js (docs/studio.md).

    Raises FileNotFoundError without the command, InputError with its message if it fails.
    """
    program = _command(command)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene, target = _written(motion, folder / "scene.json"), folder / "motion.html"
        arguments: list[str | pathlib.Path] = [program, "export", "-q", scene, "-o", target]
        if before is not None:
            arguments += ["--before", _written(before, folder / "before.json")]
        run = subprocess.run(arguments, capture_output=True, text=True)
        if run.returncode not in (0, 5):  # 5: a motion that ends early is shown as far as it goes
            raise InputError("", run.stderr.strip().removeprefix("carom: "))
        return Page(target.read_text(encoding="utf-8"), height)
