#!/bin/sh
# Makes the pictures of the README: solves scenes, writes their fields, draws them. No display is needed.
# usage: share/plot/pictures.sh [FOLDER], from the top folder, after make
set -e
folder=${1:-share/doc/pictures}
python=/usr/bin/python3
[ -x $python ] || python=python3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$folder"

picture() { # scene, options of draw.py
  scene=$1
  shift
  bin/contact "share/scenes/$scene.yaml" -quiet -output "$work/$scene"
  $python -B share/plot/draw.py "$work/$scene" "$folder/$scene.png" "$@"
  echo "$folder/$scene.png"
}

curves() { # scene, columns of its history
  scene=$1
  shift
  bin/contact "share/scenes/$scene.yaml" -quiet -output "$work/$scene"
  $python -B share/plot/curves.py "$work/$scene.csv" "$folder/$scene.png" "$@"
  echo "$folder/$scene.png"
}

assembly() { # name of the script, its options, options of draw.py
  scene=$1
  options=$2
  shift 2
  here=$PWD
  (cd "$work" && $python "$here/share/scenes/$scene.py" $options > "$scene.log" \
    && "$here/bin/contact" "$scene.yaml" -quiet -output "$scene")
  $python -B share/plot/draw.py "$work/$scene" "$folder/$scene.png" "$@"
  echo "$folder/$scene.png"
}

picture two_block --limit 8
picture ironing --limit 1
picture beam_sphere_linear --view 25 200 --up x
picture beam_sphere_neo_hookean --view 25 200 --up x
picture hertz_cylinder --mirror x --around-contact 6 --view 0 -90 --field nodal_von_mises
picture thick_tube --field equivalent_plastic_strain --view 25 -40
picture pinched_ring --only ring --mirror x --view 10 -80 --field nodal_von_mises
curves bar_impact '*energy' contact_force_x
picture lug --view 50 -60 --scale 100 --limit 100 --field nodal_von_mises --no-edges
assembly gearbox '--size 2' --field nodal_von_mises --view 20 -60 --hide 'y<0' --scale 200 --limit 150
