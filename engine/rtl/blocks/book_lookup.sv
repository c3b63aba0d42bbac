// Codebook look-up (engine/model/blocks/decompression/book_lookup.hpp): adds the codebook entries of a pixel to its flat
// colour, in the six stages of codebook_stages. All stages stall while the last one holds a pixel that the output does not
// take.
//
// The banks hold the codebooks of one object. A pixel of another object waits until all pixels before it have left; then
// its codebooks are read, a word per cycle.
module book_lookup (
    input  logic clk,
    input  logic rst,

    input  logic complete_valid,
    output logic complete_ready,
    input  logic [board::COMPLETE_BITS-1:0] complete_data,

    output logic book_reads_valid,
    input  logic book_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] book_reads_data,
    input  logic book_words_valid,
    output logic book_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] book_words_data,

    output logic samples_valid,
    input  logic samples_ready,
    output logic [board::YUV_BITS+8-1:0] samples_data,

    // Register file: the object of `view`, and the numbers of its codebooks.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [31:0] object_serial,  // of its load, from 1
    input  logic [board::ADDRESS_BITS-1:0] object_books,
    input  logic [14:0] object_book_words,
    input  logic [1:0] object_flat_blocks,
    input  logic [2:0] object_flat_quarters,
    input  logic [1:0] object_predicted_blocks,
    input  logic [2:0] object_predicted_quarters
);
`include "messages.svh"

  localparam int STAGES = board::BOOK_STAGES;

  /* verilator lint_off UNUSEDSIGNAL */
  coded_pixel_t in;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [1:0] turn;
  logic is_last_turn;
  logic [STAGES:1] valid;  // the last turn of a pixel is in the stage
  logic [31:0] resident;   // load of the object whose codebooks are in the banks; 0: none
  logic loading, starts, is_loaded, is_other, enters, moves;
  assign in = complete_data[board::CODED_COLOUR_BITS+4*board::HOP_LOOKUP_BITS+:board::CODED_PIXELS_BITS];
  assign view = in.view;
  assign moves = !loading && (!valid[STAGES] || samples_ready);
  assign is_other = in.is_visible && object_serial != resident;
  assign starts = !loading && complete_valid && is_other && valid == '0;
  assign enters = moves && complete_valid && !is_other;  // a turn
  assign complete_ready = moves && !is_other && is_last_turn;
  assign samples_valid = valid[STAGES];
  always_ff @(posedge clk) begin
    if (rst) begin
      loading <= 1'b0;
      resident <= 32'd0;
      valid <= '0;
      turn <= 2'd0;
    end else begin
      loading <= (loading || starts) && !is_loaded;
      if (is_loaded) resident <= object_serial;
      if (moves) valid <= {valid[STAGES-1:1], enters && is_last_turn};
      if (enters) turn <= is_last_turn ? 2'd0 : turn + 2'd1;
    end
  end

  logic write;
  logic [3:0] bank, part;
  logic [7:0] entry;
  codebook_loader loader (
      .clk(clk), .rst(rst), .begins(starts), .loading(loading || starts), .is_loaded(is_loaded),
      .book_reads_valid(book_reads_valid), .book_reads_ready(book_reads_ready), .book_reads_data(book_reads_data),
      .book_words_valid(book_words_valid), .book_words_ready(book_words_ready), .write(write), .bank(bank),
      .entry(entry), .part(part), .books(object_books), .book_words(object_book_words),
      .flat_blocks(object_flat_blocks), .flat_quarters(object_flat_quarters),
      .predicted_blocks(object_predicted_blocks), .predicted_quarters(object_predicted_quarters)
  );
  codebook_stages #(
      .ENTRY_BITS(8)
  ) stages (
      .clk(clk), .moves(moves), .complete_data(complete_data), .turn(turn), .second_set(1'b0), .is_last_turn(is_last_turn),
      .samples_data(samples_data), .write(write), .write_bank(bank), .write_entry(entry), .write_part(part),
      .write_data(book_words_data)
  );
endmodule
