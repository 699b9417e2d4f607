# Tetrahedra from Gmsh files of both formats beside a body of hexahedra: Lame's pipe, straight and curved, on one
# rank and on five, refined, and from a checkpoint; files for ParaView, and a picture; cells and elements that do not go
# together
contact=$AMGF_DIR/bin/contact
write() { "$PYTHON" -B "$AMGF_DIR/tests/lib/tetrahedra.py" write "$@"; }
write curved.msh 2.2 2 2 3 1
write new.msh 4.1 2 2 3 1
write straight.msh 2.2 1 2 3 1
cat > pipe.yaml <<'YAML'
bodies:
  - pipe: {mesh: curved.msh, volume: block, young: 1000, poisson: 0.3}
  - brick: {lower: [3, 0, 0], upper: [4, 1, 1], cells: [2, 2, 2], young: 1000, poisson: 0.3}
symmetry:
  - brick.xmin
  - brick.ymin
  - brick.zmin
  - bottom: {face: pipe.bottom, normal: y}
  - left: {face: pipe.left, normal: x}
  - front: {face: pipe.front, normal: z}
  - back: {face: pipe.back, normal: z}
pressures:
  - inside: {face: pipe.inner, value: 10}
probes:
  - middle: {point: [1.06066017178, 1.06066017178, 0.2]}
YAML
run() { # name, ranks, of the scene, further options
  mpiexec --oversubscribe -n "$2" "$contact" "$3.yaml" -quiet -ksp_rtol 1e-12 -summary "$1.json" "${@:4}" ||
    echo "$1: exit code $?"
}
for ranks in 1 5; do
  run "p$ranks" $ranks pipe
done
sed 's/curved/new/' pipe.yaml > new.yaml
sed 's/curved/straight/' pipe.yaml > straight.yaml
sed '0,/poisson: 0.3/s//poisson: 0.3, element: bbar/' pipe.yaml > bbar.yaml
run old 1 new
run straight 1 straight
run bbar 1 bbar
run r1 2 pipe -refine 1 -output pipe -checkpoint pipe_1.h5 -checkpoint_every 1
run r2 2 pipe -refine 2
echo "load: {factors: [1, 2]}" | cat pipe.yaml - > beyond.yaml
run whole 1 beyond -refine 2
run part 3 beyond -refine 2 -restart pipe_1.h5
run drawn 1 pipe -output drawn
"$PYTHON" -B "$AMGF_DIR/share/plot/draw.py" drawn drawn.png --scale 10 && [ -s drawn.png ] && echo "drawn"
"$contact" pipe.yaml -scene_check | grep -E "tetrahedra|cells|order 2"
sed '0,/poisson: 0.3/s//poisson: 0.3, element: incompatible/' pipe.yaml > refused.yaml
"$contact" refused.yaml -quiet 2>&1 || echo "exit code $?"
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B "$AMGF_DIR/tests/lib/tetrahedra.py" check
