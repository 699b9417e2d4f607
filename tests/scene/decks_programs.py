"""Decks as FreeCAD and PrePoMax export them, and what contact-ccx must give: python decks_programs.py write|judge.

Two cubes of 10-node tetrahedra stand on one another: [0, 1]^3 and [0, 1]^2 x [1, 2], E = 1000, no lateral strain."""
import itertools
import sys

from decks_ccx import blocks, close
from summaries import say


def cubes():
    """Nodes {number: place}, elements {number: nodes} of 10-node tetrahedra, six for each cube"""
    number, elements = {}, {}

    def node(cube, place):
        return number.setdefault((cube, place), len(number) + 1)

    for cube in range(2):
        for order in itertools.permutations(range(3)):
            corners = [(0.0, 0.0, float(cube))]
            for axis in order:
                corners.append(tuple(x + (a == axis) for a, x in enumerate(corners[-1])))
            if order in ((0, 2, 1), (1, 0, 2), (2, 1, 0)):  # odd permutations: the other orientation
                corners[1], corners[2] = corners[2], corners[1]
            middle = [tuple((a + b) / 2 for a, b in zip(corners[i], corners[j]))
                      for i, j in ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))]
            elements[len(elements) + 1] = [node(cube, place) for place in corners + middle]
    return {n: place for (_, place), n in number.items()}, elements


NODES, ELEMENTS = cubes()
SIDES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # corners of the sides 1 to 4


def face(cube, z):
    """[(element, side)] of the facets of a cube at a height"""
    return [(e, k) for e, nodes in ELEMENTS.items() if (e > 6) == cube
            for k, side in enumerate(SIDES, 1) if all(NODES[nodes[i]][2] == z for i in side)]


def at(cube, z):
    return sorted({n for e, nodes in ELEMENTS.items() if (e > 6) == cube for n in nodes if NODES[n][2] == z})


FOOT, TOP = at(0, 0), at(1, 2)
LINE = "*" * 59


def freecad(contact, load, step="*STEP, INC=2000", sets=""):
    nodes = "\n".join(f"{n}, {x:.9f}, {y:.9f}, {z:.9f}" for n, (x, y, z) in NODES.items())
    elements = "\n".join(f"{e}, " + ", ".join(map(str, nodes)) for e, nodes in ELEMENTS.items())
    return f"""** written by FreeCAD inp file writer for CalculiX,Abaqus meshes
** all nodes
*Node, NSET=Nall
{nodes}


** Volume elements
*Element, TYPE=C3D10, ELSET=Evolumes
{elements}

** Define element set Eall
*ELSET, ELSET=Eall
Evolumes

{LINE}
** Element sets for materials and FEM element type (solid, shell, beam, fluid)
*ELSET,ELSET=MaterialSolidSolid
Evolumes

{LINE}
** constraints_fixed_node_sets
** ConstraintFixed
*NSET,NSET=ConstraintFixed
{chr(10).join(f"{n}," for n in FOOT)}
** constraints_displacement_node_sets
*NSET,NSET=ConstraintDisplacement
{chr(10).join(f"{n}," for n in TOP)}
{sets}
** Physical constants for SI(mm) unit system with Kelvins
*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0, STEFAN BOLTZMANN=5.670374419e-11

{LINE}
** Materials
*MATERIAL, NAME=MaterialSolid
*ELASTIC
1000,0
*EXPANSION, ZERO=0
0

{LINE}
** Sections
*SOLID SECTION, ELSET=MaterialSolidSolid, MATERIAL=MaterialSolid
{contact}
{LINE}
** At least one step is needed to run an CalculiX analysis of FreeCAD
{step}
*STATIC
1,1,1e-05,1


{LINE}
** Fixed Constraints
** ConstraintFixed
*BOUNDARY
ConstraintFixed,1
ConstraintFixed,2
ConstraintFixed,3

{load}
{LINE}
** Outputs --> frd file
*NODE FILE
U
*EL FILE
S, E
** outputs --> dat file
*NODE PRINT, NSET=ConstraintFixed, TOTALS=ONLY
RF
*OUTPUT, FREQUENCY=1
{LINE}
*END STEP
"""


def sides(name, cells):
    return "\n".join([f"*SURFACE, NAME={name}", *(f"{e},S{k}" for e, k in cells)])


SLAVE, MASTER = sides("DEPConstraintContact", face(1, 1)), sides("INDConstraintContact", face(0, 1))


def freecad_contact(law, more=""):
    return f"""
** Contact Constraints
*CONTACT PAIR, INTERACTION=INTConstraintContact, TYPE=SURFACE TO SURFACE
DEPConstraintContact, INDConstraintContact
*SURFACE INTERACTION, NAME=INTConstraintContact
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}{more}
"""


PUSHED = "*BOUNDARY\nConstraintDisplacement,1,1,0.0\nConstraintDisplacement,2,2,0.0\nConstraintDisplacement,3,3,-0.02\n"


def consistent(total):
    """Forces of a uniform pressure on the top: a third of that on a facet at each of its middle nodes"""
    forces = {}
    for e, k in face(1, 2):
        corners = [ELEMENTS[e][i] for i in SIDES[k - 1]]
        for n in ELEMENTS[e][4:]:
            if NODES[n][2] == 2 and any(
                    all(abs(NODES[n][c] - (NODES[a][c] + NODES[b][c]) / 2) < 1e-9 for c in range(3))
                    for a, b in itertools.combinations(corners, 2)):
                forces[n] = forces.get(n, 0.0) + total * 0.5 / 3
    return "*CLOAD\n" + "\n".join(f"{n},3,{force:.13G}" for n, force in forces.items()) + "\n"


def ids(numbers):
    numbers = list(map(str, numbers))
    return ",\n".join(", ".join(numbers[i:i + 16]) for i in range(0, len(numbers), 16))


def prepomax_surface(name, cells):
    """PrePoMax makes an element set for each side of a surface"""
    text, rows = "", []
    for k in sorted({k for _, k in cells}):
        text += f"*Elset, Elset=Internal-{name}_S{k}\n{ids(e for e, side in cells if side == k)}\n"
        rows.append(f"Internal-{name}_S{k}, S{k}")
    return text + f"*Surface, Name={name}, Type=Element\n" + "\n".join(rows) + "\n"


def prepomax(contact, *steps):
    nodes = "\n".join(f"{n}, {x:.8E}, {y:.8E}, {z:.8E}" for n, (x, y, z) in NODES.items())
    parts = "\n".join(f"*Element, Type=C3D10, Elset=Solid_part-{cube + 1}\n" +
                      "\n".join(f"{e}, " + ", ".join(map(str, n)) for e, n in ELEMENTS.items() if (e > 6) == cube)
                      for cube in range(2))
    surfaces = prepomax_surface("Slave", face(1, 1)) + prepomax_surface("Master", face(0, 1)) + prepomax_surface(
        "Internal_Selection-1_Pressure-1", face(1, 2))
    written = "\n".join(f"""**
** Steps ++++++++++++++++++++++++++++++++++++++++++++++++++++
**
** Step-{n} ++++++++++++++++++++++++++++++++++++++++++++++++++++
**
*Step{keys}, Inc=100
*Static, Solver=Pardiso
1, 1, 1E-05, 1E+30
**
** Output frequency ++++++++++++++++++++++++++++++++++++++++++
**
*Output, Frequency=1
**
** Boundary conditions +++++++++++++++++++++++++++++++++++++++
**
*Boundary, op=New
** Name: Fixed-1
*Boundary
Internal_Selection-1_Fixed-1, 1, 6, 0
{held}**
** Loads +++++++++++++++++++++++++++++++++++++++++++++++++++++
**
*Cload, op=New
*Dload, op=New
{load}**
** Field outputs +++++++++++++++++++++++++++++++++++++++++++++
**
*Node file
RF, U
*El file
S, E, NOE
*Contact file
CDIS, CSTR
**
*End step""" for n, (keys, held, load) in enumerate(steps, 1))
    return f"""**
** Heading +++++++++++++++++++++++++++++++++++++++++++++++++++
**
*Heading
Hash: 0, Date: 1.1.2025, Unit system: MM_TON_S_C
**
** Nodes +++++++++++++++++++++++++++++++++++++++++++++++++++++
**
*Node
{nodes}
**
** Elements ++++++++++++++++++++++++++++++++++++++++++++++++++
**
{parts}
**
** Node sets +++++++++++++++++++++++++++++++++++++++++++++++++
**
*Nset, Nset=Internal_Selection-1_Fixed-1
{ids(FOOT)}
*Nset, Nset=Internal_Selection-1_Displacement-1
{ids(TOP)}
**
** Element sets ++++++++++++++++++++++++++++++++++++++++++++++
**
{surfaces}**
** Materials +++++++++++++++++++++++++++++++++++++++++++++++++
**
*Material, Name=Material-1
*Density
2
*Elastic
1000, 0
**
** Sections ++++++++++++++++++++++++++++++++++++++++++++++++++
**
*Solid section, Elset=Solid_part-1, Material=Material-1
*Solid section, Elset=Solid_part-2, Material=Material-1
**
** Surface interactions ++++++++++++++++++++++++++++++++++++++
**
{contact}
{written}
"""


def prepomax_contact(law, keys=""):
    return f"""*Surface interaction, Name=Surface_interaction-1
*Surface behavior, Pressure-overclosure={law}
**
** Contact pairs +++++++++++++++++++++++++++++++++++++++++++++
**
*Contact pair, Interaction=Surface_interaction-1, Type=Surface to surface{keys}
Slave, Master"""


def down(depth):
    name = "Internal_Selection-1_Displacement-1"
    return f"** Name: Displacement-1\n*Boundary\n{name}, 1, 1, 0\n{name}, 2, 2, 0\n{name}, 3, 3, {-depth}\n"


GUIDED = "** Name: Displacement-1\n*Boundary\n" + "".join(
    f"Internal_Selection-1_Displacement-1, {dof}, {dof}, 0\n" for dof in (1, 2))
PRESSURE = "** Name: Pressure-1\n*Dsload\nInternal_Selection-1_Pressure-1, P, 10\n"

# stretch l of each cube under a pressure of 10: 1000 (l^2 - 1) l / 2 = -10
STRETCH = 0.99
for _ in range(50):
    STRETCH -= (500 * (STRETCH**3 - STRETCH) + 10) / (500 * (3 * STRETCH**2 - 1))
FINITE = 2 * (STRETCH - 1)

# deck, displacement of the top, stress at the foot
DECKS = {
    "freecad_soft": (freecad(freecad_contact("LINEAR", "\n500\n*FRICTION\n0.3, 1000000"), PUSHED,
                             sets=SLAVE + "\n" + MASTER), -0.02, -5),
    "freecad_tied": (freecad(freecad_contact("TIED", "\n1000000"), consistent(-10.0), sets=SLAVE + "\n" + MASTER),
                     -0.02, -10),
    "freecad_pressure": (freecad(
        "*TIE, POSITION TOLERANCE=0.1, ADJUST=NO, NAME=ConstraintTie\nTIE_DEP, TIE_IND\n",
        "*DLOAD\n" + "\n".join(f"{e},P{k},10" for e, k in face(1, 2)) + "\n", step="*STEP, NLGEOM, INC=2000",
        sets=sides("TIE_DEP", face(1, 1)) + "\n" + sides("TIE_IND", face(0, 1))), FINITE, None),
    "prepomax_hard": (prepomax(prepomax_contact("Hard", ", Adjust=0.01"), ("", GUIDED, PRESSURE)), -0.02, -10),
    "prepomax_soft": (prepomax(prepomax_contact("Linear\n500\n*Friction\n0.1, 10000"), ("", down(0.01), ""),
                               ("", down(0.02), "")), -0.02, -5),
    "prepomax_gravity": (prepomax("*Tie, Name=Tie-1, Position tolerance=0.05\nSlave, Master",
                                  ("", "", "** Name: Gravity-1\n*Dload\nSolid_part-2, Grav, 5, 0, 0, -1\n")), -0.015,
                         None),
}


def judge():
    for name, (_, top, stress) in DECKS.items():
        found = blocks(name)
        last = max(step for _, step in found if step)
        fields = {field for field, step in found if step == last}
        wanted = {"DISP", "STRESS", "TOSTRAIN"} | ({"CONTACT"} if name in ("freecad_soft", "prepomax_hard",
                                                                      "prepomax_soft") else set())
        say(f"{name}: fields", wanted <= fields, fields)
        say(f"{name}: nodes of the deck", sorted(found["DISP", last]) == sorted(NODES), len(found["DISP", last]))
        close(f"{name}: displacement of the top", [found["DISP", last][n][2] for n in TOP], [top] * len(TOP))
        if stress is not None:
            close(f"{name}: stress", [found["STRESS", last][n][2] for n in FOOT], [stress] * len(FOOT))
            close(f"{name}: strain", [found["TOSTRAIN", last][n][2] for n in FOOT], [stress / 1000] * len(FOOT))


if __name__ == "__main__":
    if sys.argv[1] == "write":
        for key, value in DECKS.items():
            with open(key + ".inp", "w") as out:
                out.write(value[0])
    elif sys.argv[1] == "names":
        print(*DECKS)
    else:
        judge()
