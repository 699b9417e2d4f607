"""Where the bench ran: processor, memory, libraries, and the bandwidth of STREAM's triad."""
import os
import platform
import re
import subprocess

from problems import TOP

MACROS = {
    "PETSc": ("petscversion.h", ("PETSC_VERSION_MAJOR", "PETSC_VERSION_MINOR", "PETSC_VERSION_SUBMINOR")),
    "hypre": ("HYPRE_config.h", ("HYPRE_RELEASE_VERSION",)),
    "MUMPS": ("dmumps_c.h", ("MUMPS_VERSION",)),
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
        "versions": {name: library_version(*where) for name, where in MACROS.items()},
    }


def triad(sizes):
    """(bytes of the working set, byte/s) for every size"""
    program = os.path.join(TOP, "build", "bench", "triad")
    lines = subprocess.run([program, *(f"{size:.0f}" for size in sizes)], capture_output=True, text=True, check=True).stdout.splitlines()
    return [tuple(map(float, line.split())) for line in lines]
