#!/bin/sh
# Usage: uninstall.sh ROOT
# Removes what install.sh made below ROOT, of folders those that nobody else has put something into.
set -eu
root=$1
list=$root/share/amgf/installed
[ -f "$list" ] || exit 0
made=$(tac "$list") # the files of a folder before it
rm -f "$list"
printf '%s\n' "$made" | while read -r path; do
  case $path in /*) ;; *) path=$root/$path ;; esac
  if [ -d "$path" ] && [ ! -L "$path" ]; then rmdir "$path" 2> /dev/null || true; else rm -f "$path"; fi
done
