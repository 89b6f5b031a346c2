#!/usr/bin/env bash
# pictures_test.sh BUILD PROJECT COMPILER GENERATOR SCRATCH FRAMEWORK: installs what is built, and builds and runs PROJECT,
# somebody's picture tests, as docs/test_frameworks.md says. Without OpenGL all tests of CTest and GoogleTest must be skipped.
# Exits with 77 where there is no OpenGL, or no such framework.
set -euo pipefail
build=$1 project=$2 compiler=$3 generator=$4 scratch=$5 framework=$6
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

fails() {
  if "$@" >"$scratch/said" 2>&1; then fail "does not fail: $*"; fi
}
skip() {
  echo "skipped: $1"
  exit 77
}
configure() {
  expect 0 cmake -B build -G "$generator" -D CMAKE_PREFIX_PATH="$scratch/prefix" -D CMAKE_CXX_COMPILER="$compiler" \
    -D CMAKE_BUILD_TYPE=Debug
}
# A program in place of mobbscope; its script is standard input.
program() {
  { echo '#!/bin/sh'; cat; } >"$1"
  chmod +x "$1"
}
program ends.sh <<'EOF'
read -r line
echo torn down >&2
exit 7
EOF
program other.sh <<'EOF'
while read -r line; do printf 'passed someone\n\n'; done
EOF

has_opengl=true
if "$mobbscope" render person.json -o person.png >/dev/null 2>&1; then rm person.png; else
  [ -z "${MOBBSCOPE_REQUIRE_GL-}" ] || { echo "there is no OpenGL"; exit 1; }
  has_opengl=false
fi

# CTest and GoogleTest.
with_googletest() {
  configure
  expect 0 cmake --build build
  # To CMake the header is a system's, and its warnings are not shown.
  expect 0 "$compiler" -std=c++17 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion \
    -Wold-style-cast -Werror -include gtest/gtest.h -I "$scratch/prefix/include" -x c++ plain.cpp
  $has_opengl || export MESA_GL_VERSION_OVERRIDE=2.1

  # Without OpenGL nothing passes, and nothing is written.
  MESA_GL_VERSION_OVERRIDE=2.1 tests 0 -R '^pictures'
  grep -Eq 'pictures.person .*Skipped' "$scratch/said" || fail "pictures.person is not skipped"
  MESA_GL_VERSION_OVERRIDE=2.1 expect 0 build/crowd_test --gtest_filter='Crowd.Pe*'
  says '[  SKIPPED ] 3 tests'
  [ ! -e goldens ] || fail "there are goldens"
  $has_opengl || skip "there is no OpenGL"

  # There is no golden: each test says so, and what to do. The words are true.
  tests 8
  for name in pictures.person crowd; do grep -Eq "$name .*Failed" "$scratch/said" || fail "$name has not failed"; done
  grep -Eq 'pictures \(drawing\) .*Passed' "$scratch/said" || fail "pictures (drawing) has not passed"
  says_not 'Regex'
  says "there is no golden $PWD/goldens/contact.answers.json"
  says 'missing golden: person'
  says "there is no golden $PWD/goldens/meeting.png"
  says 'more of it'
  says 'or run the test with MOBBSCOPE_UPDATE=meeting'
  sed -n 's/^ *[0-9: ]*if it is right: mobbscope //p' "$scratch/said" >"$scratch/commands"
  [ "$(grep -c . "$scratch/commands")" -ge 3 ] || fail "there are no commands"
  while read -r command; do expect 0 bash -c "'$mobbscope' $command"; done <"$scratch/commands"
  for file in goldens/meeting.{case.json,png,state.json} goldens/contact.{case.json,answers.json} 'goldens/sub folder/people.case.json' pictures/person.png; do
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
  says 'people.state.json: '
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
  MOBBSCOPE_PROGRAM=$PWD/ends.sh expect 1 build/crowd_test --gtest_filter='Crowd.People*'
  says 'ends.sh ended before it answered (exit status 7)'
  says 'torn down'
  [ "$(grep -c 'ended before it answered' "$scratch/said")" -eq 2 ] || fail "the second test has no new process"
  MOBBSCOPE_PROGRAM=$PWD/other.sh expect 1 build/crowd_test --gtest_filter='Crowd.PeopleStand'
  says "answered 'passed someone' when asked for 'sub folder/people'"
  MOBBSCOPE_BACKEND=none expect 1 build/crowd_test --gtest_filter='Crowd.PeopleStand'
  says "'none' is not one of auto, osmesa, egl"

  # A case that is new since it was configured, and one that cannot be read.
  cp pictures/person.case.json pictures/new.case.json
  echo '{"mobbscope_case": 1}' >pictures/bad.case.json
  tests 8 -R '^pictures'
  grep -Eq 'pictures.new .*Failed' "$scratch/said" || fail "pictures.new has not failed"
  grep -Eq 'pictures.person .*Passed' "$scratch/said" || fail "pictures.person has not passed"
  says 'failed: bad: '
  cmake -E rename pictures gone
  tests 8 -R '^pictures'
  says 'the cases cannot be listed'
  cmake -E rename gone pictures

  # What CTest runs believes nothing that this run has not told.
  shopt -s globstar
  cases=$(echo "$scratch"/prefix/**/cases.sh)
  printf '<testcase name="old" time="0">\n</testcase>\n' >junit.xml
  expect 1 sh "$cases" tell junit.xml . nobody
  says 'does not tell of it'
  expect 0 sh "$cases" tell junit.xml . old
  expect 1 sh "$cases" draw junit.xml true
  says 'there is no junit.xml'
  expect 1 sh "$cases" draw junit.xml sh -c 'echo 3 passed; echo >junit.xml; exit 2'
  says 'exit status 2'

  # Names with what CMake or XML gives a meaning, in a folder that has such a name.
  mkdir -p "$scratch/odd[1]/cases"
  cd "$scratch/odd[1]"
  cp "$scratch/crowd/person.json" .
  for name in right 'b[r' 'we[ird;x' "a&b'c" DRAW "\${x}"; do
    cp "$scratch/crowd/pictures/person.case.json" "cases/$name.case.json"
  done
  expect 0 "$mobbscope" test cases --update right
  printf '%s\n' 'cmake_minimum_required(VERSION 3.25)' 'project(odd LANGUAGES NONE)' 'enable_testing()' \
    'find_package(mobbscope REQUIRED)' 'mobbscope_add_picture_tests(cases NAME a-b)' \
    'mobbscope_add_picture_tests(cases NAME a_b LABELS one two)' >CMakeLists.txt
  expect 0 cmake -B build -G "$generator" -D CMAKE_PREFIX_PATH="$scratch/prefix" -D CMAKE_CXX_COMPILER="$compiler"
  tests 8
  for prefix in a-b a_b; do
    for name in 'b[r' 'we[ird;x' "a&b'c" DRAW "\${x}"; do says " - $prefix.$name (Failed)"; done
  done
  says '10 tests failed out of 14'
}

# with_small NAME TARGET OPTION...: a framework of which one test is tried. With OPTION it writes a JUnit report.
with_small() {
  configure
  grep -q "^$1_DIR:PATH=/" build/CMakeCache.txt || skip "there is no $1"
  $has_opengl || skip "there is no OpenGL"
  expect 0 cmake --build build --target "$2"
  fails "build/$2"
  says 'missing golden: person'
  says "if it is right: mobbscope test $PWD/goldens person --accept $PWD/build/mobbscope-test/$2"
  # A report has all of it, in one line.
  "build/$2" "${@:3}" >"$scratch/said" 2>/dev/null || true
  says "if it is right: mobbscope test $PWD/goldens person --accept $PWD/build/mobbscope-test/$2"
  expect 0 "$mobbscope" test goldens person --accept "build/mobbscope-test/$2"
  expect 0 "build/$2"
}

with_pytest() {
  local python
  for python in $(type -ap python3) ''; do
    [ "$python" ] || skip "there is no pytest 7"
    "$python" -c 'import sys, pytest; sys.exit(int(pytest.__version__.split(".")[0]) < 7)' 2>/dev/null && break
  done
  $has_opengl || skip "there is no OpenGL"
  export COLUMNS=200 PYTHONPATH=$scratch/prefix/share/mobbscope/python PYTHONDONTWRITEBYTECODE=1
  pytest() { expect "$1" "$python" -m pytest -p no:cacheprovider "${@:2}"; }
  pytest 1
  says 'missing golden: person'
  says '3 failed'
  says_not Traceback
  says "FAILED test_people.py::test_person - missing golden: person: there is no golden"
  pytest 0 --mobbscope-update walk,wolk test_people.py::test_people
  says "wrote $PWD/goldens/walk.png"
  says 'no test has asked for wolk'
  pytest 1
  says "2 failed, 1 passed"
  expect 0 "$mobbscope" test goldens person meeting --accept mobbscope-test/goldens
  pytest 0
  expect 0 "$mobbscope" test goldens
  sed -i '/people = /s/1.2, 0/1.3, 0/' test_people.py
  cp goldens/meeting.answers.json kept
  sed -i 's/"tests": {"time": [0-9]*/"tests": {"time": 99/' goldens/meeting.answers.json
  pytest 1
  says 'walk.state.json: '
  says 'of time instead of 99'
  cmake -E rename kept goldens/meeting.answers.json
  pytest 1 --mobbscope-goldens elsewhere
  says "/elsewhere/person.png"
  MESA_GL_VERSION_OVERRIDE=2.1 pytest 0
  says '1 passed, 2 skipped'
  MOBBSCOPE_PROGRAM=/no/where pytest 1
  says 'there is no program /no/where'
  MOBBSCOPE_PROGRAM=$PWD/ends.sh pytest 1
  says 'torn down'
  MOBBSCOPE_PROGRAM=$PWD/other.sh pytest 1
  says "answered 'passed someone' when asked for 'meeting'"

  # A test that is interrupted while it waits does not leave its answer to the next one.
  program slow.sh <<'EOF'
read -r line
case $line in *'"slow"'*) exec sleep 9 ;; esac
printf 'passed next\n\n'
EOF
  cat >test_interrupted.py <<'EOF'
import signal

import pytest


class Interrupted(BaseException):
    pass


def interrupt(*_):
    raise Interrupted


def test_slow(picture):
    signal.signal(signal.SIGALRM, interrupt)
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    with pytest.raises(Interrupted):
        picture("person.json", "slow")


def test_next(picture):
    picture("person.json", "next")
EOF
  MOBBSCOPE_PROGRAM=$PWD/slow.sh pytest 0 test_interrupted.py
}

case $framework in
googletest) with_googletest ;;
catch2) with_small Catch2 catch_test --reporter junit ;;
doctest) with_small doctest doctest_test --reporters=junit ;;
pytest) with_pytest ;;
esac
