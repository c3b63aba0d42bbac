// Column set-up (engine/model/blocks/parallel/column_setup.hpp): all values shared by the pixels of a column, with a
// pipelined multiplier (P), a pipelined divider (D) and a unit for square roots (R). Of an object with a shape map, section
// 5 of RECONSTRUCTION.md:
//
//     cycle 1        take the ray
//           2, 3     P: n * n, T * T                       4, 9     D: weight, line (P 4: f * 256 S)
//           9..41    R: r                                  42..46   D: cosine, sine, 1 / r, low / r, step / r
//           77       P: p = x * cosine                     78, 79   P: c * cosine, a * sine
//           83, 80   P: p * p, D_ref * D_ref               85       D: lambda_foot
//           84..86   P: xf, zf, place along p              90..122  R: rho
//           96..110  P: 12 products of the first image     123      D: 1 / rho
//           112..126 P: likewise of the second             159      output;  124 of a ray that is too far away
//
// Without a shape map the walk of vertical_compensation, with the latencies of that block:
//
//     cycle 2..5     P: x * l1, x * q1, lambda * S, lambda * sy
//           8, 9     D: m = fl_y / l, column               42, 43   P: m * (Y - height), m * rise
//           65       output;  12 of a ray that is too near, 57 of one outside of the image
module column_setup (
    input  logic clk,
    input  logic rst,

    input  logic lined_valid,
    output logic lined_ready,
    input  logic [board::LINED_BITS-1:0] lined_data,

    output logic set_up_valid,
    input  logic set_up_ready,
    output logic [board::SET_UP_BITS-1:0] set_up_data,

    // Register file: `view`, its plane, and its object with the shape map.
    output logic [board::VIEW_BITS-1:0] view,
    output logic [board::PLANE_BITS-1:0] plane,
    input  logic [28:0] view_b_q20,   // signed, as all numbers with a fraction
    input  logic [31:0] view_s0_q28,
    input  logic [33:0] view_sy_q32,
    input  logic [28:0] plane_a_q20,
    input  logic [28:0] plane_c_q20,
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_width,
    input  logic [12:0] shape_p_cells,
    input  logic [26:0] shape_lines,
    input  logic [31:0] shape_p_half_q20,
    input  logic [31:0] shape_p_cells_per_unit_q12,
    input  logic [31:0] shape_reference_distance_q20,
    input  logic [31:0] shape_depth_low_q20,
    input  logic [31:0] shape_depth_step_q24
);
`include "messages.svh"

  localparam logic [7:0] TAKE = 8'd1;
  localparam logic [7:0] PRODUCT = 8'(board::PRODUCT_CYCLES);
  localparam logic [7:0] QUOTIENT = 8'(board::DIVIDE_CYCLES);
  localparam logic [7:0] ROOT = 8'(board::ROOT_CYCLES);
  // Cycles in which operands enter: without a shape map, then with one.
  localparam logic [7:0] P_L = 8'd2;
  localparam logic [7:0] P_Q = 8'd3;
  localparam logic [7:0] P_Y = 8'd4;
  localparam logic [7:0] P_RISE = 8'd5;
  localparam logic [7:0] D_M = P_L + PRODUCT + 8'd1;
  localparam logic [7:0] D_COLUMN = P_Q + PRODUCT + 8'd1;
  localparam logic [7:0] P_ROW = D_M + QUOTIENT;
  localparam logic [7:0] P_ROW_STEP = P_ROW + 8'd1;
  localparam logic [7:0] P_NN = 8'd2;
  localparam logic [7:0] P_TT = 8'd3;
  localparam logic [7:0] P_LINE = 8'd4;
  localparam logic [7:0] D_WEIGHT = 8'd4;
  localparam logic [7:0] D_LINE = P_LINE + PRODUCT;
  localparam logic [7:0] R_R = P_TT + PRODUCT + 8'd1;
  localparam logic [7:0] D_COSINE = R_R + ROOT;
  localparam logic [7:0] D_SINE = D_COSINE + 8'd1;
  localparam logic [7:0] D_INVERSE_R = D_COSINE + 8'd2;
  localparam logic [7:0] D_LOW = D_COSINE + 8'd3;
  localparam logic [7:0] D_STEP = D_COSINE + 8'd4;
  localparam logic [7:0] P_P = D_COSINE + QUOTIENT + 8'd1;
  localparam logic [7:0] P_C_COSINE = P_P + 8'd1;
  localparam logic [7:0] P_A_SINE = P_P + 8'd2;
  localparam logic [7:0] P_DD = P_P + 8'd3;
  localparam logic [7:0] D_FOOT = P_A_SINE + PRODUCT + 8'd1;
  localparam logic [7:0] P_PP = P_P + PRODUCT + 8'd1;
  localparam logic [7:0] P_XF = P_PP + 8'd1;
  localparam logic [7:0] P_ZF = P_PP + 8'd2;
  localparam logic [7:0] P_PLACE = P_PP + 8'd3;
  localparam logic [7:0] R_RHO = P_PP + PRODUCT + 8'd2;
  localparam logic [7:0] D_INVERSE_RHO = R_RHO + ROOT;
  localparam logic [2:0] IMAGES = 3'd3;  // cycle / 32 in which the products of both images enter, 16 cycles each
  localparam logic [7:0] NO_RAY_OUTPUT = 8'(board::NO_RAY_LATENCY);
  localparam logic [7:0] NEAR_OUTPUT = 8'(board::COMPENSATION_TOO_NEAR_LATENCY);
  localparam logic [7:0] OUTSIDE_OUTPUT = 8'(board::COMPENSATION_OUTSIDE_LATENCY);
  localparam logic [7:0] PLANE_OUTPUT = 8'(board::COMPENSATION_LATENCY);
  localparam logic [7:0] TOO_FAR_OUTPUT = 8'(board::COLUMN_SETUP_TOO_FAR_LATENCY);
  localparam logic [7:0] OUTPUT = 8'(board::COLUMN_SETUP_LATENCY);

  localparam logic signed [32:0] NEAREST_Q20 = 33'sd1 <<< 17;
  localparam logic signed [34:0] LARGEST_RISE_Q24 = 35'sd1 <<< 28;
  localparam logic signed [32:0] FARTHEST_Q20 = 33'sd1 <<< 29;
  localparam logic signed [23:0] MOST_PER_STEP_Q12 = 24'sd1 <<< 20;

  //---- Take the ray -------------------------------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  bracketed_ray_t ray;
  image_line_t line, line_left;
  /* verilator lint_on UNUSEDSIGNAL */
  image_line_t line_0, line_1;
  logic [7:0] cycle;
  logic is_none, is_plane, is_shape, is_near, is_outside, is_too_far, is_last;
  assign lined_ready = cycle == TAKE;
  assign view = ray.view;
  assign plane = ray.plane;
  assign is_none = ray.kind == 2'(board::RAY_NONE);
  assign is_plane = ray.kind == 2'(board::RAY_PLANE);
  assign is_shape = ray.kind == 2'(board::RAY_SHAPE);
  always_comb begin
    case (cycle)
      NO_RAY_OUTPUT: is_last = is_none;
      NEAR_OUTPUT: is_last = is_plane && is_near;
      OUTSIDE_OUTPUT: is_last = is_plane && is_outside;
      PLANE_OUTPUT: is_last = is_plane;
      TOO_FAR_OUTPUT: is_last = is_too_far;
      default: is_last = cycle == OUTPUT;
    endcase
  end
  assign set_up_valid = is_last;

  always_ff @(posedge clk) begin
    if (rst) cycle <= TAKE;
    else if (cycle == TAKE) cycle <= lined_valid ? TAKE + 8'd1 : TAKE;
    else if (!is_last) cycle <= cycle + 8'd1;
    else if (set_up_ready) cycle <= TAKE;
    if (lined_ready) {ray, line_0, line_1} <= lined_data;
  end

  //---- Square roots -------------------------------------------------------------------------------------------------
  logic [63:0] radicand;
  logic [31:0] root;
  serial_root square_root (
      .clk(clk),
      .start(cycle == R_R || cycle == R_RHO),
      .square(radicand),
      .root(root)
  );

  //---- Quotients ----------------------------------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  logic [69:0] product;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [63:0] dividend;
  logic [31:0] divisor;
  logic [32:0] quotient;
  logic overflow;
  logic [31:0] low_q20, step_q24;  // 0 without a shape
  logic [29:0] to_q20;             // signed
  logic [31:0] l_q20;              // of the plane; at least 2^17, or not used
  logic [35:0] lateral_q16;        // signed
  assign low_q20 = is_shape ? shape_depth_low_q20 : 32'd0;
  assign step_q24 = is_shape ? shape_depth_step_q24 : 32'd0;
  always_comb begin
    divisor = root;
    case (cycle)
      D_WEIGHT: {dividend, divisor} = {{24'd0, ray.from_first_q20, 9'd0} + {33'd0, ray.width_q20}, ray.width_q20, 1'b0};
      D_M: {dividend, divisor} = {{12{line_0.fl_y_q16[31]}}, line_0.fl_y_q16, 20'd0, l_q20};
      D_LINE: begin  // or the column
        dividend = is_plane ? {{8{lateral_q16[35]}}, lateral_q16, 20'd0} : product[63:0];
        divisor = is_plane ? l_q20 : {1'b0, ray.width_q20};
      end
      D_COSINE: dividend = {3'd0, ray.n_q28, 30'd0};
      D_SINE: dividend = {{2{ray.t_q28[31]}}, ray.t_q28, 30'd0};
      D_INVERSE_R: dividend = 64'd1 << 48;
      D_LOW: dividend = {{4{low_q20[31]}}, low_q20, 28'd0};
      D_STEP: dividend = {7'd0, step_q24, 25'd0};
      D_FOOT: dividend = {{6{to_q20[29]}}, to_q20, 28'd0};
      default: dividend = 64'd1 << 40;
    endcase
  end
  pipelined_divider divide (
      .clk(clk),
      .dividend(dividend),
      .divisor(divisor),
      .quotient(quotient),
      .overflow(overflow)
  );

  logic [31:0] cosine_q30, sine_q30;  // signed
  logic [8:0] weight;
  logic [19:0] line_q8;
  logic [24:0] inverse_r_q20;
  logic [21:0] inverse_rho_q20;
  logic [30:0] low_by_r_q20;          // these three signed
  logic [28:0] lambda1_q21;
  logic [29:0] lambda_foot_q20;
  logic signed [32:0] quotient_now;
  assign quotient_now = quotient;
  always_ff @(posedge clk) begin
    case (cycle)
      D_WEIGHT + QUOTIENT: weight <= quotient[8:0];
      D_LINE + QUOTIENT: line_q8 <= quotient[19:0];
      D_COSINE + QUOTIENT: cosine_q30 <= quotient[31:0];
      D_SINE + QUOTIENT: sine_q30 <= quotient[31:0];
      D_INVERSE_R + QUOTIENT: inverse_r_q20 <= quotient[24:0];
      D_LOW + QUOTIENT: low_by_r_q20 <= quotient[30:0];
      D_STEP + QUOTIENT: lambda1_q21 <= quotient[28:0];
      D_FOOT + QUOTIENT: lambda_foot_q20 <= quotient[29:0];
      D_INVERSE_RHO + QUOTIENT: inverse_rho_q20 <= quotient[21:0];
      default: ;
    endcase
    if (cycle == TAKE) is_too_far <= 1'b0;
    else if (cycle == D_FOOT + QUOTIENT) begin
      is_too_far <= overflow || quotient_now <= -FARTHEST_Q20 || quotient_now >= FARTHEST_Q20;
    end
  end

  //---- Products -----------------------------------------------------------------------------------------------------
  function automatic logic [34:0] wide(input logic [31:0] number);
    wide = {{3{number[31]}}, number};
  endfunction
  function automatic logic [34:0] wide_23(input logic [22:0] number);
    wide_23 = {{12{number[22]}}, number};
  endfunction
  logic is_second;  // image whose products enter
  logic [22:0] p_q20, xf_q20, zf_q20;  // signed, as all below
  logic [34:0] place_q20, l_along_q30, q_along_q16;
  logic [34:0] a, b, plane_a, plane_b, shape_a, shape_b, image_a, image_b;
  assign is_second = cycle[4];
  assign line = is_second ? line_1 : line_0;
  assign place_q20 = wide_23(p_q20) + wide(shape_p_half_q20);
  always_comb begin
    case (cycle[3:0])
      4'd0, 4'd4: image_a = wide_23(xf_q20);
      4'd1, 4'd5: image_a = wide_23(zf_q20);
      4'd2, 4'd6: image_a = wide(sine_q30);
      4'd3, 4'd7: image_a = wide(cosine_q30);
      4'd9, 4'd13: image_a = wide(low_q20);
      default: image_a = wide(step_q24);
    endcase
    case (cycle[3:0])
      4'd0, 4'd2: image_b = wide(line.l1_q30);
      4'd1, 4'd3: image_b = wide(line.l2_q30);
      4'd4, 4'd6: image_b = wide(line.q1_q16);
      4'd5, 4'd7: image_b = wide(line.q2_q16);
      4'd9, 4'd10: image_b = l_along_q30;
      default: image_b = q_along_q16;
    endcase
  end
  always_comb begin
    case (cycle)
      P_NN: {shape_a, shape_b} = {2{4'd0, ray.n_q28}};
      P_TT: {shape_a, shape_b} = {2{wide(ray.t_q28)}};
      P_LINE: {shape_a, shape_b} = {4'd0, ray.from_first_q20, 16'd0, ray.lines, 8'd0};
      P_P: {shape_a, shape_b} = {wide_23(ray.x_q20), wide(cosine_q30)};
      P_C_COSINE: {shape_a, shape_b} = {{6{plane_c_q20[28]}}, plane_c_q20, wide(cosine_q30)};
      P_A_SINE: {shape_a, shape_b} = {{6{plane_a_q20[28]}}, plane_a_q20, wide(sine_q30)};
      P_DD: {shape_a, shape_b} = {2{wide(shape_reference_distance_q20)}};
      P_PP: {shape_a, shape_b} = {2{wide_23(p_q20)}};
      P_XF: {shape_a, shape_b} = {wide_23(p_q20), wide(cosine_q30)};
      P_ZF: {shape_a, shape_b} = {wide_23(p_q20), wide(sine_q30)};
      P_PLACE: {shape_a, shape_b} = {place_q20, wide(shape_p_cells_per_unit_q12)};
      default: {shape_a, shape_b} = {image_a, image_b};
    endcase
  end
  assign {a, b} = is_plane ? {plane_a, plane_b} : {shape_a, shape_b};
  pipelined_multiplier #(
      .A_BITS(35),
      .B_BITS(35)
  ) multiply (
      .clk(clk),
      .moves(1'b1),
      .a(a),
      .b(b),
      .product(product)
  );

  // Sums: `kept` is the product before.
  logic [63:0] kept, sum;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [63:0] difference;
  /* verilator lint_on UNUSEDSIGNAL */
  logic signed [63:0] rho_square, quarter;
  logic [63:0] distance_square;
  logic signed [23:0] p_q8;
  assign sum = kept + product[63:0];
  assign difference = kept - product[63:0];
  always_ff @(posedge clk) begin
    kept <= product[63:0];
    case (cycle)
      P_TT + PRODUCT: radicand <= sum;
      P_P + PRODUCT: p_q20 <= product[52:30];
      P_A_SINE + PRODUCT: to_q20 <= difference[59:30];
      P_DD + PRODUCT: distance_square <= product[63:0];
      P_PP + PRODUCT: begin
        rho_square <= distance_square - product[63:0];
        quarter <= {2'd0, distance_square[63:2]};
      end
      P_PP + PRODUCT + 8'd1: radicand <= rho_square < quarter ? quarter : rho_square;
      default: ;
    endcase
    case (cycle)
      P_XF + PRODUCT: xf_q20 <= product[52:30];
      P_ZF + PRODUCT: zf_q20 <= product[52:30];
      P_PLACE + PRODUCT: p_q8 <= product[47:24];
      default: ;
    endcase
  end

  // Values of an image that are linear in the depth, from the products that leave.
  logic [7:0] left;  // cycle of the operands of this product
  logic [29:0] l_foot_q20;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [35:0] q_foot_q16, q_sum_q16;
  /* verilator lint_on UNUSEDSIGNAL */
  logic signed [23:0] per_step_q12;
  logic [29:0] l0_q20, l0_q20_0, l0_q20_1;
  logic [19:0] l1_q24_0, l1_q24_1;
  logic [30:0] q0_q12_0, q0_q12_1;
  logic [21:0] q1_q12, q1_q12_0, q1_q12_1;
  assign left = cycle - PRODUCT;
  assign line_left = left[4] ? line_1 : line_0;
  assign l0_q20 = l_foot_q20 + product[59:30];
  assign q_sum_q16 = q_foot_q16 + product[55:20];
  assign per_step_q12 = product[51:28];
  assign q1_q12 = per_step_q12 < -MOST_PER_STEP_Q12 ? -MOST_PER_STEP_Q12[21:0] :
                  per_step_q12 > MOST_PER_STEP_Q12 ? MOST_PER_STEP_Q12[21:0] : per_step_q12[21:0];
  always_ff @(posedge clk) begin
    if (left[7:5] == IMAGES) begin
      case (left[3:0])
        4'd1: l_foot_q20 <= line_left.l0_q20[29:0] + sum[59:30];
        4'd3: l_along_q30 <= {difference[63], difference[63:30]};
        4'd5: q_foot_q16 <= {{4{line_left.q0_q16[31]}}, line_left.q0_q16} + sum[55:20];
        4'd7: q_along_q16 <= {difference[63], difference[63:30]};
        4'd9: if (left[4]) l0_q20_1 <= l0_q20; else l0_q20_0 <= l0_q20;
        4'd10: if (left[4]) l1_q24_1 <= product[49:30]; else l1_q24_0 <= product[49:30];
        4'd13: if (left[4]) q0_q12_1 <= q_sum_q16[34:4]; else q0_q12_0 <= q_sum_q16[34:4];
        4'd14: if (left[4]) q1_q12_1 <= q1_q12; else q1_q12_0 <= q1_q12;
        default: ;
      endcase
    end
  end

  //---- Without a shape map: column of the image, first row, and rows per row of the view ------------------------------
  logic signed [32:0] l_now;
  logic [33:0] y_now;
  logic [34:0] y_q20, rise_q24;  // signed, as all three; Y - height
  logic signed [34:0] rise_now;
  logic [32:0] m_q16;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [33:0] column_now;       // signed, q16
  /* verilator lint_on UNUSEDSIGNAL */
  logic m_is_outside, rise_is_outside, column_is_outside;
  assign l_now = {line_0.l0_q20[31], line_0.l0_q20} + product[62:30];
  assign y_now = {{5{view_b_q20[28]}}, view_b_q20} + product[61:28];
  assign rise_now = product[62:28];
  assign rise_is_outside = rise_now < -LARGEST_RISE_Q24 || rise_now > LARGEST_RISE_Q24;
  assign m_is_outside = overflow || (!quotient[32] && quotient[31:30] != 2'd0);
  assign column_now = {{2{line_0.cx_q16[31]}}, line_0.cx_q16} + {quotient[32], quotient};
  assign column_is_outside = overflow || column_now[33] || column_now[32:16] >= {7'b0, object_width};
  always_comb begin
    case (cycle)
      P_L: {plane_a, plane_b} = {wide_23(ray.x_q20), wide(line_0.l1_q30)};
      P_Q: {plane_a, plane_b} = {wide_23(ray.x_q20), wide(line_0.q1_q16)};
      P_Y: {plane_a, plane_b} = {6'd0, ray.lambda_q20, wide(view_s0_q28)};
      P_RISE: {plane_a, plane_b} = {6'd0, ray.lambda_q20, view_sy_q32[33], view_sy_q32};
      P_ROW: {plane_a, plane_b} = {{2{quotient[32]}}, quotient, y_q20};
      default: {plane_a, plane_b} = {{2{m_q16[32]}}, m_q16, rise_q24};
    endcase
  end

  logic [8:0] image_column;
  logic [45:0] row_0_q16;
  logic [35:0] row_step_q16;
  always_ff @(posedge clk) begin
    case (cycle)
      P_L + PRODUCT: begin
        l_q20   <= l_now[31:0];
        is_near <= l_now < NEAREST_Q20;
      end
      P_Q + PRODUCT: lateral_q16 <= {{4{line_0.q0_q16[31]}}, line_0.q0_q16} + product[55:20];
      P_Y + PRODUCT: y_q20 <= {y_now[33], y_now} - {{3{line_0.height_q20[31]}}, line_0.height_q20};
      P_RISE + PRODUCT: begin
        rise_q24   <= rise_now;
        is_outside <= rise_is_outside;
      end
      D_M + QUOTIENT: begin
        m_q16      <= quotient;
        is_outside <= is_outside || m_is_outside;
      end
      D_COLUMN + QUOTIENT: begin
        image_column <= column_now[24:16];
        is_outside   <= is_outside || column_is_outside;
      end
      P_ROW + PRODUCT: row_0_q16 <= {{14{line_0.cy_q16[31]}}, line_0.cy_q16} - product[65:20];
      P_ROW_STEP + PRODUCT: row_step_q16 <= 36'd0 - product[59:24];
      default: ;
    endcase
  end

  //---- Columns of cells beside the ray ------------------------------------------------------------------------------
  // Lines of neighbouring gaps are consecutive; those of the first gap follow those of the last.
  /* verilator lint_off UNUSEDSIGNAL */
  logic [19:0] from_middle_q8;
  logic [23:0] p_from_middle_q8;
  /* verilator lint_on UNUSEDSIGNAL */
  logic signed [11:0] gap_line, first_of_gap, last_of_gap;
  logic signed [15:0] p_cell, last_p_cell;
  assign from_middle_q8 = line_q8 - 20'd128;
  assign p_from_middle_q8 = p_q8 - 24'd128;
  assign gap_line = from_middle_q8[19:8];
  assign first_of_gap = ray.lines_before ? -12'sd1 : 12'sd0;
  assign last_of_gap = ray.lines_behind ? {1'b0, ray.lines} : {1'b0, ray.lines} - 12'd1;
  assign p_cell = p_from_middle_q8[23:8];
  assign last_p_cell = {3'd0, shape_p_cells} - 16'd1;
  logic [53:0] map_line;
  logic [25:0] map_place;
  genvar n;
  generate
    for (n = 0; n < 2; n = n + 1) begin : sides
      logic signed [11:0] line_of_gap, clamped_line;
      logic signed [15:0] place;
      logic [28:0] number;  // signed
      assign line_of_gap = gap_line + 12'(n);
      assign place = p_cell + 16'(n);
      always_ff @(posedge clk) begin
        clamped_line <= line_of_gap < first_of_gap ? first_of_gap :
                        line_of_gap > last_of_gap ? last_of_gap : line_of_gap;
        number <= {2'd0, ray.first_line} + {{17{clamped_line[11]}}, clamped_line};
        map_line[27*n+:27] <= number[28] ? number[26:0] + shape_lines :
                              number >= {2'd0, shape_lines} ? number[26:0] - shape_lines : number[26:0];
        map_place[13*n+:13] <= place < 16'sd0 ? 13'd0 : place > last_p_cell ? last_p_cell[12:0] : place[12:0];
      end
    end
  endgenerate

  //---- Output -------------------------------------------------------------------------------------------------------
  logic signed [30:0] lambda0_q20;
  always_ff @(posedge clk) lambda0_q20 <= {lambda_foot_q20[29], lambda_foot_q20} + low_by_r_q20;

  column_setup_t setup;
  image_setup_t image_0, image_1;
  assign set_up_data = setup;
  assign image_0 = {ray.first, l0_q20_0, l1_q24_0, q0_q12_0, q1_q12_0, line_0.cx_q16[30:0], line_0.cy_q16[30:0],
                    line_0.fl_y_q16[30:0], line_0.height_q20[28:0]};
  assign image_1 = {ray.second, l0_q20_1, l1_q24_1, q0_q12_1, q1_q12_1, line_1.cx_q16[30:0], line_1.cy_q16[30:0],
                    line_1.fl_y_q16[30:0], line_1.height_q20[28:0]};
  always_comb begin
    setup = '0;
    setup.view = ray.view;
    if (is_plane) begin
      if (!is_near && !is_outside) begin
        setup.kind = ray.kind;
        setup.image = ray.first;
        setup.image_column = image_column;
        setup.row_0_q16 = row_0_q16;
        setup.row_step_q16 = row_step_q16;
      end
    end else if (!is_none && !is_too_far) begin
      setup.kind = ray.kind;
      setup.image_0 = image_0;
      setup.lambda_foot_q20 = lambda_foot_q20;
      setup.lambda0_q20 = lambda0_q20;
      setup.lambda1_q21 = lambda1_q21;
      setup.inverse_r_q20 = inverse_r_q20;
      setup.inverse_rho_q20 = inverse_rho_q20;
      if (is_shape) begin
        setup.image_1 = image_1;
        setup.weight = weight;
        setup.map_line = map_line;
        setup.map_place = map_place;
        setup.line_part = from_middle_q8[7:5];
        setup.p_part = p_from_middle_q8[7:5];
      end
    end
  end
endmodule
