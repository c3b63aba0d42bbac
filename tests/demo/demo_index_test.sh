#!/usr/bin/env bash
# demo_index_test.sh: the page of the demo's results.
set -euo pipefail
cd "$(dirname "$0")/../.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

row() { printf '%s\x1f%s\x1f%s\x1f%s\n' "$@"; }
{
  row "orbit <1>" 1.2 3M "$folder/a bü.mp4"
  row "verify" 0.1 "" ""
  row "web page" 1.0 2K "$folder/shoe-page.html"
} | .ci/demo_index.sh "$folder" "Shoes & more"

expect() {
  grep -qF -- "$1" "$folder/index.html" && return
  printf 'index.html does not contain: %s\n' "$1" >&2
  exit 1
}
expect '<title>Shoes &amp; more</title>'
expect '<video src="a%20b%C3%BC.mp4"'
expect '<figcaption>orbit &lt;1&gt;</figcaption>'
expect '<tr><td>verify</td><td>0.1</td><td></td><td></td></tr>'
expect '<li><a href="shoe-page.html">web page</a></li>'
