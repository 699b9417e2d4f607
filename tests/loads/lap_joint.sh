# A lap joint whose bolt is held by nothing but the friction of its head and nut. It slips at the force in closed form.
"$PYTHON" "$AMGF_DIR/tests/loads/lap_joint.py" write
run() {
  mpiexec --oversubscribe -n $2 "$AMGF_DIR/bin/contact" $1.yaml -quiet -summary $1_$2.json 2>&1 |
    grep -v 'penetrates the other body'
}
run slip 1
run tight 1
run smooth 1
"$PYTHON" "$AMGF_DIR/tests/loads/lap_joint.py" judge
