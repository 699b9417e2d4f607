#!/bin/sh
# Converts and checks meshes: contact-mesh IN OUT, contact-mesh IN -check
here=$(dirname "$(readlink -f "$0")")
for folder in share/amgf share; do
  script=$here/../$folder/python/contact_mesh.py
  [ ! -f "$script" ] || exec @PYTHON@ -B "$script" "$@"
done
echo "contact-mesh: error: share/python/contact_mesh.py is missing: it must be installed next to the program" >&2
exit 1
