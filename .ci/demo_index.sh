#!/usr/bin/env bash
# demo_index.sh FOLDER TITLE <STEPS: writes FOLDER/index.html, which shows or links the results of all steps. A line of
# STEPS has label, seconds, size and file, separated by the ASCII unit separator (\x1f); size and file may be empty. Files
# are below FOLDER.
set -euo pipefail
export LC_ALL=C  # text is processed by bytes

folder=$1
title=$2

escaped() { sed 's/&/\&amp;/g; s/</\&lt;/g; s/>/\&gt;/g; s/"/\&quot;/g' <<<"$1"; }

# address FILE: relative to the folder, percent-encoded.
address() {
  local path=${1#"$folder"/} encoded='' i byte
  for ((i = 0; i < ${#path}; ++i)); do
    byte=${path:i:1}
    case $byte in
      [a-zA-Z0-9./_-]) ;;
      *)
        printf -v byte '%d' "'$byte"
        printf -v byte '%%%02X' $((byte & 255))
        ;;
    esac
    encoded+=$byte
  done
  printf '%s' "$encoded"
}

# figure LABEL FILE: an image or a video with its caption; nothing for other files.
figure() {
  local label where
  label=$(escaped "$1")
  where=$(address "$2")
  case $2 in
    *.mp4) printf '<figure><video src="%s" controls loop muted preload="metadata"></video>' "$where" ;;
    *.png | *.jpg) printf '<figure><a href="%s"><img src="%s" alt="%s" loading="lazy"></a>' "$where" "$where" "$label" ;;
    *) return ;;
  esac
  printf '<figcaption>%s</figcaption></figure>\n' "$label"
}

# table_row LABEL SECONDS SIZE FILE
table_row() {
  local link=
  [ -z "$4" ] || link="<a href=\"$(address "$4")\">$(escaped "${4#"$folder"/}")</a>"
  printf '<tr><td>%s</td><td>%s</td><td>%s</td><td>%s</td></tr>\n' "$(escaped "$1")" "$2" "$3" "$link"
}

figures=
pages=
rows=
while IFS=$'\x1f' read -r label seconds size file; do
  rows+=$(table_row "$label" "$seconds" "$size" "$file")$'\n'
  [ -n "$file" ] || continue
  figures+=$(figure "$label" "$file")$'\n'
  case $file in
    *.html) pages+="<li><a href=\"$(address "$file")\">$(escaped "$label")</a></li>"$'\n' ;;
  esac
done

title=$(escaped "$title")
cat >"$folder/index.html" <<HTML
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; max-width: 75rem; margin: 2rem auto; padding: 0 1rem; color: #222; background: #fafaf8 }
.results { display: grid; grid-template-columns: repeat(auto-fill, minmax(22rem, 1fr)); gap: 1.5rem }
figure { margin: 0 }
img, video { width: 100%; background: #e8e8e4 }
table { border-collapse: collapse }
td, th { padding: .2rem .8rem .2rem 0; text-align: left; border-bottom: 1px solid #ccc }
td:nth-child(2), td:nth-child(3) { text-align: right }
@media (prefers-color-scheme: dark) { body { color: #ddd; background: #16181c } a { color: #8cf } img, video { background: #222 } }
</style>
</head>
<body>
<main>
<h1>$title</h1>
<h2>Pages</h2>
<ul>
$pages</ul>
<h2>Images and videos</h2>
<div class="results">
$figures</div>
<h2>Steps</h2>
<table>
<thead><tr><th>step</th><th>seconds</th><th>size</th><th>file</th></tr></thead>
<tbody>
$rows</tbody>
</table>
</main>
</body>
</html>
HTML
