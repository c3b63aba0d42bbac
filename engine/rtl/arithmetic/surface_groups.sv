// The four cells around a ray, and the groups that they form ("between cells" of RECONSTRUCTION.md, section 6): stages 8
// and 9 of cell_march. The suffix of a port is the number of the stage that it comes from. Cells are numbered 2 * p + h.
//
//     8  nearest and farthest, weights
//     9  groups, products
module surface_groups (
    input  logic clk,
    input  logic enable,

    // Words of two bands each, of both places in p, and where band h = 0 is. A cell of 26 bits: whether both lines have a
    // surface, the deeper line's whole steps (8 bits, 0 without a surface), lean (5), whether it exists, depth (11, q3).
    input  logic [103:0] even_7,  // [p]
    input  logic [103:0] odd_7,
    input  logic is_odd_7,        // h = 0 is the odd band
    input  logic even_half_7,
    input  logic odd_half_7,
    input  logic [1:0] is_band_7,  // [h]
    input  logic [2:0] p_part_7,
    input  logic [2:0] h_part_7,
    input  logic [7:0] jump_8,

    output logic [7:0] deepest_8,
    output logic [7:0] deepest_9,
    output logic all_have_one_9,
    output logic has_first_9,
    output logic has_behind_9,
    output logic [3:0] is_first_9,   // [cell]: in the group of the surface
    output logic [3:0] is_behind_9,  // in the group behind it
    output logic [27:0] weights_9,   // [cell]
    output logic [67:0] depths_9,    // [cell]: weight * depth
    output logic [43:0] leans_9      // [cell]: weight * lean
);
  //---- Cells: nearest and farthest ------------------------------------------------------------------------------------
  logic [3:0] exists_7, all_7, exists_8;
  logic [43:0] depth_7, depth_8;  // [cell]
  logic [31:0] deep_7;
  logic [19:0] lean_7, lean_8;
  logic [27:0] weight_8;
  logic [7:0] p_weight, h_weight;  // [p], [h]
  assign p_weight = {1'b0, p_part_7, 4'd8 - {1'b0, p_part_7}};
  assign h_weight = {1'b0, h_part_7, 4'd8 - {1'b0, h_part_7}};
  genvar p, h;
  generate
    for (p = 0; p < 2; p = p + 1) begin : places
      logic [25:0] even, odd;
      assign even = even_half_7 ? even_7[52*p+26+:26] : even_7[52*p+:26];
      assign odd = odd_half_7 ? odd_7[52*p+26+:26] : odd_7[52*p+:26];
      for (h = 0; h < 2; h = h + 1) begin : bands
        logic has_all;
        logic [7:0] deepest;
        logic exists;
        assign {has_all, deepest, lean_7[5*(2*p+h)+:5], exists, depth_7[11*(2*p+h)+:11]} =
            is_odd_7 == 1'(h) ? even : odd;
        assign exists_7[2*p+h] = is_band_7[h] && exists;
        assign all_7[2*p+h] = is_band_7[h] && has_all;
        assign deep_7[8*(2*p+h)+:8] = is_band_7[h] ? deepest : 8'd0;
        always_ff @(posedge clk) begin
          if (enable) weight_8[7*(2*p+h)+:7] <= {3'd0, p_weight[4*p+:4]} * {3'd0, h_weight[4*h+:4]};
        end
      end
    end
  endgenerate

  // Depths of cells without a surface: 1 followed by the depth as the nearest, 0 as the farthest.
  function automatic logic [11:0] nearer(input logic [11:0] a, input logic [11:0] b);
    nearer = a < b ? a : b;
  endfunction
  function automatic logic [10:0] farther(input logic [10:0] a, input logic [10:0] b);
    farther = a < b ? b : a;
  endfunction
  function automatic logic [7:0] deeper(input logic [7:0] a, input logic [7:0] b);
    deeper = a < b ? b : a;
  endfunction
  logic [47:0] as_nearest;
  logic [43:0] as_farthest;
  logic [11:0] nearest_8;
  logic [10:0] farthest_8;
  logic all_have_one_8;
  genvar n;
  generate
    for (n = 0; n < 4; n = n + 1) begin : keys
      assign as_nearest[12*n+:12] = {!exists_7[n], depth_7[11*n+:11]};
      assign as_farthest[11*n+:11] = exists_7[n] ? depth_7[11*n+:11] : 11'd0;
    end
  endgenerate
  always_ff @(posedge clk) begin
    if (enable) begin
      exists_8 <= exists_7;
      depth_8 <= depth_7;
      lean_8 <= lean_7;
      nearest_8 <= nearer(nearer(as_nearest[11:0], as_nearest[23:12]), nearer(as_nearest[35:24], as_nearest[47:36]));
      farthest_8 <= farther(farther(as_farthest[10:0], as_farthest[21:11]),
                            farther(as_farthest[32:22], as_farthest[43:33]));
      deepest_8 <= deeper(deeper(deep_7[7:0], deep_7[15:8]), deeper(deep_7[23:16], deep_7[31:24]));
      all_have_one_8 <= &all_7;
    end
  end

  //---- Groups ---------------------------------------------------------------------------------------------------------
  logic has_step;  // two groups
  logic [11:0] spread, sum_of_ends;
  logic [3:0] is_farther;
  logic [27:0] nearer_weights, farther_weights;
  logic [6:0] nearer_weight, farther_weight;
  logic farther_is_first;
  assign spread = {1'b0, farthest_8} - nearest_8;
  assign has_step = spread > {1'b0, jump_8, 3'd0};
  assign sum_of_ends = nearest_8 + {1'b0, farthest_8};
  generate
    for (n = 0; n < 4; n = n + 1) begin : groups
      assign is_farther[n] = has_step && {depth_8[11*n+:11], 1'b0} > sum_of_ends;
      assign nearer_weights[7*n+:7] = exists_8[n] && !is_farther[n] ? weight_8[7*n+:7] : 7'd0;
      assign farther_weights[7*n+:7] = exists_8[n] && is_farther[n] ? weight_8[7*n+:7] : 7'd0;
      always_ff @(posedge clk) begin
        if (enable) begin
          depths_9[17*n+:17] <= {10'd0, weight_8[7*n+:7]} * {6'd0, depth_8[11*n+:11]};
          leans_9[11*n+:11] <= {4'd0, weight_8[7*n+:7]} * {6'd0, lean_8[5*n+:5]};
        end
      end
    end
  endgenerate
  function automatic logic [6:0] sum(input logic [27:0] parts);
    sum = (parts[6:0] + parts[13:7]) + (parts[20:14] + parts[27:21]);
  endfunction
  assign nearer_weight = sum(nearer_weights);
  assign farther_weight = sum(farther_weights);
  assign farther_is_first = nearer_weight < farther_weight;
  always_ff @(posedge clk) begin
    if (enable) begin
      deepest_9 <= deepest_8;
      all_have_one_9 <= all_have_one_8;
      weights_9 <= weight_8;
      is_first_9 <= exists_8 & (is_farther ^ {4{!farther_is_first}});
      is_behind_9 <= exists_8 & is_farther;
      has_first_9 <= nearer_weight != 7'd0 || farther_weight != 7'd0;
      has_behind_9 <= !farther_is_first && farther_weight != 7'd0;
    end
  end
endmodule
