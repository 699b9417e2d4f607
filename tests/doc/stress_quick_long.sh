# The quick rows of the sweeps of `make stress`: each must end as it should, at the energy that MUMPS comes to; and
# scenes in other units
cd "$AMGF_DIR/tests/stress" && "$PYTHON" run.py --quick --folder "$OLDPWD/stress"
