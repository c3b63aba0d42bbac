#!/usr/bin/env bash
# Installs what is missing, builds everything, runs all tests. Can be run again.
#
#   ./test.sh                     the release build and all tests, then what reads files under ASan + UBSan
#   ./test.sh --no-sanitizers     the release build and its tests only
#   ./test.sh --sanitize-all      all tests under ASan + UBSan as well: much longer
#   ./test.sh -R NAME             further arguments go to ctest
set -euo pipefail
cd "$(dirname "$0")"
. .ci/setup.sh

SANITIZE=readers
case "${1:-}" in
  --no-sanitizers) SANITIZE=none; shift ;;
  --sanitize-all) SANITIZE=all; shift ;;
esac
BEGUN=$SECONDS
JOBS=$(nproc)

install_packages "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"

say "Building (release), $JOBS jobs"
configure build/release -DCMAKE_BUILD_TYPE=Release -DRAYSPACE_TESTS=ON -DRAYSPACE_BENCH=ON -DRAYSPACE_WARNINGS_AS_ERRORS=ON
cmake --build build/release -j "$JOBS"

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
