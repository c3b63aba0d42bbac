#!/usr/bin/env bash
# tools_test.sh TOOL BOARD.sv: every module of engine/rtl is accepted by Icarus Verilog or Yosys. Exits with 77 if the
# tool is not installed.
set -euo pipefail
tool=$1
board=$2
cd "$(dirname "$0")/../../../engine/rtl"
command -v "$tool" >/dev/null || { echo "$tool is not installed"; exit 77; }

mapfile -t sources < <(find . -name '*.sv' | sort)
[ ${#sources[@]} -gt 0 ]
for source in "${sources[@]}"; do
  module=$(basename "$source" .sv)
  case $tool in
    iverilog)
      # "sorry" is a note on simulation speed.
      iverilog -g2012 -I. -s "$module" -o /dev/null "$board" "${sources[@]}" 2>&1 | { grep -v ': sorry: constant selects' || true; }
      ;;
    yosys)
      yosys -q -p "read_verilog -sv $board ${sources[*]}; hierarchy -check -top $module; proc; check -assert"
      ;;
  esac
done
