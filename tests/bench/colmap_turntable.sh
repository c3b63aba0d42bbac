#!/usr/bin/env bash
# Calibrates a turn of photos with `rs-capture import` and with COLMAP, and compares both with published cameras.
#
#   tests/bench/colmap_turntable.sh PHOTOS CAMERAS.mat [OUT] [BIN]
#
# PHOTOS: folder of one turn. CAMERAS.mat: a cell array of 3x4 projection matrices, one per photo (dino_Ps.mat of
# oxford-dino). Only the angles between views are used, which are independent of scale and intrinsics. OUT (new or
# empty; default: a temporary folder) receives the logs, both models and steps.csv. BIN: folder of rs-capture
# (default: build/release/bin). THREADS: cores for each program (default 2). VARIANTS: "masks" (default) and
# "no-masks", where COLMAP uses the whole photos.
#
# COLMAP uses the same photos, one shared SIMPLE_RADIAL camera with unknown focal length, features on the CPU, and the
# alpha mattes of a nominal import as masks. Its time covers feature extraction to the model, without the creation of
# the masks; the time of rs-capture covers the whole import, including alpha mattes and rectified images.
#
# Table and CSV: errors of the steps between views in degrees, for all steps and, as "open", without the one that
# closes the turn (where incremental reconstruction accumulates its drift); the largest angle between a step's axis
# and the mean axis (0 in the model of rs-capture); focal length and distortion; RMS length of the residuals, and
# COLMAP's own mean, both over the inliers of each method; wall and CPU seconds (use the latter on a loaded machine).
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
[ -d "$1" ] || fail "$1 is not a folder of photos"
[ -f "$2" ] || fail "$2: the file of published cameras does not exist"
PHOTOS=$(realpath "$1")
CAMERAS=$(realpath "$2")
BIN=${4:-$HERE/../../build/release/bin}
[ -x "$BIN/rs-capture" ] || fail "$BIN: contains no rs-capture; build it, or give its folder as the fourth argument"
THREADS=${THREADS:-2}
if [ -n "${3:-}" ]; then
  mkdir -p "$3"
  OUT=$(realpath "$3")
  [ -z "$(ls -A "$OUT")" ] || fail "$OUT: is not empty; give a new folder"
else
  OUT=$(mktemp -d)
  trap 'rm -rf "$OUT"' EXIT
fi
export QT_QPA_PLATFORM=offscreen

# Runs a command on THREADS cores. Its output goes to OUT/WHAT.out and WHAT.err, its times to seconds.txt: WHAT, wall,
# user and system seconds. Returns the command's status.
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

echo "COLMAP: $(colmap help | head -1); $THREADS cores, load before: $(cut -d' ' -f1-3 /proc/loadavg)"
timed import "$BIN/rs-capture" import "$PHOTOS" -o "$OUT/set" --json -q
timed nominal "$BIN/rs-capture" import "$PHOTOS" -o "$OUT/nominal" --calibration nominal -q

mkdir "$OUT/masks"
python3 "$HERE/colmap_turntable.py" views "$OUT/nominal" >"$OUT/views.txt"
while IFS=$'\t' read -r image photo; do
  echo "$photo" >>"$OUT/photos.txt"
  oiiotool "$OUT/nominal/$image" --ch A --subc 0.5 --mulc 1000 --clamp:min=0:max=1 -d uint8 -o "$OUT/masks/$photo.png"
done <"$OUT/views.txt"

for variant in ${VARIANTS:-masks}; do
  case $variant in
    masks) masks=(--ImageReader.mask_path "$OUT/masks") ;;
    no-masks) masks=() ;;
    *) fail "VARIANTS: unknown variant $variant; use masks or no-masks" ;;
  esac
  database=$OUT/$variant.db
  sparse=$OUT/colmap-$variant
  mkdir "$sparse"
  timed "$variant.extraction" colmap feature_extractor --database_path "$database" --image_path "$PHOTOS" \
    --image_list_path "$OUT/photos.txt" "${masks[@]}" --ImageReader.single_camera 1 \
    --ImageReader.camera_model SIMPLE_RADIAL --SiftExtraction.use_gpu 0 --SiftExtraction.num_threads "$THREADS"
  timed "$variant.matching" colmap exhaustive_matcher --database_path "$database" --SiftMatching.use_gpu 0 \
    --SiftMatching.num_threads "$THREADS"
  # COLMAP fails if it finds no model; the table reports this.
  run_timed "$variant.mapping" colmap mapper --database_path "$database" --image_path "$PHOTOS" \
    --output_path "$sparse" --Mapper.num_threads "$THREADS" || tail -n 5 "$OUT/$variant.mapping.err" >&2
  for model in "$sparse"/*/; do
    [ -d "$model" ] || continue
    colmap model_converter --input_path "$model" --output_path "$model" --output_type TXT >>"$OUT/convert.log"
  done
done
echo "load after: $(cut -d' ' -f1-3 /proc/loadavg)"
python3 "$HERE/colmap_turntable.py" compare "$OUT" "$CAMERAS"
