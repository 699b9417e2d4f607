# adaptive on more numbers of ranks, with a cold start of the scene with friction, and with a block with edges
set -- long
. "$AMGF_DIR/tests/run/adaptive.sh"
