// Tile reader of a hop (engine/model/blocks/decompression/record_reading.hpp): takes the tile's address from the word of
// the tile table, and requests the tile's first word. Blocks of the tile before and of empty tiles pass. A block per
// cycle.
module tile_reader (
    // Without registers: no clock.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic clk,
    input  logic rst,
    /* verilator lint_on UNUSEDSIGNAL */

    input  logic found_valid,
    output logic found_ready,
    input  logic [board::FOUND_BITS-1:0] found_data,

    input  logic table_words_valid,
    output logic table_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] table_words_data,

    output logic tile_reads_valid,
    input  logic tile_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] tile_reads_data,

    output logic tiles_valid,
    input  logic tiles_ready,
    output logic [board::TILES_BITS-1:0] tiles_data
);
`include "messages.svh"

  found_tile_t found;
  memory_read_t read;
  requested_tile_t tile;
  logic [31:0] entry;
  logic has_tile, can_read, moves_all;
  assign found = found_data;
  assign entry = found.is_high ? table_words_data[63:32] : table_words_data[31:0];
  assign has_tile = !found.is_same && entry != 32'hFFFFFFFF;
  // An entry is taken only while a read of its tile is possible.
  assign can_read = table_words_valid && tile_reads_ready;
  assign moves_all = tiles_ready && (found.is_same || can_read);

  assign found_ready = moves_all;
  assign table_words_ready = found_valid && tiles_ready && !found.is_same && tile_reads_ready;
  assign tile_reads_valid = found_valid && tiles_ready && has_tile && table_words_valid;
  assign tiles_valid = found_valid && (found.is_same || can_read);

  assign read.address = entry[26:0];
  assign read.is_null = 1'b0;
  assign tile_reads_data = read;
  assign tile.request = found.request;
  assign tile.kind = found.is_same ? 2'(board::TILE_SAME) : has_tile ? 2'(board::TILE_READ) : 2'(board::TILE_NOTHING);
  assign tile.address = has_tile ? entry[26:0] : 27'd0;
  assign tiles_data = tile;
endmodule
