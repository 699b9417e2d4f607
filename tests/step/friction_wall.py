"""A wall of three courses of bricks under its weight, pushed along its top. python3 friction_wall.py scene prints the
scene; python3 friction_wall.py judges the run."""
import sys

from summaries import load, say, within

LENGTH, COURSES, PUSH = 6, 3, 0.2


def bricks():
    """Name, course, and ends of each brick; every other course begins with half a brick"""
    for course in range(COURSES):
        joints = range(0, LENGTH + 1, 2) if course % 2 == 0 else (0, 1, 3, 5, 6)
        for i, (left, right) in enumerate(zip(joints, list(joints)[1:])):
            yield f"b{course}{i}", course, left, right


def pairs():
    for lower, below, a, b in bricks():
        for upper, above, c, d in bricks():
            if above == below + 1 and min(b, d) > max(a, c):
                yield f"  - {lower}{upper}: {{mortar: {lower}.zmax, nonmortar: {upper}.zmin, friction: 0.5}}"
            if above == below and b == c:
                yield f"  - {lower}{upper}: {{mortar: {lower}.xmax, nonmortar: {upper}.xmin, friction: 0.5}}"


def scene():
    yield "bodies:"
    for name, course, left, right in bricks():
        yield (f"  - {name}: {{lower: [{left}, 0, {course}], upper: [{right}, 1, {course + 1}], "
               f"cells: [{2 * (right - left)}, 2, 2], young: 1e4, poisson: 0.2}}")
    yield "displacements:"
    yield from (f"  - {name}: {{face: {name}.zmin, value: [0, 0, 0]}}" for name, course, *_ in bricks() if not course)
    yield "body_forces: [weight: {value: [0, 0, -1]}]"
    yield f"tractions: [push: {{face: b20.xmin, value: [{PUSH}, 0, 0], ramp: push}}]"
    yield "contact:"
    yield from pairs()
    yield "ramps: [push: {factors: [0, 1]}]"
    yield "load: {factors: [1, 1]}"


if sys.argv[1:] == ["scene"]:
    print("\n".join(scene()))
else:
    last = load("wall")["steps"][-1]
    reaction = [sum(body["reaction"][c] for body in last["bodies"]) for c in (0, 2)]
    say("the ground carries the weight", within(reaction[1], LENGTH * COURSES, 1e-6), reaction)
    say("the ground holds the wall against the push", within(reaction[0], -PUSH, 1e-5), reaction)
    say("energy is stored or dissipated", last["imbalance"] < 1e-2, last["imbalance"])
