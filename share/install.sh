#!/bin/sh
# Usage: install.sh ROOT < lines "MODE FILE TARGET", TARGET relative to ROOT; MODE link: a symbolic link of that content
# Takes away what an earlier install left, then installs. ROOT/share/amgf/installed lists what it made, folders too, for
# uninstall.sh.
set -eu
root=$1
list=share/amgf/installed
made=$(mktemp)
trap 'rm -f "$made"' EXIT

# Folders of an earlier install in which others have put something are still ours to remove
earlier=$(cat "$root/$list" 2> /dev/null || true)
"$(dirname "$0")/uninstall.sh" "$root"
for path in $earlier; do
  case $path in /*) folder=$path ;; *) folder=$root/$path ;; esac
  [ ! -d "$folder" ] || echo "$path" >> "$made"
done

# A folder, after those above it
make_folder() {
  [ -d "$1" ] && return
  make_folder "$(dirname "$1")"
  mkdir "$1"
  case $1 in "$root"/*) echo "${1#"$root"/}" ;; *) echo "$1" ;; esac >> "$made"
}

make_folder "$root/$(dirname $list)"
while read -r mode file target; do
  make_folder "$(dirname "$root/$target")"
  echo "$target" >> "$made"
  if [ "$mode" = link ]; then ln -sfn "$file" "$root/$target"; else install -m "$mode" "$file" "$root/$target"; fi
done
install -m 644 "$made" "$root/$list"
echo "Installed $(grep -c . "$made") files and folders below $root"
