// The chain of readers of a hop (HopBlocks of engine/model/block_decompression.hpp): requests and pixels enter, pixels
// with their records leave, and the requests of the next hop. The FIFOs of memory and of the next hop belong to the
// surroundings. Register look-ups are named by their block.
`include "fifos.svh"

module record_chain #(
    parameter int HOP = 0,
    parameter int DEPTH = 2,  // of the FIFOs between the readers
    parameter int ASKS_DEPTH = 4,
    parameter int RECORDS_DEPTH = 4,
    parameter int PIXELS_DEPTH = 4
) (
    input  logic clk,
    input  logic rst,

    input  logic asks_valid,
    output logic asks_ready,
    input  logic [board::ASKS_BITS-1:0] asks_data,
    input  logic pixels_valid,
    output logic pixels_ready,
    input  logic [board::CODED_PIXELS_BITS+(HOP > 0 ? board::CODED_COLOUR_BITS+HOP*board::HOP_LOOKUP_BITS : 0)-1:0] pixels_data,
    output logic next_asks_valid,
    input  logic next_asks_ready,
    output logic [board::ASKS_BITS-1:0] next_asks_data,
    output logic next_pixels_valid,
    input  logic next_pixels_ready,
    output logic [board::CODED_PIXELS_BITS+board::CODED_COLOUR_BITS+(HOP+1)*board::HOP_LOOKUP_BITS-1:0] next_pixels_data,

    output logic table_reads_valid,
    input  logic table_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] table_reads_data,
    input  logic table_words_valid,
    output logic table_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] table_words_data,
    output logic tile_reads_valid,
    input  logic tile_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] tile_reads_data,
    input  logic tile_words_valid,
    output logic tile_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] tile_words_data,
    output logic record_reads_valid,
    input  logic record_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] record_reads_data,
    input  logic record_words_valid,
    output logic record_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] record_words_data,
    output logic [board::VIEW_BITS-1:0] finder_view,
    input  logic [4:0] finder_object_tile_columns,
    input  logic [4:0] finder_object_table_pitch,
    input  logic [board::ADDRESS_BITS-1:0] finder_object_tile_table,
    output logic [board::VIEW_BITS-1:0] reader_view,
    input  logic [31:0] reader_object_record_sizes,
    input  logic [31:0] reader_object_predicted_sizes,
    output logic [board::VIEW_BITS-1:0] motion_view,
    input  logic [63:0] motion_object_classes,
    input  logic [63:0] motion_object_predicted_classes,
    input  logic [board::IMAGE_SIDE_BITS-1:0] motion_object_coded_width,
    input  logic [board::IMAGE_SIDE_BITS-1:0] motion_object_coded_height,
    output logic [board::VIEW_BITS-1:0] select_view,
    input  logic [board::IMAGE_SIDE_BITS-1:0] select_object_coded_height
);
  localparam int PIXEL_BITS =
      board::CODED_PIXELS_BITS + (HOP > 0 ? board::CODED_COLOUR_BITS + HOP * board::HOP_LOOKUP_BITS : 0);

  `FIFO(requests, board::ASKS_BITS, ASKS_DEPTH)
  `FIFO(found, board::FOUND_BITS, DEPTH)
  `FIFO(tiles, board::TILES_BITS, DEPTH)
  `FIFO(asked_records, board::ASKED_RECORDS_BITS, DEPTH)
  `FIFO(records, board::RECORDS_BITS, RECORDS_DEPTH)
  `FIFO(coded_pixels, PIXEL_BITS, PIXELS_DEPTH)
  assign requests_in_valid = asks_valid;
  assign requests_in_data = asks_data;
  assign asks_ready = requests_in_ready;
  assign coded_pixels_in_valid = pixels_valid;
  assign coded_pixels_in_data = pixels_data;
  assign pixels_ready = coded_pixels_in_ready;

  tile_finder tile_finder_block (
      .clk(clk), .rst(rst), .asks_valid(requests_out_valid), .asks_ready(requests_out_ready),
      .asks_data(requests_out_data), `PIPE_PORT(table_reads), `PIPE_WRITES(found),
      .view(finder_view), .object_tile_columns(finder_object_tile_columns),
      .object_table_pitch(finder_object_table_pitch), .object_tile_table(finder_object_tile_table)
  );
  tile_reader tile_reader_block (
      .clk(clk), .rst(rst), `PIPE_READS(found), `PIPE_PORT(table_words), `PIPE_PORT(tile_reads), `PIPE_WRITES(tiles)
  );
  record_reader record_reader_block (
      .clk(clk), .rst(rst), `PIPE_READS(tiles), `PIPE_PORT(tile_words), `PIPE_PORT(record_reads),
      `PIPE_WRITES(asked_records),
      .view(reader_view), .object_record_sizes(reader_object_record_sizes),
      .object_predicted_sizes(reader_object_predicted_sizes)
  );
  block_motion block_motion_block (
      .clk(clk), .rst(rst), `PIPE_READS(asked_records), `PIPE_PORT(record_words), `PIPE_WRITES(records),
      .asks_valid(next_asks_valid), .asks_ready(next_asks_ready), .asks_data(next_asks_data),
      .view(motion_view), .object_classes(motion_object_classes),
      .object_predicted_classes(motion_object_predicted_classes), .object_coded_width(motion_object_coded_width),
      .object_coded_height(motion_object_coded_height)
  );
  record_select #(
      .HOP(HOP)
  ) record_select_block (
      .clk(clk), .rst(rst), `PIPE_READS(coded_pixels), `PIPE_READS(records), `PIPE_PORT(next_pixels),
      .view(select_view), .object_coded_height(select_object_coded_height)
  );
endmodule
