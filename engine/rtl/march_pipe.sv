// Blocks of a pipe of `parallel` that follow the rays of its pixels (engine/model/parallel_pipe.hpp), with the FIFOs
// between them: from its jobs and columns to surface hits, and from the texels of their samples to patches in the image
// buffer. FIFOs at the ports belong to the surroundings. Register look-ups are named by their block.
`include "fifos.svh"

module march_pipe #(
    parameter int PIPE = 0,
    parameter int PIPES = 16
) (
    input  logic clk,
    input  logic rst,

    input  logic scan_jobs_valid,
    output logic scan_jobs_ready,
    input  logic [board::JOBS_BITS-1:0] scan_jobs_data,
    input  logic rise_columns_valid,
    output logic rise_columns_ready,
    input  logic [board::RISE_COLUMNS_BITS-1:0] rise_columns_data,
    input  logic march_columns_valid,
    output logic march_columns_ready,
    input  logic [board::MARCH_COLUMNS_BITS-1:0] march_columns_data,
    input  logic band_words_valid,
    output logic band_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] band_words_data,
    output logic met_valid,
    input  logic met_ready,
    output logic [board::MET_BITS-1:0] met_data,

    input  logic quads_valid,
    output logic quads_ready,
    input  logic [board::QUADS_BITS-1:0] quads_data,
    output logic image_writes_valid,
    input  logic image_writes_ready,
    output logic [board::IMAGE_WRITES_BITS-1:0] image_writes_data,
    output logic stripe_free_valid,
    input  logic stripe_free_ready,
    output logic stripe_free_data,
    output logic view_done_books_valid,
    input  logic view_done_books_ready,
    output logic view_done_books_data,

    output logic [board::VIEW_BITS-1:0] scan_view,
    input  logic [board::VIEW_SIDE_BITS-1:0] scan_view_width,
    input  logic [board::VIEW_SIDE_BITS-1:0] scan_view_height,
    input  logic [35:0] scan_view_s0_q32,
    input  logic [33:0] scan_view_sy_q32,

    output logic [board::VIEW_BITS-1:0] rise_view,
    input  logic [28:0] rise_view_b_q20,
    input  logic [28:0] rise_shape_h_low_q20,
    input  logic [28:0] rise_shape_reference_height_q20,
    input  logic [26:0] rise_shape_bands_per_unit_q12,
    input  logic [18:0] rise_shape_depth_step_q24,

    output logic [board::VIEW_BITS-1:0] loading_view,
    input  logic [8:0] loading_shape_bands,
    input  logic [7:0] loading_shape_jump,
    output logic [board::VIEW_BITS-1:0] march_view,
    input  logic [board::OBJECT_BITS-1:0] march_view_object,
    input  logic [8:0] march_shape_bands,
    input  logic [7:0] march_shape_jump,
    input  logic [7:0] march_shape_thickness,
    input  logic [10:0] march_shape_foot_d_q3,
    input  logic effective_depths_valid,
    output logic effective_depths_ready,
    input  logic [board::OBJECT_BITS+20:0] effective_depths_data,

    output logic [board::VIEW_BITS-1:0] store_view,
    input  logic [board::VIEW_SIDE_BITS-1:0] store_view_height,
    input  logic [board::ADDRESS_BITS-1:0] store_view_image
);
  `PIPE_FIFO(patches, PARALLEL_PATCHES)
  `PIPE_FIFO(patch_free, PARALLEL_PATCH_FREE)
  `PIPE_FIFO(view_done_scan, PARALLEL_VIEW_DONE_SCAN)
  `PIPE_FIFO(scanned, PARALLEL_SCANNED)
  `PIPE_FIFO(risen, PARALLEL_RISEN)
  `PIPE_FIFO(again, PARALLEL_AGAIN)
  `PIPE_FIFO(empty, PARALLEL_EMPTY)
  `PIPE_FIFO(filtered, PARALLEL_FILTERED)
  `PIPE_FIFO(resolved, PARALLEL_RESOLVED)

  pixel_scan #(
      .PIPE(PIPE),
      .PIPES(PIPES)
  ) pixel_scan_block (
      .clk(clk), .rst(rst), `PIPE_PORT(scan_jobs), `PIPE_READS(patch_free), `PIPE_WRITES(patches),
      `PIPE_WRITES(scanned), .view_done_valid(view_done_scan_out_valid), .view_done_ready(view_done_scan_out_ready),
      .view_done_data(view_done_scan_out_data), .view(scan_view), .view_width(scan_view_width),
      .view_height(scan_view_height), .view_s0_q32(scan_view_s0_q32), .view_sy_q32(scan_view_sy_q32)
  );
  ray_rise ray_rise_block (
      .clk(clk), .rst(rst), `PIPE_PORT(rise_columns), `PIPE_READS(scanned), `PIPE_WRITES(risen), .view(rise_view),
      .view_b_q20(rise_view_b_q20), .object_shape_h_low_q20(rise_shape_h_low_q20),
      .object_shape_reference_height_q20(rise_shape_reference_height_q20),
      .object_shape_bands_per_unit_q12(rise_shape_bands_per_unit_q12),
      .object_shape_depth_step_q24(rise_shape_depth_step_q24)
  );
  cell_march cell_march_block (
      .clk(clk), .rst(rst), `PIPE_PORT(march_columns), `PIPE_PORT(band_words), `PIPE_READS(risen), `PIPE_READS(again),
      `PIPE_PORT(met), `PIPE_WRITES(empty), .loading_view(loading_view), .loading_shape_bands(loading_shape_bands),
      .loading_shape_jump(loading_shape_jump), .view(march_view), .view_object(march_view_object),
      .object_shape_bands(march_shape_bands), .object_shape_jump(march_shape_jump),
      .object_shape_thickness(march_shape_thickness), .object_shape_foot_d_q3(march_shape_foot_d_q3),
      `PIPE_PORT(effective_depths)
  );
  texel_filter texel_filter_block (
      .clk(clk), .rst(rst), `PIPE_PORT(quads), `PIPE_WRITES(filtered)
  );
  surface_blend surface_blend_block (
      .clk(clk), .rst(rst), `PIPE_READS(filtered), `PIPE_WRITES(resolved), `PIPE_WRITES(again)
  );
  patch_store patch_store_block (
      .clk(clk), .rst(rst), `PIPE_READS(patches), `PIPE_READS(resolved), `PIPE_READS(empty), `PIPE_PORT(image_writes),
      `PIPE_WRITES(patch_free), `PIPE_PORT(stripe_free), `PIPE_WRITES(view_done_scan), `PIPE_PORT(view_done_books),
      .view(store_view), .view_height(store_view_height), .view_image(store_view_image)
  );
endmodule
