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
# a block flies 6 m in steps of 500 wave times towards a wall that it does not reach: each step takes few AMG applications
cat > fly.yaml <<'YAML'
bodies:
  - wall: {lower: [-9, -5, -5], upper: [-8, 5, 5], cells: [1, 1, 1], material: rigid}
  - block: {lower: [1, 0, 0], upper: [2, 1, 1], cells: [4, 4, 4], young: 2e11, poisson: 0.3, density: 8000, initial_velocity: [-20, 0, 0]}
displacements:
  - fix: {body: wall, value: [0, 0, 0]}
contact:
  - hit: {mortar: wall.xmax, nonmortar: block.xmin}
dynamics: {time_step: 0.1, end_time: 0.3}
YAML
"$contact" fly.yaml -quiet -error_estimate 0 -tao_ipfilter_direct false -output fly 2> /dev/null || echo "exit $?"
"$PYTHON" -c "
from histories import history
from summaries import say
run = history('fly')
say('fly: at most 200 AMG applications a step', max(run['amg_applications']) <= 200, run['amg_applications'])
say('fly: momentum stays', max(abs(p / -160000 - 1) for p in run['dynamics.momentum_x']) < 1e-9, run['dynamics.momentum_x'])"
