#!/usr/bin/env bash
# Installs missing packages, builds the release and runs all tests. Can be run again.
#
#   ./test.sh                     the release build and all tests
#   ./test.sh --all               as well clang-tidy, and the tests of all readers of files under ASan and UBSan
#   ./test.sh --sanitize-all      as --all, with all tests under ASan and UBSan: much longer
#   ./test.sh --hostile MINUTES   builds, then runs tests/hostile and libFuzzer with new seeds, half of the time each
#   ./test.sh -R NAME             further arguments go to ctest
set -euo pipefail
cd "$(dirname "$0")"
. .ci/setup.sh

SANITIZE=none
case "${1:-}" in
  -h | --help)
    sed -n '2,9s/^# \{0,1\}//p' test.sh
    exit 0
    ;;
  --all) SANITIZE=readers; shift ;;
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

# fuzz_for SECONDS: runs all fuzz targets, one per processor at a time, and keeps their findings.
fuzz_for() {
  install_packages "${CLANG_PACKAGES[@]}"
  say "Building the fuzz targets"
  configure build/fuzz -DCMAKE_BUILD_TYPE=RelWithDebInfo "${CLANG[@]}" \
    -DRAYSPACE_SANITIZE=address,undefined -DRAYSPACE_FUZZ=ON -DRAYSPACE_BENCH=OFF -DRAYSPACE_WEB=OFF -DRAYSPACE_TESTS=ON
  cmake --build build/fuzz -j "$JOBS" --target fuzzers
  local targets=(build/fuzz/bin/fuzz_*) each
  each=$(($1 * JOBS / ${#targets[@]}))
  say "Fuzzing ${#targets[@]} targets for $each s each"
  # An allocation may fail, which a reader must report; a run may take at most 2 GB.
  export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
  printf '%s\n' "${targets[@]##*/fuzz_}" | xargs -P "$JOBS" -I{} sh -c '
    mkdir -p build/fuzz/found/{} &&
    build/fuzz/bin/fuzz_{} -max_total_time='"$each"' -timeout=20 -rss_limit_mb=2048 -artifact_prefix=build/fuzz/found/{}- \
      build/fuzz/found/{} tests/fuzz/corpus/{} >build/fuzz/found/{}.log 2>&1 ||
    { tail -n 25 build/fuzz/found/{}.log >&2; exit 1; }' || fail "a fuzz target has failed; see build/fuzz/found"
  grep -H "^Done" build/fuzz/found/*.log
}

packages=("${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}")
[ "$SANITIZE" = none ] || packages+=("${CLANG_PACKAGES[@]}")
install_packages "${packages[@]}"
(install_packages "${WEB_PACKAGES[@]}") || say "SKIPPED: the web part, whose packages cannot be installed"
(install_packages "${RTL_PACKAGES[@]}") || say "SKIPPED: the RTL of the board, whose packages cannot be installed"

say "Building (release), $JOBS jobs"
configure build/release -DCMAKE_BUILD_TYPE=Release -DRAYSPACE_TESTS=ON -DRAYSPACE_BENCH=ON -DRAYSPACE_WARNINGS_AS_ERRORS=ON
cmake --build build/release -j "$JOBS"

if [ -n "$HOSTILE_MINUTES" ]; then
  export RAYSPACE_HOSTILE_SEED=${RAYSPACE_HOSTILE_SEED:-$(date +%s%N)}
  TESTS=$(build/release/bin/test_hostile --gtest_list_tests | grep -c '^  ')
  export RAYSPACE_HOSTILE_SECONDS=$((HOSTILE_MINUTES * 30 / TESTS))
  say "Running the hostile tests for $((HOSTILE_MINUTES * 30)) s, seed $RAYSPACE_HOSTILE_SEED"
  build/release/bin/test_hostile "$@"
  fuzz_for $((HOSTILE_MINUTES * 30))
  say "No failure in $((SECONDS - BEGUN)) s"
  exit
fi

if [ "$SANITIZE" != none ]; then
  say "Checking with clang-tidy"
  cmake --build build/release --target tidy >build/release/tidy.log 2>&1 || {
    sed 's/\x1b\[[0-9;]*m//g' build/release/tidy.log | grep -E ': (error|warning): ' | sort -u >&2
    fail "clang-tidy reports errors; the whole output is in build/release/tidy.log"
  }
fi

say "Testing (release)"
ctest --test-dir build/release --output-on-failure -j $((JOBS + 1)) "$@"

if [ "$SANITIZE" != none ]; then
  if [ "$SANITIZE" = all ]; then
    TARGETS=(all)
    SELECTED=(-LE lint)
  else
    TARGETS=(test_rayspace test_reference test_conformance test_fuzz_replay test_compositor test_gpu test_sequences)
    # Tests of whole images take long and run code that other tests run, too.
    WHOLE='^(Truth|Occlusion)[.]|^WallPicture[.]IsTraced|^PhotometricWebProperty[.]|^TracedRenderer[.]EditedLight|^Shadows[.](OfObjects|OfWhat|ALit)'
    SELECTED=(-L '^(bytes|fuzz-replay|gl)$' -E "$WHOLE")
  fi
  # clang takes two thirds of g++'s time for this, and its sanitizers find more.
  say "Building with AddressSanitizer and UndefinedBehaviorSanitizer: ${TARGETS[*]}"
  # CMake drops all options when the compiler of an existing build folder changes.
  grep -qs 'CMAKE_CXX_COMPILER:.*clang' build/asan/CMakeCache.txt || rm -f build/asan/CMakeCache.txt
  configure build/asan -DCMAKE_BUILD_TYPE=RelWithDebInfo "${CLANG[@]}" -DRAYSPACE_SANITIZE=address,undefined \
    -DRAYSPACE_BENCH=OFF -DRAYSPACE_WEB=OFF -DRAYSPACE_WARNINGS_AS_ERRORS=ON
  cmake --build build/asan -j "$JOBS" --target "${TARGETS[@]}"
  say "Testing under the sanitizers"
  # Drivers and libraries leak.
  ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 RAYSPACE_RANDOM_STREAMS="${RAYSPACE_RANDOM_STREAMS:-300}" \
    ctest --test-dir build/asan --output-on-failure -j $((JOBS + 1)) "${SELECTED[@]}" "$@"
fi

say "All tests passed in $((SECONDS - BEGUN)) s"
