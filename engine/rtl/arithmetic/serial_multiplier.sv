// Serial multiplier, 36 x 36 bits signed, 4 bits of the multiplier per cycle (multiply_serially() of
// engine/model/signals/arithmetic.hpp): operands are given in the cycle of `start`, and the product is stable from
// MULTIPLY_CYCLES = 9 cycles later until the next start.
module serial_multiplier (
    input  logic        clk,
    input  logic        start,
    input  logic [35:0] multiplicand,  // signed
    input  logic [35:0] multiplier,    // signed
    output logic [71:0] product        // signed
);
  localparam logic [3:0] LAST_STEP = 4'(board::MULTIPLY_CYCLES - 1);

  logic [ 3:0] step;        // of the running product; above LAST_STEP: done
  logic [35:0] factor;      // the multiplicand
  logic [31:0] digits;      // digits of the multiplier that are left, the next one lowest
  logic [36:0] high;        // signed: sum of the partial products
  logic [35:0] low;         // bits of the product that no further step changes, in the highest places

  // Operands of this step: the first step is in the cycle of `start`.
  logic signed [35:0] a;
  logic [3:0] digit;
  logic is_last;
  logic signed [4:0] signed_digit;
  logic signed [40:0] partial;
  logic signed [40:0] sum;
  logic signed [36:0] high_now;
  assign a = start ? multiplicand : factor;
  assign digit = start ? multiplier[3:0] : digits[3:0];
  assign is_last = !start && step == LAST_STEP;
  assign signed_digit = {is_last && digit[3], digit};  // the top digit has the sign: -8 .. 7
  assign high_now = start ? 37'd0 : high;
  assign partial = 41'(a) * 41'(signed_digit);
  assign sum = partial + 41'(high_now);

  always_ff @(posedge clk) begin
    if (start) begin
      step   <= 4'd1;
      factor <= multiplicand;
      digits <= multiplier[35:4];
    end else if (step <= LAST_STEP) begin
      step   <= step + 4'd1;
      digits <= {4'b0, digits[31:4]};
    end
    if (start || step <= LAST_STEP) begin
      high <= sum[40:4];
      low  <= {sum[3:0], low[35:4]};
    end
  end

  assign product = {high[35:0], low};
endmodule
