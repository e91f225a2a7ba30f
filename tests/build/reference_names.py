#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every type, function, enumeration, constant and macro of the public headers is in the reference.

usage: reference_names.py TAGFILE HEADER...

The headers are formatted: what stands in namespace carom begins a line. Private namespaces are left out.
"""
import re
import sys

DECLARATIONS = [
    r"(?:struct|class|enum class|enum) (\w+)(?: final)?(?: : .*)? \{",
    r"using (\w+) = ",
    r"(?:inline )?constexpr [^=({]*?(\w+)(?:\[\w*\])?(?: = |\{)",
    r"concept (\w+) = ",
    r"#define (\w+)",
    r"(?!using |return |namespace |static_assert|template |requires|friend )[A-Za-z_][\w:<>,&* ]*[ &*](\w+)\(",
]


# Not for users, though installed.
PRIVATE = r"namespace ([\w:]*(?:detail|small_matrices|shapes))\w* \{"


def declared_names(text):
    names, end = set(), None
    for line in text.splitlines():
        private = re.match(PRIVATE, line)
        if private:
            told = "}  // namespace " + private.group(1)
            end = told if told in text else "}"
        if end is None:
            for declaration in DECLARATIONS:
                match = re.match(declaration, line)
                if match and not line.rstrip().endswith("= delete;"):
                    names.add(match.group(1))
        elif line == end:
            end = None
    return names


def main(tag_file, headers):
    with open(tag_file, encoding="utf-8") as file:
        known = {name.split("::")[-1] for name in re.findall(r"<name>([^<]*)</name>", file.read())}
    found, missing = 0, []
    for header in headers:
        if not header.endswith(".h"):
            continue
        with open(header, encoding="utf-8") as file:
            names = declared_names(file.read())
        found += len(names)
        missing += [f"{name} of {header}" for name in sorted(names - known)]
    print(f"{found} names in {len(headers)} files, {len(missing)} not in the reference")
    for name in missing:
        print("  " + name)
    return 1 if missing or found < 280 else 0


planted = "struct Known {\nint lone(double x);\nnamespace a_detail {\nint hidden();\n}\ninline constexpr int kOne = 1;\n"
assert declared_names(planted) == {"Known", "lone", "kOne"}, declared_names(planted)
sys.exit(main(sys.argv[1], sys.argv[2:]))
