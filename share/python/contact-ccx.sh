#!/bin/sh
# Runs decks as ccx does: contact-ccx -i JOB
here=$(dirname "$(readlink -f "$0")")
for folder in share/amgf share; do
  script=$here/../$folder/python/contact_ccx.py
  [ ! -f "$script" ] || exec @PYTHON@ -B "$script" "$@"
done
echo "contact-ccx: error: share/python/contact_ccx.py is missing: it must be installed next to the program" >&2
exit 1
