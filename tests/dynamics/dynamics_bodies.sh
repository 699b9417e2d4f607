# Bodies that move: two bars that meet, also on ranks and after a restart, a block that slides to rest, one that
# bounces, a rod that spins (dynamics_bodies.py)
contact=$AMGF_DIR/bin/contact
run() { "$contact" "$@" -quiet -error_estimate 0 2> err || { echo "exit $?"; cat err; }; }
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_bodies.py" scenes
# momentum is kept as exactly as the optimizer solves a step
exact="-tao_gatol 1e-11"
for scene in bars bars_alpha; do run $scene.yaml $exact -output $scene; done
for scene in slide bounce bounce_damped spin spin_impact rigid turn tumble pendulum massless; do
  run $scene.yaml -output $scene; done
mpiexec --oversubscribe -n 3 "$contact" bars.yaml -quiet -error_estimate 0 $exact -output bars_3
for scene in bars bars_alpha bounce_damped; do
  [ $scene != bounce_damped ] || exact=
  run $scene.yaml $exact -checkpoint_every 15 -checkpoint $scene.h5 -output part_$scene
  run $scene.yaml $exact -restart $scene.h5 -output part_$scene
done
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_bodies.py"
# the force of a contact changes in an impact: no warning of a contact one facet wide
cat > three.yaml <<'YAML'
bodies:
  - a: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [4, 2, 2], young: 1e4, poisson: 0.3, density: 1,
        initial_velocity: [5, 0, 0]}
  - b: {lower: [1.05, 0, 0], upper: [2.05, 1, 1], cells: [3, 3, 3], young: 1e4, poisson: 0.3, density: 1}
  - c: {lower: [2.1, 0, 0], upper: [3.1, 1, 1], cells: [4, 2, 2], young: 1e4, poisson: 0.3, density: 1}
contact:
  - ab: {mortar: a.xmax, nonmortar: b.xmin}
  - bc: {mortar: b.xmax, nonmortar: c.xmin}
dynamics: {time_step: 0.001, end_time: 0.12}
YAML
run three.yaml; cat err
# a block flies 6 m in steps of 500 wave times towards a wall that it does not reach: each step takes few AMG
# applications
cat > fly.yaml <<'YAML'
bodies:
  - wall: {lower: [-9, -5, -5], upper: [-8, 5, 5], cells: [1, 1, 1], material: rigid}
  - block: {lower: [1, 0, 0], upper: [2, 1, 1], cells: [4, 4, 4], young: 2e11, poisson: 0.3, density: 8000,
            initial_velocity: [-20, 0, 0]}
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
momentum = run['dynamics.momentum_x']
say('fly: momentum stays', max(abs(p / -160000 - 1) for p in momentum) < 1e-9, momentum)"
# the end of a bar is moved to and fro: reaction, and its work
cat > pull.yaml <<'YAML'
bodies:
  - bar: {lower: [0, 0, 0], upper: [1, 0.1, 0.1], cells: [10, 1, 1], young: 1000, poisson: 0, element: full, density: 1}
symmetry: [bar.ymin, bar.zmin]
displacements:
  - fix: {face: bar.xmin, value: [0, free, free]}
  - pull: {face: bar.xmax, value: [0.01, free, free]}
load: {expression: "sin(6*t)^2"}
dynamics: {time_step: 0.005, end_time: 0.5}
YAML
cp pull.yaml impact.yaml
sed 's/end_time: 0.5/&, scheme: generalized_alpha, spectral_radius: 1/' pull.yaml > generalized_alpha.yaml
for scheme in impact generalized_alpha; do run $scheme.yaml -output $scheme; done
"$PYTHON" -c "
from histories import history
from summaries import say
for name in 'impact', 'generalized_alpha':
    run = history(name)
    reaction, lost = run['bar.xmax.reaction_x'][50:53], run['dynamics.numerical_dissipation']
    say(name + ': reaction E A u/L of a bar that is moved slowly, to 10 %',
        all(abs(f - 0.1) < 0.01 for f in reaction), reaction)
    say(name + ': work of the moved end is energy, to 5 % of the largest',
        max(map(abs, lost)) < 0.05 * max(run['dynamics.total_energy']), lost)"
# a ball hits a plate with facets far larger than the contact: a force acts although no vertex is closed, so that no
# warning says that the pair was open
cat > drop.yaml <<'YAML'
bodies:
  - plate: {lower: [0, 0, -2], upper: [20, 20, 0], cells: [8, 8, 2], young: 210000, poisson: 0.3, density: 7.85e-9}
  - ball: {shape: ball, center: [0, 0, 5.01], octant: [1, 1, -1], radius: 5, patches: [4, 4, 4], layers: 3,
           young: 210000, poisson: 0.3, density: 7.85e-9, initial_velocity: [0, 0, -2000]}
symmetry: [plate.xmin, plate.ymin, ball.x0, ball.y0]
displacements:
  - edge: {face: plate.xmax, value: [0, 0, 0]}
contact:
  - hit: {mortar: plate.zmax, nonmortar: ball.surface, distance: 2}
dynamics: {time_step: 2e-6, end_time: 24e-6}
YAML
run drop.yaml -output drop; grep -c 'was open at the end' err
"$PYTHON" -c "
from histories import history
from summaries import say
say('drop: a contact force', max(history('drop')['contact_force_z']) > 10, '')"
