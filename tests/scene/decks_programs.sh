# Decks as FreeCAD and PrePoMax export them: contact-ccx runs them, and its results have the fields they look for
judge() { "$PYTHON" -B "$AMGF_DIR/tests/scene/decks_programs.py" "$@"; }
judge write
for name in $(judge names); do
  "$AMGF_DIR/bin/contact-ccx" -i "$name" -quiet > said 2> wrong || { echo "$name: exit code $?"; cat wrong; }
done
judge judge
