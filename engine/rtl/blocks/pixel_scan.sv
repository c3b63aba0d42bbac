// Pixel scan (engine/model/blocks/parallel/pixel_rays.hpp): the pixels of a pipe's stripes of 16 columns, patch by patch
// downwards, row by row within a patch. One cycle to begin a view, then a pixel per cycle. At most four patches and two
// views are in flight. The number of pipes must be a power of two.
module pixel_scan #(
    parameter int PIPE = 0,
    parameter int PIPES = 16
) (
    input  logic clk,
    input  logic rst,

    input  logic scan_jobs_valid,
    output logic scan_jobs_ready,
    input  logic [board::JOBS_BITS-1:0] scan_jobs_data,
    // Without content.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic patch_free_valid,
    output logic patch_free_ready,
    input  logic patch_free_data,
    input  logic view_done_valid,
    output logic view_done_ready,
    input  logic view_done_data,
    /* verilator lint_on UNUSEDSIGNAL */

    output logic patches_valid,
    input  logic patches_ready,
    output logic [board::PATCHES_BITS-1:0] patches_data,
    output logic scanned_valid,
    input  logic scanned_ready,
    output logic [board::SCANNED_BITS-1:0] scanned_data,

    // Register file: `view`.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::VIEW_SIDE_BITS-1:0] view_width,
    input  logic [board::VIEW_SIDE_BITS-1:0] view_height,
    input  logic [35:0] view_s0_q32,
    input  logic [33:0] view_sy_q32
);
`include "messages.svh"

  view_job_t in;
  /* verilator lint_off UNUSEDSIGNAL */
  patch_job_t new_patch, kept_patch, patch;  // the place of the patch is not read again
  /* verilator lint_on UNUSEDSIGNAL */
  scanned_pixel_t pixel;
  logic active, in_patch;
  logic [2:0] free_patches, may_begin;  // with the patch that becomes free in this cycle
  logic [1:0] views, views_left;        // in flight
  logic [3:0] current_view;
  logic [1:0] stripe_number, slot;
  logic [5:0] stripe, patch_row;  // of the patch in the view
  logic [4:0] next_column;
  logic [3:0] column, next_row;
  logic [2:0] row;
  logic [35:0] kept_rise_q32, rise_q32;
  assign in = scan_jobs_data;
  assign view = current_view;
  assign patch_free_ready = 1'b1;
  assign view_done_ready = 1'b1;
  assign may_begin = free_patches + 3'(patch_free_valid);
  assign views_left = views - 2'(view_done_valid);

  logic begins, sends, ends_row, ends_patch, ends_stripe;
  assign scan_jobs_ready = !active && views_left != 2'd2;
  assign patches_valid = active && !in_patch && may_begin != 3'd0 && scanned_ready;
  assign scanned_valid = active && (in_patch || (may_begin != 3'd0 && patches_ready));
  assign begins = patches_valid && patches_ready;
  assign sends = scanned_valid && scanned_ready;

  assign new_patch.view = current_view;
  assign new_patch.slot = slot;
  assign new_patch.stripe = stripe[4:0];
  assign new_patch.patch_row = patch_row;
  assign new_patch.columns = view_width[9:4] > stripe ? 5'd16 : {1'b0, view_width[3:0]};
  assign new_patch.rows = view_height[9:3] > {1'b0, patch_row} ? 4'd8 : {1'b0, view_height[2:0]};
  assign ends_stripe = {1'b0, patch_row, 3'b0} + 10'd8 >= view_height;
  assign new_patch.ends_stripe = ends_stripe;
  assign new_patch.ends_view = ends_stripe && {stripe, 4'b0} + 10'(16 * PIPES) >= view_width;
  assign patches_data = new_patch;
  assign patch = in_patch ? kept_patch : new_patch;
  assign rise_q32 = in_patch || patch_row != 6'd0 ? kept_rise_q32 : view_s0_q32;

  assign pixel.id = {slot, row, column};
  assign pixel.view = current_view;
  assign pixel.stripe = stripe_number;
  assign pixel.row = {patch_row, row};
  assign pixel.rise_q24 = rise_q32[35:8];
  assign scanned_data = pixel;
  assign next_column = {1'b0, column} + 5'd1;
  assign next_row = {1'b0, row} + 4'd1;
  assign ends_row = sends && next_column == patch.columns;
  assign ends_patch = ends_row && next_row == patch.rows;

  always_ff @(posedge clk) begin
    if (rst) begin
      active <= 1'b0;
      in_patch <= 1'b0;
      free_patches <= 3'd4;
      views <= 2'd0;
      slot <= 2'd0;
      stripe_number <= 2'd0;
      column <= 4'd0;
      row <= 3'd0;
    end else begin
      free_patches <= may_begin - 3'(begins);
      views <= views_left + 2'(scan_jobs_valid && scan_jobs_ready);
      if (scan_jobs_valid && scan_jobs_ready) active <= 1'b1;
      if (ends_patch && patch.ends_view) active <= 1'b0;
      if (sends) begin
        in_patch <= !ends_patch;
        column <= ends_row ? 4'd0 : next_column[3:0];
      end
      if (ends_row) row <= ends_patch ? 3'd0 : next_row[2:0];
      if (ends_patch) slot <= slot + 2'd1;
      if (ends_patch && patch.ends_stripe) stripe_number <= stripe_number + 2'd1;
    end

    if (begins) kept_patch <= new_patch;
    if (sends) kept_rise_q32 <= ends_row ? rise_q32 + {{2{view_sy_q32[33]}}, view_sy_q32} : rise_q32;
    if (!active) begin
      current_view <= in.view;
      // The first pipe of a view is another one than that of the view before.
      stripe <= 6'(PIPE - board::STRIPE_TURN * in.view) & 6'(PIPES - 1);
      patch_row <= 6'd0;
    end else if (ends_patch) begin
      patch_row <= patch.ends_stripe ? 6'd0 : patch_row + 6'd1;
      if (patch.ends_stripe) stripe <= stripe + 6'(PIPES);
    end
  end
endmodule
