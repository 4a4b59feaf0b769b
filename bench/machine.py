# SPDX-License-Identifier: Apache-2.0
"""What the results were measured on and with."""

import os
import platform
import re
import subprocess
from pathlib import Path

PACKAGES = {
    "PoCL": "libpocl2",
    "OpenVDB": "libopenvdb-dev",
    "oneTBB": "libtbb-dev",
    "CGAL": "libcgal-dev",
}


def output_of(*command: str) -> str:
    """Empty where there is no such command or it fails."""
    try:
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()
    except (FileNotFoundError, subprocess.CalledProcessError):
        return ""


def field(file: str, name: str) -> str:
    found = re.search(rf"^{name}\s*[:=]\s*(.*)$", Path(file).read_text(), re.MULTILINE)
    return found[1].strip('"') if found else "unknown"


def cpu() -> str:
    return field("/proc/cpuinfo", "model name")


def gpus(leafhull: Path) -> str:
    lines = output_of(str(leafhull), "devices").splitlines()
    found = [line.strip() for line in lines if re.search(r"\sGPU\s\s", line)]
    return "; ".join(found) or "none was available"


def describe(root: Path, leafhull: Path) -> dict[str, str]:
    memory = int(field("/proc/meminfo", "MemTotal").split()[0]) / 2**20
    versions = {
        name: output_of("dpkg-query", "-W", "-f", "${Version}", package) or "not installed"
        for name, package in PACKAGES.items()
    }
    return {
        "CPU": cpu(),
        "cores": str(len(os.sched_getaffinity(0))),
        "memory": f"{memory:.0f} GiB",
        "GPU": gpus(leafhull),
        "OS": field("/etc/os-release", "PRETTY_NAME"),
        "compiler": output_of("g++", "--version").split("\n")[0],
        **versions,
        "Python": platform.python_version(),
        "leafhull": output_of("git", "-C", str(root), "describe", "--always", "--dirty"),
        "load at the start": f"{os.getloadavg()[0]:.2f}",
    }
