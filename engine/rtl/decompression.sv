// Block decompression of compressed-2000 (engine/model/block_decompression.hpp): every block between the columns of a view
// and the samples of its pixels, with the FIFOs between them. Those at the ports belong to the surroundings: columns,
// samples, requests and words of the memory. Register look-ups are named by their block, and by the hop of its chain.
`include "fifos.svh"
`include "hop_chain.svh"

// Memory ports and register look-ups of a hop.
`define HOP_PORTS(hop) \
    output logic table_reads_``hop``_valid, \
    input  logic table_reads_``hop``_ready, \
    output logic [board::SAMPLE_READS_BITS-1:0] table_reads_``hop``_data, \
    input  logic table_words_``hop``_valid, \
    output logic table_words_``hop``_ready, \
    input  logic [board::SAMPLE_WORDS_BITS-1:0] table_words_``hop``_data, \
    output logic tile_reads_``hop``_valid, \
    input  logic tile_reads_``hop``_ready, \
    output logic [board::SAMPLE_READS_BITS-1:0] tile_reads_``hop``_data, \
    input  logic tile_words_``hop``_valid, \
    output logic tile_words_``hop``_ready, \
    input  logic [board::SAMPLE_WORDS_BITS-1:0] tile_words_``hop``_data, \
    output logic record_reads_``hop``_valid, \
    input  logic record_reads_``hop``_ready, \
    output logic [board::SAMPLE_READS_BITS-1:0] record_reads_``hop``_data, \
    input  logic record_words_``hop``_valid, \
    output logic record_words_``hop``_ready, \
    input  logic [board::SAMPLE_WORDS_BITS-1:0] record_words_``hop``_data, \
    `HOP_REGISTERS(hop)

module decompression (
    input  logic clk,
    input  logic rst,

    input  logic walks_valid,
    output logic walks_ready,
    input  logic [board::WALKS_BITS-1:0] walks_data,
    output logic samples_valid,
    input  logic samples_ready,
    output logic [board::YUV_BITS+8-1:0] samples_data,

    `HOP_PORTS(0),
    `HOP_PORTS(1),
    `HOP_PORTS(2),
    `HOP_PORTS(3),

    output logic [board::VIEW_BITS-1:0] scan_view,
    input  logic [board::VIEW_SIDE_BITS-1:0] scan_view_height,
    input  logic [board::IMAGE_SIDE_BITS-1:0] scan_object_height,

    output logic book_reads_valid,
    input  logic book_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] book_reads_data,
    input  logic book_words_valid,
    output logic book_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] book_words_data,
    output logic [board::VIEW_BITS-1:0] books_view,
    input  logic [31:0] books_object_serial,
    input  logic [board::ADDRESS_BITS-1:0] books_object_books,
    input  logic [14:0] books_object_book_words,
    input  logic [1:0] books_object_flat_blocks,
    input  logic [2:0] books_object_flat_quarters,
    input  logic [1:0] books_object_predicted_blocks,
    input  logic [2:0] books_object_predicted_quarters
);
  logic asks_0_valid, asks_0_ready, pixels_0_valid, pixels_0_ready;
  logic [board::ASKS_BITS-1:0] asks_0_data;
  logic [board::CODED_PIXELS_BITS-1:0] pixels_0_data;
  block_scan block_scan_block (
      .clk(clk), .rst(rst), `PIPE_PORT(walks),
      .asks_valid(asks_0_valid), .asks_ready(asks_0_ready), .asks_data(asks_0_data),
      .coded_pixels_valid(pixels_0_valid), .coded_pixels_ready(pixels_0_ready), .coded_pixels_data(pixels_0_data),
      .view(scan_view), .view_height(scan_view_height), .object_height(scan_object_height)
  );

  `HOP_CHAIN(0, 1, , )
  `HOP_CHAIN(1, 2, , )
  `HOP_CHAIN(2, 3, , )
  /* verilator lint_off UNUSEDSIGNAL */
  `HOP_CHAIN(3, 4, , )
  /* verilator lint_on UNUSEDSIGNAL */
  assign asks_4_ready = 1'b0;  // no record of the last hop is predicted

  `PIPE_FIFO(complete, COMPLETE)
  assign complete_in_valid = pixels_4_valid;
  assign complete_in_data = pixels_4_data;
  assign pixels_4_ready = complete_in_ready;
  book_lookup book_lookup_block (
      .clk(clk), .rst(rst), `PIPE_READS(complete), `PIPE_PORT(book_reads), `PIPE_PORT(book_words), `PIPE_PORT(samples),
      .view(books_view), .object_serial(books_object_serial), .object_books(books_object_books),
      .object_book_words(books_object_book_words), .object_flat_blocks(books_object_flat_blocks),
      .object_flat_quarters(books_object_flat_quarters), .object_predicted_blocks(books_object_predicted_blocks),
      .object_predicted_quarters(books_object_predicted_quarters)
  );
endmodule
