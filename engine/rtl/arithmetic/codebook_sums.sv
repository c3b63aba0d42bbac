// The codebooks of flat or of predicted records, and the sums of the entries of a look-up, in three stages: banks, pairs
// of entries, all entries. All stages stall while `moves` is 0. With ENTRY_BITS = 9 there are two sets of codebooks.
module codebook_sums #(
    parameter int ENTRY_BITS = 8
) (
    input  logic clk,
    input  logic moves,

    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [board::HOP_LOOKUP_BITS-1:0] lookup,  // hop_lookup_t
    input  logic second_set,
    /* verilator lint_on UNUSEDSIGNAL */
    output logic [32:0] sums,  // [Y, U, V] of 11 bits signed, Y in the low bits

    // A word of the codebooks: of bank 0 or 1 (blocks), or of bank 2 to 5 (quarters).
    input  logic write,
    input  logic [2:0] write_bank,
    input  logic [ENTRY_BITS-1:0] write_entry,
    input  logic [3:0] write_part,  // word of the entry
    input  logic [63:0] write_data
);
`include "messages.svh"

  /* verilator lint_off UNUSEDSIGNAL */
  hop_lookup_t in;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [1:0] y;  // in the quarter
  logic [2:0] x;
  logic [1:0] blocks;
  logic [2:0] quarters;
  logic chroma_row;
  assign in = lookup;
  always_ff @(posedge clk) begin
    if (moves) begin
      y <= in.y[1:0];
      x <= in.x;
      blocks <= in.block_stages;
      quarters <= in.quarter_stages;
    end
  end
  assign chroma_row = in.y[1];

  function automatic logic [7:0] byte_of(input logic [63:0] word, input logic [2:0] number);
    byte_of = word[{number, 3'b0}+:8];
  endfunction
  function automatic logic signed [8:0] sum_of(input logic [7:0] first, input logic [7:0] second);
    sum_of = {first[7], first} + {second[7], second};
  endfunction

  // Y, U, V of each stage, Y in the low bits; 0 behind the last one.
  logic [47:0] block_samples;    // [stage][plane]
  logic [95:0] quarter_samples;  // [stage][plane]
  logic [2:0] block_chroma, quarter_place;
  assign block_chroma = {y[1], x[2:1]};
  assign quarter_place = {y[0], x[1:0]};
  genvar stage, plane;
  generate
    for (stage = 0; stage < 2; stage = stage + 1) begin : block_banks
      logic [63:0] y_word, u_word, v_word;
      logic writes;
      assign writes = write && write_bank == 3'(stage);
      codebook_bank #(
          .ROW_BITS(3),
          .ENTRY_BITS(ENTRY_BITS)
      ) block_bank (
          .clk(clk), .write_y(writes && !write_part[3]), .write_u(writes && write_part[3:1] == 3'd4),
          .write_v(writes && write_part[3:1] == 3'd5), .write_entry(write_entry), .write_row(write_part[2:0]),
          .write_data(write_data), .read(moves),
          .entry(ENTRY_BITS'({second_set, in.block[8*stage+:8]})), .row(in.y), .chroma_row(in.y[2]),
          .y(y_word), .u(u_word), .v(v_word)
      );
      assign block_samples[24*stage+:24] = blocks <= 2'(stage) ? 24'd0 :
          {byte_of(v_word, block_chroma), byte_of(u_word, block_chroma), byte_of(y_word, x)};
    end
    for (stage = 0; stage < 4; stage = stage + 1) begin : quarter_banks
      logic [63:0] y_word, u_word, v_word;
      logic writes;
      assign writes = write && write_bank == 3'(stage + 2);
      codebook_bank #(
          .ROW_BITS(1),
          .ENTRY_BITS(ENTRY_BITS)
      ) quarter_bank (
          .clk(clk), .write_y(writes && write_part[2:1] == 2'd0), .write_u(writes && write_part[2:1] == 2'd1),
          .write_v(writes && write_part[2:1] == 2'd2), .write_entry(write_entry), .write_row(write_part[0]),
          .write_data(write_data), .read(moves),
          .entry(ENTRY_BITS'({second_set, in.quarter[8*stage+:8]})), .row(chroma_row),
          .chroma_row(chroma_row), .y(y_word), .u(u_word), .v(v_word)
      );
      assign quarter_samples[24*stage+:24] = quarters <= 3'(stage) ? 24'd0 :
          {byte_of(v_word, quarter_place), byte_of(u_word, quarter_place), byte_of(y_word, quarter_place)};
    end

    for (plane = 0; plane < 3; plane = plane + 1) begin : planes
      logic signed [8:0] block_sum, first_quarters, last_quarters;
      always_ff @(posedge clk) begin
        if (moves) begin
          block_sum <= sum_of(block_samples[8*plane+:8], block_samples[24+8*plane+:8]);
          first_quarters <= sum_of(quarter_samples[8*plane+:8], quarter_samples[24+8*plane+:8]);
          last_quarters <= sum_of(quarter_samples[48+8*plane+:8], quarter_samples[72+8*plane+:8]);
          sums[11*plane+:11] <= {{2{block_sum[8]}}, block_sum} + {{2{first_quarters[8]}}, first_quarters} +
                                {{2{last_quarters[8]}}, last_quarters};
        end
      end
    end
  endgenerate
endmodule
