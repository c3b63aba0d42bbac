// Tile finder of a hop (engine/model/blocks/decompression/record_reading.hpp): requests the word of the tile table with
// the entry of a block's tile, unless the tile is that of the block before. A block per cycle; two products of 7 x 5 and
// 11 x 5 bits.
module tile_finder (
    input  logic clk,
    input  logic rst,

    input  logic asks_valid,
    output logic asks_ready,
    input  logic [board::ASKS_BITS-1:0] asks_data,

    output logic table_reads_valid,
    input  logic table_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] table_reads_data,

    output logic found_valid,
    input  logic found_ready,
    output logic [board::FOUND_BITS-1:0] found_data,

    // Register file: the object of `view`.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [4:0] object_tile_columns,
    input  logic [4:0] object_table_pitch,
    input  logic [board::ADDRESS_BITS-1:0] object_tile_table
);
`include "messages.svh"

  block_request_t request;
  memory_read_t read;
  found_tile_t found;
  logic [11:0] column;
  logic [16:0] entry, last_entry;  // of the table; all ones: none
  logic is_same, moves;
  assign request = asks_data;
  assign view = request.view;
  assign column = {5'b0, request.image} * {7'b0, object_tile_columns} + {8'b0, request.column[8:5]};
  assign entry = {5'b0, column} * {12'b0, object_table_pitch} + {13'b0, request.block_row[5:2]};
  // The entry of an earlier view column may belong to an evicted object.
  assign is_same = !request.first && entry == last_entry;

  assign moves = asks_valid && found_ready && (is_same || table_reads_ready);
  assign asks_ready = found_ready && (is_same || table_reads_ready);
  assign table_reads_valid = asks_valid && found_ready && !is_same;
  assign found_valid = asks_valid && (is_same || table_reads_ready);

  always_ff @(posedge clk) begin
    if (rst) last_entry <= '1;
    else if (moves) last_entry <= entry;
  end

  assign read.address = object_tile_table + {11'b0, entry[16:1]};
  assign read.is_null = 1'b0;
  assign table_reads_data = read;
  assign found.request = request;
  assign found.is_same = is_same;
  assign found.is_high = entry[0];
  assign found_data = found;
endmodule
