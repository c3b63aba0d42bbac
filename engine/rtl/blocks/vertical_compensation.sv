// Vertical compensation (engine/model/blocks/prototype/vertical_compensation.hpp): column of the photo, first row, and
// rows of the photo per row of the view.
//
//     cycle  1       take the ray                       multiplier 2..10   x * l1
//            11      l = l0 + ..; l too small?                     12..20  x * q1
//            12..45  divider: m = fl_y / l                         22..30  lambda * S
//            21      q0 + ..                                       31..39  lambda * sy
//            22..55  divider: column                               46..54  m * (Y - height)
//            56      cx + ..; column, m, rise in range?            55..63  m * rise
//            12, 57  output of a ray that is too near, or outside  64 the signs;  65 output
module vertical_compensation (
    input  logic clk,
    input  logic rst,

    input  logic lines_valid,
    output logic lines_ready,
    input  logic [board::LINES_BITS-1:0] lines_data,

    output logic walks_valid,
    input  logic walks_ready,
    output logic [board::WALKS_BITS-1:0] walks_data,

    // Register file: `view` and its object.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [28:0] view_b_q20,   // signed, as all three
    input  logic [31:0] view_s0_q28,
    input  logic [33:0] view_sy_q32,
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_width
);
`include "messages.svh"

  localparam logic [6:0] PRODUCT = 7'(board::MULTIPLY_CYCLES);
  localparam logic [6:0] QUOTIENT = 7'(board::DIVIDE_CYCLES);
  localparam logic [6:0] TAKE = 7'd1;
  localparam logic [6:0] NO_RAY_OUTPUT = 7'(board::NO_RAY_LATENCY);
  localparam logic [6:0] SUM_L = 7'd2 + PRODUCT;
  localparam logic [6:0] L_READY = 7'(board::COMPENSATION_TOO_NEAR_LATENCY);
  localparam logic [6:0] SUM_Q = L_READY + PRODUCT;
  localparam logic [6:0] Q_READY = SUM_Q + 7'd1;
  localparam logic [6:0] S_READY = Q_READY + PRODUCT;
  localparam logic [6:0] RISE_READY = S_READY + PRODUCT;
  localparam logic [6:0] M_READY = L_READY + QUOTIENT;
  localparam logic [6:0] COLUMN_READY = Q_READY + QUOTIENT;
  localparam logic [6:0] ROW_READY = M_READY + PRODUCT;
  localparam logic [6:0] STEP_READY = ROW_READY + PRODUCT;
  localparam logic [6:0] OUTSIDE_OUTPUT = 7'(board::COMPENSATION_OUTSIDE_LATENCY);
  localparam logic [6:0] OUTPUT = 7'(board::COMPENSATION_LATENCY);

  localparam logic signed [32:0] NEAREST_Q20 = 33'sd1 <<< 17;
  localparam logic signed [34:0] LARGEST_RISE_Q24 = 35'sd1 <<< 28;

  ray_line_t in, ray;
  logic [6:0] cycle;
  logic is_near, is_outside;
  logic is_last;
  assign in = lines_data;
  assign view = ray.view;
  assign lines_ready = cycle == TAKE;
  assign is_last = cycle == OUTPUT || (cycle == OUTSIDE_OUTPUT && is_outside) || (cycle == L_READY && is_near) ||
                   (cycle == NO_RAY_OUTPUT && !ray.has_ray);
  assign walks_valid = is_last;

  always_ff @(posedge clk) begin
    if (rst) cycle <= TAKE;
    else if (cycle == TAKE) cycle <= lines_valid ? cycle + 7'd1 : TAKE;
    else if (!is_last) cycle <= cycle + 7'd1;
    else if (walks_ready) cycle <= TAKE;
    if (lines_ready) ray <= in;
  end

  // Products.
  logic starts;
  logic [35:0] x, lambda, multiplicand, multiplier;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [71:0] product;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [31:0] l_q20;        // at least 2^17, or not used
  logic [35:0] lateral_q16;  // signed
  logic [34:0] y_q20;        // signed: Y - height
  logic [34:0] rise_q24;     // signed
  logic [35:0] m_q16;
  logic [32:0] m_q16_kept;
  logic [32:0] quotient;
  logic overflow;
  assign x = {{13{ray.x_q20[22]}}, ray.x_q20};
  assign lambda = {7'b0, ray.lambda_q20};
  assign m_q16 = cycle == M_READY ? {{3{quotient[32]}}, quotient} : {{3{m_q16_kept[32]}}, m_q16_kept};
  assign starts = cycle == TAKE + 7'd1 || cycle == L_READY || cycle == Q_READY || cycle == S_READY ||
                  cycle == M_READY || cycle == ROW_READY;
  assign multiplicand = cycle == TAKE + 7'd1 || cycle == L_READY ? x :
                        cycle == Q_READY || cycle == S_READY ? lambda : m_q16;
  assign multiplier = cycle == TAKE + 7'd1 ? {{4{ray.l1_q30[31]}}, ray.l1_q30} :
                      cycle == L_READY ? {{4{ray.q1_q16[31]}}, ray.q1_q16} :
                      cycle == Q_READY ? {{4{view_s0_q28[31]}}, view_s0_q28} :
                      cycle == S_READY ? {{2{view_sy_q32[33]}}, view_sy_q32} :
                      cycle == M_READY ? {y_q20[34], y_q20} : {rise_q24[34], rise_q24};
  serial_multiplier multiply (
      .clk(clk),
      .start(starts),
      .multiplicand(multiplicand),
      .multiplier(multiplier),
      .product(product)
  );

  // Quotients.
  logic [63:0] dividend;
  assign dividend = cycle == L_READY ? {{12{ray.fl_y_q16[31]}}, ray.fl_y_q16, 20'b0} :
                    {{8{lateral_q16[35]}}, lateral_q16, 20'b0};
  pipelined_divider divide (
      .clk(clk),
      .dividend(dividend),
      .divisor(l_q20),
      .quotient(quotient),
      .overflow(overflow)
  );

  // Sums.
  logic signed [32:0] l_now;
  logic [33:0] y_now;
  logic signed [34:0] rise_now;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [33:0] column_now;  // signed, q16
  /* verilator lint_on UNUSEDSIGNAL */
  logic rise_is_outside, column_is_outside, m_is_outside;
  assign l_now = {ray.l0_q20[31], ray.l0_q20} + product[62:30];
  assign y_now = {{5{view_b_q20[28]}}, view_b_q20} + product[61:28];
  assign rise_now = product[62:28];
  assign rise_is_outside = rise_now < -LARGEST_RISE_Q24 || rise_now > LARGEST_RISE_Q24;
  assign m_is_outside = overflow || (!quotient[32] && quotient[31:30] != 2'd0);
  assign column_now = {{2{ray.cx_q16[31]}}, ray.cx_q16} + {quotient[32], quotient};
  assign column_is_outside = overflow || column_now[33] || column_now[32:16] >= {7'b0, object_width};

  logic [8:0] column;
  logic [45:0] row_0_q16;
  logic [35:0] row_step_q16;
  always_ff @(posedge clk) begin
    if (cycle == TAKE) begin
      is_near <= 1'b0;
      is_outside <= 1'b0;
    end
    if (cycle == SUM_L) begin
      l_q20   <= l_now[31:0];
      is_near <= l_now < NEAREST_Q20;
    end
    if (cycle == SUM_Q) lateral_q16 <= {{4{ray.q0_q16[31]}}, ray.q0_q16} + product[55:20];
    if (cycle == S_READY) y_q20 <= {y_now[33], y_now} - {{3{ray.height_q20[31]}}, ray.height_q20};
    if (cycle == RISE_READY) begin
      rise_q24   <= rise_now;
      is_outside <= rise_is_outside;
    end
    if (cycle == M_READY) begin
      m_q16_kept <= quotient;
      is_outside <= is_outside || m_is_outside;
    end
    if (cycle == COLUMN_READY) begin
      column <= column_now[24:16];
      is_outside <= is_outside || column_is_outside;
    end
    if (cycle == ROW_READY) row_0_q16 <= {{14{ray.cy_q16[31]}}, ray.cy_q16} - product[65:20];
    if (cycle == STEP_READY) row_step_q16 <= 36'd0 - product[59:24];
  end

  column_walk_t walk;
  always_comb begin
    walk = '0;
    walk.view = ray.view;
    if (ray.has_ray && !is_near && !is_outside) begin
      walk.has_ray = 1'b1;
      walk.image = ray.image;
      walk.column = column;
      walk.row_0_q16 = row_0_q16;
      walk.row_step_q16 = row_step_q16;
    end
  end
  assign walks_data = walk;
endmodule
