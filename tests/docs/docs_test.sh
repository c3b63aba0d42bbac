#!/usr/bin/env bash
# Builds the reference of the public headers, without a warning, and the man pages of a tool: docs_test.sh BUILD.
# 77: Doxygen or help2man is missing.
set -euo pipefail
BUILD=$(realpath "$1")
for tool in doxygen help2man; do
  command -v "$tool" >/dev/null || { echo "docs_test: $tool is missing"; exit 77; }
done
cmake --build "$BUILD" --target reference
for name in Object Renderer Executor Camera build_object evaluate_held_out; do
  grep -rqs --include='*.html' "$name" "$BUILD/reference" || { echo "docs_test: the reference lacks $name"; exit 1; }
done

WORK=$(mktemp -d)
trap 'rm -rf "$WORK"' EXIT
"$(dirname "$0")/../../docs/man_pages.sh" help2man "$BUILD/bin/rs-encode" 1.2.3 "$WORK"
for page in rs-encode rs-encode-build rs-encode-evaluate; do
  [ -s "$WORK/$page.1" ] || { echo "docs_test: there is no man page $page"; exit 1; }
done
[ "$(find "$WORK" -name "*.1" | wc -l)" -eq 6 ] || { echo "docs_test: there are other man pages than one per command"; exit 1; }
grep -q -- '\\-\\-output' "$WORK/rs-encode-build.1" || { echo "docs_test: rs-encode-build.1 lacks --output"; exit 1; }
