// FIFO between two blocks (engine/model/clock/fifo.hpp). Two-phase: a push, and the space freed by a pop, are visible
// in the next cycle, so `in_ready` and `out_valid` are functions of registers only. A message moves in each cycle in
// which valid and ready are both set; either may depend on the other.
module fifo #(
    parameter int WIDTH = 64,
    parameter int DEPTH = 4
) (
    input  logic clk,
    input  logic rst,

    input  logic in_valid,
    output logic in_ready,
    input  logic [WIDTH-1:0] in_data,

    output logic out_valid,
    input  logic out_ready,
    output logic [WIDTH-1:0] out_data,

    output logic [$clog2(DEPTH+1)-1:0] count  // messages at the beginning of the cycle
);
  localparam int PLACE_BITS = DEPTH > 1 ? $clog2(DEPTH) : 1;
  localparam int COUNT_BITS = $clog2(DEPTH + 1);
  localparam logic [PLACE_BITS-1:0] LAST_PLACE = PLACE_BITS'(DEPTH - 1);
  localparam logic [PLACE_BITS-1:0] NEXT_PLACE = PLACE_BITS'(1);
  localparam logic [COUNT_BITS-1:0] FULL = COUNT_BITS'(DEPTH);
  localparam logic [COUNT_BITS-1:0] ONE = COUNT_BITS'(1);

  logic [WIDTH-1:0] places[0:DEPTH-1];
  logic [PLACE_BITS-1:0] head, tail;  // read and written next
  logic push, pop;
  assign in_ready = count != FULL;
  assign out_valid = count != '0;
  assign push = in_valid && in_ready;
  assign pop = out_valid && out_ready;
  assign out_data = places[head];

  always_ff @(posedge clk) begin
    if (rst) begin
      head  <= '0;
      tail  <= '0;
      count <= '0;
    end else begin
      if (push) tail <= tail == LAST_PLACE ? '0 : tail + NEXT_PLACE;
      if (pop) head <= head == LAST_PLACE ? '0 : head + NEXT_PLACE;
      if (push && !pop) count <= count + ONE;
      if (pop && !push) count <= count - ONE;
    end
    if (push) places[tail] <= in_data;
  end
endmodule
