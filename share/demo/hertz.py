"""The demonstration: solves Hertz's cylinder, compares with his closed form, and draws the stress beneath the contact.

    python share/demo/hertz.py FOLDER      from the top folder, after make
"""
import json
import os
import subprocess
import sys
import time

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(TOP, "share", "scenes"), os.path.join(TOP, "share", "plot")]
import hertz_solution

SCENE = os.path.join("share", "scenes", "hertz_cylinder.yaml")


def solve(base):
    """Seconds that the run took"""
    command = [os.path.join("bin", "contact"), SCENE, "-quiet", "-output", base, "-summary", base + ".json"]
    print("$ " + " ".join(command), flush=True)
    begin = time.monotonic()
    code = subprocess.run(command, cwd=TOP).returncode
    if code:
        sys.exit(f"demo: contact ended with exit code {code}")
    return time.monotonic() - begin


def rows(base):
    """Name, computed value and Hertz's value, at the displacement that the scene prescribes"""
    problem = hertz_solution.Cylinder()
    run = hertz_solution.measure(problem, os.path.join(TOP, base))
    with open(os.path.join(TOP, base + ".json")) as file:
        energy = json.load(file)["steps"][-1]["energy"] / problem.share
    force, work = problem.loaded()
    pressure, width, _ = problem.at(force)
    yield "peak pressure", run["peak pressure"], pressure
    yield "half-width of the contact", run["contact radius"], width
    yield "force per length", run["force"], force
    yield "elastic energy per length", energy, work


def draw(base):
    """Whether there is a picture; without VTK there is none, and draw.py says why"""
    script = os.path.join(TOP, "share", "plot", "draw.py")
    options = "--field nodal_von_mises --mirror x --around-contact 6 --view 0 -90".split()
    title = ["--title", "Hertz's cylinder: stress beneath the contact"]
    command = [sys.executable, "-B", script, base, base + ".png", *options, *title]
    return subprocess.run(command, cwd=TOP).returncode == 0


def main():
    base = os.path.join(sys.argv[1], "hertz_cylinder")
    os.makedirs(os.path.join(TOP, sys.argv[1]), exist_ok=True)
    print("An elastic cylinder is pressed on a rigid plane. Hertz's formula of 1882 has the exact answer.")
    seconds = solve(base)
    with open(os.path.join(TOP, base + ".json")) as file:
        run = json.load(file)
    print(f"Solved for {run['dofs']:,} unknowns in {seconds:.1f} s:")
    print(f"{'':28}{'computed':>11}{'Hertz':>11}{'difference':>13}")
    for name, computed, exact in rows(base):
        print(f"  {name:26}{computed:11.4g}{exact:11.4g}{100 * (computed / exact - 1):+11.2f} %")
    estimate = run["steps"][-1]["error_estimate"]**2
    print(f"The program itself estimates its error in energy at {100 * estimate:.2f} %.")
    if draw(base):
        print(f"Picture:  {base}.png")
    print(f"ParaView: {base}.xmf")


if __name__ == "__main__":
    main()
