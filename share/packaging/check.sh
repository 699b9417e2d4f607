#!/bin/sh
# Usage: check.sh FOLDER, a folder for the packages
# Builds the Debian packages of the last commit in a bare Debian 12, copies them to FOLDER, and tries them in another
# bare Debian 12. Needs mmdebstrap, root and the network. The last line reads "packages: all right".
set -eu
cd "$(dirname "$0")/../.."
mkdir -p "$1"
folder=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bare() { mmdebstrap --quiet --variant=minbase --include=ca-certificates "$@" bookworm /dev/null; }

git clone -q . "$work/amgf"
needed=$(tr -d '\n' < share/packaging/debian/control |
  sed 's/.*Build-Depends: //; s/Package:.*//; s/([^)]*)//g; s/,/ /g')
echo "Building in a bare Debian 12"
install='apt-get install -qq -y --no-install-recommends build-essential'
bare --customize-hook="chroot \"\$1\" $install $needed > $work/build.log" \
  --customize-hook="copy-in $work/amgf /root" \
  --customize-hook="chroot \"\$1\" make -C /root/amgf deb >> $work/build.log 2>&1" \
  --customize-hook="sync-out /root/amgf/build/deb $work" || { tail -n 20 "$work/build.log"; exit 1; }
cp "$work"/*.deb "$folder"
mkdir "$work/debs"
cp "$work"/*.deb share/packaging/trial.sh "$work/debs"
echo "Trying the packages in a bare Debian 12"
bare --customize-hook="copy-in $work/debs /root" --customize-hook='chroot "$1" sh /root/debs/trial.sh'
