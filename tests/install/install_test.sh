#!/usr/bin/env bash
# Installs a build and uses it from outside of the source tree, like a user.
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

# expect_same TOOL IMAGE: IMAGE equals the installed tool's rendering of the object.
expect_same() {
  "$1" render "$OBJECT" --orbit 1 -o "$WORK/expected.png" -q
  cmp "$2" "$WORK/expected.png" || fail "$2 differs from the image that $1 renders"
}

# expect_web_files PREFIX: what web pages need is installed, if the web part is built.
expect_web_files() {
  local file
  [ -e "$BUILD/compositor/web/ray-space.js" ] || return 0
  for file in ray-space.js ray-space.wasm npm/package.json npm/README.md npm/ray-space.js npm/ray-space.wasm npm/types/ray_space.d.ts; do
    [ -s "$1/share/rayspace/web/$file" ] || fail "share/rayspace/web/$file is not installed"
  done
}

# in_root OPTIONS...: dpkg in $ROOT, without root privileges. It refuses a package whose dependencies are not installed.
# The package's scripts call ldconfig, which is replaced by one that is limited to $ROOT.
in_root() {
  mkdir -p "$WORK/bin"
  # shellcheck disable=SC2016  # dpkg sets DPKG_ROOT for the script
  printf '#!/bin/sh\nexec /sbin/ldconfig -n "$DPKG_ROOT/usr/lib"\n' >"$WORK/bin/ldconfig"
  chmod +x "$WORK/bin/ldconfig"
  PATH=$WORK/bin:$PATH:/usr/sbin:/sbin dpkg --root="$ROOT" --force-not-root --force-script-chrootless --no-triggers --log=/dev/null "$@" >"$WORK/log" 2>&1 ||
    { cat "$WORK/log"; fail "dpkg $*"; }
}

# Every library that a file of the package loads belongs to a package in Depends, or to one of its dependencies.
expect_all_stated() {
  local file library libraries owner
  # One line per package: its names, and after a bar its dependencies.
  dpkg-query -W -f='${Package},${Provides}|${Pre-Depends},${Depends}\n' | sed 's/([^)]*)//g; s/:[a-z]*//g' >"$WORK/packages"
  echo "rayspace|$(dpkg-deb -f "$PACKAGE" Depends | sed 's/([^)]*)//g')" >>"$WORK/packages"
  awk -F'|' '
    function reach(name,   i, n, list) {
      if (name in reached || !(name in needs)) return
      reached[name] = 1
      n = split(needs[name], list, ",")
      for (i = 1; i <= n; ++i) reach(list[i])
    }
    { gsub(" ", ""); names = $1; sub(/^[^|]*[|]/, ""); gsub("[|]", ",")
      n = split(names, list, ","); for (i = 1; i <= n; ++i) if (list[i] != "") needs[list[i]] = needs[list[i]] "," list[1] "," $0 }
    END { reach("rayspace"); for (name in reached) print name }' "$WORK/packages" | sort >"$WORK/stated"
  while read -r file; do
    ldd "$file" >>"$WORK/loaded"
  done < <(find "$ROOT/usr/bin" "$ROOT/usr/lib" -type f \( -perm -u+x -o -name '*.so*' \))
  ! grep 'not found' "$WORK/loaded" || fail "the package lacks libraries"
  mapfile -t libraries < <(awk '$2 == "=>" { print $3 }' "$WORK/loaded" | grep -v "^$WORK" | xargs realpath | sort -u)
  # The database may list a library under its path from before /lib was merged into /usr.
  dpkg-query -S "${libraries[@]}" "${libraries[@]#/usr}" 2>/dev/null | sed '/^diversion/d; s/^\([^:,]*\).*: /\1 /' >"$WORK/owners" || true
  for library in "${libraries[@]}"; do
    owner=$(awk -v a="$library" -v b="${library#/usr}" '$2 == a || $2 == b { print $1; exit }' "$WORK/owners")
    [ -n "$owner" ] || fail "no package contains $library"
    grep -qxF "$owner" "$WORK/stated" || fail "the package needs $library of $owner, which is not among its dependencies"
  done
}

case "$2" in
  library) # find_package(Rayspace) in another project
    cmake --install "$BUILD" --prefix "$WORK/there" >"$WORK/install.log"
    expect_web_files "$WORK/there"
    cmake -S "$HERE/../../examples" -B "$WORK/examples" -DCMAKE_PREFIX_PATH="$WORK/there" -DCMAKE_BUILD_TYPE=Release >"$WORK/log" || { cat "$WORK/log"; fail "find_package"; }
    cmake --build "$WORK/examples" >"$WORK/log" || { cat "$WORK/log"; fail "the examples do not build"; }
    foreign=$(cd "$WORK/there/include/"* && find . -name '*.hpp' ! -path './rayspace/api/*')
    [ -z "$foreign" ] || fail "other headers than those of rayspace/api are installed: $foreign"
    "$WORK/examples/render_orbit" "$OBJECT" "$WORK/views" 1
    expect_same "$WORK/there/bin/rs-engine" "$WORK/views/0000.png"
    ! "$WORK/examples/render_orbit" "$WORK/none.rso" "$WORK/none" 2>"$WORK/error" || fail "an object that does not exist was rendered"
    grep -q 'none.rso: ' "$WORK/error" || fail "the error does not name the file: $(cat "$WORK/error")"
    ;;
  python)
    cmake --install "$BUILD" --prefix "$WORK/there" >"$WORK/install.log"
    # A set whose images are the object's rendered views: its map has random cells, which do not reproduce its images.
    "$WORK/there/bin/rs-encode" extract "$OBJECT" -o "$WORK/set" -q >"$WORK/log"
    "$WORK/there/bin/rs-engine" render "$OBJECT" --poses "$WORK/set/transforms.json" -o "$WORK/drawn" -q
    cp -r "$WORK/drawn/." "$WORK/set"
    PYTHONPATH=$WORK/there/lib/python3/dist-packages /usr/bin/python3 "$HERE/use_module.py" "$OBJECT" "$WORK/set"
    [ -e "$WORK/there/lib/python3/dist-packages/rayspace.pyi" ] || fail "the type stub is not installed"
    ;;
  package) # a .deb, installed by dpkg beside a copy of this system's database, used from there, and removed
    (cd "$BUILD" && cpack -G DEB -B "$WORK/packed" >"$WORK/log" 2>&1) || { cat "$WORK/log"; fail "cpack"; }
    PACKAGE=$(echo "$WORK"/packed/*.deb)
    ROOT=$WORK/root
    mkdir -p "$ROOT"/var/lib/dpkg/{updates,triggers}
    cp -r /var/lib/dpkg/{status,info} "$ROOT/var/lib/dpkg"
    in_root --install "$PACKAGE"
    [ -e "$ROOT/usr/lib/rayspace/librayspace_image_io.so" ] || fail "the package lacks its image module"
    expect_all_stated
    expect_web_files "$ROOT/usr"
    for tool in "$ROOT"/usr/bin/*; do
      (cd "$WORK" && "$tool" --help >/dev/null) || fail "$tool does not start"
    done
    (cd "$WORK" && "$ROOT/usr/bin/rs-engine" render "$OBJECT" --orbit 1 -o view.png -q)
    expect_same "$BUILD/bin/rs-engine" "$WORK/view.png"
    in_root --remove rayspace
    left=$(find "$ROOT" -path "$ROOT/var/lib/dpkg" -prune -o ! -type d -print)
    [ -z "$left" ] || fail "removed, the package leaves $left"
    ;;
  *) fail "what is $2?" ;;
esac
