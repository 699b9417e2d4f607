"""Friction on rigid surfaces without facets, against balances of forces and bodies with facets.

python3 rigid_friction.py scenes writes the scenes; python3 rigid_friction.py judges the runs.
"""
import math
import sys

from summaries import load, say, within

MU = 0.25
BLOCK = "block: {lower: [-1, -1, 0], upper: [1, 1, 1], cells: [6, 6, 3], young: 1000, poisson: 0.3}"
PLANE = "table: {shape: rigid_plane, point: [0.3, 0.2, 0], normal: [0, 0, 2]}"
SLAB = "table: {lower: [-2, -2, -1], upper: [2, 2, 0], cells: [1, 1, 1], material: rigid}"
DRAG = """problem: drag
bodies:
  - {block}
  - {table}
load_steps: 2
ramps:
  - down: {{factors: [1, 1]}}
  - along: {{factors: [0, 1]}}
displacements:
  - press: {{face: block.zmax, value: [free, free, -0.01], ramp: down}}
  - hold: {{face: block.zmax, value: [{block_moves}, 0, free], ramp: along}}
  - table: {{body: table, value: [{table_moves}, 0, 0], ramp: along}}
{join}
"""
TOUCH = "contact:\n  - touch: {mortar: table.%s, nonmortar: block.zmin, %s}"
ROLLER = """problem: roller
bodies:
  - block: {{lower: [-1, 0, -1], upper: [1, 0.5, 0], cells: [16, 1, 8], young: 1000, poisson: 0.3}}
  - roller: {{shape: rigid_cylinder, center: [0, 0, 0.5], direction: [0, 1, 0], radius: 0.5}}
load_steps: {steps}
ramps:
  - down: {{factors: [{ones}]}}
  - turn: {{expression: "max(0, t - 1)"}}
displacements:
  - hold: {{face: block.zmin, value: [0, free, 0]}}
  - press: {{body: roller, value: [0, 0, -0.03], {turns}ramp: down}}
{drive}
symmetry: [block.ymin, block.ymax]
contact:
  - touch: {{mortar: roller.surface, nonmortar: block.zmax, friction: 0.25}}
"""
# A quarter of a bush that a cone is driven into
CONE = """problem: cone
bodies:
  - bush: {{shape: tube_arc, axis: z, radii: [1, 2], angles: [0, 90], extent: [-1, 0], cells: [4, 8, 4], young: 1000,
           poisson: 0.3}}
  - tool: {{shape: rigid_cone, tip: [0, 0, -{tip}], direction: [0, 0, 1], half_angle: 20}}
load_steps: 3
displacements:
  - hold: {{face: bush.lmin, value: [free, free, 0]}}
  - push: {{body: tool, value: [0, 0, -0.1]}}
symmetry: [bush.amin, bush.amax]
contact:
  - touch: {{mortar: tool.surface, nonmortar: bush.inner, friction: {friction}, gap: node}}
"""
# Half a cylinder that is pressed on a plane and pushed along it: Cattaneo and Mindlin in the plane
MINDLIN = """problem: mindlin
bodies:
  - wheel: {{shape: half_ellipse, axis: y, center: [0, 0, 1], depth: -z, semi_axes: [1, 1], extent: [0, 0.1],
            patches: [6, 24, 8], layers: 1, grading: [1, 1, 0.2], young: 1000, poisson: 0.45}}
  - {table}
load_steps: 2
ramps:
  - down: {{factors: [1, 1]}}
  - along: {{factors: [0, 1]}}
displacements:
  - press: {{face: wheel.flat, value: [free, 0, -0.03], ramp: down}}
  - push: {{face: wheel.flat, value: [0.012, free, free], ramp: along}}
  - table: {{body: table, value: [0, 0, 0]}}
symmetry: [wheel.lmin, wheel.lmax]
contact:
  - touch: {{mortar: table.{face}, nonmortar: wheel.arc, friction: 0.25, gap: node, smooth: false}}
"""
# Half of a ball, pressed on a plane and pushed along it
BALL = """problem: ball
bodies:
  - ball: {{shape: ball, center: [0, 0, 1], octant: [2, 1, -1], radius: 1, patches: [4, 4, 3], layers: 5,
           grading: [12, 12, 1], even: [2, 2, 1], layer_grading: 0.2, young: 1000, poisson: 0.45, order: 2}}
  - {table}
load_steps: 2
ramps:
  - down: {{factors: [1, 1]}}
  - along: {{factors: [0, 1]}}
displacements:
  - press: {{face: ball.z0, value: [free, free, -0.04], ramp: down}}
  - push: {{face: ball.z0, value: [0.008, free, free], ramp: along}}
  - table: {{body: table, value: [0, 0, 0]}}
symmetry: [ball.y0]
contact:
  - touch: {{mortar: table.{face}, nonmortar: ball.surface, friction: 0.25, gap: node}}
"""
TURNED = "  - turn: {body: roller, value: [0, 0, 0], rotation: [0, 20, 0], center: [0, 0, 0.5], ramp: turn}"
MOMENT = "forces:\n  - turn: {body: roller, value: [0, 0, 0], moment: [0, 0.2, 0], point: [0, 0, 0.5], ramp: turn}"
ANGLE = math.radians(20)


def drag(table, moves, join):
    return DRAG.format(block=BLOCK, table=table, block_moves=moves[0], table_moves=moves[1], join=join)


SCENES = {
    "drag": drag(PLANE, (0.5, 0), TOUCH % ("surface", f"friction: {MU}")),
    "moved": drag(PLANE, (0, -0.5), TOUCH % ("surface", f"friction: {MU}")),
    "stick": drag(PLANE, (0.01, 0), TOUCH % ("surface", "stick: true")),
    "tied": drag(SLAB, (0.01, 0), "ties:\n  - touch: {mortar: table.zmax, nonmortar: block.zmin}"),
    "turned": ROLLER.format(steps=4, ones="1, 1, 1, 1", turns="", drive=TURNED),
    "moment": ROLLER.format(steps=2, ones="1, 1", turns="rotation: [0, free, 0], center: [0, 0, 0.5], ", drive=MOMENT),
    "cone": CONE.format(tip=1 / math.tan(ANGLE), friction=MU),
    "mindlin": MINDLIN.format(table=PLANE, face="surface"),
    "ball": BALL.format(table=PLANE, face="surface"),
    "ball_mesh": BALL.format(table=SLAB, face="zmax"),
    "mindlin_mesh": MINDLIN.format(table=SLAB, face="zmax"),
}


def steps(name):
    return load(name)["steps"]


def pair(name, step=-1):
    return steps(name)[step]["pairs"][0]


def about(point, pair):
    """Moment about the y axis through a point of the forces on the tool."""
    force, moment = pair["mortar_force"], pair["mortar_moment"]
    return moment[1] - point[2] * force[0] + point[0] * force[2]


def balanced(pair):
    size = pair["normal_force"]
    return all(abs(pair[a][c] + pair["mortar_" + a][c]) < 2e-3 * size for a in ("force", "moment") for c in range(3))


def judge():
    for name in "drag", "moved":
        seen = pair(name)
        say(
            f"{name}: all of it slides, friction is mu N, and the forces balance", seen["stick_area"] == 0
            and within(seen["shear_force"], MU * seen["normal_force"], 1e-8)
            and within(abs(seen["mortar_force"][0]), MU * abs(seen["mortar_force"][2]), 1e-4) and balanced(seen), seen)
    say("the same force whichever of the two moves",
        within(pair("drag")["mortar_force"][0],
               pair("moved")["mortar_force"][0], 1e-8), (pair("drag"), pair("moved")))
    say("the same on three ranks", within(steps("drag_3")[-1]["energy"],
                                          steps("drag")[-1]["energy"], 1e-8),
        steps("drag_3")[-1])
    say("stick is a tie", within(steps("stick")[-1]["energy"],
                                 steps("tied")[-1]["energy"], 1e-5),
        (steps("stick")[-1]["energy"], steps("tied")[-1]["energy"]))
    seen = pair("turned")
    torque, axis = MU * seen["normal_force"] * 0.5, (0, 0, 0.47)
    say("turned: torque is mu N R", within(-about(axis, seen), torque, 1e-5), (about(axis, seen), torque))
    work = sum(pair("turned", k)["dissipated"] * (1 if k == 3 else -1) for k in (2, 3))
    say("turned: what a step dissipates is torque times angle", within(work, torque * math.radians(20), 1e-2),
        (work, torque))
    seen = pair("moment")
    say("moment: the friction carries it", within(about(axis, seen), -0.2, 1e-3), (about(axis, seen), seen))
    seen = pair("cone")
    axial = seen["normal_force"] * (math.sin(ANGLE) + MU * math.cos(ANGLE))
    say("cone: N (sin a + mu cos a) along the axis", within(seen["mortar_force"][2], axial, 1e-3),
        (seen["mortar_force"][2], axial))
    seen, other = pair("mindlin"), pair("mindlin_mesh")
    one, two = steps("mindlin")[-1]["energy"], steps("mindlin_mesh")[-1]["energy"]
    say(
        "cylinder on a plane that sticks in part: force, stick area and energy as with facets",
        within(seen["stick_area"], other["stick_area"], 1e-6) and within(seen["force"][0], other["force"][0], 1e-3)
        and within(one, two, 1e-3), (seen, other, one, two))
    stick = math.sqrt(1 - seen["shear_force"] / (MU * seen["normal_force"]))
    cells = (seen["stick_area"] + seen["slip_area"]) / 0.1 * 48 / math.pi
    say("its stick area is Cattaneo's and Mindlin's up to a cell",
        abs(seen["stick_area"] / (seen["stick_area"] + seen["slip_area"]) - stick) < 1 / cells, (seen, stick, cells))


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
elif sys.argv[1:] == ["ball"]:
    seen, other = pair("ball"), pair("ball_mesh")
    one, two = steps("ball")[-1]["energy"], steps("ball_mesh")[-1]["energy"]
    say(
        "ball on a plane that sticks in part: force, stick area and energy as with facets",
        within(seen["stick_area"], other["stick_area"], 1e-6) and seen["slip_area"] > 0
        and within(seen["force"][0], other["force"][0], 2e-2) and within(one, two, 1e-3), (seen, other, one, two))
    say("the same on three ranks", within(steps("ball_3")[-1]["energy"], one, 1e-6),
        (steps("ball_3")[-1]["energy"], one))
else:
    judge()
