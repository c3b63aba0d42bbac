// Codebook look-up with two sets of codebooks (engine/model/blocks/texels/double_buffered_codebook.hpp), in the six stages
// of codebook_stages. All stages stall while the last one holds a pixel that the output does not take.
//
// The views are known in advance, in order. If neither set holds the codebooks of the next view's object, they are read, a
// word per cycle, into the set that was needed less recently, once its views are done. Pixels of other objects pass
// meanwhile; a pixel waits until its codebooks are loaded. At most 15 views are not done.
module double_buffered_codebook (
    input  logic clk,
    input  logic rst,

    input  logic book_jobs_valid,
    output logic book_jobs_ready,
    input  logic [board::JOBS_BITS-1:0] book_jobs_data,
    input  logic view_done_valid,
    output logic view_done_ready,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic view_done_data,  // without content
    /* verilator lint_on UNUSEDSIGNAL */
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

    // Register file: the object of the pixel's `view`; that of `next_view`, and the numbers of its codebooks.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [31:0] object_serial,  // of its load, from 1
    output logic [board::VIEW_BITS-1:0] next_view,
    input  logic next_object_coded,
    input  logic [31:0] next_object_serial,
    input  logic [board::ADDRESS_BITS-1:0] next_object_books,
    input  logic [14:0] next_object_book_words,
    input  logic [1:0] next_object_flat_blocks,
    input  logic [2:0] next_object_flat_quarters,
    input  logic [1:0] next_object_predicted_blocks,
    input  logic [2:0] next_object_predicted_quarters
);
`include "messages.svh"

  localparam int STAGES = board::BOOK_STAGES;

  //---- Views and their sets -----------------------------------------------------------------------------------------
  view_job_t job;
  logic [31:0] serial_0, serial_1;    // load of the object whose codebooks are in the set; 0: none
  logic [5:0] left_0, left_1;         // views until the last one that needs the set is done
  logic [5:0] left_0_now, left_1_now;
  logic [5:0] ahead, ahead_now, left_new;  // signed: views taken that are not done
  logic first_is_newer;               // the first set was needed by a later view than the second one
  logic loading, loading_set;
  logic is_in_first, is_in_second, may_take, takes, begins, is_loaded, used_set;
  assign job = book_jobs_data;
  assign next_view = job.view;
  assign view_done_ready = 1'b1;
  assign ahead_now = ahead - 6'(view_done_valid);
  assign left_0_now = left_0 - 6'(view_done_valid && left_0 != 6'd0);
  assign left_1_now = left_1 - 6'(view_done_valid && left_1 != 6'd0);
  assign is_in_first = serial_0 == next_object_serial;
  assign is_in_second = serial_1 == next_object_serial;
  assign may_take = !next_object_coded || is_in_first || is_in_second ||
                    (first_is_newer ? left_1_now : left_0_now) == 6'd0;
  assign book_jobs_ready = !loading && may_take;
  assign takes = book_jobs_valid && book_jobs_ready;
  assign begins = takes && next_object_coded && !is_in_first && !is_in_second;
  assign used_set = is_in_first ? 1'b0 : is_in_second || first_is_newer;
  // A view may be done before it is taken, if all its pixels are empty.
  assign left_new = ahead_now[5] ? 6'd0 : ahead_now + 6'd1;

  // Object whose codebooks are loaded.
  logic [31:0] kept_serial;
  logic [board::ADDRESS_BITS-1:0] kept_books;
  logic [14:0] kept_book_words;
  logic [9:0] next_counts, kept_counts, counts;
  assign next_counts = {next_object_flat_blocks, next_object_flat_quarters, next_object_predicted_blocks,
                        next_object_predicted_quarters};
  assign counts = begins ? next_counts : kept_counts;
  always_ff @(posedge clk) begin
    if (rst) begin
      serial_0 <= 32'd0;
      serial_1 <= 32'd0;
      left_0 <= 6'd0;
      left_1 <= 6'd0;
      ahead <= 6'd0;
      first_is_newer <= 1'b0;
      loading <= 1'b0;
    end else begin
      ahead <= ahead_now + 6'(takes);
      left_0 <= takes && next_object_coded && !used_set ? left_new : left_0_now;
      left_1 <= takes && next_object_coded && used_set ? left_new : left_1_now;
      if (takes && next_object_coded) first_is_newer <= !used_set;
      loading <= begins || (loading && !is_loaded);
      if (begins && !used_set) serial_0 <= 32'd0;
      else if (is_loaded && !loading_set) serial_0 <= kept_serial;
      if (begins && used_set) serial_1 <= 32'd0;
      else if (is_loaded && loading_set) serial_1 <= kept_serial;
    end

    if (begins) begin
      loading_set <= used_set;
      kept_serial <= next_object_serial;
      kept_books <= next_object_books;
      kept_book_words <= next_object_book_words;
      kept_counts <= next_counts;
    end
  end

  logic write;
  logic [3:0] bank, part;
  logic [7:0] entry;
  codebook_loader loader (
      .clk(clk), .rst(rst), .begins(begins), .loading(loading), .is_loaded(is_loaded),
      .book_reads_valid(book_reads_valid), .book_reads_ready(book_reads_ready), .book_reads_data(book_reads_data),
      .book_words_valid(book_words_valid), .book_words_ready(book_words_ready), .write(write), .bank(bank),
      .entry(entry), .part(part), .books(kept_books), .book_words(kept_book_words), .flat_blocks(counts[9:8]),
      .flat_quarters(counts[7:5]), .predicted_blocks(counts[4:3]), .predicted_quarters(counts[2:0])
  );

  //---- Pixels -------------------------------------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  coded_pixel_t in;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [STAGES:1] valid;  // the last turn of a pixel is in the stage
  logic [1:0] turn;
  logic is_last_turn, is_pixel_of_first, has_books, enters, moves;
  assign in = complete_data[board::CODED_COLOUR_BITS+4*board::HOP_LOOKUP_BITS+:board::CODED_PIXELS_BITS];
  assign view = in.view;
  assign is_pixel_of_first = object_serial == serial_0;
  assign has_books = is_pixel_of_first || object_serial == serial_1;
  assign moves = !valid[STAGES] || samples_ready;
  assign enters = moves && complete_valid && has_books;  // a turn
  assign complete_ready = moves && has_books && is_last_turn;
  assign samples_valid = valid[STAGES];
  always_ff @(posedge clk) begin
    if (rst) begin
      valid <= '0;
      turn <= 2'd0;
    end else begin
      if (moves) valid <= {valid[STAGES-1:1], enters && is_last_turn};
      if (enters) turn <= is_last_turn ? 2'd0 : turn + 2'd1;
    end
  end
  codebook_stages #(
      .ENTRY_BITS(9)
  ) stages (
      .clk(clk), .moves(moves), .complete_data(complete_data), .turn(turn), .second_set(!is_pixel_of_first),
      .is_last_turn(is_last_turn), .samples_data(samples_data), .write(write), .write_bank(bank),
      .write_entry({loading_set, entry}), .write_part(part), .write_data(book_words_data)
  );
endmodule
