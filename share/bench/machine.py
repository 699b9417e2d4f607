"""Where and when the bench ran: processor, memory, libraries, commit."""
import datetime
import os
import platform
import re
import statistics
import subprocess

from problems import TOP
from runs import SOURCES, source_version

MACROS = {
    "PETSc": ("petscversion.h", ("PETSC_VERSION_MAJOR", "PETSC_VERSION_MINOR", "PETSC_VERSION_SUBMINOR")),
    "hypre": ("HYPRE_config.h", ("HYPRE_RELEASE_VERSION", )),
    "MUMPS": ("dmumps_c.h", ("MUMPS_VERSION", )),
}


def first_match(pattern, path):
    try:
        with open(path) as file:
            found = re.search(pattern, file.read(), re.M)
    except OSError:
        found = None
    return found.group(1).strip() if found else "unknown"


def petsc_flags():
    return subprocess.run(["pkg-config", "--cflags", "PETSc"], capture_output=True, text=True).stdout.split()


def library_version(header, names):
    """From the headers the programs were compiled with"""
    command = ["mpicc", *petsc_flags(), "-I/usr/include/hypre", "-E", "-dM", "-include", header, "-x", "c", "/dev/null"]
    try:
        macros = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return "unknown"
    found = [re.search(rf"#define {name} (.*)", macros) for name in names]
    return ".".join(f.group(1).strip('"') for f in found) if all(found) else "unknown"


def describe():
    memory = first_match(r"^MemTotal: *(\d+)", "/proc/meminfo")
    return {
        "processor": first_match(r"^model name\s*: (.*)", "/proc/cpuinfo"),
        "cores": os.cpu_count(),
        "memory_bytes": int(memory) * 1024 if memory.isdigit() else None,
        "system": platform.platform(),
        "versions": {name: library_version(*where)
                     for name, where in MACROS.items()},
    }


def commit():
    """Of the sources, and whether they have changed since; elsewhere than in a clone the fingerprint of the sources"""
    git = lambda *words: subprocess.run(["git", "-C", TOP, *words], capture_output=True, text=True).stdout.strip(
    )  # noqa: E731
    found = git("log", "-1", "--format=%h")
    changed = git("status", "--porcelain", "--untracked-files=no", "--", *SOURCES, "share/bench/*.py")
    return (f"commit {found}" + (" and later changes" if changed else "")) if found else "sources " + source_version()


def header(loads):
    """Rows of the table with which a page says where and when its runs were made; loads: load averages of the machine
    when they ended"""
    where = describe()
    memory = f", {where['memory_bytes'] / 2**30:.0f} GiB" if where["memory_bytes"] else ""
    load = f"{statistics.median(loads):.1f}; 1.0 is a run alone" if loads else "not measured"
    return (f"| date | {datetime.date.today()} |", f"| sources | {commit()} |",
            f"| machine | {where['processor']}, {where['cores']} cores{memory} |",
            "| libraries | " + ", ".join(f"{name} {version}" for name, version in where["versions"].items()) + " |",
            f"| load average of the machine, median | {load} |")
