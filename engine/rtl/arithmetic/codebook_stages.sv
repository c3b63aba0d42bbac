// Six stages of a codebook look-up: the entries of a pixel are added to its flat colour. All stages stall while `moves` is
// 0.
//
//     1  addresses      3, 4  sums of the entries of flat and of predicted records     6  + prediction, clamp
//     2  banks          5     + flat colour, clamp
//
// A pixel with two or three predictions uses the predicted banks two or three times (turns), from the last hop to the
// first; stage 6 adds to its own result then. With ENTRY_BITS = 9 the banks hold two sets of codebooks.
module codebook_stages #(
    parameter int ENTRY_BITS = 8
) (
    input  logic clk,
    input  logic moves,

    // A pixel, the number of its turn, its set of codebooks.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [board::COMPLETE_BITS-1:0] complete_data,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic [1:0] turn,
    input  logic second_set,
    output logic is_last_turn,
    output logic [board::YUV_BITS+8-1:0] samples_data,

    // A word of the codebooks: 2 banks of blocks and 4 of quarters for flat records, and for predicted ones; alpha.
    input  logic write,
    input  logic [3:0] write_bank,
    input  logic [ENTRY_BITS-1:0] write_entry,
    input  logic [3:0] write_part,  // word of the entry
    input  logic [63:0] write_data
);
`include "messages.svh"

  localparam int LOOKUP_BITS = board::HOP_LOOKUP_BITS;
  localparam logic [3:0] PREDICTED_BANKS = 4'd6;
  localparam logic [3:0] ALPHA_BANK = 4'd12;

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

  logic [1:0] predictions;  // the hops before the last one
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

  // View, whether the pixel is empty, and is this its first turn; in stages 1 and 2 whether alpha is in the codebook.
  logic [5:0] rest_1, rest_2, rest_3, rest_4, rest_5;
  logic has_alpha_1, has_alpha_2;
  logic [23:0] colour_1, colour_2, colour_3, colour_4;
  hop_lookup_t flat_1, predicted_1;
  logic set_1;
  logic [7:0] alpha_entry_1;
  logic [3:0] alpha_place_1;  // y, x in the quarter
  logic [2:0] alpha_byte_2;
  always_ff @(posedge clk) begin
    if (moves) begin
      rest_1 <= {in.view, !in.is_visible || colour.alpha == 2'(board::ALPHA_NONE), turn == 2'd0};
      has_alpha_1 <= colour.alpha == 2'(board::ALPHA_BOOK);
      colour_1 <= colour.flat;
      flat_1 <= flat;
      set_1 <= second_set;
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
  codebook_sums #(
      .ENTRY_BITS(ENTRY_BITS)
  ) flat_sums (
      .clk(clk), .moves(moves), .lookup(flat_1), .second_set(set_1), .sums(flat_sums_4),
      .write(write && write_bank < PREDICTED_BANKS), .write_bank(write_bank[2:0]), .write_entry(write_entry),
      .write_part(write_part), .write_data(write_data)
  );
  codebook_sums #(
      .ENTRY_BITS(ENTRY_BITS)
  ) predicted_sums (
      .clk(clk), .moves(moves), .lookup(predicted_1), .second_set(set_1), .sums(predicted_sums_4),
      .write(write && write_bank >= PREDICTED_BANKS && write_bank != ALPHA_BANK),
      .write_bank(3'(write_bank - PREDICTED_BANKS)), .write_entry(write_entry), .write_part(write_part),
      .write_data(write_data)
  );

  // Alpha, in place with the turn.
  logic [ENTRY_BITS-1:0] alpha_entry;
  logic [63:0] alpha_word;
  logic [7:0] alpha_3, alpha_4, alpha_5, alpha_6;
  assign alpha_entry = ENTRY_BITS'({set_1, alpha_entry_1});
  dual_port_ram #(
      .WIDTH(64),
      .ADDRESS_BITS(ENTRY_BITS + 1)
  ) alpha_ram (
      .clk(clk),
      .write(write && write_bank == ALPHA_BANK),
      .write_address({write_entry, write_part[0]}),
      .write_data(write_data),
      .read(moves),
      .read_address({alpha_entry, alpha_place_1[3]}),
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
