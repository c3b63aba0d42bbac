// Block RAM with a write port and a read port that answers in the same cycle: it reads at the falling edge, so that half a
// cycle is left for the address and half a cycle for the word. A written word is read from the next cycle on.
module half_cycle_ram #(
    parameter int WIDTH = 32,
    parameter int ADDRESS_BITS = 11
) (
    input  logic clk,

    input  logic write,
    input  logic [ADDRESS_BITS-1:0] write_address,
    input  logic [WIDTH-1:0] write_data,

    input  logic [ADDRESS_BITS-1:0] read_address,
    output logic [WIDTH-1:0] read_data
);
  logic [WIDTH-1:0] words[0:(1<<ADDRESS_BITS)-1];
  always_ff @(posedge clk) if (write) words[write_address] <= write_data;
  always_ff @(negedge clk) read_data <= words[read_address];
endmodule
