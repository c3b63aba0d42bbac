// Horizontal raster generator (engine/model/blocks/shared/view_rays.hpp): the columns of a view, and the plane of each
// that it sees most squarely. A cycle to take the view; then for each column a cycle per plane, in which its N and T are
// read, compared and incremented, and one cycle to put the column out. In the first column N and T come from the
// register file, then from the accumulators.
//
// A pipe of `parallel` puts out its own columns alone: stripes of 16, of the pipes in turn. The number of pipes must be a
// power of two.
module raster_generator #(
    parameter int PIPES = 1,
    parameter int PIPE = 0
) (
    input  logic clk,
    input  logic rst,

    input  logic jobs_valid,
    output logic jobs_ready,
    input  logic [board::JOBS_BITS-1:0] jobs_data,

    output logic columns_valid,
    input  logic columns_ready,
    output logic [board::COLUMNS_BITS-1:0] columns_data,

    // Register file.
    output logic [board::VIEW_BITS-1:0] view,
    output logic [board::PLANE_BITS-1:0] plane,
    input  logic [board::VIEW_SIDE_BITS-1:0] view_width,
    input  logic [board::PLANE_BITS-1:0] object_planes,
    input  logic [28:0] plane_c_q20,   // signed, as all of these
    input  logic [35:0] plane_n0_q32,
    input  logic [35:0] plane_nx_q32,
    input  logic [35:0] plane_t0_q32,
    input  logic [35:0] plane_tx_q32
);
`include "messages.svh"

  localparam logic signed [31:0] MOST_EDGE_ON_Q28 = -(32'sd1 <<< 24);

  logic active;
  logic [board::VIEW_SIDE_BITS-1:0] column;
  logic [board::PLANE_BITS-1:0] scanned;  // the next plane
  logic scans;
  assign scans = scanned != object_planes;
  assign jobs_ready = !active;
  logic owns, ends_column;
  assign owns = (board::VIEW_SIDE_BITS'(column[board::VIEW_SIDE_BITS-1:4]) +
                 board::VIEW_SIDE_BITS'(board::STRIPE_TURN) * board::VIEW_SIDE_BITS'(view)) %
                board::VIEW_SIDE_BITS'(PIPES) == board::VIEW_SIDE_BITS'(PIPE);
  assign columns_valid = active && !scans && owns;
  assign ends_column = !scans && (columns_ready || !owns);

  // Accumulators, read and written in the same cycle.
  logic [35:0] n_sums[0:board::PLANES-1];
  logic [35:0] t_sums[0:board::PLANES-1];
  logic [35:0] n_q32, t_q32;
  assign n_q32 = column == '0 ? plane_n0_q32 : n_sums[scanned];
  assign t_q32 = column == '0 ? plane_t0_q32 : t_sums[scanned];

  // Plane with the smallest N so far.
  logic [board::PLANE_BITS-1:0] best;
  logic signed [31:0] smallest_q28;
  logic [31:0] best_t_q28;
  logic signed [31:0] n_q28;
  logic is_better;
  assign n_q28 = n_q32[35:4];
  assign is_better = scanned == '0 || n_q28 < smallest_q28;
  assign plane = scans ? scanned : best;

  always_ff @(posedge clk) begin
    if (rst) begin
      active <= 1'b0;
    end else if (!active) begin
      active <= jobs_valid;
    end else if (ends_column && column + 1'b1 == view_width) begin
      active <= 1'b0;
    end

    if (!active) begin
      view <= jobs_data;
      column <= '0;
      scanned <= '0;
    end else if (scans) begin
      scanned <= scanned + 1'b1;
      n_sums[scanned] <= n_q32 + plane_nx_q32;
      t_sums[scanned] <= t_q32 + plane_tx_q32;
      if (is_better) begin
        best <= scanned;
        smallest_q28 <= n_q28;
        best_t_q28 <= t_q32[35:4];
      end
    end else if (ends_column) begin
      scanned <= '0;
      column <= column + 1'b1;
    end
  end

  logic is_before;  // the viewpoint is in front of the plane
  column_ray_t ray;
  assign is_before = !plane_c_q20[28] && plane_c_q20 != '0;
  always_comb begin
    ray.view = view;
    ray.has_ray = is_before && smallest_q28 <= MOST_EDGE_ON_Q28;
    ray.plane = best;
    ray.n_q28 = 31'd0 - smallest_q28[30:0];
    ray.t_q28 = best_t_q28;
  end
  assign columns_data = ray;
endmodule
