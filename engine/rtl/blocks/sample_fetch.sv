// Sample fetch (engine/model/blocks/prototype/sample_reading.hpp): the reads of a pair of pixels, one per cycle, each
// with its tag. Slots:
//
//     0  alpha of both pixels, or of the first where their rows are in different words; then
//     1  alpha of the second
//     2  (U, V) of the first     3  Y of the first     4  (U, V) of the second     5  Y of the second
module sample_fetch (
    input  logic clk,
    input  logic rst,

    input  logic pairs_valid,
    output logic pairs_ready,
    input  logic [board::PAIRS_BITS-1:0] pairs_data,

    output logic sample_reads_valid,
    input  logic sample_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] sample_reads_data,

    output logic tags_valid,
    input  logic tags_ready,
    output logic [board::TAGS_BITS-1:0] tags_data
);
`include "messages.svh"

  pixel_pair_t pair;
  memory_read_t read;
  sample_tag_t tag;
  logic [2:0] slot, next_slot;
  logic moves;
  assign pair = pairs_data;
  assign sample_reads_valid = pairs_valid && tags_ready;
  assign tags_valid = pairs_valid && sample_reads_ready;
  assign moves = tags_valid && tags_ready;
  assign pairs_ready = moves && slot == 3'd5;

  logic is_apart, is_alpha, is_luma, is_second, is_visible;
  logic [8:0] row;
  logic [26:0] base;
  logic [4:0] lane;
  assign is_apart = pair.is_visible_0 && pair.is_visible_1 && pair.row_0[8:5] != pair.row_1[8:5];
  assign is_alpha = slot[2:1] == 2'd0;
  assign is_luma = slot[0];
  assign is_second = is_alpha ? slot[0] || !pair.is_visible_0 : slot[2];  // the pixel whose word is read
  assign row = is_second ? pair.row_1 : pair.row_0;
  assign is_visible = is_second ? pair.is_visible_1 : pair.is_visible_0;

  // A word has alpha of 32 rows, Y of 8 rows, or (U, V) of 8 rows.
  assign base = is_alpha ? pair.alpha : is_luma ? pair.luma : pair.chroma;
  assign read.address = base + (is_alpha ? {23'b0, row[8:5]} : {21'b0, row[8:3]});
  assign read.is_null = !is_visible;
  assign sample_reads_data = read;

  assign lane = is_luma ? {2'b0, row[2:0]} : {3'b0, row[2:1]};
  always_comb begin
    tag = '0;
    tag.view = pair.view;
    if (is_alpha) begin
      tag.kind = 2'(board::TAG_ALPHA);
      tag.lane_0 = {pair.is_visible_0 && slot == 3'd0, pair.row_0[4:0]};
      tag.lane_1 = {pair.is_visible_1 && (!is_apart || slot == 3'd1), pair.row_1[4:0]};
    end else begin
      tag.kind = is_luma ? 2'(board::TAG_LUMA) : 2'(board::TAG_CHROMA);
      tag.pixel = is_second;
      if (is_second) tag.lane_1 = {1'b0, lane};
      else tag.lane_0 = {1'b0, lane};
    end
  end
  assign tags_data = tag;

  assign next_slot = slot == 3'd5 ? 3'd0 : slot == 3'd0 && !is_apart ? 3'd2 : slot + 3'd1;
  always_ff @(posedge clk) begin
    if (rst) slot <= 3'd0;
    else if (moves) slot <= next_slot;
  end
endmodule
