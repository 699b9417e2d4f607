# Bodies that move: two bars that meet, also on ranks and after a restart, a block that slides to rest, one that bounces, a rod that spins (dynamics_bodies.py)
contact=$AMGF_DIR/bin/contact
run() { "$contact" "$@" -quiet -error_estimate 0 2> err || { echo "exit $?"; cat err; }; }
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_bodies.py" scenes
for scene in bars bars_alpha slide bounce bounce_damped spin rigid turn tumble pendulum massless; do run $scene.yaml -output $scene; done
for ranks in 2 3; do mpiexec --oversubscribe -n $ranks "$contact" bars.yaml -quiet -error_estimate 0 -output bars_$ranks; done
for scene in bars bars_alpha bounce_damped; do
  run $scene.yaml -checkpoint_every 15 -checkpoint $scene.h5 -output part_$scene
  run $scene.yaml -restart $scene.h5 -output part_$scene
done
"$contact" bars.yaml -quiet -load_steps 2 -effects_view 2> err | grep '^inertia'
"$PYTHON" "$AMGF_DIR/tests/dynamics/dynamics_bodies.py"
