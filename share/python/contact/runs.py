"""Runs the program on a scene."""
import os
import subprocess
import tempfile

from .files import ContactError
from .places import program
from .results import Run


def words_of(options):
    """refine=1 is -refine 1; quiet=True is -quiet; False and None are left out"""
    for key, value in options.items():
        if value is not None and value is not False:
            yield "-" + key
            if value is not True:
                yield ",".join(map(str, value)) if isinstance(value, (list, tuple)) else str(value)


def run(scene, output=None, ranks=1, check=True, **options):
    """Runs contact on a scene and returns its results

    scene: the file; output: base name of the results, by default in a new temporary folder; ranks: of MPI. Options are
    those of the program: refine=1, accuracy=1e-3. A run that does not end with exit code 0 raises ContactError, with
    what the program said; check=False returns the results of one that ended with 2, 3 or 4 all the same.
    """
    scene = os.fspath(scene)
    if not os.path.exists(scene):
        raise ContactError(f"there is no scene {scene}")
    base = output or os.path.join(tempfile.mkdtemp(prefix="contact-"), os.path.splitext(os.path.basename(scene))[0])
    command = [program(), scene, "-quiet", "-output", os.fspath(base), "-summary", f"{base}.json", *words_of(options)]
    if ranks > 1:
        command = ["mpiexec", "-n", str(ranks), *command]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode and (check or done.returncode not in (2, 3, 4)):
        said = [line for line in done.stderr.splitlines() if line.startswith("contact: ")
                ] or done.stderr.strip().splitlines()[-1:]
        raise ContactError(f"{scene} ended with exit code {done.returncode}: " + " ".join(said))
    return Run(os.fspath(base))
