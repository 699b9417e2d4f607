# A feature folder of the optimizer can go: without tao_ipfilter/friction and its lines in register.c the sources
# compile, and the other objects of the plugin ask for nothing that was there. The same without tao_ipfilter/subspace
# besides.
set -u
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp -rL "$AMGF_DIR/tao_ipfilter" "$AMGF_DIR/pc_amgf" "$AMGF_DIR/include" "$work"
cd "$work" || exit 1
headers=$(pkg-config --cflags PETSc)
folders=()

for folder in friction subspace; do
  folders+=("$folder")
  rm -r "tao_ipfilter/$folder"
  case $folder in friction) line='ip->laws *=' ;; *) line='ip->method->ops *=' ;; esac
  sed -i -e "/$folder\//d" -e "/$line/d" tao_ipfilter/register.c
  # of the files that remain, those that included a header of the folder
  rest=$(ls tao_ipfilter/*.c tao_ipfilter/*/*.c | while read -r file; do
    grep -q " tao_ipfilter/$folder/" "$AMGF_DIR/build/${file%c}d" && echo "$file"; done)
  mpicc -std=c11 -Wall -Wextra -fsyntax-only -Iinclude -I. $headers tao_ipfilter/register.c $rest 2>&1 |
    grep -E 'error|warning' | grep -v "unused parameter 'ip'\|unused parameter ‘ip’"
  mpicc -std=c11 -fPIC -w -Iinclude -I. $headers -c tao_ipfilter/register.c -o register.o
  objects=$(ls tao_ipfilter/*.c tao_ipfilter/*/*.c \
    | sed -e '/tao_ipfilter.register/d' -e "s|^\(.*\)c$|$AMGF_DIR/build/\1o|")
  undefined=$(nm $objects register.o 2> /dev/null | awk '
    $1 == "U" { used[$2] }
    $2 ~ /^[TDBRCi]$/ { defined[$3] }
    END { for (name in used) if (name ~ /^(IP|TaoIPFilter)/ && !(name in defined)) print name }')
  [ -z "$undefined" ] && echo "without ${folders[*]}: compiles and links" ||
    echo "undefined without ${folders[*]}:" $undefined
done
