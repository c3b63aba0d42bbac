// Ray rise (engine/model/blocks/parallel/pixel_rays.hpp): the band at which a pixel's ray passes its foot, and its slope
// through the bands. A pixel per cycle, once its column is there. All stages stall while the last one holds a pixel that
// the output does not take; columns are stored nevertheless.
//
//     1       column                     14 .. 19  drift
//     2 .. 7  height, slope              20 .. 25  bands per depth step
//     8 .. 13 reference ray, foot
//
// A product takes five of the six stages, and the sum behind it one.
module ray_rise (
    input  logic clk,
    input  logic rst,

    input  logic rise_columns_valid,
    output logic rise_columns_ready,
    input  logic [board::RISE_COLUMNS_BITS-1:0] rise_columns_data,
    input  logic scanned_valid,
    output logic scanned_ready,
    input  logic [board::SCANNED_BITS-1:0] scanned_data,

    output logic risen_valid,
    input  logic risen_ready,
    output logic [board::RISEN_BITS-1:0] risen_data,

    // Register file: `view` and its object.
    output logic [board::VIEW_BITS-1:0] view,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [28:0] view_b_q20,  // these three signed; their low bits are not used
    input  logic [28:0] object_shape_h_low_q20,
    input  logic [28:0] object_shape_reference_height_q20,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic [26:0] object_shape_bands_per_unit_q12,
    input  logic [18:0] object_shape_depth_step_q24
);
`include "messages.svh"

  localparam int STAGES = board::RAY_RISE_STAGES;

  /* verilator lint_off UNUSEDSIGNAL */
  rise_column_t in_column, column;
  scanned_pixel_t in, pixel_1;
  /* verilator lint_on UNUSEDSIGNAL */
  logic moves, takes;
  logic [STAGES:1] valid;
  assign in_column = rise_columns_data;
  assign in = scanned_data;
  assign view = in.view;
  assign moves = !risen_valid || risen_ready;
  assign risen_valid = valid[STAGES];

  //---- Columns of two stripes -------------------------------------------------------------------------------------------
  logic [31:0] is_stored, is_odd;  // [slot of the stripe, column]; is_odd: the higher bit of the stripe's number
  logic [4:0] stored_place, place;
  assign stored_place = {in_column.stripe[0], in_column.column};
  assign place = {in.stripe[0], in.id[3:0]};
  assign rise_columns_ready = 1'b1;
  assign scanned_ready = moves && !rise_columns_valid && is_stored[place] && is_odd[place] == in.stripe[1];
  assign takes = scanned_valid && scanned_ready;
  always_ff @(posedge clk) begin
    if (rst) begin
      valid <= '0;
      is_stored <= '0;
    end else begin
      if (moves) valid <= {valid[STAGES-1:1], takes};
      if (rise_columns_valid) begin
        // The first column of a stripe removes the columns of the one before it in this slot.
        if (in_column.column == 4'd0) is_stored[16*in_column.stripe[0]+:16] <= 16'd0;
        is_stored[stored_place] <= 1'b1;
      end
    end
    if (rise_columns_valid) is_odd[stored_place] <= in_column.stripe[1];
  end
  dual_port_ram #(
      .WIDTH(board::RISE_COLUMNS_BITS),
      .ADDRESS_BITS(5)
  ) columns (
      .clk(clk), .write(rise_columns_valid), .write_address(stored_place), .write_data(rise_columns_data), .read(takes),
      .read_address(place), .read_data(column)
  );

  //---- Values that accompany a pixel --------------------------------------------------------------------------------------
  localparam int FOOT = 13;   // the stages behind which they are there
  localparam int DRIFT = 19;
  logic [board::SCANNED_BITS-1:0] pixels[1:STAGES];
  logic [26:0] bands_per_unit[1:FOOT];
  logic [18:0] depth_steps[1:DRIFT];
  logic [STAGES:2] has_bands;  // the ray crosses bands
  logic [25:0] above_reference[1:6], above_low[1:6];  // of the viewpoint, q16; signed
  logic [29:0] slope_7, slope_8, slope_9, slope_10, slope_11, slope_12;
  logic [29:0] feet[FOOT:STAGES];
  function automatic logic [25:0] difference(input logic [24:0] a, input logic [24:0] b);
    difference = {a[24], a} - {b[24], b};
  endfunction
  always_ff @(posedge clk) begin
    if (moves) begin
      pixels[1] <= scanned_data;
      bands_per_unit[1] <= object_shape_bands_per_unit_q12;
      depth_steps[1] <= object_shape_depth_step_q24;
      above_reference[1] <= difference(view_b_q20[28:4], object_shape_reference_height_q20[28:4]);
      above_low[1] <= difference(view_b_q20[28:4], object_shape_h_low_q20[28:4]);
      has_bands <= {has_bands[STAGES-1:2], column.kind == 2'(board::RAY_SHAPE)};
      for (int n = 2; n <= STAGES; n = n + 1) pixels[n] <= pixels[n-1];
      for (int n = 2; n <= FOOT; n = n + 1) bands_per_unit[n] <= bands_per_unit[n-1];
      for (int n = 2; n <= DRIFT; n = n + 1) depth_steps[n] <= depth_steps[n-1];
      for (int n = 2; n <= 6; n = n + 1) begin
        above_reference[n] <= above_reference[n-1];
        above_low[n] <= above_low[n-1];
      end
    end
  end

  //---- Products -----------------------------------------------------------------------------------------------------
  assign pixel_1 = pixels[1];
  logic [29:0] risen_6, slope_6, reference_12, foot_12, drift_18, per_depth_24;
  logic [30:0] over_reference_7, over_low_7, slope_difference_13;  // heights q16; q20
  logic [29:0] drift_19;
  logic [23:0] per_depth_25;
  multiply_shift #(
      .A_BITS(30),
      .B_BITS(28),
      .SHIFT(28)
  ) height_product (
      .clk(clk), .enable(moves), .a(column.lambda_foot_q20), .b(pixel_1.rise_q24), .result(risen_6)
  );
  multiply_shift #(
      .A_BITS(28),
      .B_BITS(26),
      .SHIFT(24)
  ) slope_product (
      .clk(clk), .enable(moves), .a(pixel_1.rise_q24), .b({1'b0, column.inverse_r_q20}), .result(slope_6)
  );
  // The column that the next step uses.
  logic [21:0] inverse_rho[2:7];
  multiply_shift #(
      .A_BITS(31),
      .B_BITS(23),
      .SHIFT(16)
  ) reference_product (
      .clk(clk), .enable(moves), .a(over_reference_7), .b({1'b0, inverse_rho[7]}), .result(reference_12)
  );
  multiply_shift #(
      .A_BITS(31),
      .B_BITS(28),
      .SHIFT(16)
  ) foot_product (
      .clk(clk), .enable(moves), .a(over_low_7), .b({1'b0, bands_per_unit[7]}), .result(foot_12)
  );
  multiply_shift #(
      .A_BITS(31),
      .B_BITS(28),
      .SHIFT(12)
  ) drift_product (
      .clk(clk), .enable(moves), .a(slope_difference_13), .b({1'b0, bands_per_unit[FOOT]}), .result(drift_18)
  );
  multiply_shift #(
      .A_BITS(30),
      .B_BITS(20),
      .SHIFT(24)
  ) depth_product (
      .clk(clk), .enable(moves), .a(drift_19), .b({1'b0, depth_steps[DRIFT]}), .result(per_depth_24)
  );

  //---- Sums behind the products ---------------------------------------------------------------------------------------
  function automatic logic [30:0] height(input logic [29:0] product, input logic [25:0] above);
    height = {product[29], product} + {{5{above[25]}}, above};
  endfunction
  function automatic logic [23:0] clamped(input logic [29:0] slope);  // to -2^22 .. 2^22
    clamped = slope[29:22] == {8{slope[29]}} ? slope[23:0] : {slope[29], 1'b1, 22'd0};
  endfunction
  always_ff @(posedge clk) begin
    if (moves) begin
      inverse_rho[2] <= column.inverse_rho_q20;
      for (int n = 3; n <= 7; n = n + 1) inverse_rho[n] <= inverse_rho[n-1];
      over_reference_7 <= height(risen_6, above_reference[6]);
      over_low_7 <= height(risen_6, above_low[6]);
      slope_7 <= slope_6;
      slope_8 <= slope_7;
      slope_9 <= slope_8;
      slope_10 <= slope_9;
      slope_11 <= slope_10;
      slope_12 <= slope_11;
      slope_difference_13 <= {slope_12[29], slope_12} - {reference_12[29], reference_12};
      feet[FOOT] <= foot_12;
      for (int n = FOOT + 1; n <= STAGES; n = n + 1) feet[n] <= feet[n-1];
      drift_19 <= drift_18;
      per_depth_25 <= clamped(per_depth_24);
    end
  end

  band_ray_t out;
  assign out.pixel = pixels[STAGES];
  assign out.foot_q12 = has_bands[STAGES] ? feet[STAGES] : 30'd0;
  assign out.per_d_q20 = has_bands[STAGES] ? per_depth_25 : 24'd0;
  assign risen_data = out;
endmodule
