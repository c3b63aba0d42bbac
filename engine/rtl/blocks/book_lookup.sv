// Codebook look-up (engine/model/blocks/decompression/book_lookup.hpp): adds the codebook entries of a pixel to its flat
// colour, in six stages. All stages stall while the last one holds a pixel that the output does not take.
//
//     1  addresses      3, 4  sums of the entries of flat and of predicted records     6  + prediction, clamp
//     2  banks          5     + flat colour, clamp
//
// A pixel with two or three predictions uses the predicted banks two or three times (turns), from the last hop to the
// first; stage 6 adds to its own result then.
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
  localparam int LOOKUP_BITS = board::HOP_LOOKUP_BITS;

  //---- Pixel --------------------------------------------------------------------------------------------------------
  // Without row and column, `begins` and `is_pending` of the hop behind the last one.
  /* verilator lint_off UNUSEDSIGNAL */
  coded_pixel_t in;
  hop_lookup_t hop_0, hop_1, hop_2, hop_3;
  /* verilator lint_on UNUSEDSIGNAL */
  coded_colour_t colour;
  assign in = complete_data[board::CODED_COLOUR_BITS+4*LOOKUP_BITS+:board::CODED_PIXELS_BITS];
  assign colour = complete_data[4*LOOKUP_BITS+:board::CODED_COLOUR_BITS];
  assign hop_0 = complete_data[3*LOOKUP_BITS+:LOOKUP_BITS];
  assign hop_1 = complete_data[2*LOOKUP_BITS+:LOOKUP_BITS];
  assign hop_2 = complete_data[LOOKUP_BITS+:LOOKUP_BITS];
  assign hop_3 = complete_data[0+:LOOKUP_BITS];
  assign view = in.view;

  logic [1:0] predictions, turn;  // predictions: the hops before the last one
  logic is_last_turn;
  hop_lookup_t flat, predicted;
  assign predictions = !hop_0.is_predicted ? 2'd0 : !hop_1.is_predicted ? 2'd1 : !hop_2.is_predicted ? 2'd2 : 2'd3;
  assign is_last_turn = predictions <= turn + 2'd1;
  always_comb begin
    flat = predictions == 2'd0 ? hop_0 : predictions == 2'd1 ? hop_1 : predictions == 2'd2 ? hop_2 : hop_3;
    predicted = predictions - turn == 2'd3 ? hop_2 : predictions - turn == 2'd2 ? hop_1 : hop_0;
    if (predictions == 2'd0) begin
      predicted.block_stages = 2'd0;
      predicted.quarter_stages = 3'd0;
    end
  end

  //---- Control ------------------------------------------------------------------------------------------------------
  logic [STAGES:1] valid;  // the last turn of a pixel is in the stage
  logic [31:0] resident;   // load of the object whose codebooks are in the banks; 0: none
  logic loading, starts, is_other, enters, moves;
  assign moves = !loading && (!valid[STAGES] || samples_ready);
  assign is_other = in.is_visible && object_serial != resident;
  assign starts = !loading && complete_valid && is_other && valid == '0;
  assign enters = moves && complete_valid && !is_other;  // a turn
  assign complete_ready = moves && !is_other && is_last_turn;
  assign samples_valid = valid[STAGES];

  //---- Load of codebooks --------------------------------------------------------------------------------------------
  // In the order of their codebooks: 2 banks of blocks and 4 of quarters for flat records, and for predicted ones; alpha.
  localparam logic [3:0] PREDICTED_BANKS = 4'd6;
  localparam logic [3:0] ALPHA_BANK = 4'd12;
  logic [14:0] requested, written, written_next;
  logic [11:0] exists;  // bank
  logic [3:0] bank, next_bank;
  logic [7:0] entry;
  logic [3:0] part, last_part;  // word of the entry
  logic takes_word, is_block_bank, is_alpha_bank, is_loaded;
  memory_read_t read;
  assign read.address = object_books + {12'd0, requested};
  assign read.is_null = 1'b0;
  assign book_reads_data = read;
  assign book_reads_valid = (loading || starts) && requested < object_book_words;
  assign book_words_ready = loading || starts;
  assign takes_word = book_words_ready && book_words_valid;
  assign written_next = written + {14'd0, takes_word};
  assign is_loaded = (loading || starts) && written_next == object_book_words;

  assign exists = {object_predicted_quarters > 3'd3, object_predicted_quarters > 3'd2, object_predicted_quarters > 3'd1,
                   object_predicted_quarters > 3'd0, object_predicted_blocks > 2'd1, object_predicted_blocks > 2'd0,
                   object_flat_quarters > 3'd3, object_flat_quarters > 3'd2, object_flat_quarters > 3'd1,
                   object_flat_quarters > 3'd0, object_flat_blocks > 2'd1, object_flat_blocks > 2'd0};
  always_comb begin
    next_bank = ALPHA_BANK;
    for (int n = 11; n >= 0; n = n - 1) if (exists[n] && (starts || 4'(n) > bank)) next_bank = 4'(n);
  end
  assign is_block_bank = bank[3:1] == 3'd0 || bank[3:1] == 3'd3;
  assign is_alpha_bank = bank == ALPHA_BANK;
  assign last_part = is_alpha_bank ? 4'd1 : is_block_bank ? 4'd11 : 4'd5;

  always_ff @(posedge clk) begin
    if (rst) begin
      loading <= 1'b0;
      resident <= 32'd0;
      requested <= 15'd0;
      written <= 15'd0;
    end else begin
      loading <= (loading || starts) && !is_loaded;
      if (is_loaded) resident <= object_serial;
      if (is_loaded) requested <= 15'd0;
      else if (book_reads_valid && book_reads_ready) requested <= requested + 15'd1;
      written <= is_loaded ? 15'd0 : written_next;
    end

    if (starts) begin
      bank <= next_bank;
      entry <= 8'd0;
      part <= 4'd0;
    end else if (takes_word) begin
      part <= part == last_part ? 4'd0 : part + 4'd1;
      if (part == last_part) entry <= entry + 8'd1;
      if (part == last_part && entry == 8'd255) bank <= next_bank;
    end
  end

  //---- Stages -------------------------------------------------------------------------------------------------------
  always_ff @(posedge clk) begin
    if (rst) begin
      valid <= '0;
      turn <= 2'd0;
    end else begin
      if (moves) valid <= {valid[STAGES-1:1], enters && is_last_turn};
      if (enters) turn <= is_last_turn ? 2'd0 : turn + 2'd1;
    end
  end

  // View, whether the pixel is empty, and is this its first turn; in stages 1 and 2 whether alpha is in the codebook.
  logic [5:0] rest_1, rest_2, rest_3, rest_4, rest_5;
  logic has_alpha_1, has_alpha_2;
  logic [23:0] colour_1, colour_2, colour_3, colour_4;
  hop_lookup_t flat_1, predicted_1;
  logic [7:0] alpha_entry_1;
  logic [3:0] alpha_place_1;  // y, x in the quarter
  logic [2:0] alpha_byte_2;
  always_ff @(posedge clk) begin
    if (moves) begin
      rest_1 <= {in.view, !in.is_visible || colour.alpha == 2'(board::ALPHA_NONE), turn == 2'd0};
      has_alpha_1 <= colour.alpha == 2'(board::ALPHA_BOOK);
      colour_1 <= colour.flat;
      flat_1 <= flat;
      predicted_1 <= predicted;
      alpha_entry_1 <= colour.alpha_entry;
      alpha_place_1 <= {hop_0.y[1:0], hop_0.x[1:0]};
      rest_2 <= rest_1;
      has_alpha_2 <= has_alpha_1;
      colour_2 <= colour_1;
      alpha_byte_2 <= alpha_place_1[2:0];
      rest_3 <= rest_2;
      colour_3 <= colour_2;
      rest_4 <= rest_3;
      colour_4 <= colour_3;
      rest_5 <= rest_4;
    end
  end

  // Sums of the entries of flat and of predicted records.
  logic [32:0] flat_sums_4, predicted_sums_4;
  codebook_sums flat_sums (
      .clk(clk), .moves(moves), .lookup(flat_1), .sums(flat_sums_4),
      .write(takes_word && bank < PREDICTED_BANKS), .write_bank(bank[2:0]), .write_entry(entry), .write_part(part),
      .write_data(book_words_data)
  );
  codebook_sums predicted_sums (
      .clk(clk), .moves(moves), .lookup(predicted_1), .sums(predicted_sums_4),
      .write(takes_word && bank >= PREDICTED_BANKS && !is_alpha_bank), .write_bank(3'(bank - PREDICTED_BANKS)),
      .write_entry(entry), .write_part(part), .write_data(book_words_data)
  );

  // Alpha, in place with the turn.
  logic [63:0] alpha_word;
  logic [7:0] alpha_3, alpha_4, alpha_5, alpha_6;
  dual_port_ram #(
      .WIDTH(64),
      .ADDRESS_BITS(9)
  ) alpha_ram (
      .clk(clk),
      .write(takes_word && is_alpha_bank),
      .write_address({entry, part[0]}),
      .write_data(book_words_data),
      .read(moves),
      .read_address({alpha_entry_1, alpha_place_1[3]}),
      .read_data(alpha_word)
  );

  function automatic logic [7:0] clamped(input logic [7:0] sample, input logic [10:0] sum);
    logic [11:0] total;  // signed
    total = {4'd0, sample} + {sum[10], sum};
    clamped = total[11] ? 8'd0 : total[10:8] != 3'd0 ? 8'd255 : total[7:0];
  endfunction
  logic [23:0] colour_5, colour_6;
  logic [32:0] prediction_5;
  logic [3:0] view_6;
  logic is_first_5, is_empty_5;
  assign is_first_5 = rest_5[0];
  assign is_empty_5 = rest_5[1];
  always_ff @(posedge clk) begin
    if (moves) begin
      alpha_3 <= has_alpha_2 ? alpha_word[{alpha_byte_2, 3'b0}+:8] : 8'd255;
      alpha_4 <= alpha_3;
      alpha_5 <= alpha_4;
      alpha_6 <= is_empty_5 ? 8'd0 : alpha_5;

      prediction_5 <= predicted_sums_4;
      for (int n = 0; n < 3; n = n + 1) begin
        colour_5[8*n+:8] <= clamped(colour_4[8*n+:8], flat_sums_4[11*n+:11]);
        colour_6[8*n+:8] <= is_empty_5 ? 8'd0 :
                            clamped(is_first_5 ? colour_5[8*n+:8] : colour_6[8*n+:8], prediction_5[11*n+:11]);
      end
      view_6 <= rest_5[5:2];
    end
  end

  yuv_pixel_t sample;
  assign sample.view = view_6;
  assign sample.y = colour_6[7:0];
  assign sample.u = colour_6[15:8];
  assign sample.v = colour_6[23:16];
  assign samples_data = {sample, alpha_6};
endmodule
