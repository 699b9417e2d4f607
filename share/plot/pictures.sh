#!/bin/sh
# Makes the pictures of the README: solves the three benchmarks, writes their fields, draws them. No display needed.
# usage: share/plot/pictures.sh [FOLDER], from the top folder, after make
set -e
folder=${1:-share/pictures}
python=/usr/bin/python3
[ -x $python ] || python=python3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"

picture() { # scene, name, options of draw.py
  bin/contact "share/scenes/$1.yaml" -quiet -output "$work/$2"
  base=$2
  shift 2
  $python share/plot/draw.py "$work/$base" "$folder/$base.png" "$@"
  echo "$folder/$base.png"
}

picture two_block two_block --limit 8
picture ironing ironing --limit 1
picture beam_sphere_linear beam_sphere_linear --view 25 200 --up x
picture beam_sphere_neo_hookean beam_sphere_neo_hookean --view 25 200 --up x
