#!/bin/sh
# Runs decks as ccx does: contact-ccx -i JOB
here=$(dirname "$(readlink -f "$0")")
python=python3
[ ! -x /usr/bin/python3 ] || python=/usr/bin/python3
for folder in share/amgf share; do
  script=$here/../$folder/python/contact_ccx.py
  [ ! -f "$script" ] || exec $python -B "$script" "$@"
done
echo "contact-ccx: error: share/python/contact_ccx.py is missing: it must be installed next to the program" >&2
exit 1
