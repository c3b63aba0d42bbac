// The column side of a pipe of `parallel` (ParallelPipe of engine/model/parallel_pipe.hpp): views enter, and the set-up of
// each column leaves to the three blocks that store a part of it, with the requests for its cells. The FIFOs of views,
// memory and columns belong to the surroundings. Register look-ups are named by their block.
`include "fifos.svh"

module column_chain #(
    parameter int PIPES = 16,
    parameter int PIPE = 0
) (
    input  logic clk,
    input  logic rst,

    input  logic jobs_valid,
    output logic jobs_ready,
    input  logic [board::JOBS_BITS-1:0] jobs_data,
    input  logic stripe_free_valid,
    output logic stripe_free_ready,
    input  logic stripe_free_data,
    output logic rise_columns_valid,
    input  logic rise_columns_ready,
    output logic [board::RISE_COLUMNS_BITS-1:0] rise_columns_data,
    output logic march_columns_valid,
    input  logic march_columns_ready,
    output logic [board::MARCH_COLUMNS_BITS-1:0] march_columns_data,
    output logic place_columns_valid,
    input  logic place_columns_ready,
    output logic [board::PLACE_COLUMNS_BITS-1:0] place_columns_data,

    output logic map_reads_valid,
    input  logic map_reads_ready,
    output logic [board::MAP_READS_BITS-1:0] map_reads_data,
    input  logic map_words_valid,
    output logic map_words_ready,
    input  logic [board::MAP_WORDS_BITS-1:0] map_words_data,
    output logic bracket_reads_valid,
    input  logic bracket_reads_ready,
    output logic [board::MAP_READS_BITS-1:0] bracket_reads_data,
    input  logic bracket_words_valid,
    output logic bracket_words_ready,
    input  logic [board::MAP_WORDS_BITS-1:0] bracket_words_data,
    output logic line_reads_valid,
    input  logic line_reads_ready,
    output logic [board::LINE_READS_BITS-1:0] line_reads_data,
    input  logic line_words_valid,
    output logic line_words_ready,
    input  logic [board::LINE_WORDS_BITS-1:0] line_words_data,
    output logic band_reads_valid,
    input  logic band_reads_ready,
    output logic [board::MAP_READS_BITS-1:0] band_reads_data,

    output logic [board::VIEW_BITS-1:0] raster_view,
    output logic [board::PLANE_BITS-1:0] raster_plane,
    input  logic [board::VIEW_SIDE_BITS-1:0] raster_view_width,
    input  logic [board::PLANE_BITS-1:0] raster_object_planes,
    input  logic [28:0] raster_plane_c_q20,
    input  logic [35:0] raster_plane_n0_q32,
    input  logic [35:0] raster_plane_nx_q32,
    input  logic [35:0] raster_plane_t0_q32,
    input  logic [35:0] raster_plane_tx_q32,
    output logic [board::VIEW_BITS-1:0] position_view,
    output logic [board::PLANE_BITS-1:0] position_plane,
    input  logic [board::MAP_SIDE_BITS-1:0] position_object_x_cells,
    input  logic [board::MAP_SIDE_BITS-1:0] position_object_u_cells,
    input  logic [31:0] position_object_x_half_q20,
    input  logic [31:0] position_object_u_half_q28,
    input  logic [31:0] position_object_x_cells_per_unit_q12,
    input  logic [31:0] position_object_u_cells_per_unit_q12,
    input  logic [board::ADDRESS_BITS-1:0] position_object_map,
    input  logic [28:0] position_plane_a_q20,
    input  logic [28:0] position_plane_c_q20,
    output logic [board::VIEW_BITS-1:0] bracket_view,
    input  logic bracket_object_has_shape,
    input  logic [board::IMAGE_BITS-1:0] bracket_object_images,
    input  logic [board::PLANE_BITS-1:0] bracket_object_planes,
    input  logic [board::ADDRESS_BITS-1:0] bracket_object_lines,
    output logic [board::VIEW_BITS-1:0] picture_view,
    input  logic [board::PLANE_BITS-1:0] picture_object_planes,
    input  logic [board::ADDRESS_BITS-1:0] picture_object_lines,
    output logic [board::VIEW_BITS-1:0] setup_view,
    output logic [board::PLANE_BITS-1:0] setup_plane,
    input  logic [28:0] setup_view_b_q20,
    input  logic [31:0] setup_view_s0_q28,
    input  logic [33:0] setup_view_sy_q32,
    input  logic [28:0] setup_plane_a_q20,
    input  logic [28:0] setup_plane_c_q20,
    input  logic [board::IMAGE_SIDE_BITS-1:0] setup_object_width,
    input  logic [12:0] setup_shape_p_cells,
    input  logic [26:0] setup_shape_lines,
    input  logic [31:0] setup_shape_p_half_q20,
    input  logic [31:0] setup_shape_p_cells_per_unit_q12,
    input  logic [31:0] setup_shape_reference_distance_q20,
    input  logic [31:0] setup_shape_depth_low_q20,
    input  logic [31:0] setup_shape_depth_step_q24,
    output logic [board::VIEW_BITS-1:0] band_view,
    input  logic [board::VIEW_SIDE_BITS-1:0] band_view_width,
    input  logic [12:0] band_shape_p_cells,
    input  logic [8:0] band_shape_bands,
    input  logic [board::ADDRESS_BITS-1:0] band_shape_cells
);
  localparam int DEPTH = board::COLUMNS_DEPTH;  // of all FIFOs

  `FIFO(columns, board::COLUMNS_BITS, DEPTH)
  `FIFO(points, board::POINTS_BITS + board::DIRECTION_BITS, DEPTH)
  `FIFO(mapped, board::MAPPED_BITS + board::DIRECTION_BITS, DEPTH)
  `FIFO(bracketed, board::BRACKETED_BITS, DEPTH)
  `FIFO(lined, board::LINED_BITS, DEPTH)
  `FIFO(set_up, board::SET_UP_BITS, DEPTH)

  raster_generator #(
      .PIPES(PIPES),
      .PIPE(PIPE)
  ) raster_generator_block (
      .clk(clk), .rst(rst), `PIPE_PORT(jobs), `PIPE_WRITES(columns),
      .view(raster_view), .plane(raster_plane), .view_width(raster_view_width), .object_planes(raster_object_planes),
      .plane_c_q20(raster_plane_c_q20), .plane_n0_q32(raster_plane_n0_q32), .plane_nx_q32(raster_plane_nx_q32),
      .plane_t0_q32(raster_plane_t0_q32), .plane_tx_q32(raster_plane_tx_q32)
  );
  ray_position #(
      .WITH_DIRECTION(1)
  ) ray_position_block (
      .clk(clk), .rst(rst), `PIPE_READS(columns), `PIPE_WRITES(points),
      .view(position_view), .plane(position_plane), .object_x_cells(position_object_x_cells),
      .object_u_cells(position_object_u_cells), .object_x_half_q20(position_object_x_half_q20),
      .object_u_half_q28(position_object_u_half_q28),
      .object_x_cells_per_unit_q12(position_object_x_cells_per_unit_q12),
      .object_u_cells_per_unit_q12(position_object_u_cells_per_unit_q12), .object_map(position_object_map),
      .plane_a_q20(position_plane_a_q20), .plane_c_q20(position_plane_c_q20)
  );
  map_reader #(
      .WITH_DIRECTION(1)
  ) map_reader_block (
      .clk(clk), .rst(rst), `PIPE_READS(points), `PIPE_PORT(map_reads), `PIPE_PORT(map_words), `PIPE_WRITES(mapped)
  );
  bracket_finder bracket_finder_block (
      .clk(clk), .rst(rst), `PIPE_READS(mapped), `PIPE_PORT(bracket_reads), `PIPE_PORT(bracket_words),
      `PIPE_WRITES(bracketed),
      .view(bracket_view), .object_has_shape(bracket_object_has_shape), .object_images(bracket_object_images),
      .object_planes(bracket_object_planes), .object_lines(bracket_object_lines)
  );
  picture_reader picture_reader_block (
      .clk(clk), .rst(rst), `PIPE_READS(bracketed), `PIPE_PORT(line_reads), `PIPE_PORT(line_words), `PIPE_WRITES(lined),
      .view(picture_view), .object_planes(picture_object_planes), .object_lines(picture_object_lines)
  );
  column_setup column_setup_block (
      .clk(clk), .rst(rst), `PIPE_READS(lined), `PIPE_WRITES(set_up),
      .view(setup_view), .plane(setup_plane), .view_b_q20(setup_view_b_q20), .view_s0_q28(setup_view_s0_q28),
      .view_sy_q32(setup_view_sy_q32), .plane_a_q20(setup_plane_a_q20), .plane_c_q20(setup_plane_c_q20),
      .object_width(setup_object_width), .shape_p_cells(setup_shape_p_cells), .shape_lines(setup_shape_lines),
      .shape_p_half_q20(setup_shape_p_half_q20), .shape_p_cells_per_unit_q12(setup_shape_p_cells_per_unit_q12),
      .shape_reference_distance_q20(setup_shape_reference_distance_q20),
      .shape_depth_low_q20(setup_shape_depth_low_q20), .shape_depth_step_q24(setup_shape_depth_step_q24)
  );
  band_reader #(
      .PIPE(PIPE),
      .PIPES(PIPES)
  ) band_reader_block (
      .clk(clk), .rst(rst), `PIPE_READS(set_up), `PIPE_PORT(stripe_free), `PIPE_PORT(band_reads),
      `PIPE_PORT(rise_columns), `PIPE_PORT(march_columns), `PIPE_PORT(place_columns),
      .view(band_view), .view_width(band_view_width), .shape_p_cells(band_shape_p_cells),
      .shape_bands(band_shape_bands), .shape_cells(band_shape_cells)
  );
endmodule
