// Pipelined divider (divide_serially() of engine/model/signals/arithmetic.hpp): floor(dividend / divisor), a new division
// in any cycle, its quotient DIVIDE_CYCLES = 34 cycles later: sign and magnitude, 32 bits of the quotient one after the
// other, sign and floor. The divisor is 1 or more. `overflow`: the magnitude of the quotient is 2^32 or more.
module pipelined_divider (
    input  logic        clk,
    input  logic [63:0] dividend,  // signed; magnitude below 2^63
    input  logic [31:0] divisor,
    output logic [32:0] quotient,  // signed
    output logic        overflow
);
  localparam int STAGES = board::DIVIDE_CYCLES - 2;

  // Before stage n: the rest, and the bits of the magnitude that are left above the n bits of the quotient.
  logic [31:0] rest[0:STAGES];
  logic [31:0] bits[0:STAGES];
  logic [31:0] by[0:STAGES];
  logic [STAGES:0] negative;
  logic [STAGES:0] exceeds;

  logic [63:0] magnitude;
  assign magnitude = dividend[63] ? ~dividend + 64'd1 : dividend;

  always_ff @(posedge clk) begin
    rest[0] <= magnitude[63:32];
    bits[0] <= magnitude[31:0];
    by[0] <= divisor;
    negative[0] <= dividend[63];
    exceeds[0] <= magnitude[63:32] >= divisor;
  end

  generate
    for (genvar n = 0; n < STAGES; n = n + 1) begin : g_stage
      logic [32:0] next;
      logic [32:0] difference;  // signed: the rest is below the divisor, so `next` is below twice of it
      assign next = {rest[n], bits[n][31]};
      assign difference = next - {1'b0, by[n]};
      always_ff @(posedge clk) begin
        rest[n+1] <= difference[32] ? next[31:0] : difference[31:0];
        bits[n+1] <= {bits[n][30:0], !difference[32]};
        by[n+1] <= by[n];
        negative[n+1] <= negative[n];
        exceeds[n+1] <= exceeds[n];
      end
    end
  endgenerate

  always_ff @(posedge clk) begin
    overflow <= exceeds[STAGES];
    if (!negative[STAGES]) quotient <= {1'b0, bits[STAGES]};
    else if (rest[STAGES] == 32'd0) quotient <= 33'd0 - {1'b0, bits[STAGES]};
    else quotient <= ~{1'b0, bits[STAGES]};
  end
endmodule
