#!/usr/bin/env bash
# What users get: installs a build and uses it as they would, from the outside.
#
#     install_test.sh BUILD library|python|package
set -euo pipefail
BUILD=$(realpath "$1")
HERE=$(dirname "$(realpath "$0")")
OBJECT=$HERE/../reference/golden/valid/dense-64x64-alpha3.rso
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT

fail() {
  printf 'install_test: %s\n' "$*" >&2
  exit 1
}

# expect_same TOOL PICTURE: PICTURE is what the installed tool draws of the object.
expect_same() {
  "$1" render "$OBJECT" --orbit 1 -o "$WORK/expected.png" -q
  cmp "$2" "$WORK/expected.png" || fail "$2 is another picture than $1 draws"
}

case "$2" in
  library) # find_package(Rayspace) in somebody else's project
    cmake --install "$BUILD" --prefix "$WORK/there" >"$WORK/install.log"
    cmake -S "$HERE/consumer" -B "$WORK/consumer" -DCMAKE_PREFIX_PATH="$WORK/there" -DCMAKE_BUILD_TYPE=Release >"$WORK/log" || { cat "$WORK/log"; fail "find_package"; }
    cmake --build "$WORK/consumer" >"$WORK/log" || { cat "$WORK/log"; fail "the consumer does not build"; }
    "$WORK/consumer/consumer" "$OBJECT" "$WORK/view.png"
    expect_same "$WORK/there/bin/rs-engine" "$WORK/view.png"
    ! "$WORK/consumer/consumer" "$WORK/none.rso" "$WORK/none.png" 2>"$WORK/error" || fail "an object that is not there was drawn"
    grep -q 'none.rso: ' "$WORK/error" || fail "the error does not name the file: $(cat "$WORK/error")"
    ;;
  python)
    cmake --install "$BUILD" --prefix "$WORK/there" >"$WORK/install.log"
    # A set whose pictures are the object's views: its map is of random cells, which do not give its pictures back.
    "$WORK/there/bin/rs-encode" extract "$OBJECT" -o "$WORK/set" -q >"$WORK/log"
    "$WORK/there/bin/rs-engine" render "$OBJECT" --poses "$WORK/set/transforms.json" -o "$WORK/drawn" -q
    cp -r "$WORK/drawn/." "$WORK/set"
    PYTHONPATH=$WORK/there/lib/python3/dist-packages /usr/bin/python3 "$HERE/use_module.py" "$OBJECT" "$WORK/set"
    ;;
  package) # a .deb whose dependencies are stated, used from where it was unpacked
    (cd "$BUILD" && cpack -G DEB -B "$WORK/packed" >"$WORK/log" 2>&1) || { cat "$WORK/log"; fail "cpack"; }
    PACKAGE=$(echo "$WORK"/packed/*.deb)
    DEPENDS=$(dpkg-deb -f "$PACKAGE" Depends)
    for library in libtbb libopenimageio libopencv-core libembree libzstd; do
      grep -q "$library" <<<"$DEPENDS" || fail "the package does not depend on $library: $DEPENDS"
    done
    dpkg-deb -x "$PACKAGE" "$WORK/unpacked"
    [ -e "$WORK/unpacked/usr/lib/rayspace/librayspace_pictures.so" ] || fail "the package lacks its picture module"
    (cd "$WORK" && "$WORK/unpacked/usr/bin/rs-engine" render "$OBJECT" --orbit 1 -o view.png -q)
    expect_same "$BUILD/bin/rs-engine" "$WORK/view.png"
    ;;
  *) fail "what is $2?" ;;
esac
