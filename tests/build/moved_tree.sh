# The scripts of the tests have absolute paths: a copy of a tree that was tested makes them anew, and a second call
# leaves them alone
rm -rf tree && mkdir tree && cp -a "$AMGF_DIR"/makefile "$AMGF_DIR"/share "$AMGF_DIR"/tests tree &&
  mkdir -p tree/build/tests/shell
cp "$AMGF_DIR"/build/configuration tree/build && cp "$AMGF_DIR"/build/tests/place tree/build/tests &&
  touch tree/build/tests/shell/old.sh
plan() { env -u MAKEFLAGS -u MAKELEVEL make -n -C tree -f tests/makefile check TESTS=structure > log 2>&1 \
  || tail -3 log; }
plan
[ -e tree/build/tests/shell/old.sh ] || echo "the scripts of the other place are gone"
mkdir -p tree/build/tests/shell && touch tree/build/tests/shell/new.sh
plan
[ -e tree/build/tests/shell/new.sh ] && echo "those of this place stay"
