#!/bin/sh
# Converts and checks meshes: contact-mesh IN OUT, contact-mesh IN -check
here=$(dirname "$(readlink -f "$0")")
python=python3
[ ! -x /usr/bin/python3 ] || python=/usr/bin/python3
for folder in share/amgf share; do
  script=$here/../$folder/python/contact_mesh.py
  [ ! -f "$script" ] || exec $python -B "$script" "$@"
done
echo "contact-mesh: error: share/python/contact_mesh.py is missing: it must be installed next to the program" >&2
exit 1
