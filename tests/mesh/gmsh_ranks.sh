# Gmsh meshes are partitioned before the DMPlex is built. The answer is that of one rank, and that of a mesh that PETSc
# distributes.
"$PYTHON" "$AMGF_DIR/tests/mesh/gmsh_rings.py" write
sed "s|\.\./gmsh|$AMGF_DIR/share/gmsh|" "$AMGF_DIR/share/scenes/gmsh_blocks.yaml" > blocks.yaml
cat >> blocks.yaml << 'END'
faces:
  - corner: {of: slab.bottom, upper: [0, 0, inf]}
  - rest: {of: slab.bottom, lower: [0, -inf, -inf]}
END
run() { # scene, name, ranks, options
  mpiexec --oversubscribe -n "$3" "$AMGF_DIR/bin/contact" "$1.yaml" -quiet -tao_ipfilter_tol 1e-12 -contact_updates 1 \
    -summary "$1_$2.json" ${4:-} || echo "$1, $2: exit code $?"
}
for scene in blocks rings_27_2.2; do
  for ranks in 1 5; do run $scene $ranks $ranks; done
done
run blocks petsc 2 "-petscpartitioner_type simple"
sed 's/upper: \[0, 0, inf\]/upper: [-99, 0, inf]/' blocks.yaml > empty.yaml
mpiexec --oversubscribe -n 3 "$AMGF_DIR/bin/contact" empty.yaml -quiet 2>&1 | grep error:
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B - << 'PY'
from summaries import load, say, within
for scene, names in (("blocks", ("5", "petsc")), ("rings_27_2.2", ("5", ))):
    one = load(f"{scene}_1")
    for name in names:
        other = load(f"{scene}_{name}")
        steps = list(zip(one["steps"], other["steps"]))
        seen = [(one["dofs"], other["dofs"])] + [(a["energy"], b["energy"]) for a, b in steps]
        seen += [(p["normal_force"], q["normal_force"]) for a, b in steps for p, q in zip(a["pairs"], b["pairs"])]
        say(f"{scene}, {name}: unknowns, energies and forces as on one rank to 1e-12",
            all(within(a, b, 1e-12) for a, b in seen), seen)
PY
