"""A cantilever that the corner of a rigid profile lifts between two vertices: Timoshenko's beam. A narrow bump that
slides along a block between its vertices.

python3 rigid_corner.py scenes writes the scenes; python3 rigid_corner.py judges the runs.
"""
import sys

from summaries import load, say, within

BEAM = """problem: beam
bodies:
  - beam: {{lower: [0, -0.5, 0], upper: [10, 0.5, 1], cells: [10, {across}, 2], young: 1000, poisson: 0,
      element: incompatible}}
  - tool: {{{tool}}}
displacements:
  - clamp: {{face: beam.xmin, value: [0, 0, 0]}}
  - lift: {{body: tool, value: [0, 0, 0.2]}}
contact:
  - touch: {{mortar: tool.surface, nonmortar: beam.zmin}}
"""
# A ramp and a plateau, whose corner is below the beam at x = at
TOOL = ("shape: rigid_extruded, center: [{at}, 0, -0.1], direction: [{slant}, -1, 0], across: [1, {slant}, 0], "
        "points: [6, -5, 6, 0, 0, 0, -1, -1]")
ROUNDED = TOOL.replace("points: [6, -5, 6, 0, 0, 0, -1, -1]",
                       "points: [6, -5.01, 6, -0.01, 0, -0.01, -1, -1.01], outside: 0.01")
REVOLVED = ("shape: rigid_revolved, center: [{center}, 0, -0.1], direction: [0, 0, 1], "
            "points: [{out}, -5, {out}, 0, {radius}, 0, {inn}, -1]")
BUMP = """problem: bump
bodies:
  - block: {lower: [0, 0, 0], upper: [4, 1, 1], cells: [4, 2, 2], young: 1000, poisson: 0.3}
  - tool: {shape: rigid_extruded, center: [1, 0, 0], direction: [0, -1, 0], across: [1, 0, 0],
      points: [0.65, -0.5, 0.15, 0, -0.15, 0, -0.65, -0.5]}
symmetry: [block.ymin, block.ymax]
ramps:
  - up: {factors: [1, 1, 1, 1, 1]}
  - along: {factors: [0, 1, 2, 3, 4]}
displacements:
  - clamp: {face: block.zmax, value: [0, 0, 0]}
  - lift: {body: tool, value: [0, 0, 0.02], ramp: up}
  - slide: {body: tool, value: [0.25, 0, 0], ramp: along}
contact:
  - touch: {mortar: tool.surface, nonmortar: block.zmin}
"""
FAR = 1000  # radius of the revolved corner

SCENES = {f"beam_{at}": BEAM.format(across=1, tool=TOOL.format(at=at, slant=0)) for at in (6.25, 6.5, 6.75)}
SCENES |= {
    "oblique": BEAM.format(across=3, tool=TOOL.format(at=6.5, slant=0.3)),
    "rounded": BEAM.format(across=1, tool=ROUNDED.format(at=6.5, slant=0)),
    "revolved": BEAM.format(across=1, tool=REVOLVED.format(center=6.5 - FAR, radius=FAR, inn=FAR - 1, out=FAR + 6)),
    "bump": BUMP,
}


def forces(name):
    return [step["pairs"][0]["force"] for step in load(name)["steps"]]


def beam(at, lift=0.1):
    """Force on a cantilever of Young's modulus 1000 and unit height and width, lifted at the distance `at`."""
    return 3 * 1000 / 12 * lift / at**3 / (1 + 3 * 0.2 / at**2)


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(f"{name}.yaml", "w", encoding="utf-8") as file:
            file.write(text)
    sys.exit()
for at in (6.25, 6.5, 6.75):
    x, _, z = forces(f"beam_{at}")[0]
    say(f"corner at {at}: force of Timoshenko's beam within 2.5 %", within(z, beam(at), 0.025), (z, beam(at)))
    say("and normal to the inclined beam within 5 %", within(-x / z, 1.5 * 0.1 / at, 0.05), (x, z))
middle = forces("beam_6.5")[0][2]
for name in ("rounded", "revolved"):
    z = forces(name)[0][2]
    say(f"{name} corner: the same force within 1e-3", within(z, middle, 1e-3), (z, middle))
one, three = forces("oblique")[0], forces("oblique_3")[0]
say("oblique corner: the same on one and three ranks", max(abs(a - b) for a, b in zip(one, three)) < 1e-9, (one, three))
bump = forces("bump")
say("narrow bump: touches between the vertices, too", min(f[2] for f in bump) > 0.6 * max(f[2] for f in bump), bump)
say("and is not pushed aside", max(abs(f[0] / f[2]) for f in bump) < 0.01, bump)
