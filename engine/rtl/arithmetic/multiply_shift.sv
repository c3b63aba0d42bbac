// (a * b) >> SHIFT, saturated to 30 bits: hold() of engine/RECONSTRUCTION.md. A product enters in every cycle in which
// `enable` is set, and its result is there five of these cycles later. b has at most 30 bits.
//
//     1     a * each digit of 6 bits of b
//     2..4  sums
//     5     saturated
module multiply_shift #(
    parameter int A_BITS = 31,
    parameter int B_BITS = 28,
    parameter int SHIFT = 16
) (
    input  logic clk,
    input  logic enable,
    input  logic [A_BITS-1:0] a,  // these signed
    input  logic [B_BITS-1:0] b,
    output logic [29:0] result
);
  localparam int DIGITS = 5;
  localparam int DIGIT_BITS = 6;
  localparam int PARTIAL_BITS = A_BITS + DIGIT_BITS;
  localparam int PAIR_BITS = PARTIAL_BITS + DIGIT_BITS;
  localparam int QUAD_BITS = PAIR_BITS + 2 * DIGIT_BITS;
  localparam int PRODUCT_BITS = QUAD_BITS + DIGIT_BITS;

  logic [DIGITS*DIGIT_BITS-1:0] wide_b;
  logic signed [PARTIAL_BITS-1:0] wide_a;
  logic [DIGITS*PARTIAL_BITS-1:0] partials_1;
  assign wide_b = {{DIGITS * DIGIT_BITS - B_BITS{b[B_BITS-1]}}, b};
  assign wide_a = {{DIGIT_BITS{a[A_BITS-1]}}, a};
  genvar digit;
  generate
    for (digit = 0; digit < DIGITS; digit = digit + 1) begin : digits
      logic sign;
      logic signed [PARTIAL_BITS-1:0] factor;
      assign sign = digit == DIGITS - 1 ? wide_b[DIGITS*DIGIT_BITS-1] : 1'b0;
      assign factor = {{A_BITS{sign}}, wide_b[DIGIT_BITS*digit+:DIGIT_BITS]};
      always_ff @(posedge clk) begin
        if (enable) partials_1[PARTIAL_BITS*digit+:PARTIAL_BITS] <= wide_a * factor;
      end
    end
  endgenerate

  logic [2*PAIR_BITS-1:0] pairs_2;
  logic [PARTIAL_BITS-1:0] last_2, last_3;
  logic [QUAD_BITS-1:0] quad_3;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [PRODUCT_BITS-1:0] product_4;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [PRODUCT_BITS-SHIFT-30:0] high_4;  // equal bits unless the result is saturated
  function automatic logic [PAIR_BITS-1:0] pair(input logic [PARTIAL_BITS-1:0] low, input logic [PARTIAL_BITS-1:0] high);
    pair = {{DIGIT_BITS{low[PARTIAL_BITS-1]}}, low} + {high, {DIGIT_BITS{1'b0}}};
  endfunction
  assign high_4 = product_4[PRODUCT_BITS-1:SHIFT+29];
  always_ff @(posedge clk) begin
    if (enable) begin
      pairs_2[0+:PAIR_BITS] <= pair(partials_1[0+:PARTIAL_BITS], partials_1[PARTIAL_BITS+:PARTIAL_BITS]);
      pairs_2[PAIR_BITS+:PAIR_BITS] <= pair(partials_1[2*PARTIAL_BITS+:PARTIAL_BITS], partials_1[3*PARTIAL_BITS+:PARTIAL_BITS]);
      last_2 <= partials_1[4*PARTIAL_BITS+:PARTIAL_BITS];
      quad_3 <= {{2 * DIGIT_BITS{pairs_2[PAIR_BITS-1]}}, pairs_2[0+:PAIR_BITS]} +
                {pairs_2[PAIR_BITS+:PAIR_BITS], {2 * DIGIT_BITS{1'b0}}};
      last_3 <= last_2;
      product_4 <= {{DIGIT_BITS{quad_3[QUAD_BITS-1]}}, quad_3} + {last_3, {4 * DIGIT_BITS{1'b0}}};
      result <= &high_4 || !(|high_4) ? product_4[SHIFT+:30] : {high_4[PRODUCT_BITS-SHIFT-30], {29{!high_4[PRODUCT_BITS-SHIFT-30]}}};
    end
  end
endmodule
