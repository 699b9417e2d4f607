# Decks of Abaqus and CalculiX: each keyword, by closed forms; what is refused, and what -deck_ignore leaves out
contact=$AMGF_DIR/bin/contact
decks() { "$PYTHON" -B "$AMGF_DIR/tests/scene/decks.py" "$@"; }
mesh() { "$AMGF_DIR/bin/contact-mesh" "$@" 2>&1; }
try() { "$contact" "$@" -quiet 2>&1 || echo "exit code $?"; }
decks write
for deck in $(decks names); do try "${deck}_deck.yaml" -summary "$deck.json" -error_estimate 0 | grep -v warning; done
mpiexec --oversubscribe -n 3 "$contact" friction.inp -quiet -summary friction.json -error_estimate 0
decks judge

mpiexec --oversubscribe -n 2 "$contact" keyword.inp -quiet 2>&1 | grep "^contact"
mesh keyword.inp -scene keyword.yaml -deck_ignore mpc -quiet
try keyword.yaml -scene_check | grep "contact pair"
mesh pressure.inp -scene pressure_deck.yaml -deck_ignore EQUATION
echo "problem: mine" > pressure_deck.yaml
try pressure.inp

mesh two.inp -scene two.yaml -deck_ignore "SPRING, *mpc"
mesh rough_deck.msh -scene two.yaml
mesh edge.inp -scene edge.yaml -deck_ignore "CONTACT PAIR" | grep "holds no whole facet"
grep -v "^  *#" rough_deck.yaml
