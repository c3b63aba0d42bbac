// Ray position (engine/model/blocks/shared/view_rays.hpp): the point (x, u) of a column's ray on its plane, the axial
// distance lambda, and the ray's cell of the RS map.
//
//     cycle  1       take the column                     45      x = a + u c; ranges of x and lambda
//            2..35   divider: u (3..36: lambda)          46      output of a miss
//            2..10   multiplier: k * x_cells             46..54  (x + x_half) * x_cells_per_unit
//            36..44  multiplier: u * c                   55..63  (u + u_half) * u_cells_per_unit
//                                                        64      clamp xi, ui
//                                                        65..73  (k * x_cells + xi) * u_cells
//                                                        74      + ui + the map's address;  75  output
module ray_position #(
    parameter int WITH_DIRECTION = 0  // 1: `parallel`, whose points end with slope u and direction N, T
) (
    input  logic clk,
    input  logic rst,

    input  logic columns_valid,
    output logic columns_ready,
    input  logic [board::COLUMNS_BITS-1:0] columns_data,

    output logic points_valid,
    input  logic points_ready,
    output logic [board::POINTS_BITS+WITH_DIRECTION*board::DIRECTION_BITS-1:0] points_data,

    // Register file: the object of `view`, and its plane.
    output logic [board::VIEW_BITS-1:0] view,
    output logic [board::PLANE_BITS-1:0] plane,
    input  logic [board::MAP_SIDE_BITS-1:0] object_x_cells,
    input  logic [board::MAP_SIDE_BITS-1:0] object_u_cells,
    input  logic [31:0] object_x_half_q20,
    input  logic [31:0] object_u_half_q28,
    input  logic [31:0] object_x_cells_per_unit_q12,
    input  logic [31:0] object_u_cells_per_unit_q12,
    input  logic [board::ADDRESS_BITS-1:0] object_map,
    input  logic [28:0] plane_a_q20,  // signed
    input  logic [28:0] plane_c_q20   // signed; positive where there is a ray
);
`include "messages.svh"

  localparam logic [6:0] TAKE = 7'd1;
  localparam logic [6:0] NO_RAY_OUTPUT = 7'(board::NO_RAY_LATENCY);
  localparam logic [6:0] DIVIDE_U = 7'd2;
  localparam logic [6:0] U_READY = DIVIDE_U + 7'(board::DIVIDE_CYCLES);
  localparam logic [6:0] LAMBDA_READY = U_READY + 7'd1;
  localparam logic [6:0] X_READY = U_READY + 7'(board::MULTIPLY_CYCLES);
  localparam logic [6:0] MISS_OUTPUT = 7'(board::RAY_POSITION_MISS_LATENCY);
  localparam logic [6:0] XI_READY = X_READY + 7'd1 + 7'(board::MULTIPLY_CYCLES);
  localparam logic [6:0] UI_READY = XI_READY + 7'(board::MULTIPLY_CYCLES);
  localparam logic [6:0] CELL_READY = UI_READY + 7'd1 + 7'(board::MULTIPLY_CYCLES);
  localparam logic [6:0] OUTPUT = 7'(board::RAY_POSITION_LATENCY);

  column_ray_t in, ray;
  logic [6:0] cycle;
  logic misses;
  logic is_last;
  assign in = columns_data;
  assign view = ray.view;
  assign plane = ray.plane;
  assign columns_ready = cycle == TAKE;
  assign is_last = cycle == OUTPUT || (cycle == MISS_OUTPUT && misses) || (cycle == NO_RAY_OUTPUT && !ray.has_ray);
  assign points_valid = is_last;

  always_ff @(posedge clk) begin
    if (rst) cycle <= TAKE;
    else if (cycle == TAKE) cycle <= columns_valid ? cycle + 7'd1 : TAKE;
    else if (!is_last) cycle <= cycle + 7'd1;
    else if (points_ready) cycle <= TAKE;
    if (columns_ready) ray <= in;
  end

  // Quotients.
  logic [63:0] dividend;
  logic [32:0] quotient;
  logic overflow;
  logic [32:0] u_q28;  // signed
  logic [28:0] lambda_q20;
  assign dividend = cycle == DIVIDE_U ? {{4{ray.t_q28[31]}}, ray.t_q28, 28'b0} : {7'b0, plane_c_q20, 28'b0};
  pipelined_divider divide (
      .clk(clk),
      .dividend(dividend),
      .divisor({1'b0, ray.n_q28}),
      .quotient(quotient),
      .overflow(overflow)
  );

  // Products.
  logic starts;
  logic signed [35:0] multiplicand, multiplier;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [71:0] product;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [35:0] u_now, x_from_left, u_from_left, row;
  logic [22:0] x_q20;  // signed
  logic [14:0] first_row;  // k * x_cells
  logic [10:0] xi, ui;
  assign u_now = cycle == U_READY ? {{3{quotient[32]}}, quotient} : {{3{u_q28[32]}}, u_q28};
  assign x_from_left = {{13{x_q20[22]}}, x_q20} + {{4{object_x_half_q20[31]}}, object_x_half_q20};
  assign u_from_left = u_now + {{4{object_u_half_q28[31]}}, object_u_half_q28};
  assign row = {21'b0, first_row} + {25'b0, xi};
  assign starts = cycle == DIVIDE_U || cycle == U_READY || cycle == MISS_OUTPUT || cycle == XI_READY ||
                  cycle == UI_READY + 7'd1;
  assign multiplicand = cycle == DIVIDE_U ? {32'b0, ray.plane} :
                        cycle == U_READY ? u_now :
                        cycle == MISS_OUTPUT ? x_from_left :
                        cycle == XI_READY ? u_from_left : row;
  assign multiplier = cycle == DIVIDE_U ? {25'b0, object_x_cells} :
                      cycle == U_READY ? {7'b0, plane_c_q20} :
                      cycle == MISS_OUTPUT ? {{4{object_x_cells_per_unit_q12[31]}}, object_x_cells_per_unit_q12} :
                      cycle == XI_READY ? {{4{object_u_cells_per_unit_q12[31]}}, object_u_cells_per_unit_q12} :
                      {25'b0, object_u_cells};
  serial_multiplier multiply (
      .clk(clk),
      .start(starts),
      .multiplicand(multiplicand),
      .multiplier(multiplier),
      .product(product)
  );

  // Position.
  logic signed [43:0] x_now;
  logic signed [43:0] x_half;
  logic x_is_outside;
  assign x_now = {{15{plane_a_q20[28]}}, plane_a_q20} + product[71:28];
  assign x_half = {{12{object_x_half_q20[31]}}, object_x_half_q20};
  assign x_is_outside = x_now < -x_half || x_now >= x_half;

  // Cell: floors of the products, within the map.
  logic [39:0] xi_floor;
  logic [31:0] ui_floor;
  logic [10:0] xi_now, ui_now;
  assign xi_floor = product[71:32];
  assign ui_floor = product[71:40];
  assign xi_now = xi_floor[39] ? 11'd0 : xi_floor >= {29'b0, object_x_cells} ? object_x_cells - 11'd1 : xi_floor[10:0];
  assign ui_now = ui_floor[31] ? 11'd0 : ui_floor >= {21'b0, object_u_cells} ? object_u_cells - 11'd1 : ui_floor[10:0];

  logic [29:0] cell_byte;
  always_ff @(posedge clk) begin
    if (cycle == DIVIDE_U + 7'(board::MULTIPLY_CYCLES)) first_row <= product[14:0];
    if (cycle == U_READY) begin
      u_q28  <= quotient;
      misses <= overflow;
    end
    if (cycle == LAMBDA_READY) begin
      lambda_q20 <= quotient[28:0];
      misses <= misses || overflow || quotient[32:29] != 4'd0;
    end
    if (cycle == X_READY) begin
      x_q20  <= x_now[22:0];
      misses <= misses || x_is_outside;
    end
    if (cycle == XI_READY) xi <= xi_now;
    if (cycle == UI_READY) ui <= ui_now;
    if (cycle == CELL_READY) cell_byte <= {object_map, 3'b0} + {19'b0, ui} + product[29:0];
  end

  ray_point_t point;
  always_comb begin
    point = '0;
    point.view = ray.view;
    if (ray.has_ray && !misses) begin
      point.has_ray = 1'b1;
      point.plane = ray.plane;
      point.x_q20 = x_q20;
      point.lambda_q20 = lambda_q20;
      point.cell_byte = cell_byte;
    end
  end
  generate
    if (WITH_DIRECTION == 0) begin : without_direction
      assign points_data = point;
    end else begin : with_direction
      assign points_data = {point, point.has_ray ? {u_q28[29:0], ray.n_q28, ray.t_q28} : 93'd0};
    end
  endgenerate
endmodule
