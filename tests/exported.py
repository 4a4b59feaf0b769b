# SPDX-License-Identifier: Apache-2.0
"""Whether the shared library exports what its public headers mark, and nothing else, and whether
they mark all that they declare and do not define: exported.py NM LIBRARY HEADERS."""

import pathlib
import re
import subprocess
import sys

# Of an exported class, what the compiler adds.
GENERATED = re.compile(r"^(?:typeinfo for |typeinfo name for |vtable for )")
ARGUMENTS = re.compile(r"[(<\[].*")
MARKED = re.compile(r"LEAFHULL_API\s(?:[^;{(]*?[\s&*])?(~?\w+|operator=)(?=\(| : | \{)")

# What a scan for declarations passes over: comments, directives, text.
PASSED_OVER = re.compile(r"//.*|^\s*#.*|\"[^\"]*\"", re.MULTILINE)
TEMPLATE_ARGUMENTS = re.compile(r"<[^<>;{}]*>")
PARTS = re.compile(r"[{};:]|[^{};:]+")
SCOPE = re.compile(r"\b(namespace|struct|class)\b[^()]*$")
FUNCTION = re.compile(r"(~?\w+|operator\W+?)\((?!\*)")
# It has a mark, is defined elsewhere in the headers, or declares no function of its own.
NEEDS_NO_MARK = re.compile(
    r"LEAFHULL_API|\b(?:inline|constexpr|template|friend|using|static_assert)\b"
    r"|= (?:default|delete|0)$"
)


def unmarked(header):
    """The functions that a header declares for its readers, but neither marks nor defines."""
    text = PASSED_OVER.sub("", header)
    while TEMPLATE_ARGUMENTS.search(text):
        text = TEMPLATE_ARGUMENTS.sub("", text)
    names, statement = [], ""
    # Whether each, from the outermost in, shows what it declares; None: it never does.
    scopes = [True]
    for part in PARTS.findall(text):
        if part == "{":
            scope = SCOPE.search(statement)
            is_body = statement.count("(") == statement.count(")") > 0
            is_open = scope and "LEAFHULL_API" not in statement
            scopes.append(scope[1] != "class" if is_open else None)
            statement = "" if scope or is_body else statement
        elif part == "}":
            scopes.pop()
        elif part == ";":
            function = FUNCTION.search(statement)
            if all(scopes) and function and not NEEDS_NO_MARK.search(statement.rstrip()):
                names.append(function[1])
            statement = ""
        elif part == ":" and statement.strip() in ("public", "protected", "private"):
            if scopes[-1] is not None:
                scopes[-1] = statement.strip() == "public"
            statement = ""
        else:
            statement += part
    return names


def exported(nm, library):
    """The names that the library exports, without their arguments."""
    listed = subprocess.run(
        [nm, "-D", "--defined-only", "-C", library], check=True, capture_output=True, text=True
    ).stdout
    symbols = [GENERATED.sub("", line.split(maxsplit=2)[2]) for line in listed.splitlines()]
    return {ARGUMENTS.sub("", symbol).removeprefix("leafhull::") for symbol in symbols}


def main(nm, library, headers):
    paths = sorted(set(pathlib.Path(headers).glob("*.h")) - {pathlib.Path(headers) / "api.h"})
    text = "\n".join(path.read_text(encoding="utf-8") for path in paths)
    words = set(re.findall(r"operator=|~?\w+", text))
    marked = set(MARKED.findall(re.sub(r"//.*", "", text)))
    names = exported(nm, library)
    faults = [
        f"{library} exports {name}, which no public header declares"
        for name in sorted(names)
        if not set(name.split("::")) <= words
    ]
    last = {name.split("::")[-1] for name in names}
    faults += [f"{library} does not export {name}" for name in sorted(marked - last)]
    faults += [
        f"{path.name} declares {name} without LEAFHULL_API"
        for path in paths
        for name in unmarked(path.read_text(encoding="utf-8"))
    ]
    print("\n".join(faults) or f"{len(names)} names, all of them public")
    return bool(faults) or not names


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
