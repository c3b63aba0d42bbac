// Block RAM with a write port and a read port. A word is there in the cycle after `read`, and stays until the next one;
// one that is written in the same cycle is read as it was before.
module dual_port_ram #(
    parameter int WIDTH = 64,
    parameter int ADDRESS_BITS = 9
) (
    input  logic clk,

    input  logic write,
    input  logic [ADDRESS_BITS-1:0] write_address,
    input  logic [WIDTH-1:0] write_data,

    input  logic read,
    input  logic [ADDRESS_BITS-1:0] read_address,
    output logic [WIDTH-1:0] read_data
);
  logic [WIDTH-1:0] words[0:(1<<ADDRESS_BITS)-1];
  always_ff @(posedge clk) begin
    if (write) words[write_address] <= write_data;
    if (read) read_data <= words[read_address];
  end
endmodule
