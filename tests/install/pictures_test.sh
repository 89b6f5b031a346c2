#!/usr/bin/env bash
# pictures_test.sh BUILD PROJECT COMPILER GENERATOR SCRATCH: installs what is built, and builds and runs PROJECT, somebody's
# picture tests, as docs/test_frameworks.md says. Where there is no OpenGL, all of them must be skipped.
set -euo pipefail
build=$1 project=$2 compiler=$3 generator=$4 scratch=$5
rm -rf "$scratch"
mkdir -p "$scratch"
cp -r "$project" "$scratch/crowd"
cmake --install "$build" --prefix "$scratch/prefix" >"$scratch/log"
cd "$scratch/crowd"
mobbscope=$scratch/prefix/bin/mobbscope
unset MOBBSCOPE_PROGRAM MOBBSCOPE_GOLDENS MOBBSCOPE_OUTPUT MOBBSCOPE_UPDATE MOBBSCOPE_BACKEND

fail() {
  echo "FAILED: $1"
  cat "$scratch/said"
  exit 1
}
# expect STATUS COMMAND...: its words are then in the file `said`.
expect() {
  local wanted=$1 status=0
  shift
  "$@" >"$scratch/said" 2>&1 || status=$?
  [ "$status" -eq "$wanted" ] || fail "exits with $status, not $wanted: $*"
}
says() { grep -qF -- "$1" "$scratch/said" || fail "does not say: $1"; }
says_not() { ! grep -qF -- "$1" "$scratch/said" || fail "says: $1"; }
tests() { expect "$1" ctest --test-dir build --output-on-failure "${@:2}"; }

expect 0 cmake -B build -G "$generator" -D CMAKE_PREFIX_PATH="$scratch/prefix" -D CMAKE_CXX_COMPILER="$compiler" \
  -D CMAKE_BUILD_TYPE=Debug
expect 0 cmake --build build
# To CMake the header is a system's, and its warnings are not shown.
expect 0 "$compiler" -std=c++17 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion \
  -Wold-style-cast -Werror -include gtest/gtest.h -I "$scratch/prefix/include" -x c++ plain.cpp
has_catch=false
if [ -x build/catch_test ]; then has_catch=true; else echo "there is no Catch2: not tried"; fi

if "$mobbscope" render person.json -o person.png >/dev/null 2>&1; then rm person.png; else
  echo "there is no OpenGL"
  [ -z "${MOBBSCOPE_REQUIRE_GL-}" ] || exit 1
  export MESA_GL_VERSION_OVERRIDE=2.1
fi

# Without OpenGL nothing passes, and nothing is written.
MESA_GL_VERSION_OVERRIDE=2.1 tests 0 -R '^pictures'
grep -Eq 'pictures.person .*Skipped' "$scratch/said" || fail "pictures.person is not skipped"
MESA_GL_VERSION_OVERRIDE=2.1 expect 0 build/crowd_test --gtest_filter='Crowd.Pe*'
says '[  SKIPPED ] 3 tests'
[ ! -e goldens ] || fail "there are goldens"
if [ "${MESA_GL_VERSION_OVERRIDE-}" ]; then exit 0; fi

# There is no golden: each test says so, and what to do. The words are true.
tests 8
for name in pictures.person crowd; do grep -Eq "$name .*Failed" "$scratch/said" || fail "$name has not failed"; done
grep -Eq 'pictures.DRAW .*Passed' "$scratch/said" || fail "pictures.DRAW has not passed"
says 'missing golden: person'
says "there is no golden $PWD/goldens/meeting.png"
says 'more of it'
says 'or run the test with MOBBSCOPE_UPDATE=meeting'
sed -n 's/^ *[0-9: ]*if it is right: mobbscope //p' "$scratch/said" >"$scratch/commands"
[ "$(grep -c . "$scratch/commands")" -ge 3 ] || fail "there are no commands"
if $has_catch; then says 'missing golden: person'; fi
while read -r command; do expect 0 bash -c "'$mobbscope' $command"; done <"$scratch/commands"
for file in goldens/meeting.{case.json,png,draw.json} goldens/contact.{case.json,answers.json} 'goldens/sub folder/people.case.json' pictures/person.png; do
  [ -s "$file" ] || fail "$file is not there"
done
tests 0
expect 0 "$mobbscope" test goldens --strict
[ ! -e build/mobbscope-test/crowd_test/report.json ] || fail "a report of nothing is left"

# A test that gives another scene fails, also where other tests are other processes; only then the golden follows.
export B_BEGINS_AT=1.1
before=$(cat 'goldens/sub folder/people.case.json')
expect 1 build/crowd_test --gtest_filter='Crowd.PeopleStand'
says 'different: sub folder/people'
says 'people.draw.json: disk of B, sample 0'
[ -s 'build/mobbscope-test/crowd_test/sub folder/people.heat.png' ] || fail "there is no heat map"
[ "$(cat 'goldens/sub folder/people.case.json')" = "$before" ] || fail "the case has changed"
expect 2 "$mobbscope" test goldens meeting --accept build/mobbscope-test/crowd_test
says "passed there"
B_BEGINS_AT='' MOBBSCOPE_UPDATE=meeting expect 0 build/crowd_test --gtest_filter='Crowd.PeopleMeet'
says "wrote "
[ -s build/mobbscope-test/crowd_test/report.json ] || fail "another process took what the report told"
MOBBSCOPE_UPDATE=meeting,nothing expect 1 build/crowd_test --gtest_filter='Crowd.PeopleStand'
MOBBSCOPE_UPDATE='sub*' expect 0 build/crowd_test --gtest_filter='Crowd.PeopleStand'
says 'people.case.json'
grep -q 1.1 'goldens/sub folder/people.case.json' || fail "the case has not followed"
expect 0 build/crowd_test
expect 0 "$mobbscope" test goldens

# A program that is not there, and one that ends.
MOBBSCOPE_PROGRAM=/no/where expect 1 build/crowd_test --gtest_filter='Crowd.PeopleStand'
says 'cannot start /no/where: No such file or directory; install Mobbscope, or name the program'
printf '#!/bin/sh\nread -r line\necho torn down >&2\nexit 7\n' >ends.sh
chmod +x ends.sh
MOBBSCOPE_PROGRAM=$PWD/ends.sh expect 1 build/crowd_test --gtest_filter='Crowd.People*'
says 'ends.sh ended before it answered (exit status 7)'
says 'torn down'
[ "$(grep -c 'ended before it answered' "$scratch/said")" -eq 2 ] || fail "the second test has no new process"
MOBBSCOPE_BACKEND=none expect 1 build/crowd_test --gtest_filter='Crowd.PeopleStand'
says "'none' is not one of auto, osmesa, egl"

# A case that is new since it was configured, and one that cannot be read.
cp pictures/person.case.json pictures/new.case.json
echo '{"mobbscope_case": 1}' >pictures/bad.case.json
tests 8 -R '^pictures'
grep -Eq 'pictures.new .*Failed' "$scratch/said" || fail "pictures.new has not failed"
grep -Eq 'pictures.person .*Passed' "$scratch/said" || fail "pictures.person has not passed"
says 'failed: bad: '

if ! python3 -m pytest --version >/dev/null 2>&1; then echo "there is no pytest: not tried"; exit 0; fi
export PYTHONPATH=$scratch/prefix/share/mobbscope/python PYTHONDONTWRITEBYTECODE=1
pytest() { expect "$1" python3 -m pytest -p no:cacheprovider "${@:2}"; }
rm -rf goldens
pytest 1
says 'missing golden: person'
says '3 failed'
says_not Traceback
pytest 0 --mobbscope-update walk test_people.py::test_people
pytest 1
says "2 failed, 1 passed"
expect 0 "$mobbscope" test goldens person meeting --accept mobbscope-test/goldens
pytest 0
expect 0 "$mobbscope" test goldens
sed -i 's/1.2, 0/1.3, 0/' test_people.py
cp goldens/meeting.answers.json kept
sed -i 's/"tests": {"time": [0-9]*/"tests": {"time": 99/' goldens/meeting.answers.json
pytest 1
says 'walk.draw.json: disk of '
says 'tests of time instead of 99'
mv kept goldens/meeting.answers.json
pytest 1 --mobbscope-goldens elsewhere
says "/elsewhere/person.png"
MESA_GL_VERSION_OVERRIDE=2.1 pytest 0
says '1 passed, 2 skipped'
MOBBSCOPE_PROGRAM=/no/where pytest 1
says 'there is no program /no/where'
MOBBSCOPE_PROGRAM=$PWD/ends.sh pytest 1
says 'torn down'
