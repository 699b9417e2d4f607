# A name in TESTS that no test has is an error, also beside names of tests
for names in nosuch "test_names nosuch*"; do
  env -u MAKEFLAGS -u MAKELEVEL make -n -C "$AMGF_DIR" -f tests/makefile check TESTS="$names" 2>&1 |
    sed -n 's/^.*\*\*\* //p'
  env -u MAKEFLAGS -u MAKELEVEL make -n -C "$AMGF_DIR" -f tests/makefile check TESTS="$names" > /dev/null 2>&1 &&
    echo "$names: exit code 0"
done
true
