// Texel merge (engine/model/blocks/texels/texel_fills.hpp): the samples of a block, decompressed or raw from memory, in
// the order of the requests. One cycle to begin a block, then a texel per cycle; the words of a raw column come before
// its texels: (U, V) of a pair of columns, Y and alpha of one.
module texel_merge (
    input  logic clk,
    input  logic rst,

    input  logic kinds_valid,
    output logic kinds_ready,
    input  logic [board::KINDS_BITS-1:0] kinds_data,

    input  logic samples_valid,
    output logic samples_ready,
    input  logic [board::YUV_BITS+8-1:0] samples_data,
    input  logic raw_words_valid,
    output logic raw_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] raw_words_data,

    output logic merged_valid,
    input  logic merged_ready,
    output logic [board::YUV_BITS+8-1:0] merged_data
);
`include "messages.svh"

  logic [6:0] left, left_next;  // texels of the block
  logic is_coded;
  logic [1:0] words;  // received of the column, including those of its pair
  logic [63:0] chroma, luma, alpha;
  logic active, is_raw_texel, sends;
  assign active = left != 7'd0;
  assign is_raw_texel = active && !is_coded && words == 2'd3;
  assign kinds_ready = !active;
  assign samples_ready = active && is_coded && merged_ready;
  assign raw_words_ready = active && !is_coded && words != 2'd3;
  assign merged_valid = is_raw_texel || (active && is_coded && samples_valid);
  assign sends = merged_valid && merged_ready;
  assign left_next = left - 7'd1;

  always_ff @(posedge clk) begin
    if (rst) left <= 7'd0;
    else if (!active) left <= kinds_valid ? 7'd64 : 7'd0;
    else if (sends) left <= left_next;

    if (!active) begin
      is_coded <= kinds_data[0];
      words <= 2'd0;
    end else if (raw_words_ready && raw_words_valid) begin
      words <= words + 2'd1;
    end else if (sends && left_next[2:0] == 3'd0) begin
      words <= {1'b0, left_next[3]};  // behind an even column its chroma is used once more
    end
    if (raw_words_ready) begin
      if (words == 2'd0) chroma <= raw_words_data;
      if (words == 2'd1) luma <= raw_words_data;
      if (words == 2'd2) alpha <= raw_words_data;
    end
  end

  logic [2:0] row;
  yuv_pixel_t texel;
  assign row = 3'd0 - left[2:0];
  assign texel.view = 4'd0;
  assign texel.y = luma[{row, 3'b0}+:8];
  assign texel.u = chroma[{row[2:1], 4'b0}+:8];
  assign texel.v = chroma[{row[2:1], 4'b1000}+:8];
  assign merged_data = is_coded ? samples_data : {texel, alpha[{row, 3'b0}+:8]};
endmodule
