// Row scan, the vertical raster generator (engine/model/blocks/prototype/image_scan.hpp): takes a column in one cycle,
// then scans its rows, one per cycle, and puts out a pair of pixels every second cycle. The last pair of a view of odd
// height has an empty second pixel.
//
// The row is a sum of 46 bits. It may wrap, but stays invisible: |row_0| < 2^45, and 512 steps below 2^35 do not lead
// from the other end of the range back to the photo.
module row_scan (
    input  logic clk,
    input  logic rst,

    input  logic placed_valid,
    output logic placed_ready,
    input  logic [board::PLACED_BITS-1:0] placed_data,

    output logic pairs_valid,
    input  logic pairs_ready,
    output logic [board::PAIRS_BITS-1:0] pairs_data,

    // Register file: `view` and its object.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::VIEW_SIDE_BITS-1:0] view_height,
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_height
);
`include "messages.svh"

  placed_column_t in;
  /* verilator lint_off UNUSEDSIGNAL */
  placed_column_t column;  // row_0 is not read again
  /* verilator lint_on UNUSEDSIGNAL */
  pixel_pair_t pair;
  logic active;
  logic [45:0] row_q16;
  logic [board::VIEW_SIDE_BITS-1:0] view_row, next_view_row;
  logic is_second;  // of the pair
  logic is_visible, is_visible_0;
  logic [8:0] row, row_0;
  assign in = placed_data;
  assign view = column.view;
  assign placed_ready = !active;
  assign is_second = view_row[0];
  assign pairs_valid = active && is_second;
  assign next_view_row = view_row + 10'd1;

  // Bit 45 is the sign.
  assign is_visible = column.has_ray && view_row < view_height && row_q16[45:26] == '0 && row_q16[25:16] < object_height;
  assign row = is_visible ? row_q16[24:16] : 9'd0;

  always_ff @(posedge clk) begin
    if (rst) begin
      active <= 1'b0;
    end else if (!active) begin
      active <= placed_valid;
    end else if (pairs_valid && pairs_ready) begin
      active <= next_view_row < view_height;
    end

    if (!active) begin
      column <= in;
      row_q16 <= in.row_0_q16;
      view_row <= '0;
    end else if (!is_second || pairs_ready) begin
      row_q16 <= row_q16 + {{10{column.row_step_q16[35]}}, column.row_step_q16};
      view_row <= next_view_row;
    end
    if (!is_second) begin
      is_visible_0 <= is_visible;
      row_0 <= row;
    end
  end

  always_comb begin
    pair.view = column.view;
    pair.is_visible_0 = is_visible_0;
    pair.is_visible_1 = is_visible;
    pair.row_0 = row_0;
    pair.row_1 = row;
    pair.luma = column.luma;
    pair.chroma = column.chroma;
    pair.alpha = column.alpha;
  end
  assign pairs_data = pair;
endmodule
