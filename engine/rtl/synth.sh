#!/usr/bin/env bash
# synth.sh [BUILD]: synthesizes every block with Yosys, places and routes it for an iCE40 HX8K, and writes RESULTS.md. The
# modules of memory/ are left out: an iCE40 has no RAM that answers in the same cycle.
# BUILD (build/release) is a build folder whose target rtl_board_constants is up to date. Needs yosys and nextpnr-ice40.
# RAYSPACE_SYNTH_JOBS modules are processed at a time (1). Modules whose row is in BUILD/rtl_synth are not
# repeated: delete that folder after a change.
set -euo pipefail

build=$(realpath "${1:-build/release}")
rtl=$(cd "$(dirname "$0")" && pwd)
board=$build/tests/engine/rtl/board.sv
out=$build/rtl_synth
[ -f "$board" ] || { echo "synth.sh: $board is missing; build the target rtl_board_constants" >&2; exit 1; }
mkdir -p "$out"
cd "$rtl"

# Blocks whose cells are added up.
prototype="colour_conversion column_address disk_controller host_bus host_dma image_writer line_reader map_reader
  memory_controller raster_generator ray_position render_control row_scan sample_fetch sample_select
  vertical_compensation"

# synthesize MODULE: writes $out/MODULE.row, a row of the table.
synthesize() {
  local module=$1 sources memories luts frequency
  mapfile -t sources < <(find . -name '*.sv' ! -path './memory/*' | sort)
  memories=(memory/*.sv)
  local read="read_verilog -sv $board ${sources[*]} ${memories[*]}"

  yosys -q -w "Replacing memory" -p "$read; hierarchy -top $module; proc; write_json $out/$module.ports.json"
  # Memories are not cells: black boxes.
  yosys -q -w "Replacing memory" -p "read_verilog -sv $board ${sources[*]}; read_verilog -sv -lib ${memories[*]};
    synth -flatten -top $module; abc -lut 4; tee -o $out/$module.lut.txt stat"
  yosys -q -w "Replacing memory" -p "$read; synth_ice40 -top $module; tee -o $out/$module.ice40.txt stat"
  luts=$(awk '$1 == "$lut" { print $2 }' "$out/$module.lut.txt")
  cells() { awk -v kind="$1" '$1 ~ kind { sum += $2 } END { print sum + 0 }' "$out/$module.ice40.txt"; }

  # The pins of the chip are fewer than the bits of the ports: shift registers lead to them.
  python3 pins.py "$out/$module.ports.json" "$module" >"$out/${module}_pins.v"
  yosys -q -w "Replacing memory" -p "$read $out/${module}_pins.v; synth_ice40 -top ${module}_pins -json $out/$module.json"
  if nextpnr-ice40 --hx8k --package ct256 --json "$out/$module.json" --seed 1 --freq 40 --timing-allow-fail \
    --pcf-allow-unconstrained --log "$out/$module.nextpnr.log" --quiet 2>/dev/null; then
    frequency=$(sed -n "s/.*Max frequency for clock.*: \([0-9.]*\) MHz.*/\1/p" "$out/$module.nextpnr.log" | tail -n 1)
  else
    frequency="does not fit"
  fi
  echo "| $module | ${luts:-0} | $(cells '^SB_LUT4$') | $(cells '^SB_CARRY$') | $(cells '^SB_DFF') | $(cells '^SB_RAM') | $frequency |" >"$out/$module.row"
  cat "$out/$module.row"
}

if [ "${2:-}" = --module ]; then  # called by itself
  synthesize "$3"
  exit
fi

# Without memories, and without the modules that only connect others.
modules=$(find . -name '*.sv' ! -path './memory/*' ! -name board_top.sv ! -name pipe.sv ! -name decompression.sv ! -name record_chain.sv ! -name column_chain.sv ! -name march_pipe.sv ! -name parallel_pipe.sv \
  -printf '%f\n' | sed 's/\.sv$//' | sort)
for module in $modules; do [ -f "$out/$module.row" ] || echo "$module"; done |
  xargs -P "${RAYSPACE_SYNTH_JOBS:-1}" -I{} "$rtl/$(basename "$0")" "$build" --module {}

{
  cat <<'HEAD'
# Synthesis of the RTL

Written by `engine/rtl/synth.sh`. Each module alone, with the constants of `prototype-2000`. "LUT4" is a generic mapping (`synth; abc -lut 4`), comparable to the logic cells of four inputs of the
board's FPGA, without memories; LUTs, carry cells, flip-flops and block RAMs are those of an iCE40 HX8K (`synth_ice40`; it has 7680 cells). The frequency is that of the routed module, with shift registers between its ports
and the pins. The board's clock is 40 MHz.

| module | LUT4 | iCE40 LUTs | carries | flip-flops | block RAMs | MHz on HX8K |
|---|---|---|---|---|---|---|
HEAD
  cat "$out"/*.row
  # Blocks hold the arithmetic that they use.
  for block in $prototype; do cat "$out/$block.row"; done |
    awk '{ for (n = 4; n <= 12; n += 2) sum[n] += $n }
      END { printf "| blocks of `prototype-2000` | %d | %d | %d | %d | %d | |\n", sum[4], sum[6], sum[8], sum[10], sum[12] }'
  printf '\n%s; %s.\n' "$(yosys -V)" "$(nextpnr-ice40 --version 2>&1 | sed 's/^nextpnr-ice40 -- //')"
} >"$out/RESULTS.md"
cp "$out/RESULTS.md" RESULTS.md
