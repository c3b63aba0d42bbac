// FIFO between two clocks (engine/model/clock/crossing_fifo.hpp): a memory whose pointers pass as Gray code through two
// flip-flops of the other clock. A push is visible to the reader at the second edge of its clock after it, and space to
// the writer likewise. DEPTH is a power of two, 2 or more. Both resets are active together, for two edges of each clock
// or more.
module crossing_fifo #(
    parameter int WIDTH = 64,
    parameter int DEPTH = 4
) (
    input  logic in_clk,
    input  logic in_rst,
    input  logic in_valid,
    output logic in_ready,
    input  logic [WIDTH-1:0] in_data,

    input  logic out_clk,
    input  logic out_rst,
    output logic out_valid,
    input  logic out_ready,
    output logic [WIDTH-1:0] out_data,
    output logic [$clog2(DEPTH+1)-1:0] out_count  // messages that the reader sees
);
  localparam int PLACE_BITS = $clog2(DEPTH);
  localparam int BITS = PLACE_BITS + 1;
  localparam logic [BITS-1:0] ONE = BITS'(1);
  localparam logic [BITS-1:0] TURN = BITS'(3 << (BITS - 2));  // Gray codes that differ so are DEPTH apart

  logic [WIDTH-1:0] places[0:DEPTH-1];

  // Clock of the writer.
  logic [BITS-1:0] pushes, pushes_gray, pushes_next;
  logic [BITS-1:0] pops_seen_0, pops_seen_1;
  logic push;
  assign in_ready = (pushes_gray ^ pops_seen_1) != TURN;
  assign push = in_valid && in_ready;
  assign pushes_next = push ? pushes + ONE : pushes;

  // Clock of the reader.
  logic [BITS-1:0] pops, pops_gray, pops_next;
  logic [BITS-1:0] pushes_seen_0, pushes_seen_1;
  logic pop;
  assign out_valid = pops_gray != pushes_seen_1;
  assign pop = out_valid && out_ready;
  assign pops_next = pop ? pops + ONE : pops;
  assign out_data = places[pops[PLACE_BITS-1:0]];
  logic [BITS-1:0] pushes_seen;
  generate
    for (genvar n = 0; n < BITS; n = n + 1) assign pushes_seen[n] = ^pushes_seen_1[BITS-1:n];
  endgenerate
  assign out_count = pushes_seen - pops;

  always_ff @(posedge in_clk) begin
    if (in_rst) begin
      pushes <= '0;
      pushes_gray <= '0;
      pops_seen_0 <= '0;
      pops_seen_1 <= '0;
    end else begin
      pushes <= pushes_next;
      pushes_gray <= pushes_next ^ {1'b0, pushes_next[BITS-1:1]};
      pops_seen_0 <= pops_gray;
      pops_seen_1 <= pops_seen_0;
    end
    if (push) places[pushes[PLACE_BITS-1:0]] <= in_data;
  end

  always_ff @(posedge out_clk) begin
    if (out_rst) begin
      pops <= '0;
      pops_gray <= '0;
      pushes_seen_0 <= '0;
      pushes_seen_1 <= '0;
    end else begin
      pops <= pops_next;
      pops_gray <= pops_next ^ {1'b0, pops_next[BITS-1:1]};
      pushes_seen_0 <= pushes_gray;
      pushes_seen_1 <= pushes_seen_0;
    end
  end
endmodule
