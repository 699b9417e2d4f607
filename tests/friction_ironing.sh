# Ironing with friction at finite strain against published forces (friction_ironing.py)
"$PYTHON" "$AMGF_DIR/tests/friction_ironing.py" scenes
timeout 1200 "$AMGF_DIR/bin/contact" ironing.yaml -quiet -summary ironing.json 2> /dev/null
"$PYTHON" "$AMGF_DIR/tests/friction_ironing.py"
