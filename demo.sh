#!/usr/bin/env bash
# Runs the whole pipeline: installs missing packages, builds the tools, and
#
#   ./demo.sh                   traces two objects on a turntable,
#   ./demo.sh FOLDER_OF_PHOTOS  or imports your turntable photos, or a video of a turn,
#
# encodes them, verifies the files and the renderer bit for bit, and renders an orbit video and a contact sheet. Traced
# objects are then shown in a walk through a shop and a museum (further objects are traced at low resolution), imported
# ones on a floor. Results are in demo-out/, index.html shows them. Arguments after the folder are passed to
# `rs-capture import`.
set -euo pipefail
cd "$(dirname "$0")"
FROM=$OLDPWD
. .ci/setup.sh

OUT=demo-out
BIN=build/release/bin
VIEWS=${RAYSPACE_DEMO_VIEWS:-90}
SIZE=${RAYSPACE_DEMO_SIZE:-400x400}
SPP=${RAYSPACE_DEMO_SPP:-12}
OBJECTS=${RAYSPACE_DEMO_OBJECTS:-vase doll}
# Further objects in the showroom, which are farther away, and the walk through it.
ROOM_VIEWS=${RAYSPACE_DEMO_ROOM_VIEWS:-48}
ROOM_SIZE=${RAYSPACE_DEMO_ROOM_SIZE:-224x224}
ROOM_SPP=${RAYSPACE_DEMO_ROOM_SPP:-8}
WALK_SIZE=${RAYSPACE_DEMO_WALK_SIZE:-960x540}
STREET_SIZE=${RAYSPACE_DEMO_STREET_SIZE:-640x360}

PHOTOS=
if [ $# -gt 0 ]; then
  case $1 in
    -h | --help)
      sed -n '2,10s/^# \{0,1\}//p' demo.sh
      exit 0
      ;;
    /*) PHOTOS=$1 ;;
    *) PHOTOS=$FROM/$1 ;;
  esac
  shift
  [ -e "$PHOTOS" ] || fail "$PHOTOS: there is no such folder or video; give turntable photos or a video of a turn"
fi

install_packages "${BUILD_PACKAGES[@]}"

say "Building the tools"
# Without tests, which need more packages than the tools.
configure build/release -DCMAKE_BUILD_TYPE=Release -DRAYSPACE_TESTS=OFF -DRAYSPACE_BENCH=OFF
cmake --build build/release -j "$(nproc)" --target rs-capture rs-encode rs-engine rs-showroom rs-street rs-view

mkdir -p "$OUT"
STEPS=()

# step LABEL FILE COMMAND...: runs the command and records its time and the size of its output.
step() {
  local label=$1 file=$2 begun size=
  shift 2
  say "$label"
  begun=$(date +%s.%N)
  "$@"
  [ -n "$file" ] && size=$(du -sh --apparent-size "$file" | cut -f1)
  STEPS+=("$(printf '%s\x1f%.1f\x1f%s\x1f%s' "$label" "$(echo "$begun $(date +%s.%N)" | awk '{print $2 - $1}')" "$size" "$file")")
}

# from_set NAME: all steps after the capture set $OUT/NAME-set.
from_set() {
  local name=$1
  step "$name: encode" "$OUT/$name.rso" "$BIN/rs-encode" build "$OUT/$name-set" -o "$OUT/$name.rso" --name "$name"
  step "$name: orbit video" "$OUT/$name-orbit.mp4" "$BIN/rs-engine" render "$OUT/$name.rso" --orbit 180 -o "$OUT/$name-orbit.mp4"
  step "$name: verify" "" "$BIN/rs-encode" verify "$OUT/$name.rso"
  step "$name: bit-accuracy" "" "$BIN/rs-engine" conformance "$OUT/$name.rso" --views 40
  step "$name: contact sheet" "$OUT/$name-sheet.png" "$BIN/rs-engine" render "$OUT/$name.rso" --orbit 12 --sheet 4 -o "$OUT/$name-sheet.png"
  [ ! -f build/release/compositor/web/ray-space.js ] ||
    step "$name: web page" "$OUT/$name-page.html" "$BIN/rs-view" page "$OUT/$name.rso" -o "$OUT/$name-page.html"
  step "$name: evaluate" "$OUT/$name.html" "$BIN/rs-encode" evaluate "$OUT/$name-set" --report "$OUT/$name.html" -q
}

# traced_for_room NAME...: traces and encodes the missing objects in parallel, at low resolution.
traced_for_room() {
  local name job jobs=()
  for name in "$@"; do
    {
      "$BIN/rs-capture" synth "datasets-synthetic/recipes/$name.json" -o "$OUT/$name-set" \
        --views "$ROOM_VIEWS" --size "$ROOM_SIZE" --spp "$ROOM_SPP" -q &&
        "$BIN/rs-encode" build "$OUT/$name-set" -o "$OUT/$name.rso" --name "$name" -q
    } &
    jobs+=($!)
  done
  for job in "${jobs[@]}"; do wait "$job" || fail "an object of the showroom could not be built; see above"; done
}

# show_toon: an object with toon shading among photorealistic ones.
show_toon() {
  local world=$OUT/showroom
  step "toon: trace 48 images" "$OUT/blocks-toon-set" "$BIN/rs-capture" synth datasets-synthetic/recipes/blocks-toon.json \
    -o "$OUT/blocks-toon-set" --views 48 --size 224x224 --spp 4 -q
  step "toon: encode" "$OUT/blocks-toon.rso" "$BIN/rs-encode" build "$OUT/blocks-toon-set" -o "$OUT/blocks-toon.rso" -q
  step "toon: in the shop" "$OUT/showroom-toon.png" "$BIN/rs-view" render "$world/showroom.wrl" --viewpoint table \
    --object "$OUT/blocks-toon.rso@-0.82,0.8,4.1,-10,0.11" --size 800x450 -o "$OUT/showroom-toon.png"
}

# show_room: images of the shop and the museum, and the walk through both.
show_room() {
  local rest=() name world=$OUT/showroom view
  for name in vase flower doll lamp lattice blocks; do
    case " $OBJECTS " in *" $name "*) ;; *) rest+=("$name") ;; esac
  done
  [ ${#rest[@]} -eq 0 ] || step "showroom: ${rest[*]}" "" traced_for_room "${rest[@]}"
  step "showroom: build the rooms" "$world" "$BIN/rs-showroom" -o "$world"
  for view in shop museum; do
    step "showroom: $view" "$OUT/showroom-$view.png" \
      "$BIN/rs-view" render "$world/showroom.wrl" --viewpoint "$view" -o "$OUT/showroom-$view.png"
  done
  step "showroom: evening, traced" "$OUT/showroom-evening.png" "$BIN/rs-view" render "$world/showroom.wrl" --viewpoint table \
    --lights "$world/evening.json" --exposure 3 --renderer radiosity --passes 4 --size 800x450 -o "$OUT/showroom-evening.png"
  step "showroom: quilt" "$OUT/showroom_qs5x9a0.75.png" "$BIN/rs-view" quilt "$world/showroom.wrl" --viewpoint table --layout 5x9 \
    -o "$OUT/showroom.png"
  [ ! -f build/release/compositor/web/scene.js ] ||
    step "showroom: web page" "$OUT/showroom.html" "$BIN/rs-view" page "$world/showroom.wrl" -o "$OUT/showroom.html"
  step "showroom: walk" "$OUT/showroom-walk.mp4" "$BIN/rs-view" render "$world/showroom.wrl" \
    --path "$world/showroom-walk.json" --size "$WALK_SIZE" --upright -o "$OUT/showroom-walk.mp4"
}

# encoded_for_board FOLDER: the showroom's objects as the prototype board stores them, uncompressed with plane maps.
encoded_for_board() {
  local name
  for name in vase flower doll lamp lattice blocks; do
    "$BIN/rs-encode" build "$OUT/$name-set" -o "$1/$name.rso" --raymap plane --profile raw --cells 256x256 --name "$name" -q
  done
}

# field KEY FILE.json: the first number of this key.
field() {
  awk -F'[:,]' -v key="\"$1\"" 'index($1, key) { print $2 + 0; exit }' "$2"
}

# board_rates FOLDER: the board's rate, counted in its cycles, beside the rate of the core on this machine.
board_rates() {
  "$BIN/rs-engine" simulate prototype-2000 "$1"/*.rso --orbit 4 --upright --stats "$1/simulated.json" >"$1/simulated.txt"
  tail -n 1 "$1/simulated.txt"
  awk -v board="$(field mpixels_per_second "$1/simulated.json")" -v clock="$(field clock_mhz "$1/simulated.json")" \
    -v views="$(field views_by_board "$1/board.json")" -v core_views="$(field views_by_core "$1/board.json")" \
    -v pixels="$(field engine_pixels_per_frame "$1/core.json")" -v ms="$(field engine "$1/core.json")" \
    'BEGIN { printf "board: %.1f Mpixel/s at %.0f MHz; core: %.0f Mpixel/s on this machine\n", board, clock, pixels / ms / 1000
             printf "board: drew %d of %d views of the shop\n", views, views + core_views }'
}

# show_board: a few frames of the shop with objects drawn by the model of the prototype board, beside those of the core.
show_board() {
  local board=$OUT/board executor name
  mkdir -p "$board"
  step "board: encode" "$board" encoded_for_board "$board"
  step "board: memory" "" "$BIN/rs-engine" board "$board"/*.rso
  "$BIN/rs-showroom" -o "$board/showroom"
  for executor in core board:prototype-2000; do
    name=${executor%%:*}
    step "board: shop by $executor" "$board/$name" "$BIN/rs-view" render "$board/showroom/showroom.wrl" --viewpoint table \
      --orbit 6 --executor "$executor" --upright --object-depth plane --size 640x360 --stats "$board/$name.json" -o "$board/$name"
  done
  step "board: rates" "" board_rates "$board"
  step "board: beside the core" "$OUT/showroom-board.png" oiiotool "$board/core/0000.png" "$board/board/0000.png" \
    --mosaic:pad=8 2x1 -o "$OUT/showroom-board.png"
}

# show_street: ten seconds of traffic, and one frame by day, by night and in every weather.
show_street() {
  local look images=() image folder
  step "street: by day" "$OUT/town" "$BIN/rs-street" -o "$OUT/town" --objects ..
  step "street: by night" "$OUT/town-night" "$BIN/rs-street" -o "$OUT/town-night" --time night --objects ..
  step "street: ten seconds" "$OUT/street.mp4" "$BIN/rs-view" sequence "$OUT/town" --size "$STREET_SIZE" --upright -o "$OUT/street.mp4"
  for look in town:fair town:rain town:snow town:fog town-night:fair town-night:rain; do
    folder=${look%%:*}
    image=$OUT/street-${look/:/-}.png
    local weather=()
    [ "${look##*:}" = fair ] || weather=(--weather "${look##*:}")
    "$BIN/rs-view" sequence "$OUT/$folder" "${weather[@]}" --frame 130 --size "$STREET_SIZE" -o "$image"
    images+=("$image")
  done
  step "street: contact sheet" "$OUT/street-sheet.jpg" oiiotool "${images[@]}" --mosaic:pad=8 3x2 -o "$OUT/street-sheet.jpg"
}

if [ -n "$PHOTOS" ]; then
  # In a folder of their own, since they may have the name of a traced object.
  OUT=$OUT/photographs
  mkdir -p "$OUT"
  NAME=$(basename "$(realpath "$PHOTOS")")
  [ -d "$PHOTOS" ] || NAME=${NAME%.*}
  step "$NAME: import photos" "$OUT/$NAME-set" "$BIN/rs-capture" import "$PHOTOS" -o "$OUT/$NAME-set" "$@"
  from_set "$NAME"
  step "on a floor" "$OUT/$NAME-floor.png" "$BIN/rs-view" render --object "$OUT/$NAME.rso" -o "$OUT/$NAME-floor.png"
  TITLE=$NAME
  LOOK="the contact sheet, the orbit video and $NAME-floor.png"
else
  for name in $OBJECTS; do
    step "$name: trace $VIEWS images" "$OUT/$name-set" "$BIN/rs-capture" synth "datasets-synthetic/recipes/$name.json" \
      -o "$OUT/$name-set" --views "$VIEWS" --size "$SIZE" --spp "$SPP"
    from_set "$name"
  done
  show_room
  show_toon
  show_board
  show_street
  TITLE="Rayspace: results of the demo"
  LOOK="showroom-walk.mp4, street.mp4, showroom-shop.png, showroom-museum.png, showroom-evening.png, showroom-toon.png, showroom-board.png (core, board) and street-sheet.jpg, the contact sheets and the orbit videos"
fi

printf '%s\n' "${STEPS[@]}" | .ci/demo_index.sh "$OUT" "$TITLE"
printf '\n%-34s %9s  %7s  %s\n' "step" "time" "size" "file"
printf '%s\n' "${STEPS[@]}" | awk -F '\x1f' '{ printf "%-34s %7.1f s  %7s  %s\n", $1, $2, $3 == "" ? "-" : $3, $4 }'
say "Done. Open $OUT/index.html, or look at $OUT/: $LOOK"
