"""Runs cases whose values others published, and writes a page with their values and ours: cases.py [--only NAME,...]

Scenes, summaries and the page cases.md are in build/published/cases. The exit code is 1 if a value is not within its
tolerance."""
import argparse
import json
import math
import os
import resource
import subprocess
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(TOP, "share", "bench"))
import machine

FOLDER = os.path.join(TOP, "build", "published", "cases")


class Value:
    """A published value, or the range (low, high) of several programs; ours is a function of the summary"""

    def __init__(self, what, published, ours, tolerance, note=""):
        self.what, self.published, self.ours, self.tolerance, self.note = what, published, ours, tolerance, note

    def difference(self, value):
        low, high = self.published if isinstance(self.published, tuple) else (self.published, self.published)
        nearest = min(max(value, low), high)
        return 100 * (value - nearest) / abs(nearest)


class Case:
    """A scene and its values. The scene is text, or the name of a file in share/scenes or of one that a test makes"""

    def __init__(self, name, title, source, scene, *values, maker="", options=()):
        self.name, self.title, self.source, self.scene, self.values = name, title, source, scene, values
        self.maker, self.options = maker, options

    def run(self):
        """The summary of a run and its user time; None if the run did not end right"""
        scene = os.path.join(TOP, "share", "scenes", self.scene)
        if self.maker:
            subprocess.run([sys.executable, os.path.join(TOP, "tests", "step", self.maker), "scenes"], check=True,
                           env=dict(os.environ, PYTHONPATH=os.path.join(TOP, "tests", "lib")))
            scene = self.scene
        elif "\n" in self.scene:
            scene = self.name + ".yaml"
            with open(scene, "w", encoding="utf-8") as file:
                file.write(self.scene)
        summary = self.name + ".json"
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        command = [os.path.join(TOP, "bin", "contact"), scene, "-quiet", "-summary", summary, *self.options]
        ended = subprocess.run(command, capture_output=True, text=True)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        if ended.returncode:
            print(f"{self.name}: exit code {ended.returncode}: {ended.stderr.strip()[-200:]}", file=sys.stderr)
            return None, seconds
        with open(summary, encoding="utf-8") as file:
            return json.load(file), seconds


def figure(quantity, name=None):
    """Our value is an entry of the list of largest values"""
    return lambda run: max(one["value"] for one in run["figures"]
                           if one["quantity"] == quantity and name in (None, one["name"]))


def moved(probe, axis):
    return lambda run: next(one["displacement"][axis] for one in run["steps"][-1]["probes"] if one["name"] == probe)


def pair(key, factor=1, step=-1):
    return lambda run: factor * sum(one[key] for one in run["steps"][step]["pairs"])


# The push is horizontal, the weight vertical; axes are those of the incline
PUSHED = """problem: incline
bodies:
  - plane: {{shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}}
  - block: {{lower: [0, 0, 0], upper: [4, 2, 1], cells: [4, 2, 2], young: 2e5, poisson: 0.3}}
displacements:
  - fix: {{body: plane, value: [0, 0, 0]}}
forces:
  - weight: {{face: block.zmax, value: [{0}, 0, {1}]}}
  - push: {{face: block.xmin, value: [{2}, 0, {3}]}}
contact:
  - base: {{mortar: plane.surface, nonmortar: block.zmin, friction: 0.3}}
"""
PATCH = """problem: patch
bodies:
  - lower: {lower: [0, 0, 0], upper: [2, 2, 1], cells: [3, 3, 2], order: 2, young: 2000, poisson: 0.3}
  - upper: {lower: [0, 0, 1], upper: [2, 2, 2], cells: [4, 5, 2], order: 2, young: 2000, poisson: 0.3}
symmetry: [lower.xmin, lower.ymin, lower.zmin, upper.xmin, upper.ymin]
pressures:
  - top: {face: upper.zmax, value: 25}
contact:
  - joint: {mortar: lower.zmax, nonmortar: upper.zmin}
"""
CUBE = """problem: cube
bodies:
  - cube: {lower: [0.5, 0.5, 0], upper: [1, 1, 1], cells: [4, 4, 8], element: full, material: j2, young: 200000,
           poisson: 0.3, yield: 489.89794855663564, hardening: 2331.002331002331}
  - ball: {shape: rigid_sphere, center: [0.5, 0.5, 1.6], radius: 0.6}
displacements:
  - bottom: {face: cube.zmin, value: [0, 0, 0]}
  - x: {face: cube.xmax, value: [0, 0, free]}
  - y: {face: cube.ymax, value: [0, 0, free]}
  - press: {body: ball, value: [0, 0, -0.01]}
symmetry: [cube.xmin, cube.ymin]
contact:
  - touch: {mortar: ball.surface, nonmortar: cube.zmax, gap: node}
"""
TAYLOR = """problem: Taylor
bodies:
  - bar: {shape: tube_arc, axis: z, radii: [1e-4, 3.2], angles: [0, 10], extent: [0, 32.4], cells: [2, 1, 12],
          material: j2_finite, young: 117e3, poisson: 0.35, yield: 400, hardening: 100, density: 8.93e-9, element: bbar,
          initial_velocity: [0, 0, -227e3]}
  - wall: {shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}
displacements:
  - wall: {body: wall, value: [0, 0, 0]}
  - axis: {face: bar.inner, value: [0, 0, free]}
symmetry:
  - begin: {face: bar.amin, normal: y}
  - end: {face: bar.amax, normal: [-0.17364817766693, 0.984807753012208, 0]}
contact:
  - hit: {mortar: wall.surface, nonmortar: bar.lmin}
probes:
  - tail: {point: [1e-4, 0, 32.4], body: bar}
  - foot: {point: [3.2, 0, 0], body: bar}
dynamics: {mass: lumped, time_step: 1.6e-6, end_time: 80e-6}
"""
# Force of a ball on a rigid plane over the one at first yield, omega* = 2, 6, 20 times the approach there
YOUNG, YIELD = 2e5, 2e3
HARDNESS = 2.8 * YIELD * (0.454 + 0.41 * 0.3)
FIRST = (math.pi * HARDNESS * (1 - 0.3**2) / 2 / YOUNG)**2
FORCE = 2 / 3 * math.pi * HARDNESS * FIRST / 4
BALL = f"""problem: Kogut and Etsion
bodies:
  - ball: {{shape: ball, center: [0, 0, 1], octant: [1, 1, -1], radius: 1, patches: [6, 6, 6], layers: 6,
           material: j2, young: {YOUNG}, poisson: 0.3, yield: {YIELD}}}
  - plane: {{shape: rigid_plane, point: [0, 0, 0], normal: [0, 0, 1]}}
displacements:
  - hold: {{body: plane, value: [0, 0, 0]}}
  - press: {{face: ball.z0, value: [free, free, {-20 * FIRST}]}}
symmetry: [ball.x0, ball.y0]
contact:
  - touch: {{mortar: plane.surface, nonmortar: ball.surface}}
refinements:
  - wide: {{near: touch, levels: 2, distance: 0.25}}
  - close: {{near: touch, levels: 3, distance: 0.12}}
load: {{factors: [0.1, 0.3, 0.65, 1]}}
"""

# Two rings under a pressure 100 + 20 cos 2 theta, without friction
RINGS = """problem: two rings
bodies:
  - inner: {shape: tube_arc, axis: z, radii: [1, 1.5], angles: [0, 90], extent: [0, 0.1], cells: [6, 24, 1], order: 2,
            young: 2e5, poisson: 0.3}
  - outer: {shape: tube_arc, axis: z, radii: [1.5, 2], angles: [0, 90], extent: [0, 0.1], cells: [6, 32, 1], order: 2,
            young: 2e5, poisson: 0.3}
symmetry: [inner.amin, inner.amax, inner.lmin, inner.lmax, outer.amin, outer.amax, outer.lmin, outer.lmax]
pressures:
  - mean: {face: outer.outer, value: "100 + 20*(x^2 - y^2)/(x^2 + y^2)"}
contact:
  - joint: {mortar: inner.outer, nonmortar: outer.inner}
"""
TORUS = """problem: ball on a torus
bodies:
  - ball: {shape: ball, center: [0, 0, 1], octant: [1, 1, -1], radius: 1, patches: [6, 6, 6], layers: 6, young: 2e5,
           poisson: 0.3}
  - ring: {shape: rigid_torus, center: [0, 0, -3], direction: [0, 1, 0], radius: 2.5, section_radius: 0.5}
displacements:
  - hold: {body: ring, value: [0, 0, 0]}
  - press: {face: ball.z0, value: [free, free, -1e-3]}
symmetry: [ball.x0, ball.y0]
contact:
  - touch: {mortar: ring.surface, nonmortar: ball.surface}
refinements:
  - wide: {near: touch, levels: 2, distance: 0.2}
  - close: {near: touch, levels: 5, distance: 0.05}
"""
EQUAL = """problem: SSNP121
bodies:
  - lower: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [3, 3, 2], young: 2e6, poisson: 0}
  - upper: {lower: [0, 0, 1], upper: [1, 1, 2], cells: [4, 5, 3], young: 2e6, poisson: 0}
displacements:
  - fix: {face: lower.zmin, value: [0, 0, 0]}
  - press: {face: upper.zmax, value: [0, 0, -0.1]}
contact:
  - joint: {mortar: lower.zmax, nonmortar: upper.zmin}
"""


def rings():
    """Largest and smallest pressure between the rings: Lame's solution and that of Michell for cos 2 theta. Rows: of
    each ring no shear on both circles, no pressure inside, and the pressure outside; equal normal stress and radial
    displacement between them. Unknowns: the factors of r^2, r^4, r^-2 and 1 of the stress function of each ring"""
    a, c, b, kappa = 1.0, 1.5, 2.0, 3 - 4 * 0.3
    normal = lambda r: [-2, 0, -6 * r**-4, -4 * r**-2]
    shear = lambda r: [2, 6 * r**2, -6 * r**-4, -2 * r**-2]
    move = lambda r: [-2 * r, (kappa - 3) * r**3, 2 * r**-3, (kappa + 1) / r]
    none = [0.0] * 4
    between = [x + [-y for y in x] for x in (normal(c), move(c))]
    rows = [normal(a) + none, shear(a) + none, shear(c) + none, none + shear(c), none + shear(b), none + normal(b)]
    factors = np.linalg.solve(np.array(rows + between), [0, 0, 0, 0, 0, -20, 0, 0])
    mean = 100 * (1 - a**2 / c**2) / (1 - a**2 / b**2)
    wave = -np.dot(normal(c), factors[:4])
    return mean + abs(wave), mean - abs(wave)


def hertz_ellipse(run):
    """Hertz's peak pressure for the force of the ball on the torus, whose relative curvatures are 4/3 and 3"""
    k, e = lambda m: elliptic(m)[0], lambda m: elliptic(m)[1]
    low, high = 0.0, 1.0
    for _ in range(60):
        m = (low + high) / 2
        ratio = (e(m) / (1 - m) - k(m)) / (k(m) - e(m))
        low, high = (m, high) if ratio < 9 / 4 else (low, m)
    force, modulus = 4 * pair("normal_force")(run), 2e5 / (1 - 0.3**2)
    # half-axes a and b, with A = 2/3 the half of the smaller curvature, and m = 1 - (b/a)^2:
    # A = (p0 / E) (b / (m a^2)) (K - E) and P = 2/3 p0 pi a b, hence a^3 = 3 P / (2 pi A E) (K - E) / m
    a = (3 * force / (2 * math.pi * (2 / 3) * modulus) * (k(m) - e(m)) / m)**(1 / 3)
    return 1.5 * force / (math.pi * a * a * math.sqrt(1 - m))


def elliptic(m):
    """Complete elliptic integrals of the first and second kind of the parameter m, by the arithmetic-geometric mean"""
    a, b, c, total, power = 1.0, math.sqrt(1 - m), math.sqrt(m), m / 2, 0.5
    while c > 1e-15:
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        power *= 2
        total += power * c * c
    k = math.pi / 2 / a
    return k, k * (1 - total)


def belt_ratio(run):
    ends = {face["name"]: math.hypot(*face["reaction"][:2]) for face in run["steps"][-1]["faces"]}
    return ends["belt.amin"] / ends["belt.amax"]


def ball(omega, step):
    fit = 1.03 * omega**1.425 if omega <= 6 else 1.40 * omega**1.263
    return Value(f"force over the first yield's, approach {omega} times", fit, pair("normal_force", 1 / FORCE, step), 5)


def incline(ratio):
    """The block holds or slides under this ratio of push and weight"""
    size = math.hypot(1, 0.1)
    return PUSHED.format(-0.1 / size, -1 / size, ratio / size, -0.1 * ratio / size)


CASES = [
    Case("hertz_cylinder", "Cylinder on a rigid plane, plane strain", "Hertz; McEwen 1949", "hertz_cylinder.yaml",
         Value("peak pressure", 2.747, figure("contact pressure"), 1),
         Value("largest von Mises stress", 1.5308, figure("von Mises stress"), 2)),
    Case("ssnv104", "Two balls, approach 2 mm each", "Code_Aster V6.04.104 (Hertz)", "ssnv104.yaml",
         Value("peak pressure [MPa]", 2798.3, figure("contact pressure"), 12,
               "a/R = 0.2, too large for Hertz's theory")),
    Case("press_fit", "Shrink fit, overlap 1 % of the radius", "Lamé", "press_fit.yaml",
         Value("pressure times radius", 5.1965, lambda run: pair("normal_force")(run) / (math.pi / 2 * 0.25), 1)),
    Case("patch", "Two blocks of order 2 whose meshes do not match", "Code_Aster SSNP170",
         PATCH, Value("largest stress [MPa]", 25, figure("von Mises stress"), 0.1)),
    Case("plate", "Plate pushed along a rigid ground, friction 1", "Raous et al. 1988; Code_Aster SSNV128",
         "greco_32.yaml", *(Value(f"displacement at x = {x:g} mm [1e-5 m]", value,
                                  lambda run, x=x: 100 * moved(f"at{100 * x:.0f}", 0)(run), 3)
                            for x, value in ((0, 2.86), (1.25, 2.72), (5, 2.28), (7.5, 1.98), (11.25, 1.54))),
         maker="friction_published.py"),
    Case("roller", "Cylinder on a block, plane strain, friction 0.1", "NAFEMS contact benchmark 1 (FENET 1)",
         "roller_8.yaml", Value("displacement [mm]", -1.30264, moved("middle", 2), 1),
         Value("pressure in the middle [MPa]", 3542.7,
               lambda run: run["steps"][-1]["probes"][0]["contact_pressure"], 1), maker="friction_published.py"),
    *(Case(f"punch_{friction:g}", f"Round punch with a rounded edge, friction {friction:g}",
           "NAFEMS contact benchmark 2 (FENET 2)", f"punch_6_{friction:g}.yaml",
           Value("displacement of the base [mm]", value, moved("middle", 2), 1),
           maker="friction_punch.py") for friction, value in ((0, -0.13294), (0.1, -0.13079))),
    Case("belt", "Belt around a half of a pulley, friction 0.3", "capstan formula, thickness 1.6 % of the radius",
         "capstan_180_48.yaml", Value("ratio of the forces at its ends", math.exp(0.3 * math.pi * 50 / 50.4),
                                      belt_ratio, 1), maker="friction_published.py"),
    Case("cube", "Ball pressed into a metal cube, first mesh", "deal.II step-42", CUBE,
         Value("force", 37.3058, pair("normal_force", 4), 0.01)),
    Case("taylor", "Copper bar that hits a wall at 227 m/s, coarse mesh",
         "Kamoulakos 1990; Zhu and Cescotto 1995; Camacho and Ortiz 1997", TAYLOR,
         Value("length [mm]", (21.26, 21.66), lambda run: 32.4 + moved("tail", 2)(run), 1),
         Value("radius of the foot [mm]", (6.89, 7.24), lambda run: 3.2 + moved("foot", 0)(run), 1),
         Value("largest plastic strain", (2.5, 3.3), figure("eq. plastic strain"), 6)),
    Case("kogut_etsion", "Elastic-plastic ball on a rigid plane", "Kogut and Etsion 2002 (fits)", BALL, ball(2, 0),
         ball(6, 1), ball(20, 3)),
    Case("rings", "Two rings under a pressure p + q cos 2 theta", "Michell 1899", RINGS,
         Value("largest pressure between them", rings()[0], figure("contact pressure"), 1)),
    Case("torus", "Ball on a rigid torus", "Hertz, elliptic contact", TORUS,
         Value("peak pressure over Hertz's", 1,
               lambda run: figure("contact pressure")(run) / hertz_ellipse(run), 1)),
    Case("cubes", "Two cubes, Poisson's ratio 0, meshes that do not match", "Code_Aster SSNP121", EQUAL,
         Value("largest pressure [Pa]", 1e5, figure("contact pressure"), 0.1)),
]


def text(number):
    return f"{number[0]:g} to {number[1]:g}" if isinstance(number, tuple) else f"{number:.5g}"


def holds(ratio):
    """Whether the block of the incline holds; a block that slides ends the run"""
    run, _ = Case("incline", "", "", incline(ratio), options=("-load_max_cuts", "0")).run()
    return run is not None


def rows(case):
    """Lines of the table, and whether all values are within their tolerances"""
    run, seconds = case.run()
    lines, good = [], run is not None
    for number, value in enumerate(case.values):
        head = f"{case.title} | {case.source}" if not number else " | "
        time = f"{seconds:.1f}" if not number else ""
        if run is None:
            lines.append(f"| {head} | {value.what} | {text(value.published)} | failed | | {time} |")
            continue
        ours = value.ours(run)
        off = value.difference(ours)
        good = good and abs(off) <= value.tolerance
        lines.append(f"| {head} | {value.what} | {text(value.published)} | {ours:.5g} | {off:+.2g} % | {time} |")
    return lines, good


def incline_rows():
    """The ratio of push and weight at which the block slides, between two runs"""
    exact, low, high = 0.412371, 0.4119, 0.4129
    good = holds(low) and not holds(high)
    ours = f"{low} holds, {high} slides" if good else "failed"
    title = "Block pushed up an incline of slope 0.1, friction 0.3"
    return [f"| {title} | NAFEMS CGS | push over weight | {exact} | {ours} | | |"], good


def page(lines, notes):
    return "\n".join([
        "# Cases that others published", "",
        "`make published-cases` runs these cases and writes this page. The difference is that to the",
        "published value, or to the nearest end of the range that several programs have. Times are",
        "user seconds.", "",
        "| | |", "| --- | --- |", *machine.header([]), "",
        "| case | source | value | published | ours | difference | time [s] |",
        "| --- | --- | --- | --- | --- | --- | --- |", *lines, "", *notes, ""
    ])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", default="", help="names of cases, separated by commas")
    parser.add_argument("--scene", help="name of a case whose scene is printed instead, for a test")
    parser.add_argument("--folder", default=FOLDER, help="of the scenes, the summaries and the page")
    args = parser.parse_args()
    if args.scene:
        print(next(case.scene for case in CASES if case.name == args.scene))
        return
    only = args.only.split(",")
    os.makedirs(args.folder, exist_ok=True)
    os.chdir(args.folder)
    lines, notes, good = [], [], True
    for case in CASES:
        if only != [""] and case.name not in only:
            continue
        more, fine = rows(case)
        lines, good = lines + more, good and fine
        notes += [f"- {case.title}: {value.note}." for value in case.values if value.note]
        print("\n".join(more), flush=True)
    if only == [""] or "incline" in only:
        more, fine = incline_rows()
        lines, good = lines + more, good and fine
        print("\n".join(more))
    if only == [""]:
        with open("cases.md", "w", encoding="utf-8") as file:
            file.write(page(lines, notes))
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
