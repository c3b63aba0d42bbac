// A pipe of `parallel` with its memory channel (ParallelPipe of engine/model/parallel_pipe.hpp): every block from a
// view's start to its words in the SDRAM, with their FIFOs. The FIFOs at its ports belong to the surroundings: views,
// host DMA, loads. Register look-ups are named by their block, those of record chains by their hop, too.
`include "fifos.svh"
`include "hop_chain.svh"

// A FIFO of answers from the memory, which has room for every word.
`define ANSWERS(name, NAME) \
  /* verilator lint_off UNUSEDSIGNAL */ \
  `PIPE_FIFO(name, NAME) \
  /* verilator lint_on UNUSEDSIGNAL */ \
  logic [ROOM_BITS-1:0] name``_room; \
  assign name``_room = ROOM_BITS'(board::NAME``_DEPTH) - ROOM_BITS'(name``_count); \
  assign name``_in_data = host_words_data;

// A signal of all read ports but the host's, in their order of service from right to left.
`define READ_PORTS(kind, signal) \
  book_``kind``_``signal, raw_``kind``_``signal, \
  table_``kind``_0_``signal, tile_``kind``_0_``signal, record_``kind``_0_``signal, \
  table_``kind``_1_``signal, tile_``kind``_1_``signal, record_``kind``_1_``signal, \
  table_``kind``_2_``signal, tile_``kind``_2_``signal, record_``kind``_2_``signal, \
  table_``kind``_3_``signal, tile_``kind``_3_``signal, record_``kind``_3_``signal, \
  band_``kind``_``signal, line_``kind``_``signal, bracket_``kind``_``signal, map_``kind``_``signal

module parallel_pipe #(
    parameter int PIPE = 0,
    parameter int PIPES = 16
) (
    input  logic clk,
    input  logic rst,

    input  logic jobs_valid,
    output logic jobs_ready,
    input  logic [board::JOBS_BITS-1:0] jobs_data,
    input  logic scan_jobs_valid,
    output logic scan_jobs_ready,
    input  logic [board::JOBS_BITS-1:0] scan_jobs_data,
    input  logic book_jobs_valid,
    output logic book_jobs_ready,
    input  logic [board::JOBS_BITS-1:0] book_jobs_data,
    output logic view_written_valid,
    input  logic view_written_ready,
    output logic [board::VIEW_WRITTEN_BITS-1:0] view_written_data,

    input  logic host_reads_valid,
    output logic host_reads_ready,
    input  logic [board::PARALLEL_HOST_READS_BITS-1:0] host_reads_data,
    output logic host_words_valid,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic host_words_ready,  // there is room for every word
    /* verilator lint_on UNUSEDSIGNAL */
    output logic [board::PARALLEL_HOST_WORDS_BITS-1:0] host_words_data,
    input  logic [$clog2(board::PARALLEL_HOST_WORDS_DEPTH+1)-1:0] host_words_room,

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
    input  logic [board::ADDRESS_BITS-1:0] band_shape_cells,
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
    input  logic [board::ADDRESS_BITS-1:0] store_view_image,
    output logic [board::VIEW_BITS-1:0] place_view,
    input  logic [28:0] place_view_b_q20,
    input  logic [board::IMAGE_SIDE_BITS-1:0] place_object_width,
    input  logic [board::IMAGE_SIDE_BITS-1:0] place_object_height,
    output logic [board::VIEW_BITS-1:0] tags_view,
    input  logic [31:0] tags_object_serial,
    output logic [board::VIEW_BITS-1:0] fetch_view,
    input  logic fetch_object_coded,
    input  logic [31:0] fetch_object_serial,
    input  logic [6:0] fetch_object_block_columns,
    input  logic [6:0] fetch_object_block_rows,
    input  logic [board::ADDRESS_BITS-1:0] fetch_object_raw_blocks,
    output logic [board::VIEW_BITS-1:0] books_view,
    input  logic [31:0] books_object_serial,
    output logic [board::VIEW_BITS-1:0] next_view,
    input  logic next_object_coded,
    input  logic [31:0] next_object_serial,
    input  logic [board::ADDRESS_BITS-1:0] next_object_books,
    input  logic [14:0] next_object_book_words,
    input  logic [1:0] next_object_flat_blocks,
    input  logic [2:0] next_object_flat_quarters,
    input  logic [1:0] next_object_predicted_blocks,
    input  logic [2:0] next_object_predicted_quarters,
    `HOP_REGISTERS(0),
    `HOP_REGISTERS(1),
    `HOP_REGISTERS(2),
    `HOP_REGISTERS(3)
);
  localparam int ROOM_BITS = 6;  // of the space in the FIFO of answers with most places

  `PIPE_FIFO(rise_columns, PARALLEL_RISE_COLUMNS)
  `PIPE_FIFO(march_columns, PARALLEL_MARCH_COLUMNS)
  `PIPE_FIFO(place_columns, PARALLEL_PLACE_COLUMNS)
  `PIPE_FIFO(stripe_free, PARALLEL_STRIPE_FREE)
  `PIPE_FIFO(view_done_books, PARALLEL_VIEW_DONE_BOOKS)
  `PIPE_FIFO(met, PARALLEL_MET)
  `PIPE_FIFO(placed, PARALLEL_PLACED)
  `PIPE_FIFO(fills, PARALLEL_FILLS)
  `PIPE_FIFO(waiting, PARALLEL_WAITING)
  `PIPE_FIFO(targets, PARALLEL_TARGETS)
  `PIPE_FIFO(kinds, PARALLEL_KINDS)
  `PIPE_FIFO(samples, PARALLEL_SAMPLES)
  `PIPE_FIFO(merged, PARALLEL_MERGED)
  `PIPE_FIFO(texels, PARALLEL_TEXELS)
  `PIPE_FIFO(quads, PARALLEL_QUADS)
  `PIPE_FIFO(image_writes, PARALLEL_IMAGE_WRITES)
  `PIPE_FIFO(complete, COMPLETE)

  `PIPE_FIFO(map_reads, PARALLEL_MAP_READS)
  `ANSWERS(map_words, PARALLEL_MAP_WORDS)
  `PIPE_FIFO(bracket_reads, PARALLEL_BRACKET_READS)
  `ANSWERS(bracket_words, PARALLEL_BRACKET_WORDS)
  `PIPE_FIFO(line_reads, PARALLEL_LINE_READS)
  `ANSWERS(line_words, PARALLEL_LINE_WORDS)
  `PIPE_FIFO(band_reads, PARALLEL_BAND_READS)
  `ANSWERS(band_words, PARALLEL_BAND_WORDS)
  `PIPE_FIFO(raw_reads, PARALLEL_RAW_READS)
  `ANSWERS(raw_words, PARALLEL_RAW_WORDS)
  `PIPE_FIFO(book_reads, PARALLEL_BOOK_READS)
  `ANSWERS(book_words, PARALLEL_BOOK_WORDS)

  `PIPE_FIFO(table_reads_0, TABLE_READS_0)
  `ANSWERS(table_words_0, TABLE_WORDS_0)
  `PIPE_FIFO(tile_reads_0, TILE_READS_0)
  `ANSWERS(tile_words_0, TILE_WORDS_0)
  `PIPE_FIFO(record_reads_0, RECORD_READS_0)
  `ANSWERS(record_words_0, RECORD_WORDS_0)
  `PIPE_FIFO(table_reads_1, TABLE_READS_1)
  `ANSWERS(table_words_1, TABLE_WORDS_1)
  `PIPE_FIFO(tile_reads_1, TILE_READS_1)
  `ANSWERS(tile_words_1, TILE_WORDS_1)
  `PIPE_FIFO(record_reads_1, RECORD_READS_1)
  `ANSWERS(record_words_1, RECORD_WORDS_1)
  `PIPE_FIFO(table_reads_2, TABLE_READS_2)
  `ANSWERS(table_words_2, TABLE_WORDS_2)
  `PIPE_FIFO(tile_reads_2, TILE_READS_2)
  `ANSWERS(tile_words_2, TILE_WORDS_2)
  `PIPE_FIFO(record_reads_2, RECORD_READS_2)
  `ANSWERS(record_words_2, RECORD_WORDS_2)
  `PIPE_FIFO(table_reads_3, TABLE_READS_3)
  `ANSWERS(table_words_3, TABLE_WORDS_3)
  `PIPE_FIFO(tile_reads_3, TILE_READS_3)
  `ANSWERS(tile_words_3, TILE_WORDS_3)
  `PIPE_FIFO(record_reads_3, RECORD_READS_3)
  `ANSWERS(record_words_3, RECORD_WORDS_3)

  column_chain #(
      .PIPES(PIPES),
      .PIPE(PIPE)
  ) column_chain_block (
      .clk(clk), .rst(rst), `PIPE_PORT(jobs), `PIPE_READS(stripe_free), `PIPE_WRITES(rise_columns),
      `PIPE_WRITES(march_columns), `PIPE_WRITES(place_columns), `PIPE_WRITES(map_reads), `PIPE_READS(map_words),
      `PIPE_WRITES(bracket_reads), `PIPE_READS(bracket_words), `PIPE_WRITES(line_reads), `PIPE_READS(line_words),
      `PIPE_WRITES(band_reads),
      .raster_view(raster_view), .raster_plane(raster_plane), .raster_view_width(raster_view_width),
      .raster_object_planes(raster_object_planes), .raster_plane_c_q20(raster_plane_c_q20),
      .raster_plane_n0_q32(raster_plane_n0_q32), .raster_plane_nx_q32(raster_plane_nx_q32),
      .raster_plane_t0_q32(raster_plane_t0_q32), .raster_plane_tx_q32(raster_plane_tx_q32),
      .position_view(position_view), .position_plane(position_plane), .position_object_x_cells(position_object_x_cells),
      .position_object_u_cells(position_object_u_cells), .position_object_x_half_q20(position_object_x_half_q20),
      .position_object_u_half_q28(position_object_u_half_q28),
      .position_object_x_cells_per_unit_q12(position_object_x_cells_per_unit_q12),
      .position_object_u_cells_per_unit_q12(position_object_u_cells_per_unit_q12),
      .position_object_map(position_object_map), .position_plane_a_q20(position_plane_a_q20),
      .position_plane_c_q20(position_plane_c_q20), .bracket_view(bracket_view),
      .bracket_object_has_shape(bracket_object_has_shape), .bracket_object_images(bracket_object_images),
      .bracket_object_planes(bracket_object_planes), .bracket_object_lines(bracket_object_lines),
      .picture_view(picture_view), .picture_object_planes(picture_object_planes),
      .picture_object_lines(picture_object_lines), .setup_view(setup_view), .setup_plane(setup_plane),
      .setup_view_b_q20(setup_view_b_q20), .setup_view_s0_q28(setup_view_s0_q28), .setup_view_sy_q32(setup_view_sy_q32),
      .setup_plane_a_q20(setup_plane_a_q20), .setup_plane_c_q20(setup_plane_c_q20),
      .setup_object_width(setup_object_width), .setup_shape_p_cells(setup_shape_p_cells),
      .setup_shape_lines(setup_shape_lines), .setup_shape_p_half_q20(setup_shape_p_half_q20),
      .setup_shape_p_cells_per_unit_q12(setup_shape_p_cells_per_unit_q12),
      .setup_shape_reference_distance_q20(setup_shape_reference_distance_q20),
      .setup_shape_depth_low_q20(setup_shape_depth_low_q20), .setup_shape_depth_step_q24(setup_shape_depth_step_q24),
      .band_view(band_view), .band_view_width(band_view_width), .band_shape_p_cells(band_shape_p_cells),
      .band_shape_bands(band_shape_bands), .band_shape_cells(band_shape_cells)
  );
  march_pipe #(
      .PIPE(PIPE),
      .PIPES(PIPES)
  ) march_pipe_block (
      .clk(clk), .rst(rst), `PIPE_PORT(scan_jobs), `PIPE_READS(rise_columns), `PIPE_READS(march_columns),
      `PIPE_READS(band_words), `PIPE_WRITES(met), `PIPE_READS(quads), `PIPE_WRITES(image_writes),
      `PIPE_WRITES(stripe_free), `PIPE_WRITES(view_done_books),
      .scan_view(scan_view), .scan_view_width(scan_view_width), .scan_view_height(scan_view_height),
      .scan_view_s0_q32(scan_view_s0_q32), .scan_view_sy_q32(scan_view_sy_q32), .rise_view(rise_view),
      .rise_view_b_q20(rise_view_b_q20), .rise_shape_h_low_q20(rise_shape_h_low_q20),
      .rise_shape_reference_height_q20(rise_shape_reference_height_q20),
      .rise_shape_bands_per_unit_q12(rise_shape_bands_per_unit_q12),
      .rise_shape_depth_step_q24(rise_shape_depth_step_q24), .loading_view(loading_view),
      .loading_shape_bands(loading_shape_bands), .loading_shape_jump(loading_shape_jump), .march_view(march_view),
      .march_view_object(march_view_object), .march_shape_bands(march_shape_bands), .march_shape_jump(march_shape_jump),
      .march_shape_thickness(march_shape_thickness), .march_shape_foot_d_q3(march_shape_foot_d_q3),
      .effective_depths_valid(effective_depths_valid), .effective_depths_ready(effective_depths_ready),
      .effective_depths_data(effective_depths_data), .store_view(store_view), .store_view_height(store_view_height),
      .store_view_image(store_view_image)
  );

  sample_place sample_place_block (
      .clk(clk), .rst(rst), `PIPE_READS(place_columns), `PIPE_READS(met), `PIPE_WRITES(placed),
      .view(place_view), .view_b_q20(place_view_b_q20), .object_width(place_object_width),
      .object_height(place_object_height)
  );
  texel_tags texel_tags_block (
      .clk(clk), .rst(rst), `PIPE_READS(placed), `PIPE_WRITES(fills), `PIPE_WRITES(waiting),
      .view(tags_view), .object_serial(tags_object_serial)
  );
  texel_cache texel_cache_block (
      .clk(clk), .rst(rst), `PIPE_READS(waiting), `PIPE_READS(targets), `PIPE_READS(texels), `PIPE_WRITES(quads)
  );

  logic asks_0_valid, asks_0_ready, pixels_0_valid, pixels_0_ready;
  logic [board::ASKS_BITS-1:0] asks_0_data;
  logic [board::CODED_PIXELS_BITS-1:0] pixels_0_data;
  fill_fetch fill_fetch_block (
      .clk(clk), .rst(rst), `PIPE_READS(fills),
      .asks_valid(asks_0_valid), .asks_ready(asks_0_ready), .asks_data(asks_0_data),
      .coded_pixels_valid(pixels_0_valid), .coded_pixels_ready(pixels_0_ready), .coded_pixels_data(pixels_0_data),
      `PIPE_WRITES(raw_reads), `PIPE_WRITES(kinds), `PIPE_WRITES(targets),
      .view(fetch_view), .object_coded(fetch_object_coded), .object_serial(fetch_object_serial),
      .object_block_columns(fetch_object_block_columns), .object_block_rows(fetch_object_block_rows),
      .object_raw_blocks(fetch_object_raw_blocks)
  );
  `HOP_CHAIN(0, 1, _out, _in)
  `HOP_CHAIN(1, 2, _out, _in)
  `HOP_CHAIN(2, 3, _out, _in)
  /* verilator lint_off UNUSEDSIGNAL */
  `HOP_CHAIN(3, 4, _out, _in)
  /* verilator lint_on UNUSEDSIGNAL */
  assign asks_4_ready = 1'b0;  // no record of the last hop is predicted
  assign complete_in_valid = pixels_4_valid;
  assign complete_in_data = pixels_4_data;
  assign pixels_4_ready = complete_in_ready;
  double_buffered_codebook double_buffered_codebook_block (
      .clk(clk), .rst(rst), `PIPE_PORT(book_jobs), .view_done_valid(view_done_books_out_valid),
      .view_done_ready(view_done_books_out_ready), .view_done_data(view_done_books_out_data), `PIPE_READS(complete),
      `PIPE_WRITES(book_reads), `PIPE_READS(book_words), `PIPE_WRITES(samples),
      .view(books_view), .object_serial(books_object_serial), .next_view(next_view),
      .next_object_coded(next_object_coded), .next_object_serial(next_object_serial),
      .next_object_books(next_object_books), .next_object_book_words(next_object_book_words),
      .next_object_flat_blocks(next_object_flat_blocks), .next_object_flat_quarters(next_object_flat_quarters),
      .next_object_predicted_blocks(next_object_predicted_blocks),
      .next_object_predicted_quarters(next_object_predicted_quarters)
  );
  texel_merge texel_merge_block (
      .clk(clk), .rst(rst), `PIPE_READS(kinds), `PIPE_READS(samples), `PIPE_READS(raw_words), `PIPE_WRITES(merged)
  );
  colour_conversion #(
      .ALPHA_BITS(8)
  ) colour_conversion_block (
      .clk(clk), .rst(rst),
      .samples_valid(merged_out_valid), .samples_ready(merged_out_ready), .samples_data(merged_out_data),
      .pixels_valid(texels_in_valid), .pixels_ready(texels_in_ready), .pixels_data(texels_in_data)
  );

  memory_controller #(
      .PORTS(19),
      .ROOM_BITS(ROOM_BITS),
      .IMAGE_WRITES_DEPTH(board::PARALLEL_IMAGE_WRITES_DEPTH)
  ) memory_controller_block (
      .clk(clk), .rst(rst),
      .reads_valid({`READ_PORTS(reads, out_valid), host_reads_valid}),
      .reads_ready({`READ_PORTS(reads, out_ready), host_reads_ready}),
      .reads_data({`READ_PORTS(reads, out_data), host_reads_data}),
      .words_valid({`READ_PORTS(words, in_valid), host_words_valid}),
      .words_data(host_words_data),
      .words_room({`READ_PORTS(words, room), ROOM_BITS'(host_words_room)}),
      `PIPE_READS(image_writes), .image_writes_count(image_writes_count),
      `PIPE_PORT(view_written), `PIPE_PORT(load_words), `PIPE_PORT(object_loaded),
      .sdram_command(sdram_command), .sdram_bank(sdram_bank), .sdram_row(sdram_row), .sdram_column(sdram_column),
      .sdram_write_data(sdram_write_data), .sdram_read_data(sdram_read_data)
  );
endmodule
