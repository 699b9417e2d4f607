"""Where the work goes: blocks that turn with what grips them, a pin pressed into a hub, a die that slides over a seam.

python3 friction_energy.py scenes writes the scenes; python3 friction_energy.py judges the runs that friction_energy.sh
has made.
"""
import math
import sys

from summaries import load, say, within

# Two rigid plates overlap a block's ends and turn about its middle, a block between them with them
GRIP = """problem: grip
bodies:
  - low: {{lower: [-1, -1, -1.5], upper: [1, 1, -0.48], cells: [2, 2, 1], material: rigid}}
  - block: {{lower: [-0.5, -0.5, -0.5], upper: [0.5, 0.5, 0.5], cells: [3, 3, 3], material: neohookean, young: 10,
            poisson: 0.3}}
  - top: {{lower: [-1, -1, 0.48], upper: [1, 1, 1.5], cells: [2, 2, 1], material: rigid}}
displacements:
  - below: {{body: low, value: [0, 0, 0], rotation: [0, 90, 0], center: [0, 0, 0], ramp: turn}}
  - above: {{body: top, value: [0, 0, 0], rotation: [0, 90, 0], center: [0, 0, 0], ramp: turn}}
contact:
  - foot: {{mortar: low.zmax, nonmortar: block.zmin, {law}, interference: true}}
  - head: {{mortar: top.zmin, nonmortar: block.zmax, {law}, interference: true}}
load: {{factors: {load}}}
ramps:
  - turn: {{factors: {turn}}}
"""


def grip(law, turns=2):
    """The quarter turn in this many load steps, after one that closes the grip"""
    return GRIP.format(law=law, load=[1] * (turns + 1), turn=[k / turns for k in range(turns + 1)])


PIN = """problem: pin
bodies:
  - hub: {shape: tube_arc, axis: z, radii: [10, 20], angles: [0, 90], extent: [0, 10], cells: [3, 10, 5], young: 200000,
          poisson: 0.3}
  - pin: {shape: tube_arc, axis: z, radii: [5, 10.01], angles: [0, 90], extent: [8, 20], cells: [3, 8, 6],
          young: 200000, poisson: 0.3}
displacements:
  - base: {face: hub.lmin, value: [free, free, 0]}
  - push: {face: pin.lmax, value: [free, free, -3.6]}
symmetry: [hub.amin, hub.amax, pin.amin, pin.amax]
contact:
  - fit: {mortar: hub.inner, nonmortar: pin.outer, friction: 0.12, interference: true}
load: {steps: 6}
"""
SEAM = """problem: seam
bodies:
  - left: {lower: [-2, 0, -0.5], upper: [0, 1, 0], cells: [8, 3, 2], young: 1e4, poisson: 0.3}
  - right: {lower: [0, 0, -0.5], upper: [2, 1, 0], cells: [7, 3, 2], young: 1e4, poisson: 0.3}
  - die: {lower: [-1.2, 0.1, 0], upper: [-0.2, 0.9, 0.5], cells: [5, 3, 2], young: 1e5, poisson: 0.3}
displacements:
  - left: {face: left.zmin, value: [0, 0, 0]}
  - right: {face: right.zmin, value: [0, 0, 0]}
  - press: {face: die.zmax, value: [free, free, -0.005]}
  - shift: {face: die.zmax, value: [1.3, 0, free], ramp: across}
contact:
  - one: {mortar: left.zmax, nonmortar: die.zmin, friction: 0.3}
  - two: {mortar: right.zmax, nonmortar: die.zmin, friction: 0.3}
load: {factors: [1, 1, 1, 1, 1, 1, 1, 1]}
ramps:
  - across: {factors: [0, 0.14, 0.28, 0.42, 0.56, 0.7, 0.84, 1]}
"""
SWAPPED = SEAM
for side in "left", "right":
    SWAPPED = SWAPPED.replace(f"mortar: {side}.zmax, nonmortar: die.zmin", f"mortar: die.zmin, nonmortar: {side}.zmax")
# A block that rests under a pressure, and is then pushed over a rigid floor, all at once and in many load steps
PUSH = """problem: push
bodies:
  - floor: {{lower: [-1, -1, -1], upper: [3, 2, 0], cells: [1, 1, 1], material: rigid}}
  - block: {{lower: [0, 0, 0], upper: [1, 1, {height}], cells: [3, 3, 3], young: 1000, poisson: 0.3}}
displacements:
  - ground: {{body: floor, value: [0, 0, 0]}}
  - push: {{face: block.zmax, value: [0.1, 0, free], ramp: along}}
pressures:
  - press: {{face: block.zmax, value: 1}}
contact:
  - pair: {{mortar: floor.zmax, nonmortar: block.zmin, {law}}}
load: {{factors: {load}}}
ramps:
  - along: {{factors: {along}}}
"""
# A tooth that is pushed between two teeth, pulled off one of them and pressed against the other. The teeth bend by more
# than a degree.
TEETH = """problem: teeth
bodies:
  - first: {shape: wedge, axis: y, corners: [2,2, 2,4, 4,3], extent: [0,2], side_cells: 3, length_cells: 2, young: 1e4,
            poisson: 0.3}
  - second: {shape: wedge, axis: y, corners: [2,6, 2,8, 4,7], extent: [0,2], side_cells: 3, length_cells: 2, young: 1e4,
             poisson: 0.3}
  - tooth: {shape: wedge, axis: y, corners: [4,3.05, 4,6.95, 2.2,5], extent: [0,2], side_cells: 4, length_cells: 3,
            young: 1e4, poisson: 0.3}
displacements:
  - one: {face: first.side1, value: [0, 0, 0]}
  - two: {face: second.side1, value: [0, 0, 0]}
  - drive: {face: tooth.side1, value: [0, 0, -0.1], ramp: down}
  - push: {face: tooth.side1, value: [0.15, 0, 0], ramp: along}
contact:
  - auto: {friction: 0.1}
load: {steps: 6}
ramps:
  - down: {factors: [0.5, 1, 1, 1, 1, 1]}
  - along: {factors: [0, 0, 0.5, 1, 0, -1]}
"""
# A rubber block that is squeezed to half of its height in one load step; friction acts nowhere
APART = """problem: apart
bodies:
  - block: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2], material: neohookean, young: 10, poisson: 0.3}
  - far: {lower: [0, 0, 1.2], upper: [1, 1, 1.5], cells: [1, 1, 1], material: rigid}
symmetry: [block.xmin, block.ymin, block.zmin]
displacements:
  - press: {face: block.zmax, value: [free, free, -0.5]}
  - hold: {body: far, value: [0, 0, 0], rotation: [0, 0, 0], center: [0.5, 0.5, 1.2]}
contact:
  - pair: {mortar: far.zmin, nonmortar: block.zmax, friction: 0.3}
"""
# A ring that shrinks onto a shaft and expands until it is loose: heat does all work
RING = """problem: ring
bodies:
  - shaft: {shape: tube_arc, axis: z, radii: [5, 10], angles: [0, 90], extent: [0, 5], cells: [3, 8, 3], young: 2e5,
            poisson: 0.3, expansion: 12e-6}
  - ring: {shape: tube_arc, axis: z, radii: [10, 16], angles: [0, 90], extent: [0, 5], cells: [3, 10, 3], young: 1e5,
           poisson: 0.3, expansion: 20e-6}
symmetry: [shaft.amin, shaft.amax, ring.amin, ring.amax, shaft.lmin, ring.lmin]
temperatures:
  - cool: {body: ring, value: -100}
contact:
  - fit: {mortar: shaft.outer, nonmortar: ring.inner, friction: 0.2}
load: {factors: [0.5, 1, 0.5, -0.2]}
"""
STEPS = 16
PUSHES = {
    "low": dict(height=0.25, law="friction: 0.3"), "high": dict(height=1, law="friction: 0.3"),
    "limited": dict(height=0.25, law="friction: 5, shear_limit: 0.3")
}
SCENES = {
    "sticks": grip("stick: true"), "rubs": grip("friction: 1"), "slides": grip("friction: 0.5"),
    "eases": grip("friction: 0.3"), "sticks_7": grip("stick: true", 7), "slides_7": grip("friction: 0.5", 7),
    "pin": PIN, "seam": SEAM, "swapped": SWAPPED, "teeth": TEETH, "apart": APART, "ring": RING
}
for push, values in PUSHES.items():
    SCENES[push + "_once"] = PUSH.format(load=[1, 1, 1], along=[0, 1, 0], **values)
    SCENES[push + "_slowly"] = PUSH.format(load=[1] * (2 * STEPS + 1),
                                           along=[k / STEPS for k in [*range(STEPS + 1), *range(STEPS - 1, -1, -1)]],
                                           **values)


def parts(name):
    """Of every load step, beside its report: work, what is stored, what friction took, and what else contact took"""
    before = dict.fromkeys(("work", "energy", "dissipated", "normal_work"), 0.0)
    for step in load(name)["steps"]:
        yield step, {key: step[key] - value for key, value in before.items()}
        before = {key: step[key] for key in before}


if sys.argv[1:] == ["scenes"]:
    for name, text in SCENES.items():
        with open(name + ".yaml", "w") as file:
            file.write(text)
else:
    for name in "sticks", "rubs", "slides", "eases":
        steps = load(name)["steps"]
        slid = steps[0]["dissipated"] if name in ("slides", "eases") else 0  # when the grip closed
        shear = 1e-3 if name in ("slides", "eases") else 1e-4
        # contact updates end at a slip of 1e-6 of the displacements, some 1e-5 of the forces here
        first = steps[0]["energy"]
        for step in steps[1:]:
            pair, title = step["pairs"][0], "%s, turned by %d degrees: " % (name, 45 * (step["step"] - 1))
            normal = abs(steps[0]["pairs"][0]["force"][2])
            angle = math.radians(45 * (step["step"] - 1))
            turned = abs(pair["force"][0] - normal * math.sin(angle)) + abs(pair["force"][2] - normal * math.cos(angle))
            say(title + "the force turns with the plates", turned < 1e-4 * normal, pair["force"])
            say(
                title + "all of it is normal force, and the sizes of shear are as before",
                within(pair["normal_force"], normal, 1e-4)
                and within(pair["shear_force"], steps[0]["pairs"][0]["shear_force"], shear), pair)
            say(
                title + "no energy is lost",
                within(step["energy"], first, 1e-4) and abs(step["dissipated"] - slid) < 1e-4 * first
                and abs(step["work"]) < 1e-3 * first, (step["energy"], first, step["work"]))
    for name in "sticks_7", "slides_7":
        steps = load(name)["steps"]
        first, last = steps[0]["pairs"][0], [step["pairs"][0] for step in steps[1:]]
        say(
            f"{name}: normal and shear forces as before the turn in each of seven load steps, to 1e-3",
            len(last) == 7
            and all(within(pair[key], first[key], 1e-3) for pair in last for key in ("normal_force", "shear_force")),
            [(pair["normal_force"], pair["shear_force"]) for pair in (first, *last)])
        say(f"{name}: no energy is lost", all(within(step["energy"], steps[0]["energy"], 1e-4) for step in steps),
            [step["energy"] for step in steps])
    for name in "pin", "seam", "swapped":
        run = load(name)
        say(f"{name}: converged", run["converged"] and not run["warnings"], (run["reason"], run["warnings"]))
        steps = list(parts(name))[1:]  # at first overlaps are pressed out, by no work of loads
        say(f"{name}: in every step work is stored or dissipated, to 1 %",
            all(within(part["energy"] + part["dissipated"], part["work"], 0.01) for _, part in steps), steps)
        say(
            f"{name}: with what normal forces do, to 1e-8",
            all(
                within(part["energy"] + part["dissipated"] +
                       part["normal_work"], part["work"], 1e-8) and step["imbalance"] < 1e-8
                for step, part in steps), steps)
    teeth = load("teeth")
    taken = [pair["dissipated"] for step in teeth["steps"] for pair in step["pairs"]]
    say("teeth: friction takes work in steps 3, 4 and 6",
        all(part["dissipated"] > 0.01 for step, part in parts("teeth") if step["step"] in (3, 4, 6)),
        list(parts("teeth")))
    say("teeth: it never gives any back, also where a contact opens",
        min(taken) >= 0 and all(part["dissipated"] > -1e-12 for _, part in parts("teeth")), taken)
    say("teeth: the energy is balanced, although bodies of small strain rotate",
        all(step["imbalance"] < 1e-8 for step in teeth["steps"][2:]), [step["imbalance"] for step in teeth["steps"]])
    say("apart: no warning of work that is lost, where friction does not act",
        not any("of the work" in warning for warning in load("apart")["warnings"]),
        load("apart")["warnings"])
    steps = load("ring")["steps"]
    size = max(step["energy"] for step in steps)
    say("ring: no load does work", all(abs(step["work"]) < 1e-6 * size for step in steps),
        [step["work"] for step in steps])
    say(
        "ring: friction takes work, and the rest of the contact's is that of normal forces",
        steps[0]["dissipated"] > 0.001 * size
        and all(within(step["dissipated"] + step["normal_work"], step["contact_work"], 1e-9)
                for step in steps), [(step["dissipated"], step["normal_work"], step["contact_work"]) for step in steps])
    for push in PUSHES:
        once, slowly = load(push + "_once")["steps"], load(push + "_slowly")["steps"]
        for title, step, other in ("pushed", once[1], slowly[STEPS]), ("and back", once[2], slowly[-1]):
            taken, work = (step[key] - once[0][key] for key in ("dissipated", "work"))
            say(f"{push}, {title}: dissipated in one load step as in {STEPS}, to 3 %",
                within(taken, other["dissipated"] - slowly[0]["dissipated"], 0.03), (taken, other["dissipated"]))
            say(f"{push}, {title}: the work of the loads as well",
                within(work, other["work"] - slowly[0]["work"], 0.03) and step["imbalance"] < 1e-6,
                (work, other["work"], step["imbalance"]))
        say(f"{push}: friction times way, to 5 %", within(once[1]["dissipated"], 0.03, 0.05), once[1]["dissipated"])
    whole, restarted = (load(name)["steps"][-1] for name in ("pin", "pin_restarted"))
    say("pin: restarted, dissipated", within(restarted["dissipated"], whole["dissipated"], 1e-6),
        (restarted["dissipated"], whole["dissipated"]))
