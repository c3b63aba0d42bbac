# shellcheck shell=bash
# Sourced by demo.sh and test.sh: installs missing packages and configures a build, with a line of output per step.

BUILD_PACKAGES=(
  g++ cmake ninja-build pkg-config
  libopencv-dev libopenimageio-dev openimageio-tools libglm-dev libceres-dev libembree-dev libassimp-dev libcli11-dev
  nlohmann-json3-dev libtbb-dev libhwy-dev libepoxy-dev libegl-dev libgl-dev libegl1 libegl-mesa0 libgl1-mesa-dri
  libavcodec-dev libavformat-dev libswscale-dev libxxhash-dev libzstd-dev liblcms2-dev libcoin-dev zlib1g-dev libexpat1-dev libglfw3-dev libimgui-dev libasio-dev
)
# shellcheck disable=SC2034
WEB_PACKAGES=(emscripten nodejs chromium)  # optional
command -v npm >/dev/null || WEB_PACKAGES+=(npm)  # nodejs of some sources contains it
# shellcheck disable=SC2034
RTL_PACKAGES=(verilator yosys iverilog nextpnr-ice40)  # optional
# shellcheck disable=SC2034  # used by the scripts that source this file
TEST_PACKAGES=(libgtest-dev libgmock-dev libbenchmark-dev clang-format-14 clang-tidy-14 shellcheck xvfb
  dpkg-dev pybind11-dev python3-dev python3-numpy python3-opencv snakemake doxygen help2man)
# shellcheck disable=SC2034
CLANG_PACKAGES=(clang-14 libclang-rt-14-dev llvm)  # for fuzzing and sanitizers, whose stack traces need llvm-symbolizer
# shellcheck disable=SC2034
CLANG=(-DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14)

export LC_ALL=C  # decimal points, independent of the locale

say() { printf '\n== %s\n' "$*"; }

fail() {
  printf '%s: error: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

install_packages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then
    say "All ${#} packages are installed"
    return
  fi
  local sudo=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || fail "these packages are missing: ${missing[*]}; install them as root, or install sudo"
    sudo=(sudo)
  fi
  say "Installing ${#missing[@]} missing packages: ${missing[*]}"
  # Waits for the lock: a new machine may be installing updates.
  local apt=("${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300)
  "${apt[@]}" update -qq || fail "apt-get update failed; check the network"
  "${apt[@]}" install -y -qq --no-install-recommends "${missing[@]}" >/dev/null ||
    fail "apt-get could not install: ${missing[*]}"
}

# configure FOLDER [cmake options]: a Ninja build in FOLDER.
configure() {
  local folder=$1 log
  shift
  mkdir -p "$folder"
  log=$folder/configure.log
  cmake -S . -B "$folder" -G Ninja -DRAYSPACE_UNITY=ON "$@" >"$log" 2>&1 || {
    cat "$log" >&2
    fail "the build could not be configured"
  }
}
