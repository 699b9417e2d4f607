#!/bin/sh
# Usage: html.sh FOLDER PAGE.md...
# The pages as HTML below FOLDER, where they stand here, links between them too, and the pictures they show.
set -eu
folder=$1
shift
for page; do
  html=$folder/${page%.md}.html
  mkdir -p "$(dirname "$html")"
  up=$(dirname "$page" | sed -e 's|^\.$||' -e 's|[^/][^/]*/*|../|g')
  sed 's|\(]([^):]*\)\.md\([)#]\)|\1.html\2|g' "$page" |
    pandoc --from gfm --to html5 --standalone --css "${up}style.css" --metadata "pagetitle=$page" -o "$html"
  for picture in $(grep -o '!\[[^]]*]([^)]*)' "$page" | sed 's/.*(\(.*\))/\1/'); do
    install -D -m 644 "$(dirname "$page")/$picture" "$(dirname "$html")/$picture"
  done
done
cp "$(dirname "$0")/style.css" "$folder"
