# Bodies that move: two bars that meet, also on ranks and after a restart, a block that slides to rest, one that bounces, a rod that spins (dynamics_bodies.py)
contact=$AMGF_DIR/bin/contact
run() { "$contact" "$@" -quiet -error_estimate 0 2> err || { echo "exit $?"; cat err; }; }
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_bodies.py" scenes
for scene in bars bars_alpha slide bounce bounce_damped spin spin_impact rigid turn tumble pendulum massless; do run $scene.yaml -output $scene; done
for ranks in 2 3; do mpiexec --oversubscribe -n $ranks "$contact" bars.yaml -quiet -error_estimate 0 -output bars_$ranks; done
for scene in bars bars_alpha bounce_damped; do
  run $scene.yaml -checkpoint_every 15 -checkpoint $scene.h5 -output part_$scene
  run $scene.yaml -restart $scene.h5 -output part_$scene
done
"$contact" bars.yaml -quiet -load_steps 2 -effects_view 2> err | grep '^inertia'
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_bodies.py"
# the force of a contact changes in an impact: no warning of a contact one facet wide
cat > three.yaml <<'YAML'
bodies:
  - a: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [4, 2, 2], young: 1e4, poisson: 0.3, density: 1, initial_velocity: [5, 0, 0]}
  - b: {lower: [1.05, 0, 0], upper: [2.05, 1, 1], cells: [3, 3, 3], young: 1e4, poisson: 0.3, density: 1}
  - c: {lower: [2.1, 0, 0], upper: [3.1, 1, 1], cells: [4, 2, 2], young: 1e4, poisson: 0.3, density: 1}
contact:
  - ab: {mortar: a.xmax, nonmortar: b.xmin}
  - bc: {mortar: b.xmax, nonmortar: c.xmin}
dynamics: {time_step: 0.001, end_time: 0.12}
YAML
run three.yaml; cat err
