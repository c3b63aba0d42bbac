// Mean depth and lean of a group of cells, rounded to the nearest: stages 10 and 11 of cell_march, and the sum behind
// them. Division by the weight is a product with a reciprocal, which is exact for all sums (divide_by_weight() of
// engine/model/signals/arithmetic.hpp).
module surface_mean (
    input  logic clk,
    input  logic enable,

    input  logic [3:0] is_in_group_9,  // [cell], as surface_groups has them
    input  logic [27:0] weights_9,
    input  logic [67:0] depths_9,
    input  logic [43:0] leans_9,

    output logic [10:0] depth_q3_11,
    output logic [4:0] lean_11
);
  localparam int SHIFT = 23;

  logic [27:0] weights;
  logic [67:0] depths;
  logic [43:0] leans;
  logic [6:0] weight;
  genvar n;
  generate
    for (n = 0; n < 4; n = n + 1) begin : cells
      assign weights[7*n+:7] = is_in_group_9[n] ? weights_9[7*n+:7] : 7'd0;
      assign depths[17*n+:17] = is_in_group_9[n] ? depths_9[17*n+:17] : 17'd0;
      assign leans[11*n+:11] = is_in_group_9[n] ? leans_9[11*n+:11] : 11'd0;
    end
  endgenerate
  assign weight = (weights[6:0] + weights[13:7]) + (weights[20:14] + weights[27:21]);

  logic [65*24-1:0] reciprocals;  // [weight], rounded up
  assign reciprocals[23:0] = 24'd0;
  generate
    for (n = 1; n <= 64; n = n + 1) begin : table_of_reciprocals
      assign reciprocals[24*n+:24] = 24'(((1 << SHIFT) + n - 1) / n);
    end
  endgenerate

  logic [16:0] depth_10;
  logic [10:0] lean_10;
  logic [23:0] reciprocal_10;
  logic [28:0] low_depth_11, high_depth_11;
  logic [22:0] low_lean_11, high_lean_11;
  always_ff @(posedge clk) begin
    if (enable) begin
      depth_10 <= (depths[16:0] + depths[33:17]) + (depths[50:34] + depths[67:51]) + {11'd0, weight[6:1]};
      lean_10 <= (leans[10:0] + leans[21:11]) + (leans[32:22] + leans[43:33]) + {5'd0, weight[6:1]};
      reciprocal_10 <= reciprocals[24*weight+:24];
      low_depth_11 <= {12'd0, depth_10} * {17'd0, reciprocal_10[11:0]};
      high_depth_11 <= {12'd0, depth_10} * {17'd0, reciprocal_10[23:12]};
      low_lean_11 <= {12'd0, lean_10} * {11'd0, reciprocal_10[11:0]};
      high_lean_11 <= {12'd0, lean_10} * {11'd0, reciprocal_10[23:12]};
    end
  end

  // Bits 22 and below, and those that a mean does not reach, are cut off.
  /* verilator lint_off UNUSEDSIGNAL */
  logic [40:0] depth;
  logic [34:0] lean;
  /* verilator lint_on UNUSEDSIGNAL */
  assign depth = {12'd0, low_depth_11} + {high_depth_11, 12'd0};
  assign lean = {12'd0, low_lean_11} + {high_lean_11, 12'd0};
  assign depth_q3_11 = depth[SHIFT+:11];
  assign lean_11 = lean[SHIFT+:5];
endmodule
