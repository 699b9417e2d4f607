# contact-ccx: files and exit codes as those of ccx, for a deck of cubes and one of cells of order 2 that yield
ccx() {
  "$AMGF_DIR/bin/contact-ccx" "$@" -quiet > said 2> wrong
  echo "exit code $?"
  grep -hv warning wrong
}
"$PYTHON" -B "$AMGF_DIR/tests/scene/decks_ccx.py" write
ccx -i pressure -summary mine.json
cmp mine.json pressure_deck.json
ccx order2.inp -deck_ignore FREQUENCY
ccx -i reduced
ccx -i rigid
"$PYTHON" -B "$AMGF_DIR/tests/scene/decks_ccx.py" judge
grep -E '^ (-4|-5|-3)|1PSTEP|100C|^    [23]C' order2.frd
grep -vE '^ *-?[0-9]' order2.dat
ccx -i nothing
ccx -i order2
sed 's/P2, 10./P2, -10./' pressure.inp > pulled.inp
ccx -i pulled
"$AMGF_DIR/bin/contact-ccx" 2>&1 | tail -n 1
"$AMGF_DIR/bin/contact-ccx" -v
