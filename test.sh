#!/usr/bin/env bash
# Installs what is missing, builds everything, runs all tests. Can be run again.
#
#   ./test.sh                     the release build, clang-tidy and all tests, then what reads files under ASan + UBSan
#   ./test.sh --no-sanitizers     without the last
#   ./test.sh --sanitize-all      all tests under ASan + UBSan as well: much longer
#   ./test.sh --hostile MINUTES   builds, and only tries to break things, for that long, with new seeds: half of it with
#                                 tests/hostile, half with libFuzzer
#   ./test.sh -R NAME             further arguments go to ctest; no clang-tidy
set -euo pipefail
cd "$(dirname "$0")"
. .ci/setup.sh

SANITIZE=readers
case "${1:-}" in
  -h | --help)
    sed -n '2,10s/^# \{0,1\}//p' test.sh
    exit 0
    ;;
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

# fuzz_for SECONDS: all fuzz targets, as many at a time as there are processors. What one finds is kept.
fuzz_for() {
  install_packages "${CLANG_PACKAGES[@]}"
  say "Building the fuzz targets"
  configure build/fuzz -DCMAKE_BUILD_TYPE=RelWithDebInfo "${CLANG[@]}" \
    -DRAYSPACE_SANITIZE=address,undefined -DRAYSPACE_FUZZ=ON -DRAYSPACE_BENCH=OFF -DRAYSPACE_TESTS=ON
  cmake --build build/fuzz -j "$JOBS" --target fuzzers
  local targets=(build/fuzz/bin/fuzz_*) each
  each=$(($1 * JOBS / ${#targets[@]}))
  say "Fuzzing ${#targets[@]} targets for $each s each"
  # A reader may ask for more memory than there is, and then must say so; no run may take 2 GB.
  export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
  printf '%s\n' "${targets[@]##*/fuzz_}" | xargs -P "$JOBS" -I{} sh -c '
    mkdir -p build/fuzz/found/{} &&
    build/fuzz/bin/fuzz_{} -max_total_time='"$each"' -timeout=20 -rss_limit_mb=2048 -artifact_prefix=build/fuzz/found/{}- \
      build/fuzz/found/{} tests/fuzz/corpus/{} >build/fuzz/found/{}.log 2>&1 ||
    { tail -n 25 build/fuzz/found/{}.log >&2; exit 1; }' || fail "a fuzz target has found something; see build/fuzz/found"
  grep -H "^Done" build/fuzz/found/*.log
}

packages=("${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}")
[ "$SANITIZE" = none ] || packages+=("${CLANG_PACKAGES[@]}")
install_packages "${packages[@]}"

say "Building (release), $JOBS jobs"
configure build/release -DCMAKE_BUILD_TYPE=Release -DRAYSPACE_TESTS=ON -DRAYSPACE_BENCH=ON -DRAYSPACE_WARNINGS_AS_ERRORS=ON
cmake --build build/release -j "$JOBS"

if [ -n "$HOSTILE_MINUTES" ]; then
  export RAYSPACE_HOSTILE_SEED=${RAYSPACE_HOSTILE_SEED:-$(date +%s%N)}
  TESTS=$(build/release/bin/test_hostile --gtest_list_tests | grep -c '^  ')
  export RAYSPACE_HOSTILE_SECONDS=$((HOSTILE_MINUTES * 30 / TESTS))
  say "Trying to break things for $((HOSTILE_MINUTES * 30)) s, from seed $RAYSPACE_HOSTILE_SEED"
  build/release/bin/test_hostile "$@"
  fuzz_for $((HOSTILE_MINUTES * 30))
  say "Nothing broke in $((SECONDS - BEGUN)) s"
  exit
fi

if [ $# -eq 0 ]; then
  say "Checking with clang-tidy"
  cmake --build build/release --target tidy >build/release/tidy.log 2>&1 || {
    sed 's/\x1b\[[0-9;]*m//g' build/release/tidy.log | grep -E ': (error|warning): ' | sort -u >&2
    fail "clang-tidy has found something; all of it is in build/release/tidy.log"
  }
fi

say "Testing (release)"
ctest --test-dir build/release --output-on-failure -j $((JOBS + 1)) "$@"

if [ "$SANITIZE" != none ]; then
  if [ "$SANITIZE" = all ]; then
    TARGETS=(all)
    SELECTED=(-LE lint)
  else
    TARGETS=(test_rayspace test_reference test_conformance test_fuzz_replay test_compositor test_sequences)
    # Whole pictures take long, and other tests the same ways.
    WHOLE='^(Truth|Occlusion)[.]|^WallPicture[.]IsTraced|^PhotometricWebProperty[.]|^TracedRenderer[.]EditedLight|^Shadows[.](OfObjects|OfWhat|ALit)'
    SELECTED=(-L '^(bytes|fuzz-replay|gl)$' -E "$WHOLE")
  fi
  # By clang, which takes two thirds of g++'s time for it, and sees what g++ does not.
  say "Building with AddressSanitizer and UndefinedBehaviorSanitizer: ${TARGETS[*]}"
  # With another compiler's cache CMake would forget all that is asked for.
  grep -qs 'CMAKE_CXX_COMPILER:.*clang' build/asan/CMakeCache.txt || rm -f build/asan/CMakeCache.txt
  configure build/asan -DCMAKE_BUILD_TYPE=RelWithDebInfo "${CLANG[@]}" -DRAYSPACE_SANITIZE=address,undefined \
    -DRAYSPACE_BENCH=OFF -DRAYSPACE_WARNINGS_AS_ERRORS=ON
  cmake --build build/asan -j "$JOBS" --target "${TARGETS[@]}"
  say "Testing under the sanitizers"
  # Leaks inside of the drivers and libraries that we load are not ours to report.
  ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1 RAYSPACE_RANDOM_STREAMS="${RAYSPACE_RANDOM_STREAMS:-300}" \
    ctest --test-dir build/asan --output-on-failure -j $((JOBS + 1)) "${SELECTED[@]}" "$@"
fi

say "All tests passed in $((SECONDS - BEGUN)) s"
