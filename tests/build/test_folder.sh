# A shell test begins without the files that an earlier run of it left: they could be taken for its own
mkdir -p tests shell counts
echo 'test -e left && echo yes || echo no; touch left' > tests/inner.sh
harness=$(sed -n "s|^\. '\(.*\)/petsc_harness.sh'|\1|p" ../test_folder.sh)
sed -e 's|@NAME@|inner|g' -e "s|@TESTDIR@|$PWD|g" -e "s|@CONFIGDIR@|$harness|g" -e "s|@AMGF_DIR@|$PWD|g" \
  -e 's|@FOLDER@|tests|g' "$AMGF_DIR/share/shell-test.sh.in" > shell/inner.sh
for run in 1 2; do
  bash shell/inner.sh > log || cat log
  echo "run $run finds the file of an earlier run: $(cat shell/inner/inner.tmp)"
done
