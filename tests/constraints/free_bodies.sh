# Bodies that are hardly held (free_bodies.py).
# A slender body that is clamped at one end gets no warning of a missing support.
# A force along its faces moves a bracket that a bolt presses down without friction. The program must report this before
# the first solve.
# A log that lies on two other logs without friction finds its equilibrium, although it can turn about its axis.
# A strip keeps its position when its forming tools have lost contact with it.
contact=$AMGF_DIR/bin/contact
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B "$AMGF_DIR/tests/constraints/free_bodies.py" write
run() { # scene, ranks; a pair that stays open is meant
  mpiexec --oversubscribe -n "$2" "$contact" "$1.yaml" -quiet -error_estimate 0 -summary "$1_$2.json" > "$1.said" 2>&1
  code=$?
  grep '^contact:' "$1.said" | grep -v 'was open at the end\|penetrates the other body'
  echo "$1, $2 ranks: exit code $code"
}
for scene in cantilever_60 cantilever_100 pressed leaf lever; do run $scene 1; done
run cantilever_100 3
for n in 20 24 32; do run logs_$n 1 && run logs_${n}_swapped 1; done
run logs_24 3
for law in linear neohookean; do run springback_$law 1 && run springback_$law 3; done
for n in 1 3; do (ulimit -t 5 && run bracket $n); done # seconds of the processor; solves that find nothing take 100
PYTHONPATH=$AMGF_DIR/tests/lib "$PYTHON" -B "$AMGF_DIR/tests/constraints/free_bodies.py" judge
