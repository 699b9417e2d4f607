"""Decks of two cubes, and what must come out: python decks.py write|judge.

The lower cube is [0, 1]^3, the upper one stands on it. Both are of one element set, with E = 1000 and no lateral strain
(Poisson's ratio 0) unless said otherwise. Their nodes at z = 1 coincide."""
import os
import sys

from summaries import load, say

CORNERS = ((0, 0), (1, 0), (1, 1), (0, 1))
ELASTIC = "*ELASTIC\n1000., 0."
HARD = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD"
SOFT = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1000., 3."
TIED = "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n1.E7"
PAIR = "*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE\nover, under"
PRESS = "*DLOAD\n2, P2, 10."
HOLD = "*BOUNDARY\nfoot, 1, 3\ntop, 1, 2"


def cubes():
    """Nodes 1 to 8 of the lower cube and 9 to 16 of the upper one"""
    places = [(x, y, z) for z in (0, 1, 1, 2) for x, y in CORNERS]
    return "\n".join(["*NODE, NSET=Nall", *(f"{n}, {x}, {y}, {z}" for n, (x, y, z) in enumerate(places, 1))])


MESH = cubes() + """
*ELEMENT, TYPE=C3D8, ELSET=Eall
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 9, 10, 11, 12, 13, 14, 15, 16
*NSET, NSET=foot, GENERATE
1, 4
*NSET, NSET=top, GENERATE
13, 16
*SURFACE, NAME=under
1, S2
*SURFACE, NAME=over
2, S1"""


def shifted(z):
    """The mesh with the lower face of the upper cube at z"""
    lines = MESH.splitlines()
    return "\n".join([*lines[:9], *(line.rsplit(",", 1)[0] + f", {z}" for line in lines[9:13]), *lines[13:]])


def step(*cards, procedure="*STATIC", nlgeom=""):
    return "\n".join([f"*STEP{nlgeom}", procedure, *cards, "*NODE PRINT, NSET=Nall", "U", "*END STEP"])


def deck(*steps, elastic=ELASTIC, law=HARD, pair=PAIR, hold=HOLD, more="", mesh=MESH):
    contact = f"*SURFACE INTERACTION, NAME=SI\n{law}\n{pair}" if pair else ""
    parts = [
        "*HEADING\n two cubes", mesh, f"*MATERIAL, NAME=EL\n{elastic}\n*SOLID SECTION, ELSET=Eall, MATERIAL=EL", hold,
        more, contact, *steps
    ]
    return "\n".join(part for part in parts if part) + "\n"


def push(value, **keys):
    return step(f"*BOUNDARY\ntop, 3, 3, {value}", **keys)


AMPLITUDE = "*AMPLITUDE, NAME=A\n0., 0., 0.5, 1., 1., 0.25"
JOINED = cubes() + """
*ELEMENT, TYPE=C3D8, ELSET=Elow
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=Eall
2, 5, 6, 7, 8, 13, 14, 15, 16
*NSET, NSET=foot, GENERATE
1, 4
*NSET, NSET=top, GENERATE
13, 16
*MATERIAL, NAME=SOFT
*ELASTIC
500., 0.
*SOLID SECTION, ELSET=Elow, MATERIAL=SOFT"""


def rigid(*cards, joint="*RIGID BODY, NSET=top, REF NODE=17, ROT NODE=18"):
    mesh = JOINED.replace("C3D8", "C3D8I").replace("500.", "1000.") + "\n*NODE\n17, 0.5, 0.5, 3.\n18, 0.5, 0.5, 3."
    return deck(step(*cards), pair="", hold="*BOUNDARY\nfoot, 1, 3", mesh=mesh, more=joint)


DISTRIBUTING = "*SURFACE, NAME=head\n2, S2\n*COUPLING, REF NODE=17, SURFACE=head\n*DISTRIBUTING\n1, 6"
PARTS = """*PART, NAME=Cube
*NODE
""" + "\n".join(cubes().splitlines()[1:9]) + """
*ELEMENT, TYPE=C3D8, ELSET=Eall
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=foot, GENERATE
1, 4
*NSET, NSET=top, GENERATE
5, 8
*SURFACE, NAME=under
1, S2
*SURFACE, NAME=over
1, S1
*SOLID SECTION, ELSET=Eall, MATERIAL=EL
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=Low, PART=Cube
*END INSTANCE
*INSTANCE, NAME=Up,
PART=Cube
0., 0., 1.
*END INSTANCE
*NSET, NSET=foot, INSTANCE=Up, GENERATE
5, 8
*ELSET, ELSET=cell, INSTANCE=Low
1
*SURFACE, NAME=under
cell, S2
*SURFACE, NAME=over, TYPE=NODE
Up.foot
*END ASSEMBLY
*MATERIAL, NAME=EL
*ELASTIC
1000., 0.
*SURFACE INTERACTION, NAME=SI
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
*CONTACT PAIR, INTERACTION=SI
over, under
*BOUNDARY
Low.foot, ENCASTRE
foot, 1, 2
*STEP
*STATIC
*BOUNDARY
Up.top, 3, 3, -0.02
*END STEP
"""

# displacement 0.1 (x - 1/2) (z - 1/2) along x of the lower cube
BENT = deck(
    step("*BOUNDARY", "foot, 2, 3", "5, 2, 3", "6, 2, 3", "7, 2, 3", "8, 2, 3", "9, 1, 3", "10, 1, 3", "11, 1, 3",
         "12, 1, 3",
         *(f"{n}, 1, 1, {0.025 * sign}" for n, sign in enumerate((1, -1, -1, 1, -1, 1, 1, -1), 1))), pair="", hold="")

DECKS = {
    # strain zz = 0, xx = 0.1 (z - 1/2), xz = 0.05 (x - 1/2); with incompatible modes there is no shear
    "bent": (BENT, {"energy": 0.625}),
    "bent_incompatible": (BENT.replace("C3D8", "C3D8I"), {"energy": 0.625 * 2 / 3}),
    # each cube stores 10^2 / (2 E)
    "pressure": (deck(step(PRESS)), {"energy": 0.1, "reaction": 10}),
    # the force on one corner of the top, which stays level by equations
    "equation": (deck(step("*CLOAD\n13, 3, -10."), more="*EQUATION\n2\n14, 3, 1., 13, 3, -1.\n2\n15, 3, 1., 13, 3, "
                      "-1.\n2\n16, 3, 2., 13, 3, -2."), {"energy": 0.1, "reaction": 10}),
    # the local axes 1, 2, 3 are z, x, y; the cylinder's axes are radial, tangential and along z
    "transform": (deck(push(-0.02).replace("top, 3, 3", "top, 1, 1"), hold="*BOUNDARY\nfoot, 1, 3\ntop, 2, 3",
                       more="*TRANSFORM, NSET=top, TYPE=R\n0., 0., 1., 1., 0., 0."), {"reaction": 10}),
    # the bar is pulled along the axes of its upper end, which are turned about y
    "oblique": (deck(push(0.02).replace("top, 3, 3", "top, 1, 1"), pair="", mesh=JOINED.replace("500.", "1000."),
                     hold="*BOUNDARY\nfoot, 1, 3\ntop, 2, 3",
                     more="*TRANSFORM, NSET=top, TYPE=R\n3., 0., 4., 4., 0., -3."), {"reaction": -8}),
    "transformed_force": (deck(step("*CLOAD\ntop, 3, -2.5"),
                               more="*TRANSFORM, NSET=top, TYPE=C\n-1., -1., 0., -1., -1., 2.",
                               hold="*BOUNDARY\nfoot, 1, 3", law=TIED), {"energy": 0.1, "reaction": 10}),
    # one corner of the slave surface is listed; the others have its height
    "slave_point": (deck(step(PRESS), pair="*CONTACT PAIR, INTERACTION=SI, TYPE=NODE TO SURFACE\nslave, under",
                         mesh=MESH + "\n*SURFACE, NAME=slave, TYPE=NODE\n9"), {"energy": 0.1}),
    "dsload": (deck(step("*DSLOAD\nhead, P, 10."), mesh=MESH + "\n*SURFACE, NAME=head\n2, S2"), {"energy": 0.1}),
    "nodes": (deck(step("*CLOAD\ntop, 3, -1.", "*CLOAD\ntop, 3, -1.5")), {"energy": 0.1, "reaction": 10}),
    # the layer between the cubes is as stiff as each of them
    "soft": (deck(push(-0.03), law=SOFT), {"reaction": 10, "energy": 0.1}),
    # the pressure is 1 at no gap, a hundredth of that at a gap of 0.02, and 10 at a depth of 0.01
    "exponential": (deck(push(-0.03), law="*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL\n0.02, 1."), {
        "reaction": 10,
        "energy": 0.1
    }),
    "tabular": (deck(push(-0.02),
                     law="*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR\n0., 0.\n1.E7, 1."), {"reaction": 10}),
    "push": (deck(push(-0.01), push(-0.02)), {"reactions": [5, 10]}),
    "increments": (deck(push(-0.02, procedure="*STATIC, DIRECT\n0.25, 1.")), {"reactions": [2.5, 5, 7.5, 10]}),
    "amplitude": (deck(step("*BOUNDARY, AMPLITUDE=A\ntop, 3, 3, -0.02", procedure="*STATIC, DIRECT\n0.5, 1."),
                       more=AMPLITUDE), {"reactions": [10, 2.5]}),
    "total_time": (deck(step("*BOUNDARY, AMPLITUDE=A\ntop, 3, 3, -0.02"), step(),
                        more="*AMPLITUDE, NAME=A, TIME=TOTAL TIME\n0., 0., 1., 0.25,\n2., 1."), {
                            "reactions": [2.5, 10]
                        }),
    "include": ("*include, input = pressure.inp\n", {"energy": 0.1}),
    "new": (deck(step(PRESS), step("*DLOAD, OP=NEW", "*CLOAD\ntop, 3, -1.")), {"reactions": [10, 4]}),
    # as PrePoMax writes steps: everything anew, in cards without data before the cards
    "prepomax": (deck(
        *(step("*Boundary, op=New", "*Boundary\nfoot, 1, 3, 0", "*Boundary\ntop, 1, 2, 0", "*Cload, op=New",
               "*Dload, op=New", f"*Dsload\nhead, P, {value}", "*Output, Frequency=1", "*Node file\nRF, U",
               "*El file\nS, E", procedure="*Static, Solver=Pardiso") for value in (5, 10)), hold="",
        mesh=MESH + "\n*Surface, Name=head, Type=Element\n2, S2"), {"reactions": [5, 10]}),
    "gravity": (deck(step("*DLOAD\nEall, GRAV, 5., 0., 0., -1."),
                     elastic=ELASTIC + "\n*DENSITY\n2."), {"reaction": 20}),
    "node_to_surface": (deck(step(PRESS), pair="*CONTACT PAIR, INTERACTION=SI, TYPE=NODE TO SURFACE\nslave, under",
                             mesh=MESH + "\n*SURFACE, NAME=slave, TYPE=NODE\n9\n10\n11\n12"), {"energy": 0.1}),
    # the lower face of the upper cube is 0.005 away, or 0.005 too deep; adjusted, both cubes have the height 1
    "adjust": (deck(push(-0.02), mesh=shifted(1.005), pair=PAIR.replace("\n", ", ADJUST=0.01\n")), {"reaction": 10}),
    "adjust_inside": (deck(push(-0.02), mesh=shifted(0.995), pair=PAIR.replace("\n",
                                                                               ", ADJUST=0.\n")), {"reaction": 10}),
    "adjust_set": (deck(push(-0.02), mesh=shifted(1.005) + "\n*NSET, NSET=near\n9, 10, 11, 12",
                        pair=PAIR.replace("\n", ", ADJUST=near\n")), {"reaction": 10}),
    # a gap of 0.005 is closed first; the cubes then have the heights 1 and 0.995
    "too_far": (deck(push(-0.02), mesh=shifted(1.005),
                     pair=PAIR.replace("\n", ", ADJUST=0.001\n")), {"reaction": 15 / 1.995}),
    # an overlap of 0.01 that the nodes do not have; the ends do not move
    "clearance": (deck(step(), hold=HOLD + "\ntop, 3, 3",
                       more="*CLEARANCE, MASTER=under, SLAVE=over, VALUE=-0.01"), {"reaction": 5}),
    # a cube on top of the others is removed
    "removed_cube": (deck(step("*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n3", PRESS), mesh=MESH + "\n*NODE, NSET=Nall\n" +
                          "\n".join(f"{n}, {x}, {y}, 3." for n, (x, y) in enumerate(CORNERS, 17)) +
                          "\n*ELEMENT, TYPE=C3D8, ELSET=Eall\n3, 13, 14, 15, 16, 17, 18, 19, 20"), {
                              "energy": 0.1,
                              "reaction": 10
                          }),
    # follows the faces of finite strain: the area stays 1 without lateral strain
    "finite": (deck(step(PRESS, nlgeom=", NLGEOM")), {"reaction": 10}),
    # shear force over normal force; the small compression leaves the faces level
    "friction": (deck(push(-2e-5), step("*BOUNDARY\ntop, 1, 1, 0.05"),
                      law=HARD + "\n*FRICTION\n0.2, 1.E5"), {"shear": 0.2}),
    "change_friction": (deck(push(-2e-5), step("*BOUNDARY\ntop, 1, 1, 0.05"),
                             step("*CHANGE FRICTION, INTERACTION=SI\n*FRICTION\n0.1", "*BOUNDARY\ntop, 1, 1, 0.1"),
                             law=HARD + "\n*FRICTION\n0.2"), {"shear": 0.1}),
    "glued": (deck(push(-0.02), step("*BOUNDARY\ntop, 1, 1, 0.001"), law=TIED), {}),
    "rough": (deck(push(-0.02), step("*BOUNDARY\ntop, 1, 1, 0.001"), law=HARD + "\n*FRICTION, ROUGH"), {"as": "glued"}),
    "tied": (deck(push(0.02), law=TIED), {"reaction": -10}),
    "tie": (deck(push(0.02), pair="", more="*TIE, NAME=T, POSITION TOLERANCE=0.1\nover, under"), {"reaction": -10}),
    "removed": (deck(step("*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\nover, under", "*BOUNDARY\ntop, 3, 3, -0.02"),
                     step("*MODEL CHANGE, TYPE=CONTACT PAIR, ADD\nover, under")), {"reactions": [0, 10]}),
    "warm": (deck(step("*TEMPERATURE\nNall, 120."), hold=HOLD + "\ntop, 3, 3", elastic=ELASTIC + "\n*EXPANSION\n1.E-4",
                  more="*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNall, 20."), {"reaction": 10}),
    # strain 0.02 = s / 1000 + (s - 5) / 100
    "plastic": (deck(push(-0.04), elastic="*ELASTIC\n1000., 0.3\n*PLASTIC\n5., 0.\n15., 0.1",
                     hold="*BOUNDARY\nfoot, 3\n1, 1, 2\n2, 2\n9, 1, 2\n10, 2"), {"reaction": 0.07 / 0.011}),
    "orthotropic": (deck(
        push(-0.02), elastic="*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
        "2000., 1000., 500., 0., 0., 0., 400., 300.,\n200."), {"reaction": 5}),
    # The first material axis, with the modulus 2000, lies along z. The top is pushed along z.
    "stiffness": (deck(push(-0.02), elastic="*ELASTIC, TYPE=ORTHO\n2000., 0., 1000., 0., 0., 500., 400., 300.,\n200.",
                       more="*ORIENTATION, NAME=OR, SYSTEM=RECTANGULAR\n0., 0., 1., 1., 0., 0.").replace(
                           "MATERIAL=EL\n*B", "MATERIAL=EL, ORIENTATION=OR\n*B"), {"reaction": 20}),
    # the same axes, by a rotation of 90 degrees about the second one
    "rotated": (deck(push(-0.02), elastic="*ELASTIC, TYPE=ORTHO\n2000., 0., 1000., 0., 0., 500., 400., 300.,\n200.",
                     more="*ORIENTATION, NAME=OR\n1., 0., 0., 0., 1., 0.\n2, -90.").replace(
                         "MATERIAL=EL\n*B", "MATERIAL=EL, ORIENTATION=OR\n*B"), {"reaction": 20}),
    # shear modulus 400, bulk modulus 1000
    "rubber": (deck(push(-1e-5), elastic="*HYPERELASTIC, NEO HOOKE\n200., 0.002",
                    hold="*BOUNDARY\nfoot, 3\n1, 1, 2\n2, 2\n9, 1, 2\n10, 2"), {"reaction": 9e5 * 4 / 3400 * 5e-6}),
    # the same moduli at small strain
    "mooney": (deck(push(-1e-5), elastic="*HYPERELASTIC, MOONEY-RIVLIN\n150., 50., 0.002",
                    hold="*BOUNDARY\nfoot, 3\n1, 1, 2\n2, 2\n9, 1, 2\n10, 2"), {"as": "rubber"}),
    "explicit": (deck(step("*DLOAD\nEall, GRAV, 8., 0., 0., 1.",
                           procedure="*DYNAMIC, EXPLICIT\n0.01, 0.5"), hold="", elastic=ELASTIC + "\n*DENSITY\n2.",
                      more="*INITIAL CONDITIONS, TYPE=VELOCITY\nNall, 3, 3."), {"momentum": 4 * 7}),
    # a quarter of a bar, held by nothing else in its plane but at one corner
    "cyclic": (deck(step(PRESS), pair="", hold="*BOUNDARY\nfoot, 3\n2, 2", elastic="*ELASTIC\n1000., 0.3",
                    mesh=JOINED.replace("500., 0.", "1000., 0.3") + "\n*SURFACE, NAME=front\n1, S3\n2, S3\n"
                    "*SURFACE, NAME=left\n1, S6\n2, S6\n*TIE, NAME=C, CYCLIC SYMMETRY\nleft, front\n"
                    "*CYCLIC SYMMETRY MODEL, N=4, TIE=C\n0., 0., 0., 0., 0., 1."), {"energy": 0.1, "reaction": 10}),
    "dynamic": (deck(step("*DLOAD\nEall, GRAV, 8., 0., 0., 1.",
                          procedure="*DYNAMIC, DIRECT\n0.01, 0.5"), hold="", elastic=ELASTIC + "\n*DENSITY\n2.",
                     more="*INITIAL CONDITIONS, TYPE=VELOCITY\nNall, 3, 3."), {"momentum": 4 * 7}),
    "joined": (deck(push(-0.03), mesh=JOINED, pair=""), {"reaction": 10}),
    # a bar whose end is rigid, with the nodes 17 for displacements and 18 for rotations. It bends by M L / (E I)
    "rigid_push": (rigid("*BOUNDARY\n17, 1, 2\n17, 3, 3, -0.02\n17, 4, 6"), {"reaction": 10}),
    "rigid_moment": (rigid("*CLOAD\n18, 2, 0.1"), {"energy": 0.1**2 * 2 / 2 * 12 / 1000}),
    "coupling": (rigid("*CLOAD\n17, 5, 0.1", joint="*SURFACE, NAME=head\n2, S2\n*COUPLING, CONSTRAINT NAME=C, "
                       "REF NODE=17, SURFACE=head\n*KINEMATIC\n1, 3"), {"as": "rigid_moment"}),
    "distributing": (rigid("*CLOAD\n17, 5, 0.1\n17, 3, -10.", joint=DISTRIBUTING), {"energy": 0.10012, "reaction": 10}),
    # the assembly's sets `foot` and `under` are unlike those of the part
    "parts": (PARTS, {"reaction": 10}),
    "left_out": (deck(step(PRESS), step(procedure="*FREQUENCY\n10")), {"energy": 0.1}),
}

REFUSED = {
    "keyword": deck(step(PRESS), more="*MPC\nPLANE, 1, 2, 3"),
    "terms": deck(step(PRESS), more="*EQUATION\n3\n1, 3, 1., 2, 3, -1., 3, 3, 2."),
    "rigid": deck(step(PRESS), more="*RIGID BODY, NSET=two, REF NODE=1", mesh=MESH + "\n*NSET, NSET=two\n13, 14"),
    "distributed": rigid("*BOUNDARY\n17, 3, 3, -0.1", joint=DISTRIBUTING),
    "shell": deck(step(PRESS), mesh=MESH + "\n*ELEMENT, TYPE=S4\n3, 1, 2, 3, 4"),
    "heat": deck(step(procedure="*HEAT TRANSFER")),
    "two": deck(step(PRESS), more="*SPRING\n1, 3\n*MPC\nPLANE, 1, 2, 3"),
    "released": deck(step(PRESS), step("*BOUNDARY, OP=NEW\nfoot, 1, 3")),
    "edge": deck(step(PRESS), pair="*CONTACT PAIR, INTERACTION=SI\nslave, beside",
                 mesh=MESH + "\n*SURFACE, NAME=beside\n1, S6\n*SURFACE, NAME=slave, TYPE=NODE\n9\n12"),
    "velocity": deck(step("*BOUNDARY, TYPE=VELOCITY\ntop, 3, 3, -0.02")),
    "perturbation": deck(step(PRESS, nlgeom=", PERTURBATION")),
    "no_step": deck(),
    "no_set": deck(step("*CLOAD\nnowhere, 3, 1.")),
    "no_material": deck(step(PRESS)).replace("*MATERIAL, NAME=EL", "*MATERIAL, NAME=EM"),
    "no_density": deck(step("*DLOAD\nEall, GRAV, 5., 0., 0., -1.")),
    "no_number": deck(step("*CLOAD\ntop, 3, much")),
    "temperatures": deck(step(PRESS), elastic="*ELASTIC\n1000., 0., 20.\n900., 0., 100."),
    "gravity_part": deck(
        step("*DLOAD\n2, GRAV, 5., 0., 0., -1."), mesh=JOINED.replace("Elow", "Eall").replace("SOFT", "EL").replace(
            "*MATERIAL, NAME=EL\n*ELASTIC\n500., 0.\n*SOLID SECTION, ELSET=Eall, MATERIAL=EL", ""),
        elastic=ELASTIC + "\n*DENSITY\n2.", pair=""),
}


def foot(step, axis):
    """Reaction of the lower body"""
    return sum(body["reaction"][axis] for body in step["bodies"] if body["name"] in ("Eall_1", "Elow", "Low"))


def judge():
    for name, (_, expected) in DECKS.items():
        steps = load(name)["steps"]
        last = steps[-1]
        reactions = [foot(one, 2) for one in steps]
        found = {"energy": last["energy"], "reaction": reactions[-1], "reactions": reactions}
        for key, value in expected.items():
            if key == "as":
                other = load(value)["steps"][-1]
                found[key], value = [foot(last, axis) for axis in (0, 2)], [foot(other, axis) for axis in (0, 2)]
            elif key == "shear":
                found[key] = -foot(last, 0) / foot(last, 2)
            elif key == "momentum":
                found[key] = last["motions"][0]["momentum"][2]
            pairs = list(zip(found[key], value)) if isinstance(value, list) else [(found[key], value)]
            size = (5e-4 if key == "shear" else 1e-4) * max(abs(wanted) for _, wanted in pairs)
            say(
                f"{name}: {key}",
                all(abs(one - wanted) <= size for one, wanted in pairs)
                and (not isinstance(value, list) or len(found[key]) == len(value)), (found[key], value))


def write():
    """Writes all decks, and the translations of those that run. Prints why the others are refused"""
    sys.path.insert(0, os.path.join(os.environ["AMGF_DIR"], "share", "python"))
    from contact.decks.translate import PARAMETERS, translate
    from contact.meshes.model import MeshError

    for name, text in {**{key: value[0] for key, value in DECKS.items()}, **REFUSED}.items():
        with open(name + ".inp", "w") as file:
            file.write(text)
        try:
            translate(name + ".inp", name + "_deck.yaml", ["FREQUENCY"] if name == "left_out" else [])
        except MeshError as error:
            print(error)
    given = "".join(text for text, _ in DECKS.values()).upper()
    say("each keyword is in a deck that runs", all(f"*{word}" in given for word in PARAMETERS),
        [word for word in PARAMETERS if f"*{word}" not in given])


if __name__ == "__main__":
    if sys.argv[1] == "write":
        write()
    elif sys.argv[1] == "names":
        print(*DECKS)
    else:
        judge()
