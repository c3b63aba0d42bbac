#!/usr/bin/env bash
# Man pages of a tool and of its subcommands, from what --help prints.
#
#     man_pages.sh HELP2MAN TOOL VERSION FOLDER
set -euo pipefail
HELP2MAN=$1 TOOL=$2 VERSION=$3 FOLDER=$4
export LC_ALL=C
mkdir -p "$FOLDER"

# page NAME COMMAND: FOLDER/NAME.1 of COMMAND --help, whose first line is the summary.
page() {
  local summary
  # awk reads to the end: a tool that writes to a closed pipe would fail the script.
  summary=$($2 --help | awk 'NF && !found { sub(/[.]$/, ""); print; found = 1 }')
  "$HELP2MAN" --no-info --no-discard-stderr --version-string="$VERSION" --source=Rayspace --manual="Rayspace tools" \
    --name="$summary" --output="$FOLDER/$1.1" "$2"
}

name=$(basename "$TOOL")
for subcommand in $("$TOOL" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p'); do
  page "$name-$subcommand" "$TOOL $subcommand"
done
page "$name" "$TOOL"
