#!/usr/bin/env bash
# Baseline of the paper on Spot: 90 views of 512x512, focal length 1.4 widths, eye at 3.5 object radii, scored on 90
# views halfway between. "photo" is the nearest captured image, unchanged; "plane" renders the object.
#
#   tests/bench/paper_baseline.sh [DATA]      DATA: folder with meshes/spot and hdr (default: $RAYSPACE_DATA)
#
# SPP: samples per pixel (default 64). LIGHTS: "white" (uniform, overexposed), "bright" (uniform with a sun) and names
# of light probes in hdr/. 3.5 object radii are 2.81 bounding-sphere radii, the unit of `synth`.
set -euo pipefail
DATA=$(realpath "${1:-${RAYSPACE_DATA:?give the folder of test inputs}}")
BIN=$(realpath "$(dirname "$0")/../../build/release/bin")
SPP=${SPP:-64}
WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT

for light in ${LIGHTS:-white bright courtyard}; do
  case $light in
    white) environment='{"constant": [1.4, 1.4, 1.4]}' ;;
    bright) environment='{"constant": [0.9, 0.9, 0.9]},
 "lights": [{"type": "directional", "direction": [-0.4, -0.8, -0.5], "irradiance": [1.2, 1.2, 1.2]}]' ;;
    *) environment="{\"file\": \"$DATA/hdr/$light.exr\"}" ;;
  esac
  cat >"$WORK/spot.json" <<JSON
{"name": "spot", "seed": 1,
 "object": {"mesh": "$DATA/meshes/spot/spot_triangulated.obj", "texture": "$DATA/meshes/spot/spot_texture.png"},
 "camera": {"distance_radii": 2.81, "focal_widths": 1.4}, "environment": $environment}
JSON
  "$BIN/rs-capture" synth "$WORK/spot.json" -o "$WORK/set" --views 90 --size 512x512 --spp "$SPP" --no-filter -q >/dev/null
  "$BIN/rs-capture" synth "$WORK/spot.json" -o "$WORK/halfway" --views 90 --size 512x512 --spp "$SPP" --no-filter --first-angle 2 -q >/dev/null
  "$BIN/rs-encode" build "$WORK/set" -o "$WORK/spot.rso" --raymap plane --planes 12 -q >/dev/null
  # Images of the halfway set with the captured poses: the error of switching between photos.
  cp -r "$WORK/halfway" "$WORK/flipped"
  cp "$WORK/set/transforms.json" "$WORK/flipped/transforms.json"
  printf '%-10s photo %s\n' "$light" "$("$BIN/rs-engine" compare "$WORK/spot.rso" "$WORK/flipped" -q | tail -1)"
  printf '%-10s plane %s\n' "$light" "$("$BIN/rs-engine" compare "$WORK/spot.rso" "$WORK/halfway" -q | tail -1)"
  rm -rf "${WORK:?}"/*
done
