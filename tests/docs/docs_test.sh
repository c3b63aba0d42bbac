#!/usr/bin/env bash
# Builds the reference of the public headers, without a warning, and looks for what it must hold: docs_test.sh BUILD.
# 77: Doxygen is missing.
set -euo pipefail
BUILD=$(realpath "$1")
command -v doxygen >/dev/null || { echo "docs_test: doxygen is missing"; exit 77; }
cmake --build "$BUILD" --target reference
for name in Object Renderer Executor Camera build_object evaluate_held_out; do
  grep -rqs --include='*.html' "$name" "$BUILD/reference" || { echo "docs_test: the reference lacks $name"; exit 1; }
done
