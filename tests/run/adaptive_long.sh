# adaptive on more numbers of ranks, with finer meshes of the scene with friction and of the block with edges
set -- long
. "$AMGF_DIR/tests/run/adaptive.sh"
