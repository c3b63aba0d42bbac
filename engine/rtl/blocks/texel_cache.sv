// Texel cache (engine/model/blocks/texels/texel_cache.hpp): 128 lines of 8x8 texels, R, G, B and alpha, in four banks by the
// lowest bits of column and row. A sample is read in the cycle in which it passes, once the blocks that were requested for
// it have been written; a texel is written beside it. Texels without a weight are 0.
module texel_cache (
    input  logic clk,
    input  logic rst,

    input  logic waiting_valid,
    output logic waiting_ready,
    input  logic [board::WAITING_BITS-1:0] waiting_data,
    input  logic targets_valid,
    output logic targets_ready,
    input  logic [board::TARGETS_BITS-1:0] targets_data,
    input  logic texels_valid,
    output logic texels_ready,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [board::PIXELS_BITS-1:0] texels_data,  // the view is not used
    /* verilator lint_on UNUSEDSIGNAL */

    output logic quads_valid,
    input  logic quads_ready,
    output logic [board::QUADS_BITS-1:0] quads_data
);
`include "messages.svh"

  //---- Control ------------------------------------------------------------------------------------------------------
  waiting_sample_t in;
  logic [6:0] line;           // to be written
  logic [9:0] guard, behind;  // samples that have been read behind the guard, modulo 1024
  logic [9:0] samples;        // that have been read
  logic [7:0] fills;          // blocks written, without those that samples have waited for: of as many lines
  logic [5:0] written;        // texels of the block
  logic is_filled, is_guard_passed, reads, writes, ends;
  assign in = waiting_data;
  assign {line, guard} = targets_data;
  assign behind = samples - guard;
  assign is_guard_passed = behind <= 10'(board::WAITING_SAMPLES);
  assign is_filled = {5'd0, in.fills} <= fills;
  assign quads_valid = waiting_valid && is_filled;
  assign waiting_ready = quads_ready && is_filled;
  assign texels_ready = targets_valid && is_guard_passed;
  assign targets_ready = texels_valid && is_guard_passed && written == 6'd63;
  assign reads = quads_valid && quads_ready;
  assign writes = texels_valid && texels_ready;
  assign ends = targets_valid && targets_ready;
  always_ff @(posedge clk) begin
    if (rst) begin
      samples <= 10'd0;
      fills <= 8'd0;
      written <= 6'd0;
    end else begin
      samples <= samples + 10'(reads);
      fills <= fills + 8'(ends) - (reads ? {5'd0, in.fills} : 8'd0);
      written <= written + 6'(writes);
    end
  end

  //---- Banks --------------------------------------------------------------------------------------------------------
  // The texels of a sample are in different banks, or the same.
  logic [43:0] addresses;  // [texel], in its bank
  logic [7:0] banks;       // [texel]
  logic [127:0] words;     // [bank]
  logic [127:0] rgba;      // [texel]
  genvar n, bank;
  generate
    for (n = 0; n < 4; n = n + 1) begin : texels
      localparam bit RIGHT = n / 2 == 1;
      localparam bit BOTTOM = n % 2 == 1;
      logic [2:0] column, row;
      logic has_weight;
      assign {column, row} = in.texels[6*n+:6];
      assign addresses[11*n+:11] = {in.lines[7*n+:7], column[2:1], row[2:1]};
      assign banks[2*n+:2] = {column[0], row[0]};
      assign has_weight = in.is_inside && (!RIGHT || in.fx != 3'd0) && (!BOTTOM || in.fy != 3'd0);
      assign rgba[32*n+:32] = has_weight ? words[{banks[2*n+:2], 5'd0}+:32] : 32'd0;
    end
    for (bank = 0; bank < 4; bank = bank + 1) begin : memories
      logic [1:0] texel;
      assign texel = 2'(bank) ^ banks[1:0];
      half_cycle_ram #(
          .WIDTH(32),
          .ADDRESS_BITS(11)
      ) memory (
          .clk(clk),
          .write(writes && {written[3], written[0]} == 2'(bank)),
          .write_address({line, written[5:4], written[2:1]}),
          .write_data(texels_data[31:0]),
          .read_address(texel == 2'd0 ? addresses[10:0] : texel == 2'd1 ? addresses[21:11] :
                        texel == 2'd2 ? addresses[32:22] : addresses[43:33]),
          .read_data(words[32*bank+:32])
      );
    end
  endgenerate

  texel_quad_t out;
  assign out.head = in.head;
  assign out.is_inside = in.is_inside;
  assign out.fx = in.fx;
  assign out.fy = in.fy;
  assign out.rgba = rgba;
  assign quads_data = out;
endmodule
