#!/usr/bin/env bash
# A turn of photographs calibrated by `rs-capture import` and by COLMAP, both held against published cameras.
#
#   tests/bench/colmap_turntable.sh PHOTOS CAMERAS.mat [OUT] [BIN]
#
# PHOTOS: the folder of one turn. CAMERAS.mat: a cell array of 3x4 projection matrices, one per photograph (dino_Ps.mat
# of oxford-dino). Only the angles from view to view are taken from them, which need neither their scale nor their lens.
# OUT (new or empty; default: a temporary folder) keeps the logs, both models and steps.csv. BIN holds rs-capture
# (default: build/release/bin). THREADS (default 2) processors for either. VARIANTS: "masks" (default) and "no-masks",
# where COLMAP sees the whole photographs.
#
# COLMAP gets the same photographs, one shared SIMPLE_RADIAL camera whose focal length it finds, features on the CPU,
# and as masks the mattes of a nominal import. Its time runs from feature extraction to the model and does not count the
# making of those masks; ours is the whole import, mattes and rectified pictures included.
#
# Table and CSV: errors of the steps from view to view in degrees, all of them and "open", without the one that closes
# the turn (cameras that were found picture after picture pile their drift up there); the largest angle of a step's axis
# to the mean axis (0 by our model); focal length and distortion; RMS of the residuals' lengths and COLMAP's own mean,
# both over the observations that the method kept; wall and processor seconds (believe the latter on a busy machine).
set -euo pipefail
HERE=$(realpath "$(dirname "$0")")
fail() {
  echo "colmap_turntable: $*" >&2
  exit 1
}
if [ $# -lt 2 ] || [ $# -gt 4 ]; then
  echo "usage: $0 PHOTOS CAMERAS.mat [OUT] [BIN]" >&2
  exit 2
fi
for tool in colmap oiiotool python3 taskset; do
  command -v "$tool" >/dev/null || fail "$tool is not installed (Debian: colmap openimageio-tools python3 util-linux)"
done
[ -d "$1" ] || fail "$1 is not a folder of photographs"
[ -f "$2" ] || fail "$2, the published cameras, is not there"
PHOTOS=$(realpath "$1")
CAMERAS=$(realpath "$2")
BIN=${4:-$HERE/../../build/release/bin}
[ -x "$BIN/rs-capture" ] || fail "no rs-capture in $BIN: build it, or name its folder as the fourth argument"
THREADS=${THREADS:-2}
if [ -n "${3:-}" ]; then
  mkdir -p "$3"
  OUT=$(realpath "$3")
  [ -z "$(ls -A "$OUT")" ] || fail "$OUT is not empty: name a new folder"
else
  OUT=$(mktemp -d)
  trap 'rm -rf "$OUT"' EXIT
fi
export QT_QPA_PLATFORM=offscreen

# Runs a command on THREADS processors; what it prints goes to OUT/WHAT.out and WHAT.err, its times to seconds.txt:
# WHAT, wall, user and system seconds. Returns the command's status.
run_timed() {
  local what=$1
  shift
  local TIMEFORMAT="$what %R %U %S"
  { time taskset -c "0-$((THREADS - 1))" "$@" >"$OUT/$what.out" 2>"$OUT/$what.err"; } 2>>"$OUT/seconds.txt"
}

timed() {
  local what=$1
  run_timed "$@" && return
  shift
  tail -n 5 "$OUT/$what.out" "$OUT/$what.err" >&2
  fail "$what failed: $*"
}

echo "COLMAP: $(colmap help | head -1); $THREADS processors, load before: $(cut -d' ' -f1-3 /proc/loadavg)"
timed import "$BIN/rs-capture" import "$PHOTOS" -o "$OUT/set" --json -q
timed mattes "$BIN/rs-capture" import "$PHOTOS" -o "$OUT/nominal" --calibration nominal -q

mkdir "$OUT/masks"
python3 "$HERE/colmap_turntable.py" views "$OUT/nominal" >"$OUT/views.txt"
while IFS=$'\t' read -r matte photo; do
  echo "$photo" >>"$OUT/photos.txt"
  oiiotool "$OUT/nominal/$matte" --ch A --subc 0.5 --mulc 1000 --clamp:min=0:max=1 -d uint8 -o "$OUT/masks/$photo.png"
done <"$OUT/views.txt"

for variant in ${VARIANTS:-masks}; do
  case $variant in
    masks) masks=(--ImageReader.mask_path "$OUT/masks") ;;
    no-masks) masks=() ;;
    *) fail "VARIANTS knows masks and no-masks, not $variant" ;;
  esac
  database=$OUT/$variant.db
  sparse=$OUT/colmap-$variant
  mkdir "$sparse"
  timed "$variant.extraction" colmap feature_extractor --database_path "$database" --image_path "$PHOTOS" \
    --image_list_path "$OUT/photos.txt" "${masks[@]}" --ImageReader.single_camera 1 \
    --ImageReader.camera_model SIMPLE_RADIAL --SiftExtraction.use_gpu 0 --SiftExtraction.num_threads "$THREADS"
  timed "$variant.matching" colmap exhaustive_matcher --database_path "$database" --SiftMatching.use_gpu 0 \
    --SiftMatching.num_threads "$THREADS"
  # Where it finds no model it fails; the table then says that it calibrated nothing.
  run_timed "$variant.mapping" colmap mapper --database_path "$database" --image_path "$PHOTOS" \
    --output_path "$sparse" --Mapper.num_threads "$THREADS" || tail -n 5 "$OUT/$variant.mapping.err" >&2
  for model in "$sparse"/*/; do
    [ -d "$model" ] || continue
    colmap model_converter --input_path "$model" --output_path "$model" --output_type TXT >>"$OUT/convert.log"
  done
done
echo "load after: $(cut -d' ' -f1-3 /proc/loadavg)"
python3 "$HERE/colmap_turntable.py" compare "$OUT" "$CAMERAS"
