// Pipelined multiplier of signed numbers: a new product in any cycle, there 5 cycles later (kProductCycles of
// engine/model/signals/arithmetic.hpp). Operands of up to 36 bits are split, so that all products are of 18 x 18 bits. All
// stages stall while `moves` is 0.
//
//     1  operands     2  products     3  middle sum     4, 5  sums
module pipelined_multiplier #(
    parameter int A_BITS = 36,
    parameter int B_BITS = 36
) (
    input  logic clk,
    input  logic moves,
    input  logic [A_BITS-1:0] a,  // signed
    input  logic [B_BITS-1:0] b,  // signed
    output logic [A_BITS+B_BITS-1:0] product  // signed
);
  // Low part of 18 bits without sign, or the whole of a short operand.
  logic signed [18:0] a_low, a_high, b_low, b_high;
  generate
    if (A_BITS > 18) begin : long_a
      assign a_low = {1'b0, a[17:0]};
      assign a_high = {{37 - A_BITS{a[A_BITS-1]}}, a[A_BITS-1:18]};
    end else begin : short_a
      assign a_low = {{19 - A_BITS{a[A_BITS-1]}}, a};
      assign a_high = 19'd0;
    end
    if (B_BITS > 18) begin : long_b
      assign b_low = {1'b0, b[17:0]};
      assign b_high = {{37 - B_BITS{b[B_BITS-1]}}, b[B_BITS-1:18]};
    end else begin : short_b
      assign b_low = {{19 - B_BITS{b[B_BITS-1]}}, b};
      assign b_high = 19'd0;
    end
  endgenerate

  logic signed [18:0] a_low_1, a_high_1, b_low_1, b_high_1;
  logic signed [37:0] low_2, first_middle_2, second_middle_2, high_2, low_3, middle_3, high_3, high_4;
  logic signed [56:0] sum_4;
  /* verilator lint_off UNUSEDSIGNAL */
  logic signed [73:0] sum_5;  // of short operands without the high bits
  /* verilator lint_on UNUSEDSIGNAL */
  always_ff @(posedge clk) begin
    if (moves) begin
      a_low_1 <= a_low;
      a_high_1 <= a_high;
      b_low_1 <= b_low;
      b_high_1 <= b_high;
      low_2 <= 38'(a_low_1) * 38'(b_low_1);
      first_middle_2 <= 38'(a_low_1) * 38'(b_high_1);
      second_middle_2 <= 38'(a_high_1) * 38'(b_low_1);
      high_2 <= 38'(a_high_1) * 38'(b_high_1);
      low_3 <= low_2;
      middle_3 <= first_middle_2 + second_middle_2;
      high_3 <= high_2;
      sum_4 <= {{19{low_3[37]}}, low_3} + {middle_3[37], middle_3, 18'd0};
      high_4 <= high_3;
      sum_5 <= {{17{sum_4[56]}}, sum_4} + {high_4, 36'd0};
    end
  end
  assign product = sum_5[A_BITS+B_BITS-1:0];
endmodule
