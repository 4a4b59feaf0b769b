# SPDX-License-Identifier: Apache-2.0
"""Whether the shared library exports what its public headers mark, and nothing else:
exported.py NM LIBRARY HEADERS."""

import pathlib
import re
import subprocess
import sys

# Of an exported class, what the compiler adds.
GENERATED = re.compile(r"^(?:typeinfo for |typeinfo name for |vtable for )")
ARGUMENTS = re.compile(r"[(<\[].*")
MARKED = re.compile(r"LEAFHULL_API\s(?:[^;{(]*?[\s&*])?(~?\w+|operator=)(?=\(| : | \{)")


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
    print("\n".join(faults) or f"{len(names)} names, all of them public")
    return bool(faults) or not names


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
