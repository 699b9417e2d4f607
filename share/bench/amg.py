"""One solve by three multigrid cycles, of a connecting rod of tetrahedra (Gmsh) on one core: amg.py [SIZE]

SIZE is the size of the cells [mm]; 1.39 gives about the 81,657 unknowns of AMGCL's benchmark. Each cycle runs in a
process of its own. Times are processor times; digits are those that CG gains."""
import math
import os
import subprocess
import sys
import time

TOP = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOLDER = os.path.join(TOP, "build", "amg")
HYPRE = {
    "coarsen_type": "HMIS", "interp_type": "ext+i", "P_max": "4", "strong_threshold": "0.5", "agg_nl": "0",
    "relax_type_all": "l1scaled-SOR/Jacobi"
}
CYCLES = {
    "blockamg": ["-pc_type", "blockamg"],
    "hypre's BoomerAMG": ["-pc_type", "hypre"] + [word for key, value in HYPRE.items()
                                                  for word in (f"-pc_hypre_boomeramg_{key}", value)],
    "PETSc's GAMG": ["-pc_type", "gamg"],
}
SCENE = """problem: rod
bodies:
  - rod: {mesh: rod.msh, volume: rod, young: 210000, poisson: 0.3, order: 1, element: full}
displacements:
  - hold: {face: rod.held, value: [0, 0, 0]}
forces:
  - pull: {face: rod.pulled, value: [1000, 0, 200]}
"""


def mesh(size):
    """A bar between two rings; writes rod.msh"""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    parts, model = gmsh.model.occ, gmsh.model
    rings = [parts.addCylinder(x, 0, 0, 0, 0, 20, radius) for x, radius in ((0, 30), (150, 18))]
    body, _ = parts.fuse([(3, rings[0])], [(3, rings[1]), (3, parts.addBox(20, -10, 4, 120, 20, 12))])
    holes = [(3, parts.addCylinder(x, 0, -1, 0, 0, 22, radius)) for x, radius in ((0, 20), (150, 10))]
    body, _ = parts.cut(body, holes)
    parts.synchronize()
    model.setPhysicalName(3, model.addPhysicalGroup(3, [tag for _, tag in body]), "rod")
    for name, x, radius in (("held", 0, 20), ("pulled", 150, 10)):
        box = (x - radius - 0.1, -radius - 0.1, -0.1, x + radius + 0.1, radius + 0.1, 20.1)
        bore = [tag for _, tag in model.getEntitiesInBoundingBox(*box, 2) if model.getType(2, tag) == "Cylinder"]
        model.setPhysicalName(2, model.addPhysicalGroup(2, bore), name)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.option.setNumber("Mesh.MeshSizeMax", size)
    model.mesh.generate(3)
    gmsh.write("rod.msh")


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def solve(options):
    """Prints unknowns, iterations, digits, processor times of set-up and solution, and the memory of the cycle"""
    import h5py
    import petsc4py

    plugin = os.path.join(TOP, "lib", "libpetscamgf.so")
    petsc4py.init([sys.argv[0], "-dll_append", plugin, "-ksp_type", "cg", "-ksp_rtol", "1e-8", "-ksp_norm_type",
                   "unpreconditioned", *options])
    from petsc4py import PETSc

    K, b, places = PETSc.Mat(), PETSc.Vec(), PETSc.Vec()
    K.create()
    K.setType("aij")
    K.load(PETSc.Viewer().createBinary("K.bin"))
    K.setBlockSize(3)
    b.load(PETSc.Viewer().createBinary("b.bin"))
    with h5py.File("rod.h5") as file:
        places.createWithArray(file["vertices"][...].ravel().copy(), bsize=3)
        K.setNearNullSpace(PETSc.NullSpace().createRigidBody(places))
    x, ksp = b.duplicate(), PETSc.KSP().create()
    ksp.setOperators(K)
    ksp.setFromOptions()
    before, start = resident(), time.process_time()
    ksp.setUp()
    done = time.process_time()
    ksp.solve(b, x)
    end = time.process_time()
    rest = b.copy()
    K.multAdd(-x, b, rest)
    print(b.getSize(), ksp.getIterationNumber(), math.log10(b.norm() / rest.norm()), done - start, end - done,
          resident() - before)


def main():
    os.makedirs(FOLDER, exist_ok=True)
    os.chdir(FOLDER)
    if sys.argv[1:2] == ["--solve"]:
        solve(sys.argv[2:])
        return
    mesh(float(sys.argv[1]) if len(sys.argv) > 1 else 1.39)
    with open("rod.yaml", "w", encoding="utf-8") as file:
        file.write(SCENE)
    dump = [word for name, file in (("mat", "K"), ("rhs", "b")) for word in (f"-elasticity_ksp_view_{name}",
                                                                             f"binary:{file}.bin")]
    subprocess.run([os.path.join(TOP, "bin", "contact"), "rod.yaml", "-quiet", "-error_estimate", "0", "-output", "rod",
                    "-elasticity_pc_amgf_factor", "false", *dump], check=True, stdout=subprocess.DEVNULL)
    print("| cycle | unknowns | iterations | µs an unknown and digit | set-up [s] | solution [s] | memory [MB] |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, options in CYCLES.items():
        ended = subprocess.run([sys.executable, os.path.abspath(__file__), "--solve", *options], capture_output=True,
                               text=True, check=True)
        n, iterations, digits, setup, solution, memory = (float(word) for word in ended.stdout.split())
        print(f"| {name} | {n:,.0f} | {iterations:.0f} | {1e6 * solution / n / digits:.2f} | {setup:.2f} | "
              f"{solution:.2f} | {memory:.0f} |")


if __name__ == "__main__":
    main()
