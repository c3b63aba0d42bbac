#!/usr/bin/env bash
# Installs what is missing, builds everything, runs all tests. Can be run again.
#
#   ./test.sh                     the release build and all tests, then the tools that read files under ASan + UBSan
#   ./test.sh --no-sanitizers     the release build and its tests only
#   ./test.sh -R NAME             further arguments go to ctest
set -euo pipefail
cd "$(dirname "$0")"
. .ci/setup.sh

SANITIZERS=yes
if [ "${1:-}" = --no-sanitizers ]; then
  SANITIZERS=no
  shift
fi
BEGUN=$SECONDS
JOBS=$(nproc)

install_packages "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"

say "Building (release), $JOBS jobs"
configure build/release -DCMAKE_BUILD_TYPE=Release -DRAYSPACE_TESTS=ON -DRAYSPACE_BENCH=ON -DRAYSPACE_WARNINGS_AS_ERRORS=ON
cmake --build build/release -j "$JOBS"

say "Testing (release)"
ctest --test-dir build/release --output-on-failure -j "$JOBS" "$@"

if [ "$SANITIZERS" = yes ]; then
  say "Building with AddressSanitizer and UndefinedBehaviorSanitizer"
  configure build/asan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DRAYSPACE_SANITIZE=address,undefined -DRAYSPACE_BENCH=OFF
  cmake --build build/asan -j "$JOBS"
  say "Testing under the sanitizers (all but the procedural objects, which read nothing from outside, and whole turns of real
   photographs, which take the same ways as drawn ones; both take long)"
  # Leaks inside of the drivers and libraries that we load are not ours to report.
  ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 \
    ctest --test-dir build/asan --output-on-failure -j "$JOBS" -LE 'lint|procedural' -E '^RealPhotos' "$@"
fi

say "All tests passed in $((SECONDS - BEGUN)) s"
