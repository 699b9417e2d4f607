#!/bin/sh
# Runs in a bare Debian 12 beside the packages: installs them, runs what they contain, removes them, and compares the
# files before and after.
set -eu
export HOME=/tmp LC_ALL=C DEBIAN_FRONTEND=noninteractive OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
cd "$(dirname "$0")"
ours='petscamgf contact libcontact-dev amgf-doc'
tools='gcc make pkg-config libopenmpi-dev python3-petsc4py python3-petsc4py-real'
files() { find / -xdev \( -path /tmp -o -path /root -o -path /proc -o -path /var/cache -o -path /var/log \
  -o -path /var/lib/apt -o -path /var/lib/dpkg \) -prune -o -print | sort; }

# What ours need, so that only ours come and go between the two lists of files
apt-get install -s --no-install-recommends ./*.deb $tools | sed -n 's/^Inst \([^ ]*\) .*/\1/p' > /tmp/all
needed=$(grep -vxE "$(echo $ours | tr ' ' '|')" /tmp/all)
apt-get install -qq -y --no-install-recommends $needed > /tmp/log 2>&1 || { cat /tmp/log; exit 1; }
files > /tmp/before
apt-get install -qq -y --no-install-recommends ./*.deb > /tmp/log 2>&1 || { cat /tmp/log; exit 1; }
! command -v lintian > /dev/null || lintian ./*.deb

mkdir -p /tmp/runs
cd /tmp/runs
contact -version
contact /usr/share/amgf/scenes/hertz_cylinder.yaml -refine 0 -quiet -output hertz -summary hertz.json
mpiexec --oversubscribe -n 2 contact /usr/share/amgf/scenes/patch_test.yaml -quiet
contact-mesh /usr/share/amgf/gmsh/two_blocks.msh blocks.inp
contact-mesh blocks.inp -check
python3 - << 'P'
import contact
run = contact.run("/usr/share/amgf/scenes/hertz_cylinder.yaml", refine=0)
old = contact.load("hertz")
assert run.exit_code == 0 and abs(run.history["energy"][-1] / old.history["energy"][-1] - 1) < 1e-9
P
plugin=$(pkg-config --variable=plugin petscamgf)
python3 /usr/share/amgf/examples/ties_petsc4py.py -dll_append "$plugin" -pc_type amgf
cp -r /usr/share/amgf/examples . && make -s -C examples
examples/ties_ksp -dll_append "$plugin" -pc_type amgf
examples/press_library /usr/share/amgf/scenes/patch_test.yaml
zcat -f /usr/share/man/man1/contact.1* > /dev/null
zcat -f /usr/share/man/man3/PCAMGF.3* > /dev/null

apt-get purge -qq -y $ours > /tmp/log 2>&1 || { cat /tmp/log; exit 1; }
files > /tmp/after
diff /tmp/before /tmp/after || { echo 'packages: the files above remain'; exit 1; }
echo 'packages: all right'
