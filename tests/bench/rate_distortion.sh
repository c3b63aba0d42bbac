#!/usr/bin/env bash
# Compares image coding with ASTC, JPEG, WebP and x265: creates the sets (two of real photos, three synthetic ones of 90
# views of 512x512), then runs bench_rd on them. Writes rd.csv, rd_ratios.csv and rd.svg to OUT.
#
#   tests/bench/rate_distortion.sh DATA OUT [OPTION...]     DATA: folder with turntable/oxford-dino and shoe36
#
# Further options are passed to bench_rd, such as --only anchors. SPP: samples per pixel (default 64). BIN: folder of
# the programs. Sets and the anchors' results in OUT are reused, so that further runs mainly measure the encoder.
# Needs the commands astcenc and x265. The first run takes hours on two cores, mostly for ASTC and x265.
set -euo pipefail
DATA=$(realpath "${1:?give the folder of test inputs}")
OUT=${2:?give a folder for the results}
shift 2
ROOT=$(realpath "$(dirname "$0")/../..")
BIN=$(realpath "${BIN:-$ROOT/build/release/bin}")
SPP=${SPP:-64}
mkdir -p "$OUT/sets"
OUT=$(realpath "$OUT")

SETS=()
for name in oxford-dino shoe36; do
  SETS+=("$OUT/sets/$name")
  if [ ! -e "$OUT/sets/$name" ]; then
    "$BIN/rs-capture" import "$DATA/turntable/$name" -o "$OUT/sets/$name" >&2
  fi
done
for name in vase doll flower; do
  SETS+=("$OUT/sets/$name")
  if [ ! -e "$OUT/sets/$name" ]; then
    "$BIN/rs-capture" synth "$ROOT/datasets-synthetic/recipes/$name.json" -o "$OUT/sets/$name" \
      --views 90 --size 512x512 --spp "$SPP" --no-filter >&2
  fi
done
exec "$BIN/bench_rd" --work "$OUT/work" --csv "$OUT/rd.csv" --svg "$OUT/rd.svg" "$@" "${SETS[@]}"
