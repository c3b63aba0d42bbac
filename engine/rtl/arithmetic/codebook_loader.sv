// Load of an object's codebooks: a request and a word per cycle. The words come in the order of the banks of
// codebook_stages; books that the object lacks are left out.
module codebook_loader (
    input  logic clk,
    input  logic rst,

    input  logic begins,   // with the first bank; the registers must be valid from this cycle to the last word
    input  logic loading,
    output logic is_loaded,

    output logic book_reads_valid,
    input  logic book_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] book_reads_data,
    input  logic book_words_valid,
    output logic book_words_ready,

    // Bank, entry and place of the word that is taken.
    output logic write,
    output logic [3:0] bank,
    output logic [7:0] entry,
    output logic [3:0] part,

    // Registers of the object.
    input  logic [board::ADDRESS_BITS-1:0] books,
    input  logic [14:0] book_words,
    input  logic [1:0] flat_blocks,
    input  logic [2:0] flat_quarters,
    input  logic [1:0] predicted_blocks,
    input  logic [2:0] predicted_quarters
);
`include "messages.svh"

  localparam logic [3:0] ALPHA_BANK = 4'd12;
  logic [14:0] requested, written, written_next;
  logic [11:0] exists;  // bank
  logic [3:0] next_bank, last_part;
  logic is_block_bank;
  memory_read_t read;
  assign read.address = books + {12'd0, requested};
  assign read.is_null = 1'b0;
  assign book_reads_data = read;
  assign book_reads_valid = loading && requested < book_words;
  assign book_words_ready = loading;
  assign write = book_words_ready && book_words_valid;
  assign written_next = written + {14'd0, write};
  assign is_loaded = loading && written_next == book_words;

  assign exists = {predicted_quarters > 3'd3, predicted_quarters > 3'd2, predicted_quarters > 3'd1,
                   predicted_quarters > 3'd0, predicted_blocks > 2'd1, predicted_blocks > 2'd0,
                   flat_quarters > 3'd3, flat_quarters > 3'd2, flat_quarters > 3'd1, flat_quarters > 3'd0,
                   flat_blocks > 2'd1, flat_blocks > 2'd0};
  always_comb begin
    next_bank = ALPHA_BANK;
    for (int n = 11; n >= 0; n = n - 1) if (exists[n] && (begins || 4'(n) > bank)) next_bank = 4'(n);
  end
  assign is_block_bank = bank[3:1] == 3'd0 || bank[3:1] == 3'd3;
  assign last_part = bank == ALPHA_BANK ? 4'd1 : is_block_bank ? 4'd11 : 4'd5;

  always_ff @(posedge clk) begin
    if (rst) begin
      requested <= 15'd0;
      written <= 15'd0;
    end else begin
      if (is_loaded) requested <= 15'd0;
      else if (book_reads_valid && book_reads_ready) requested <= requested + 15'd1;
      written <= is_loaded ? 15'd0 : written_next;
    end

    if (begins) begin
      bank <= next_bank;
      entry <= 8'd0;
      part <= 4'd0;
    end else if (write) begin
      part <= part == last_part ? 4'd0 : part + 4'd1;
      if (part == last_part) entry <= entry + 8'd1;
      if (part == last_part && entry == 8'd255) bank <= next_bank;
    end
  end
endmodule
