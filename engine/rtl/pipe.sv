// The pipe of the board with its memory channel: every block from a view's start to its words in the SDRAM, connected by
// FIFOs of the depths of the model (PipeFifos and SingleBoard of engine/model/board_top.hpp). The FIFOs at its ports
// belong to the surroundings: render control, host DMA, disk controller. Register look-ups are named by their block.
`include "fifos.svh"

module pipe (
    input  logic clk,
    input  logic rst,

    input  logic jobs_valid,
    output logic jobs_ready,
    input  logic [board::JOBS_BITS-1:0] jobs_data,
    output logic view_written_valid,
    input  logic view_written_ready,
    output logic [board::VIEW_WRITTEN_BITS-1:0] view_written_data,

    input  logic host_reads_valid,
    output logic host_reads_ready,
    input  logic [board::HOST_READS_BITS-1:0] host_reads_data,
    output logic host_words_valid,
    input  logic host_words_ready,
    output logic [board::HOST_WORDS_BITS-1:0] host_words_data,
    input  logic [$clog2(board::HOST_WORDS_DEPTH+1)-1:0] host_words_room,

    input  logic load_words_valid,
    output logic load_words_ready,
    input  logic [board::LOAD_WORDS_BITS-1:0] load_words_data,
    output logic object_loaded_valid,
    input  logic object_loaded_ready,
    output logic [board::OBJECT_LOADED_BITS-1:0] object_loaded_data,

    // Pins of the SDRAM.
    output logic [2:0] sdram_command,
    output logic [board::SDRAM_BANK_BITS-1:0] sdram_bank,
    output logic [board::SDRAM_ROW_BITS-1:0] sdram_row,
    output logic [board::SDRAM_COLUMN_BITS-1:0] sdram_column,
    output logic [63:0] sdram_write_data,
    input  logic [63:0] sdram_read_data,

    // Register file.
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

    output logic [board::VIEW_BITS-1:0] line_view,
    input  logic [board::PLANE_BITS-1:0] line_object_planes,
    input  logic [board::ADDRESS_BITS-1:0] line_object_lines,

    output logic [board::VIEW_BITS-1:0] compensation_view,
    input  logic [28:0] compensation_view_b_q20,
    input  logic [31:0] compensation_view_s0_q28,
    input  logic [33:0] compensation_view_sy_q32,
    input  logic [board::IMAGE_SIDE_BITS-1:0] compensation_object_width,

    output logic [board::VIEW_BITS-1:0] address_view,
    input  logic [board::IMAGE_SIDE_BITS-1:0] address_object_width,
    input  logic [board::IMAGE_SIDE_BITS-4:0] address_object_luma_pitch,
    input  logic [board::IMAGE_SIDE_BITS-4:0] address_object_chroma_pitch,
    input  logic [board::IMAGE_SIDE_BITS-6:0] address_object_alpha_pitch,
    input  logic [board::ADDRESS_BITS-1:0] address_object_luma,
    input  logic [board::ADDRESS_BITS-1:0] address_object_chroma,
    input  logic [board::ADDRESS_BITS-1:0] address_object_alpha,

    output logic [board::VIEW_BITS-1:0] scan_view,
    input  logic [board::VIEW_SIDE_BITS-1:0] scan_view_height,
    input  logic [board::IMAGE_SIDE_BITS-1:0] scan_object_height,

    output logic [board::VIEW_BITS-1:0] writer_view,
    input  logic [board::VIEW_SIDE_BITS-1:0] writer_view_width,
    input  logic [board::VIEW_SIDE_BITS-1:0] writer_view_height,
    input  logic active_buffer
);
  `PIPE_FIFO(columns, COLUMNS)
  `PIPE_FIFO(points, POINTS)
  `PIPE_FIFO(mapped, MAPPED)
  `PIPE_FIFO(lines, LINES)
  `PIPE_FIFO(walks, WALKS)
  `PIPE_FIFO(placed, PLACED)
  `PIPE_FIFO(pairs, PAIRS)
  `PIPE_FIFO(tags, TAGS)
  `PIPE_FIFO(samples, SAMPLES)
  `PIPE_FIFO(pixels, PIXELS)
  `PIPE_FIFO(map_reads, MAP_READS)
  `PIPE_FIFO(map_words, MAP_WORDS)
  `PIPE_FIFO(line_reads, LINE_READS)
  `PIPE_FIFO(line_words, LINE_WORDS)
  `PIPE_FIFO(sample_reads, SAMPLE_READS)
  `PIPE_FIFO(sample_words, SAMPLE_WORDS)
  `PIPE_FIFO(image_writes, IMAGE_WRITES)

  raster_generator raster_generator_block (
      .clk(clk), .rst(rst), `PIPE_PORT(jobs), `PIPE_WRITES(columns),
      .view(raster_view), .plane(raster_plane), .view_width(raster_view_width), .object_planes(raster_object_planes),
      .plane_c_q20(raster_plane_c_q20), .plane_n0_q32(raster_plane_n0_q32), .plane_nx_q32(raster_plane_nx_q32),
      .plane_t0_q32(raster_plane_t0_q32), .plane_tx_q32(raster_plane_tx_q32)
  );
  ray_position ray_position_block (
      .clk(clk), .rst(rst), `PIPE_READS(columns), `PIPE_WRITES(points),
      .view(position_view), .plane(position_plane),
      .object_x_cells(position_object_x_cells), .object_u_cells(position_object_u_cells),
      .object_x_half_q20(position_object_x_half_q20), .object_u_half_q28(position_object_u_half_q28),
      .object_x_cells_per_unit_q12(position_object_x_cells_per_unit_q12),
      .object_u_cells_per_unit_q12(position_object_u_cells_per_unit_q12),
      .object_map(position_object_map), .plane_a_q20(position_plane_a_q20), .plane_c_q20(position_plane_c_q20)
  );
  map_reader map_reader_block (
      .clk(clk), .rst(rst), `PIPE_READS(points), `PIPE_WRITES(map_reads), `PIPE_READS(map_words), `PIPE_WRITES(mapped)
  );
  line_reader line_reader_block (
      .clk(clk), .rst(rst), `PIPE_READS(mapped), `PIPE_WRITES(line_reads), `PIPE_READS(line_words), `PIPE_WRITES(lines),
      .view(line_view), .object_planes(line_object_planes), .object_lines(line_object_lines)
  );
  vertical_compensation vertical_compensation_block (
      .clk(clk), .rst(rst), `PIPE_READS(lines), `PIPE_WRITES(walks),
      .view(compensation_view), .view_b_q20(compensation_view_b_q20), .view_s0_q28(compensation_view_s0_q28),
      .view_sy_q32(compensation_view_sy_q32), .object_width(compensation_object_width)
  );
  column_address column_address_block (
      .clk(clk), .rst(rst), `PIPE_READS(walks), `PIPE_WRITES(placed),
      .view(address_view), .object_width(address_object_width), .object_luma_pitch(address_object_luma_pitch),
      .object_chroma_pitch(address_object_chroma_pitch), .object_alpha_pitch(address_object_alpha_pitch),
      .object_luma(address_object_luma), .object_chroma(address_object_chroma), .object_alpha(address_object_alpha)
  );
  row_scan row_scan_block (
      .clk(clk), .rst(rst), `PIPE_READS(placed), `PIPE_WRITES(pairs),
      .view(scan_view), .view_height(scan_view_height), .object_height(scan_object_height)
  );
  sample_fetch sample_fetch_block (
      .clk(clk), .rst(rst), `PIPE_READS(pairs), `PIPE_WRITES(sample_reads), `PIPE_WRITES(tags)
  );
  sample_select sample_select_block (
      .clk(clk), .rst(rst), `PIPE_READS(tags), `PIPE_READS(sample_words), `PIPE_WRITES(samples)
  );
  colour_conversion colour_conversion_block (
      .clk(clk), .rst(rst), `PIPE_READS(samples), `PIPE_WRITES(pixels)
  );
  image_writer image_writer_block (
      .clk(clk), .rst(rst), `PIPE_READS(pixels), `PIPE_WRITES(image_writes),
      .view(writer_view), .view_width(writer_view_width), .view_height(writer_view_height),
      .active_buffer(active_buffer)
  );

  // Space in the FIFOs of the answers.
  logic [$clog2(board::MAP_WORDS_DEPTH+1)-1:0] map_words_room;
  logic [$clog2(board::LINE_WORDS_DEPTH+1)-1:0] line_words_room;
  logic [$clog2(board::SAMPLE_WORDS_DEPTH+1)-1:0] sample_words_room;
  assign map_words_room = $clog2(board::MAP_WORDS_DEPTH + 1)'(board::MAP_WORDS_DEPTH) - map_words_count;
  assign line_words_room = $clog2(board::LINE_WORDS_DEPTH + 1)'(board::LINE_WORDS_DEPTH) - line_words_count;
  assign sample_words_room = $clog2(board::SAMPLE_WORDS_DEPTH + 1)'(board::SAMPLE_WORDS_DEPTH) - sample_words_count;
  memory_controller memory_controller_block (
      .clk(clk), .rst(rst),
      `PIPE_PORT(host_reads), `PIPE_READS(map_reads), `PIPE_READS(line_reads), `PIPE_READS(sample_reads),
      `PIPE_PORT(host_words), `PIPE_WRITES(map_words), `PIPE_WRITES(line_words), `PIPE_WRITES(sample_words),
      .host_words_room(host_words_room), .map_words_room(map_words_room), .line_words_room(line_words_room),
      .sample_words_room(sample_words_room), `PIPE_READS(image_writes), .image_writes_count(image_writes_count),
      `PIPE_PORT(view_written), `PIPE_PORT(load_words), `PIPE_PORT(object_loaded),
      .sdram_command(sdram_command), .sdram_bank(sdram_bank), .sdram_row(sdram_row), .sdram_column(sdram_column),
      .sdram_write_data(sdram_write_data), .sdram_read_data(sdram_read_data)
  );
endmodule
