#!/usr/bin/env bash
# check_dependencies.sh CHECK FOLDER: runs .ci/check-dependencies on a tree of its own in FOLDER, whose program includes
# a header, links a library and opens another, and whose scripts call programs: all is well with the packages of those;
# without them each is named. Exits with 77 where there is no dpkg.
set -euo pipefail
check=$1 folder=$2
command -v dpkg-query >/dev/null || { echo "there is no dpkg to ask for packages"; exit 77; }
rm -rf "$folder"
mkdir -p "$folder"/{.ci,scripts,third_party,tests/app/real_window,own,build/bin}
cd "$folder"
cp "$check" .ci/
cat >main.c <<'C'
#include <dlfcn.h>
#include <stb/stb_image.h>
int main(void) { return dlopen("libEGL.so.1", RTLD_NOW) ? 0 : 3; }
C
printf '#!/bin/sh\nexec "$@"\n' >tests/app/real_window/under_xvfb.sh
printf '#!/bin/sh\ncat "$(dirname "$0")/packages"\n' >scripts/setup
printf '#!/bin/sh\n# no git here\nwords=(git)\ncat >text <<"END"\ngit\nEND\nif Xvfb -help; then echo there; fi\n' >scripts/demo
chmod +x tests/app/real_window/under_xvfb.sh scripts/setup
printf 'opens egl libEGL.so.1\ncalls xdotool # moves the mouse\n' >third_party/run_time.txt

cat >build/CMakeCache.txt <<EOF2
CMAKE_HOME_DIRECTORY:INTERNAL=$PWD
CMAKE_MAKE_PROGRAM:FILEPATH=$(command -v ninja)
CMAKE_CXX_COMPILER:FILEPATH=$(command -v c++)
EOF2
cat >build/build.ninja <<'NINJA'
rule compile
  command = cc -MD -MF $out.d -c $in -o $out $flags
  deps = gcc
  depfile = $out.d
rule link
  command = cc $in -o $out -Wl,--no-as-needed -lyaml
build build.ninja: phony
build main.o: compile ../main.c
build bin/mobbscope: link main.o
build all: phony bin/mobbscope
NINJA
ninja -C build >/dev/null

fail() {
  echo "$1"
  cat said
  exit 1
}
# expect STATUS: runs the check, whose words are then in the file `said`.
expect() {
  local status=0
  .ci/check-dependencies build >said 2>&1 || status=$?
  [ "$status" -eq "$1" ] || fail "exits with $status, not $1:"
}
# lacks WORDS PACKAGE: one line has both, and says where the package has to go.
lacks() {
  [ "$(grep -F -- "$1" said | grep -cE "is in ([^ ]+, )*$2(, [^ ]+)*, .*scripts/setup")" -eq 1 ] ||
    fail "does not name $1 of $2:"
}

printf '%s\n' g++ ninja-build libstb-dev libyaml-dev libegl1 xdotool xvfb >scripts/packages
expect 0

printf '%s\n' g++ ninja-build >scripts/packages
expect 1
lacks 'header /usr/include/stb/stb_image.h, included by main.c,' libstb-dev
lacks 'libyaml.so, linked into bin/mobbscope,' libyaml-dev
lacks 'libEGL.so.1, loaded at run time by bin/mobbscope,' libegl1
lacks 'program /usr/bin/Xvfb, called by scripts/demo,' xvfb
lacks 'program /usr/bin/xdotool, listed in third_party/run_time.txt,' xdotool

# What no package has, by its place or by its name.
printf '%s\n' g++ ninja-build libstb-dev libyaml-dev libegl1 xdotool xvfb >scripts/packages
outside=$(mktemp -d)
trap 'rm -rf "$outside"' EXIT
echo >"$outside/nobodys.h"
echo '#include <nobodys.h>' >>main.c
sed -i "s#^build main.o.*#&\n  flags = -I$outside#" build/build.ninja
echo 'opens none libnobodys.so.1 libnobodys.so.2' >>third_party/run_time.txt
echo 'calls nobodys' >>third_party/run_time.txt
ninja -C build >/dev/null
expect 1
grep -qF "header $outside/nobodys.h, included by main.c, is in no package" said || fail "not nobodys.h:"
grep -qF 'library libnobodys.so.1, opened by mobbscope, is not on this machine' said || fail "not libnobodys.so.1:"
grep -qF 'program nobodys, listed in third_party/run_time.txt, is not on this machine' said || fail "not nobodys:"
[ "$(grep -c . said)" -eq 3 ] || fail "finds more than there is:"

# Half a record proves nothing.
rm build/.ninja_deps
expect 2
grep -q 'build it first' said || fail "does not say what to do:"
