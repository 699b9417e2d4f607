"""Starts a program with a time limit, and says how it ended."""
import json
import os
import resource
import signal
import subprocess


def environment():
    """Root may start ranks; a rank that waits leaves its core to others; no rank makes threads"""
    return dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                OMPI_MCA_mpi_yield_when_idle="1", OMP_NUM_THREADS="1")


def end(process):
    """mpiexec must have the time to end its ranks"""
    process.terminate()
    try:
        return process.communicate(timeout=10)[0]
    except subprocess.TimeoutExpired:
        process.kill()
        return process.communicate()[0]


def execute(command, limit):
    """Exit code, what was said, whether the limit ended it; a run that is asked to end still writes its summary"""
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment(),
                          errors="replace") as process:
        try:
            said, _ = process.communicate(timeout=limit)
            return process.returncode, said, False
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGUSR1)
        except BaseException:
            end(process)
            raise
        try:
            said, _ = process.communicate(timeout=max(5.0, 0.3 * limit))
        except subprocess.TimeoutExpired:
            said = end(process)
        return process.returncode, said, True


def last_words(said):
    """The sentence of ours, or the first that PETSc says"""
    lines = [line.strip() for line in said.splitlines() if line.strip()]
    ours = [line for line in lines if line.startswith("contact: ")]
    petsc = [line.split("ERROR: ", 1)[1] for line in lines if "PETSC ERROR: " in line and "----" not in line]
    return (ours[-1:] or petsc[:1] or lines[-1:] or [""])[0][:300]


def user_seconds():
    """User processor time of all programs that have ended"""
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime


def read_summary(base):
    """What a run has written of itself; None where it has not come to that"""
    if not os.path.exists(base + ".json"):
        return None
    with open(base + ".json") as file:
        return json.load(file)
