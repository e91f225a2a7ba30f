# SPDX-License-Identifier: MIT
"""Makes notebooks of the sources beside it, and runs them:  build.py FOLDER [NAME]...

A source is a Python file whose cells begin with `# %%`, those of text with `# %% [markdown]`. What a cell shows is what it
gives when it is run here.
"""

import pathlib
import re
import sys

import nbformat
from nbclient import NotebookClient

SOURCES = pathlib.Path(__file__).resolve().parent


def cells_of(text):
    """(kind, source) of each cell: 'code' or 'markdown'."""
    for head, body in re.findall(r"^# %%(.*)\n((?:(?!# %%).*\n)*)", text, re.MULTILINE):
        if "[markdown]" in head:
            yield "markdown", re.sub(r"^# ?", "", body, flags=re.MULTILINE).strip()
        else:
            yield "code", body.strip()


def run(name):
    """The notebook of a source, after it was run; raises CellExecutionError where a cell does."""
    notebook = nbformat.v4.new_notebook(metadata={"kernelspec": {"name": "python3", "display_name": "Python 3"}})
    for i, (kind, source) in enumerate(cells_of((SOURCES / f"{name}.py").read_text())):
        cell = (nbformat.v4.new_markdown_cell if kind == "markdown" else nbformat.v4.new_code_cell)(source)
        cell["id"] = f"cell-{i}"
        notebook.cells.append(cell)
    NotebookClient(notebook, timeout=None, extra_arguments=["--log-level=40"]).execute()
    return notebook


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    names = sys.argv[2:] or sorted(path.stem for path in SOURCES.glob("*.py") if path.stem != "build")
    for name in names:
        nbformat.write(run(name), folder / f"{name}.ipynb")
        print(folder / f"{name}.ipynb")


if __name__ == "__main__":
    main()
