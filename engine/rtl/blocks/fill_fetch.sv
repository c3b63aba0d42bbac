// Fill fetch (engine/model/blocks/texels/texel_fills.hpp): fetches a block of 8x8 texels. A coded block: a request of
// hop 0 for each column and 64 pixels, one of each per cycle, as far as the FIFOs have space. A raw one: a read per
// cycle. The first ones leave in the cycle in which the block is taken.
module fill_fetch (
    input  logic clk,
    input  logic rst,

    input  logic fills_valid,
    output logic fills_ready,
    input  logic [board::FILLS_BITS-1:0] fills_data,

    output logic asks_valid,
    input  logic asks_ready,
    output logic [board::ASKS_BITS-1:0] asks_data,
    output logic coded_pixels_valid,
    input  logic coded_pixels_ready,
    output logic [board::CODED_PIXELS_BITS-1:0] coded_pixels_data,
    output logic raw_reads_valid,
    input  logic raw_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] raw_reads_data,
    output logic kinds_valid,
    input  logic kinds_ready,
    output logic [board::KINDS_BITS-1:0] kinds_data,
    output logic targets_valid,
    input  logic targets_ready,
    output logic [board::TARGETS_BITS-1:0] targets_data,

    // Register file: the object of `view`. Blocks of a raw image, column by column.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic object_coded,
    input  logic [31:0] object_serial,  // of its load, from 1
    input  logic [6:0] object_block_columns,
    input  logic [6:0] object_block_rows,
    input  logic [board::ADDRESS_BITS-1:0] object_raw_blocks
);
`include "messages.svh"

  localparam logic [4:0] RAW_WORDS = 5'(board::RAW_BLOCK_WORDS);

  /* verilator lint_off UNUSEDSIGNAL */
  texel_fill_t in, kept, fill;  // the target is not kept
  /* verilator lint_on UNUSEDSIGNAL */
  logic active, begins, works;
  assign in = fills_data;
  assign view = in.view;
  assign begins = !active && fills_valid && kinds_ready && targets_ready;
  assign works = active || begins;
  assign fills_ready = !active && kinds_ready && targets_ready;
  assign kinds_valid = !active && fills_valid && targets_ready;
  assign targets_valid = !active && fills_valid && kinds_ready;
  assign kinds_data = object_coded;
  assign targets_data = {in.line, in.guard};

  // State of the block; that of a new one in its first cycle.
  logic kept_coded, is_coded, kept_first, is_first;
  logic [31:0] serial;  // of the last block
  logic [4:0] kept_requested, requested, requested_next;
  logic [6:0] kept_sent, sent, sent_next;
  logic [26:0] kept_address, first_address, address;  // kept: of the first word
  // Address of a raw block, whose words are a multiple of 4: products as sums of shifted terms, so that one adder of all
  // terms follows the image's column.
  logic [9:0] pitch;  // of a column of blocks, in 4 words
  logic [8:0] above;  // blocks above this one, in 4 words
  logic [12:0] column;
  logic [24:0] first_quad;
  assign pitch = {3'b0, object_block_rows} * 10'(board::RAW_BLOCK_WORDS / 4);
  assign above = {3'b0, in.block_row} * 9'(board::RAW_BLOCK_WORDS / 4);
  assign column = {6'b0, in.image} * {6'b0, object_block_columns} + {7'b0, in.block_column};
  always_comb begin
    first_quad = object_raw_blocks[26:2] + {16'b0, above};
    for (int n = 0; n < 10; n = n + 1) begin
      first_quad = first_quad + (pitch[n] ? {12'b0, column} << n : 25'd0);
    end
  end
  assign first_address = {first_quad, object_raw_blocks[1:0]};
  assign fill = active ? kept : in;
  assign is_coded = active ? kept_coded : object_coded;
  assign is_first = active ? kept_first : object_serial != serial;
  assign requested = active ? kept_requested : 5'd0;
  assign sent = active ? kept_sent : 7'd0;
  assign address = active ? kept_address + {22'b0, kept_requested} : first_address;

  assign asks_valid = works && is_coded && requested != 5'd8;
  assign coded_pixels_valid = works && is_coded && sent != 7'd64;
  assign raw_reads_valid = works && !is_coded;
  assign requested_next = requested + 5'((asks_valid && asks_ready) || (raw_reads_valid && raw_reads_ready));
  assign sent_next = sent + 7'(coded_pixels_valid && coded_pixels_ready);

  block_request_t request;
  coded_pixel_t pixel;
  memory_read_t read;
  assign request.view = fill.view;
  assign request.first = is_first;
  assign request.down = 1'b1;
  assign request.image = fill.image;
  assign request.column = {fill.block_column, requested[2:0]};
  assign request.block_row = fill.block_row;
  assign request.rows = 8'hFF;
  assign asks_data = request;
  assign pixel.view = fill.view;
  assign pixel.is_visible = 1'b1;
  assign pixel.begins = sent[2:0] == 3'd0;
  assign pixel.is_pending = 1'b1;
  assign pixel.row = {fill.block_row, sent[2:0]};
  assign pixel.column = sent[5:3];
  assign coded_pixels_data = pixel;
  assign read.address = address;
  assign read.is_null = 1'b0;
  assign raw_reads_data = read;

  always_ff @(posedge clk) begin
    if (rst) begin
      active <= 1'b0;
      serial <= 32'd0;
    end else begin
      active <= works && (is_coded ? requested_next != 5'd8 || sent_next != 7'd64 : requested_next != RAW_WORDS);
      if (begins) serial <= object_serial;
    end

    kept <= fill;
    kept_coded <= is_coded;
    kept_first <= is_first && !(asks_valid && asks_ready);
    kept_requested <= requested_next;
    kept_sent <= sent_next;
    if (!active) kept_address <= first_address;
  end
endmodule
