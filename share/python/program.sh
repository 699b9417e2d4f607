#!/bin/sh
# Runs the Python program @NAME@, whose file is in the folder share of this tree or of an installation
here=$(dirname "$(readlink -f "$0")")
for folder in share/amgf share; do
  script=$here/../$folder/python/@FILE@
  [ ! -f "$script" ] || exec @PYTHON@ -B "$script" "$@"
done
echo "@NAME@: error: share/python/@FILE@ is missing: it must be installed next to the program" >&2
exit 1
