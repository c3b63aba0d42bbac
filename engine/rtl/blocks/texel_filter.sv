// Texel filter (engine/model/blocks/texels/texel_cache.hpp): sums of a sample over its four texels, of weight * alpha and
// of this times R, G and B, in six stages. All stages stall while the last one holds a sample that the output does not
// take.
//
//     1  weights              3, 4  shares * R, G, B, in two halves of 4 bits
//     2  shares of alpha      5, 6  sums of two and of four texels
module texel_filter (
    input  logic clk,
    input  logic rst,

    input  logic quads_valid,
    output logic quads_ready,
    input  logic [board::QUADS_BITS-1:0] quads_data,

    output logic filtered_valid,
    input  logic filtered_ready,
    output logic [board::FILTERED_BITS-1:0] filtered_data
);
`include "messages.svh"

  localparam int STAGES = board::TEXEL_FILTER_STAGES;
  texel_quad_t in;
  logic moves;
  logic [STAGES:1] valid;
  assign in = quads_data;
  assign filtered_valid = valid[STAGES];
  assign moves = !filtered_valid || filtered_ready;
  assign quads_ready = moves;
  always_ff @(posedge clk) begin
    if (rst) valid <= '0;
    else if (moves) valid <= {valid[STAGES-1:1], quads_valid};
  end

  // Head and `is_inside` of the samples in stages 1 to 6.
  logic [31:0] rest_1, rest_2, rest_3, rest_4, rest_5, rest_6;
  logic [3:0] left, right, upper, lower;  // of 8
  logic [27:0] weights_1;                 // [texel] of 7 bits
  logic [127:0] rgba_1;
  assign right = {1'b0, in.fx};
  assign left = 4'd8 - right;
  assign lower = {1'b0, in.fy};
  assign upper = 4'd8 - lower;
  function automatic logic [6:0] weight(input logic [3:0] x, input logic [3:0] y);
    weight = {3'b0, x} * {3'b0, y};
  endfunction
  always_ff @(posedge clk) begin
    if (moves) begin
      rest_1 <= {in.head, in.is_inside};
      rest_2 <= rest_1;
      rest_3 <= rest_2;
      rest_4 <= rest_3;
      rest_5 <= rest_4;
      rest_6 <= rest_5;
      weights_1 <= {weight(right, lower), weight(right, upper), weight(left, lower), weight(left, upper)};
      rgba_1 <= in.rgba;
    end
  end

  // Shares and products of each texel.
  logic [55:0] shares_4;     // [texel] of 14 bits
  logic [263:0] products_4;  // [texel][channel] of 22 bits
  genvar texel, channel;
  generate
    for (texel = 0; texel < 4; texel = texel + 1) begin : texels
      logic [13:0] share_2, share_3;
      logic [23:0] rgb_2;
      always_ff @(posedge clk) begin
        if (moves) begin
          share_2 <= rest_1[0] ? {7'b0, weights_1[7*texel+:7]} * {6'b0, rgba_1[32*texel+24+:8]} : 14'd0;
          rgb_2 <= rgba_1[32*texel+:24];
          share_3 <= share_2;
          shares_4[14*texel+:14] <= share_3;
        end
      end
      for (channel = 0; channel < 3; channel = channel + 1) begin : channels
        logic [17:0] low_3, high_3;
        always_ff @(posedge clk) begin
          if (moves) begin
            low_3 <= {4'b0, share_2} * {14'b0, rgb_2[8*channel+:4]};
            high_3 <= {4'b0, share_2} * {14'b0, rgb_2[8*channel+4+:4]};
            products_4[66*texel+22*channel+:22] <= {4'b0, low_3} + {high_3, 4'b0};
          end
        end
      end
    end
  endgenerate

  logic [27:0] alpha_pairs_5;  // [pair]
  logic [131:0] pairs_5;       // [pair][channel]
  logic [13:0] alpha_6;
  logic [65:0] sums_6;
  always_ff @(posedge clk) begin
    if (moves) begin
      for (int pair = 0; pair < 2; pair = pair + 1) begin
        alpha_pairs_5[14*pair+:14] <= shares_4[28*pair+:14] + shares_4[28*pair+14+:14];
        for (int c = 0; c < 3; c = c + 1) begin
          pairs_5[66*pair+22*c+:22] <= products_4[132*pair+22*c+:22] + products_4[132*pair+66+22*c+:22];
        end
      end
      alpha_6 <= alpha_pairs_5[13:0] + alpha_pairs_5[27:14];
      for (int c = 0; c < 3; c = c + 1) sums_6[22*c+:22] <= pairs_5[22*c+:22] + pairs_5[66+22*c+:22];
    end
  end

  filtered_sample_t out;
  assign out.head = rest_6[31:1];
  assign out.is_inside = rest_6[0];
  assign out.a = alpha_6;
  assign out.r = sums_6[21:0];
  assign out.g = sums_6[43:22];
  assign out.b = sums_6[65:44];
  assign filtered_data = out;
endmodule
