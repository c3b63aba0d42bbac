// Block scan, the vertical raster generator of boards with compressed images
// (engine/model/blocks/decompression/block_scan.hpp): takes a column in one cycle, then scans its rows, one per cycle,
// and joins pixels of the same block of 8x8 samples into a run. The request of a run is sent in the cycle after its
// last pixel. The sum of the rows may wrap, as in row_scan.
module block_scan (
    input  logic clk,
    input  logic rst,

    input  logic walks_valid,
    output logic walks_ready,
    input  logic [board::WALKS_BITS-1:0] walks_data,

    output logic asks_valid,
    input  logic asks_ready,
    output logic [board::ASKS_BITS-1:0] asks_data,

    output logic coded_pixels_valid,
    input  logic coded_pixels_ready,
    output logic [board::CODED_PIXELS_BITS-1:0] coded_pixels_data,

    // Register file: `view` and its object.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::VIEW_SIDE_BITS-1:0] view_height,
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_height
);
`include "messages.svh"

  localparam logic [4:0] FULL_RUN = 5'(board::RUN_PIXELS);

  column_walk_t in;
  /* verilator lint_off UNUSEDSIGNAL */
  column_walk_t column;  // row_0 is not read again
  /* verilator lint_on UNUSEDSIGNAL */
  block_request_t request, next_request;
  coded_pixel_t pixel;
  logic active, is_first;  // no run of this column has begun
  logic [4:0] run;         // pixels
  logic [45:0] row_q16;
  logic [board::VIEW_SIDE_BITS-1:0] view_row, next_view_row;
  assign in = walks_data;
  assign view = column.view;
  assign next_view_row = view_row + 10'd1;

  logic is_visible, joins, ends_run, scans, is_last;
  logic [8:0] row;
  // Bit 45 is the sign.
  assign is_visible = column.has_ray && view_row < view_height && row_q16[45:26] == '0 && row_q16[25:16] < object_height;
  assign row = row_q16[24:16];
  assign joins = is_visible && run != 5'd0 && run != FULL_RUN && row[8:3] == request.block_row;
  assign ends_run = run != 5'd0 && !joins;
  assign scans = active && coded_pixels_ready && (!ends_run || asks_ready);
  assign is_last = next_view_row[board::VIEW_SIDE_BITS-1:0] == {view_height[9:1] + {8'b0, view_height[0]}, 1'b0};

  assign walks_ready = !active && (run == 5'd0 || asks_ready);
  assign asks_valid = active ? coded_pixels_ready && ends_run : run != 5'd0;
  assign asks_data = request;
  assign coded_pixels_valid = active && (!ends_run || asks_ready);

  always_comb begin
    pixel = '0;
    pixel.view = column.view;
    pixel.is_visible = is_visible;
    pixel.is_pending = is_visible;
    if (is_visible) begin
      pixel.begins = !joins;
      pixel.row = row;
      pixel.column = column.column[2:0];
    end
  end
  assign coded_pixels_data = pixel;

  always_comb begin
    next_request = request;
    if (!joins) begin
      next_request.view = column.view;
      next_request.first = is_first;
      next_request.down = !column.row_step_q16[35];
      next_request.image = column.image;
      next_request.column = column.column;
      next_request.block_row = row[8:3];
      next_request.rows = '0;
    end
    next_request.rows = next_request.rows | (8'd1 << row[2:0]);
  end

  always_ff @(posedge clk) begin
    if (rst) begin
      active <= 1'b0;
      run <= 5'd0;
    end else begin
      if (walks_valid && walks_ready) active <= 1'b1;
      if (scans && is_last) active <= 1'b0;
      if (scans) run <= !is_visible ? 5'd0 : joins ? run + 5'd1 : 5'd1;
      else if (!active && asks_ready) run <= 5'd0;
    end

    if (walks_ready) begin
      column <= in;
      row_q16 <= in.row_0_q16;
      view_row <= '0;
      is_first <= 1'b1;
    end else if (scans) begin
      row_q16 <= row_q16 + {{10{column.row_step_q16[35]}}, column.row_step_q16};
      view_row <= next_view_row;
      if (is_visible) begin
        is_first <= 1'b0;
        request <= next_request;
      end
    end
  end
endmodule
