# SPDX-License-Identifier: Apache-2.0
"""fake_contender.py NAME LOG [FAULT]: answers like a contender and writes its name to LOG at each
run. FAULT: refuse (sends an error instead of ready), crash:N (exits at run N), mute (never
answers), slow (reports that each run takes a minute)."""

import json
import sys
import time

name, log, fault = [*sys.argv[1:], ""][:3]


def say(values: dict) -> None:
    print(json.dumps(values), flush=True)


if fault == "refuse":
    say({"error": "out of order"})
    sys.exit(1)
if fault == "mute":
    time.sleep(60)
print("chatter of a library")
say({"ready": True, "name": name, "version": "7", "setup": {"open": 0.5}})
for number, line in enumerate(sys.stdin, 1):
    if line != "run\n":
        break
    if fault == f"crash:{number}":
        sys.exit("the roof fell in")
    with open(log, "a") as file:
        file.write(name)
    total = 60 if fault == "slow" else 1 + number
    say({"field": 0.25, "mesh": None, "total": total, "stages": {"hash": 0.125}, "vertices": 8})
