// Sample place (engine/model/blocks/texels/sample_place.hpp): the samples of a surface in the two images and the texels of
// each, in 52 stages. A sample per cycle, at most two per surface. All stages stall while the last one holds a sample that
// the output does not take.
//
//      1 ..  9  wait                               36 .. 40  d * q1, d * lambda1, row * step of a plane
//     10        l0, l1 of the column               40        the other parts of the column, and of the view
//     11 .. 16  l = l0 + d * l1                    41 .. 45  column, rows per radius and height
//     17 .. 40  1 / l, a bit each                  46 .. 50  row
//     35        q1, lambda1, step of the column    51, 52    texels
//
// A surface at or before the viewpoint (lambda <= 0) has no sample, so lambda's sign decides in the first cycle how many
// there are. Since lambda grows with the depth, a comparison with the last depth at which lambda <= 0 gives the sign. That
// depth is found bit by bit in the twelve cycles after a column arrives; its first pixel arrives 38 cycles after it
// (ray_rise, cell_march).
module sample_place (
    input  logic clk,
    input  logic rst,

    input  logic place_columns_valid,
    output logic place_columns_ready,
    input  logic [board::PLACE_COLUMNS_BITS-1:0] place_columns_data,
    input  logic met_valid,
    output logic met_ready,
    input  logic [board::MET_BITS-1:0] met_data,

    output logic placed_valid,
    input  logic placed_ready,
    output logic [board::PLACED_SAMPLES_BITS-1:0] placed_data,

    // Register file: `view`, and its object.
    output logic [board::VIEW_BITS-1:0] view,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [28:0] view_b_q20,  // fraction
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_width,
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_height
);
`include "messages.svh"

  localparam int STAGES = board::SAMPLE_PLACE_STAGES;
  localparam int LAST_BIT = 40;  // stage of the last bit of 1 / l
  localparam int BEHIND_BITS = 11;

  //---- Columns: memories by the stage that reads them ---------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  place_column_t column;  // fractions of no effect
  image_setup_t image_0, image_1;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [4:0] column_place;
  assign column = place_columns_data;
  assign image_0 = column.image_0;
  assign image_1 = column.image_1;
  assign column_place = {column.stripe[0], column.column};
  assign place_columns_ready = 1'b1;

  localparam int LATE_BITS = 132;  // values of an image in stage 40
  localparam int LATE_COLUMN_BITS = 2 * LATE_BITS + 96;
  logic [LATE_BITS-1:0] late_0, late_1;
  assign late_0 = {image_0.image, image_0.q0_q12, image_0.cx_q16[30:8], image_0.cy_q16[30:8], image_0.fl_y_q16[30:8],
                   image_0.height_q20[28:4]};
  assign late_1 = {image_1.image, image_1.q0_q12, image_1.cx_q16[30:8], image_1.cy_q16[30:8], image_1.fl_y_q16[30:8],
                   image_1.height_q20[28:4]};

  logic moves;
  logic [4:0] place_9, place_34, place_39;
  logic [99:0] early_10;
  logic [101:0] middle_35;
  logic [LATE_COLUMN_BITS-1:0] late_40;
  dual_port_ram #(
      .WIDTH(100),
      .ADDRESS_BITS(5)
  ) early_columns (
      .clk(clk), .write(place_columns_valid), .write_address(column_place),
      .write_data({image_1.l0_q20, image_1.l1_q24, image_0.l0_q20, image_0.l1_q24}), .read(moves),
      .read_address(place_9), .read_data(early_10)
  );
  dual_port_ram #(
      .WIDTH(102),
      .ADDRESS_BITS(5)
  ) middle_columns (
      .clk(clk), .write(place_columns_valid), .write_address(column_place),
      .write_data({image_1.q1_q12, image_0.q1_q12, column.lambda1_q21, column.row_step_q16}), .read(moves),
      .read_address(place_34), .read_data(middle_35)
  );
  dual_port_ram #(
      .WIDTH(LATE_COLUMN_BITS),
      .ADDRESS_BITS(5)
  ) late_columns (
      .clk(clk), .write(place_columns_valid), .write_address(column_place),
      .write_data({late_1, late_0, column.kind == 2'(board::RAY_PLANE), column.weight, column.lambda0_q20,
                   column.row_0_q16, column.image_column}),
      .read(moves), .read_address(place_39), .read_data(late_40)
  );

  //---- Last depth of a column at which lambda <= 0: the greatest d with d * lambda1 <= 15 - 16 * lambda0 ------------
  logic [BEHIND_BITS:0] arrived;
  logic signed [35:0] rests[0:BEHIND_BITS];
  logic [21:0] steps[0:BEHIND_BITS];
  logic [BEHIND_BITS-1:0] depths[0:BEHIND_BITS];
  logic [8:0] heads[0:BEHIND_BITS];  // place, plane, first alone, second alone, lambda > 0 at every depth
  always_ff @(posedge clk) begin
    if (rst) arrived <= '0;
    else arrived <= {arrived[BEHIND_BITS-1:0], place_columns_valid};
    rests[0] <= 36'd15 - {column.lambda0_q20[30], column.lambda0_q20, 4'd0};
    steps[0] <= column.lambda1_q21;
    depths[0] <= '0;
    heads[0] <= {column_place, column.kind == 2'(board::RAY_PLANE), column.weight == 9'd0, column.weight == 9'd256,
                 !column.lambda0_q20[30] && column.lambda0_q20 != 31'd0};
  end
  genvar n;
  generate
    for (n = 0; n < BEHIND_BITS; n = n + 1) begin : behind_bits
      localparam int SHIFT = BEHIND_BITS - 1 - n;
      logic [35:0] difference;
      assign difference = rests[n] - {{14{1'b0}}, steps[n]} * (36'd1 << SHIFT);
      always_ff @(posedge clk) begin
        rests[n+1] <= difference[35] ? rests[n] : difference;
        steps[n+1] <= steps[n];
        depths[n+1] <= {depths[n][BEHIND_BITS-2:0], !difference[35]};
        heads[n+1] <= heads[n];
      end
    end
  endgenerate

  //---- Samples of a surface -----------------------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  surface_hit_t in;
  scanned_pixel_t pixel;  // a pixel has the stripe's number modulo 4, and two stripes are stored
  /* verilator lint_on UNUSEDSIGNAL */
  logic [4:0] place;
  logic is_plane, first_alone, second_alone, is_before, exists, has_two, is_second_turn, enters;
  logic [BEHIND_BITS-1:0] behind;
  logic [STAGES:1] valid;
  assign in = met_data;
  assign pixel = in.pixel;
  assign place = {pixel.stripe[0], pixel.id[3:0]};
  register_ram #(
      .WIDTH(4 + BEHIND_BITS),
      .DEPTH(32)
  ) kinds (
      .clk(clk), .write(arrived[BEHIND_BITS]), .write_place(heads[BEHIND_BITS][8:4]),
      .write_data({heads[BEHIND_BITS][3:0], depths[BEHIND_BITS]}), .read_place(place),
      .read_data({is_plane, first_alone, second_alone, is_before, behind})
  );
  assign exists = !is_plane && (is_before || in.depth_q3 > behind);
  assign has_two = exists && !first_alone && !second_alone;
  assign placed_valid = valid[STAGES];
  assign moves = !placed_valid || placed_ready;
  assign enters = moves && met_valid;
  assign met_ready = moves && (!has_two || is_second_turn);

  logic is_there, second, last;
  assign is_there = is_plane || exists;
  assign second = exists && (second_alone || (has_two && is_second_turn));
  assign last = !has_two || is_second_turn;
  always_ff @(posedge clk) begin
    if (rst) begin
      valid <= '0;
      is_second_turn <= 1'b0;
    end else begin
      if (moves) valid <= {valid[STAGES-1:1], met_valid};
      if (enters) is_second_turn <= has_two && !is_second_turn;
    end
  end

  logic second_9, second_10, second_34, second_35;
  logic [10:0] depth_9, depth_10, depth_34, depth_35;
  logic [8:0] row_34, row_35;
  logic [59:0] rest_39;
  logic [58:0] rest_40;
  delay_ram #(
      .WIDTH(17),
      .STAGES(9)
  ) wait_9 (
      .clk(clk), .rst(rst), .moves(moves), .in({place, second, in.depth_q3}), .out({place_9, second_9, depth_9})
  );
  delay_ram #(
      .WIDTH(26),
      .STAGES(34)
  ) wait_34 (
      .clk(clk), .rst(rst), .moves(moves), .in({place, second, in.depth_q3, pixel.row}),
      .out({place_34, second_34, depth_34, row_34})
  );
  delay_ram #(
      .WIDTH(60),
      .STAGES(39)
  ) wait_39 (
      .clk(clk), .rst(rst), .moves(moves),
      .in({pixel.stripe[0], pixel.id, pixel.view, pixel.rise_q24, in.is_final, in.next, in.lean, is_there, second, last}),
      .out(rest_39)
  );
  assign place_39 = {rest_39[59], rest_39[53:50]};

  //---- 1 / l --------------------------------------------------------------------------------------------------------
  logic [29:0] l0_10;
  logic [19:0] l1_10;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [31:0] l_part_15;  // fraction
  /* verilator lint_on UNUSEDSIGNAL */
  logic [29:0] l0_11, l0_12, l0_13, l0_14, l0_15, l_16;
  logic [LAST_BIT+11:17] is_near;
  assign {l0_10, l1_10} = second_10 ? early_10[99:50] : early_10[49:0];
  pipelined_multiplier #(
      .A_BITS(12),
      .B_BITS(20)
  ) l_product (
      .clk(clk), .moves(moves), .a({1'b0, depth_10}), .b(l1_10), .product(l_part_15)
  );
  always_ff @(posedge clk) begin
    if (moves) begin
      second_10 <= second_9;
      depth_10 <= depth_9;
      l0_11 <= l0_10;
      l0_12 <= l0_11;
      l0_13 <= l0_12;
      l0_14 <= l0_13;
      l0_15 <= l0_14;
      l_16 <= l0_15 + {{5{l_part_15[31]}}, l_part_15[31:7]};
      is_near <= {is_near[LAST_BIT+10:17], l_16[29] || l_16[28:17] == 12'd0};
    end
  end

  // Before a bit: the rest, and the bits of the quotient. The rest begins with 2^40 / 2^24, which is below l.
  logic [28:0] rests_of_l[17:LAST_BIT];
  logic [28:0] divisors[17:LAST_BIT];
  logic [23:0] inverses[17:LAST_BIT];
  generate
    for (n = 17; n <= LAST_BIT; n = n + 1) begin : inverse_bits
      logic [28:0] rest, divisor, difference;
      logic [22:0] bits;
      logic is_less;
      if (n == 17) begin : first
        assign rest = 29'd65536;
        assign divisor = l_16[28:0];
        assign bits = 23'd0;
      end else begin : others
        assign rest = rests_of_l[n-1];
        assign divisor = divisors[n-1];
        assign bits = inverses[n-1][22:0];
      end
      assign {is_less, difference} = {rest, 1'b0} - {1'b0, divisor};
      always_ff @(posedge clk) begin
        if (moves) begin
          rests_of_l[n] <= is_less ? {rest[27:0], 1'b0} : difference;
          divisors[n] <= divisor;
          inverses[n] <= {bits, !is_less};
        end
      end
    end
  endgenerate

  //---- Products of the depth, and of a plane's row ------------------------------------------------------------------
  logic [21:0] q1_35, lambda1_35;
  logic [35:0] row_step_35;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [33:0] q_part_40;  // fractions
  logic [34:0] lambda_part_40;
  logic [45:0] row_part_40;
  /* verilator lint_on UNUSEDSIGNAL */
  assign {lambda1_35, row_step_35} = middle_35[57:0];
  assign q1_35 = second_35 ? middle_35[101:80] : middle_35[79:58];
  always_ff @(posedge clk) begin
    if (moves) begin
      second_35 <= second_34;
      depth_35 <= depth_34;
      row_35 <= row_34;
      rest_40 <= rest_39[58:0];
    end
  end
  pipelined_multiplier #(
      .A_BITS(12),
      .B_BITS(22)
  ) q_product (
      .clk(clk), .moves(moves), .a({1'b0, depth_35}), .b(q1_35), .product(q_part_40)
  );
  pipelined_multiplier #(
      .A_BITS(12),
      .B_BITS(23)
  ) lambda_product (
      .clk(clk), .moves(moves), .a({1'b0, depth_35}), .b({1'b0, lambda1_35}), .product(lambda_part_40)
  );
  pipelined_multiplier #(
      .A_BITS(10),
      .B_BITS(36)
  ) plane_product (
      .clk(clk), .moves(moves), .a({1'b0, row_35}), .b(row_step_35), .product(row_part_40)
  );

  //---- Stage 40: the other parts of the column, and of the view -----------------------------------------------------
  logic is_there_40, second_40, last_40, is_plane_40, fits_40;
  logic [8:0] id_40, weight_40, image_column_40;
  logic [3:0] view_40;
  logic [27:0] rise_40;
  logic [6:0] image_40;
  logic [30:0] q0_40, lambda0_40, q_40, lambda_40;
  logic [22:0] cx_40, cy_40, fl_y_40;
  logic [24:0] height_40;
  logic [25:0] b_above_40;  // height of the viewpoint above the camera
  logic [45:0] row_0_40;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [46:0] row_40;  // fraction
  /* verilator lint_on UNUSEDSIGNAL */
  logic final_40;
  logic [8:0] next_40;
  logic [4:0] lean_40;
  assign {id_40, view_40, rise_40, final_40, next_40, lean_40, is_there_40, second_40, last_40} = rest_40;
  assign view = view_40;
  assign {image_40, q0_40, cx_40, cy_40, fl_y_40, height_40} = second_40 ? late_40[359:228] : late_40[227:96];
  assign {is_plane_40, weight_40, lambda0_40, row_0_40, image_column_40} = late_40[95:0];
  assign q_40 = q0_40 + q_part_40[33:3];
  assign lambda_40 = lambda0_40 + lambda_part_40[34:4];
  assign b_above_40 = {view_b_q20[28], view_b_q20[28:4]} - {height_40[24], height_40};
  assign row_40 = {row_0_40[45], row_0_40} + {row_part_40[45], row_part_40};
  assign fits_40 = row_40[46:25] == 22'd0;

  // Weight of the second image, adjusted by the lean.
  logic leans_to_second;
  logic [8:0] base_41, base_42, factor_41, weight_43, weight_52;
  logic [3:0] lean_41;
  logic [12:0] product_42;
  assign leans_to_second = lean_40 > 5'd8;
  always_ff @(posedge clk) begin
    if (moves) begin
      base_41 <= leans_to_second && !is_plane_40 ? weight_40 : 9'd0;
      factor_41 <= is_plane_40 ? 9'd0 : leans_to_second ? 9'd256 - weight_40 : weight_40;
      lean_41 <= leans_to_second ? 4'(lean_40 - 5'd8) : lean_40[3:0];
      base_42 <= base_41;
      product_42 <= {4'd0, factor_41} * {9'd0, lean_41};
      weight_43 <= base_42 + 9'((product_42 + 13'd4) >> 3);
    end
  end
  delay_ram #(
      .WIDTH(9),
      .STAGES(9)
  ) wait_weight (
      .clk(clk), .rst(rst), .moves(moves), .in(weight_43), .out(weight_52)
  );
  sample_head_t head_52;
  logic [3:0] view_52;
  logic [6:0] image_52;
  delay_ram #(
      .WIDTH(33),
      .STAGES(12)
  ) wait_52 (
      .clk(clk), .rst(rst), .moves(moves),
      .in({id_40, is_there_40, second_40, last_40, final_40, next_40, view_40, is_there_40 ? image_40 : 7'd0}),
      .out({head_52.id, head_52.is_there, head_52.second, head_52.last, head_52.is_final, head_52.next, view_52, image_52})
  );
  assign head_52.weight = weight_52;

  //---- Column, rows per radius, height above the camera; row --------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  logic [55:0] column_part_45;  // fractions, and bits that repeat the sign
  logic [47:0] m_part_45;
  logic [58:0] y_part_45;
  logic [60:0] row_part_50;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [22:0] cx_45;
  logic [25:0] b_above_45;
  logic [31:0] column_46;
  logic [29:0] y_above_45;
  delay_ram #(
      .WIDTH(49),
      .STAGES(5)
  ) wait_45 (
      .clk(clk), .rst(rst), .moves(moves), .in({cx_40, b_above_40}), .out({cx_45, b_above_45})
  );
  pipelined_multiplier #(
      .A_BITS(31),
      .B_BITS(25)
  ) column_product (
      .clk(clk), .moves(moves), .a(q_40), .b({1'b0, inverses[LAST_BIT]}), .product(column_part_45)
  );
  pipelined_multiplier #(
      .A_BITS(23),
      .B_BITS(25)
  ) m_product (
      .clk(clk), .moves(moves), .a(fl_y_40), .b({1'b0, inverses[LAST_BIT]}), .product(m_part_45)
  );
  pipelined_multiplier #(
      .A_BITS(31),
      .B_BITS(28)
  ) y_product (
      .clk(clk), .moves(moves), .a(lambda_40), .b(rise_40), .product(y_part_45)
  );
  assign y_above_45 = y_part_45[57:28] + {{4{b_above_45[25]}}, b_above_45};
  pipelined_multiplier #(
      .A_BITS(31),
      .B_BITS(30)
  ) row_product (
      .clk(clk), .moves(moves), .a(m_part_45[46:16]), .b(y_above_45), .product(row_part_50)
  );
  always_ff @(posedge clk) begin
    if (moves) column_46 <= {{9{cx_45[22]}}, cx_45} + column_part_45[55:24];
  end

  //---- Texels -------------------------------------------------------------------------------------------------------
  logic column_fits_50, is_there_50, is_plane_50, fits_50, is_there_51, is_plane_51, fits_51, row_fits_51;
  logic [16:0] column_50, row_51;
  logic [22:0] cy_50;
  logic [9:0] width_50, height_50, height_51;
  logic [8:0] image_column_50, image_column_51, image_row_50, image_row_51;
  logic [41:0] row_50;
  delay_ram #(
      .WIDTH(18),
      .STAGES(4)
  ) wait_column (
      .clk(clk), .rst(rst), .moves(moves), .in({column_46[31:17] == 15'd0, column_46[16:0]}),
      .out({column_fits_50, column_50})
  );
  delay_ram #(
      .WIDTH(64),
      .STAGES(10)
  ) wait_50 (
      .clk(clk), .rst(rst), .moves(moves),
      .in({cy_40, object_width, object_height, image_column_40, fits_40, row_40[24:16], is_plane_40, is_there_40}),
      .out({cy_50, width_50, height_50, image_column_50, fits_50, image_row_50, is_plane_50, is_there_50})
  );
  assign row_50 = {{19{cy_50[22]}}, cy_50} - {row_part_50[60], row_part_50[60:20]};

  // Along an axis, of a position in the image: whether there is no texel behind the first one, eighths, first texel.
  function automatic logic [12:0] texels_at(input logic [16:0] position_q8, input logic [9:0] size);
    /* verilator lint_off UNUSEDSIGNAL */
    logic [17:0] from_centre_q8;  // signed
    /* verilator lint_on UNUSEDSIGNAL */
    logic is_before_first;
    from_centre_q8 = {1'b0, position_q8} - 18'd112;
    is_before_first = from_centre_q8[17];
    texels_at = {is_before_first || {1'b0, from_centre_q8[16:8]} + 10'd1 == size, from_centre_q8[7:5],
                 is_before_first ? 9'd0 : from_centre_q8[16:8]};
  endfunction

  logic x_is_inside_51, is_inside, is_inside_52;
  logic [12:0] x_51, x_52, y_52;
  assign is_inside = is_there_51 && !is_near[LAST_BIT+11] && x_is_inside_51 && row_fits_51 && {1'b0, row_51[16:8]} < height_51;
  always_ff @(posedge clk) begin
    if (moves) begin
      x_51 <= texels_at(column_50, width_50);
      x_is_inside_51 <= column_fits_50 && {1'b0, column_50[16:8]} < width_50;
      row_51 <= row_50[16:0];
      row_fits_51 <= row_50[41:17] == 25'd0;
      height_51 <= height_50;
      {image_column_51, fits_51, image_row_51, is_plane_51, is_there_51} <=
          {image_column_50, fits_50, image_row_50, is_plane_50, is_there_50};
      if (is_plane_51) begin  // one texel, unfiltered
        is_inside_52 <= fits_51 && {1'b0, image_row_51} < height_51;
        x_52 <= {4'd0, image_column_51};
        y_52 <= fits_51 && {1'b0, image_row_51} < height_51 ? {4'd0, image_row_51} : 13'd0;
      end else begin
        is_inside_52 <= is_inside;
        x_52 <= is_inside ? x_51 : 13'd0;
        y_52 <= is_inside ? texels_at(row_51, height_51) : 13'd0;
      end
    end
  end

  placed_sample_t out;
  assign out.head = head_52;
  assign out.view = view_52;
  assign out.is_inside = is_inside_52;
  assign out.image = image_52;
  assign out.left = x_52[8:0];
  assign out.top = y_52[8:0];
  assign out.fx = x_52[11:9];
  assign out.fy = y_52[11:9];
  assign out.right_is_left = x_52[12];
  assign out.bottom_is_top = y_52[12];
  assign placed_data = out;
endmodule
