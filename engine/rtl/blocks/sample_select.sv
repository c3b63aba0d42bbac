// Sample select (engine/model/blocks/prototype/sample_reading.hpp): takes a word per cycle, in the order of its tags,
// and selects alpha, (U, V) and Y from it. A pixel leaves in the cycle of its Y.
module sample_select (
    input  logic clk,
    input  logic rst,

    input  logic tags_valid,
    output logic tags_ready,
    input  logic [board::TAGS_BITS-1:0] tags_data,

    input  logic sample_words_valid,
    output logic sample_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] sample_words_data,

    output logic samples_valid,
    input  logic samples_ready,
    output logic [board::SAMPLES_BITS-1:0] samples_data
);
`include "messages.svh"

  sample_tag_t tag;
  yuv_pixel_t sample;
  logic is_alpha, is_luma, may_move, moves;
  assign tag = tags_data;
  assign is_alpha = tag.kind == 2'(board::TAG_ALPHA);
  assign is_luma = tag.kind == 2'(board::TAG_LUMA);
  assign may_move = !is_luma || samples_ready;
  assign tags_ready = sample_words_valid && may_move;
  assign sample_words_ready = tags_valid && may_move;
  assign moves = tags_valid && sample_words_valid && may_move;
  assign samples_valid = tags_valid && sample_words_valid && is_luma;

  logic [63:0] word;
  logic [2:0] lane;
  logic [1:0] alpha_0, alpha_1;
  logic [15:0] chroma_pair;
  logic [7:0] luma;
  assign word = sample_words_data;
  assign lane = tag.pixel ? tag.lane_1[2:0] : tag.lane_0[2:0];
  assign alpha_0 = word[{tag.lane_0[4:0], 1'b0}+:2];
  assign alpha_1 = word[{tag.lane_1[4:0], 1'b0}+:2];
  assign chroma_pair = word[{lane[1:0], 4'b0}+:16];
  assign luma = word[{lane, 3'b0}+:8];

  // 0 unless a word has given the pixel's alpha since its last Y: it is transparent.
  logic [1:0] level_0, level_1;
  logic [7:0] u, v;
  always_ff @(posedge clk) begin
    if (rst) begin
      level_0 <= 2'd0;
      level_1 <= 2'd0;
    end else if (moves) begin
      if (is_alpha && tag.lane_0[5]) level_0 <= alpha_0;
      if (is_alpha && tag.lane_1[5]) level_1 <= alpha_1;
      if (is_luma && !tag.pixel) level_0 <= 2'd0;
      if (is_luma && tag.pixel) level_1 <= 2'd0;
    end
    if (moves && !is_alpha && !is_luma) {v, u} <= chroma_pair;
  end

  assign sample.view = tag.view;
  assign sample.y = luma;
  assign sample.u = u;
  assign sample.v = v;
  assign samples_data = {sample, tag.pixel ? level_1 : level_0};
endmodule
