#!/usr/bin/env bash
# Installs what is missing, builds everything, runs all tests. Can be run again.
#
#   ./test.sh                     the release build, clang-tidy and all tests, then what reads files under ASan + UBSan
#   ./test.sh --no-sanitizers     without the last
#   ./test.sh --sanitize-all      all tests under ASan + UBSan as well: much longer
#   ./test.sh --hostile MINUTES   builds, and only tries to break things, for that long, with new seeds
#   ./test.sh -R NAME             further arguments go to ctest; no clang-tidy
set -euo pipefail
cd "$(dirname "$0")"
. .ci/setup.sh

SANITIZE=readers
case "${1:-}" in
  --no-sanitizers) SANITIZE=none; shift ;;
  --sanitize-all) SANITIZE=all; shift ;;
esac
HOSTILE_MINUTES=
if [ "${1:-}" = --hostile ]; then
  HOSTILE_MINUTES=${2:?"--hostile needs a number of minutes"}
  [[ $HOSTILE_MINUTES =~ ^[0-9]+$ ]] || { echo "test.sh: --hostile $HOSTILE_MINUTES: give whole minutes" >&2; exit 2; }
  shift 2
fi
BEGUN=$SECONDS
JOBS=$(nproc)

install_packages "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"

say "Building (release), $JOBS jobs"
configure build/release -DCMAKE_BUILD_TYPE=Release -DRAYSPACE_TESTS=ON -DRAYSPACE_BENCH=ON -DRAYSPACE_WARNINGS_AS_ERRORS=ON
cmake --build build/release -j "$JOBS"

if [ -n "$HOSTILE_MINUTES" ]; then
  export RAYSPACE_HOSTILE_SEED=${RAYSPACE_HOSTILE_SEED:-$(date +%s%N)}
  TESTS=$(build/release/bin/test_hostile --gtest_list_tests | grep -c '^  ')
  export RAYSPACE_HOSTILE_SECONDS=$((HOSTILE_MINUTES * 60 / TESTS))
  say "Trying to break things for $HOSTILE_MINUTES minutes, from seed $RAYSPACE_HOSTILE_SEED"
  exec build/release/bin/test_hostile "$@"
fi

if [ $# -eq 0 ]; then
  say "Checking with clang-tidy"
  cmake --build build/release --target tidy >build/release/tidy.log 2>&1 || {
    sed 's/\x1b\[[0-9;]*m//g' build/release/tidy.log | grep -E ': (error|warning): ' | sort -u >&2
    fail "clang-tidy has found something; all of it is in build/release/tidy.log"
  }
fi

say "Testing (release)"
ctest --test-dir build/release --output-on-failure -j "$JOBS" "$@"

if [ "$SANITIZE" != none ]; then
  if [ "$SANITIZE" = all ]; then
    TARGETS=(all)
    SELECTED=(-LE lint)
  else
    TARGETS=(test_rayspace test_reference test_conformance test_fuzz_replay test_compositor)
    SELECTED=(-L '^(bytes|fuzz-replay|gl)$' -E '^(Truth|Occlusion)[.]')  # whole pictures take long, and other tests the same ways
  fi
  say "Building with AddressSanitizer and UndefinedBehaviorSanitizer: ${TARGETS[*]}"
  configure build/asan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DRAYSPACE_SANITIZE=address,undefined -DRAYSPACE_BENCH=OFF
  cmake --build build/asan -j "$JOBS" --target "${TARGETS[@]}"
  say "Testing under the sanitizers"
  # Leaks inside of the drivers and libraries that we load are not ours to report.
  ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 \
    ctest --test-dir build/asan --output-on-failure -j "$JOBS" "${SELECTED[@]}" "$@"
fi

say "All tests passed in $((SECONDS - BEGUN)) s"
