// Square root, rounded down, a bit per cycle (square_root_serially() of engine/model/signals/arithmetic.hpp): the square
// is given in the cycle of `start`, and the root is stable from ROOT_CYCLES = 33 cycles later until the next start.
module serial_root (
    input  logic        clk,
    input  logic        start,
    input  logic [63:0] square,
    output logic [31:0] root
);
  localparam logic [5:0] STEPS = 6'(board::ROOT_CYCLES - 1);

  logic [5:0] step;
  logic [63:0] bits;         // of the square that are left, the next ones highest
  logic [31:0] rest;         // at most twice the root, of which a bit is missing before each step
  logic [33:0] next, trial;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [34:0] difference;   // signed
  /* verilator lint_on UNUSEDSIGNAL */
  assign next = {rest, bits[63:62]};
  assign trial = {root, 2'd1};
  assign difference = {1'b0, next} - {1'b0, trial};

  always_ff @(posedge clk) begin
    if (start) begin
      step <= 6'd0;
      bits <= square;
      rest <= 32'd0;
      root <= 32'd0;
    end else if (step != STEPS) begin
      step <= step + 6'd1;
      bits <= {bits[61:0], 2'd0};
      rest <= difference[34] ? next[31:0] : difference[31:0];
      root <= {root[30:0], !difference[34]};
    end
  end
endmodule
