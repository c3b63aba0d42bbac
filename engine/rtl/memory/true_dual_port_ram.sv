// Block RAM with two ports: port 0 reads, port 1 reads or writes. A word is there in the cycle after `read`, and stays
// until the next one; one that is written in the same cycle is read as it was before.
module true_dual_port_ram #(
    parameter int WIDTH = 52,
    parameter int WORDS = 3072,
    parameter int ADDRESS_BITS = $clog2(WORDS)
) (
    input  logic clk,

    input  logic read_0,
    input  logic [ADDRESS_BITS-1:0] address_0,
    output logic [WIDTH-1:0] data_0,

    input  logic read_1,
    input  logic write_1,
    input  logic [ADDRESS_BITS-1:0] address_1,
    input  logic [WIDTH-1:0] write_data_1,
    output logic [WIDTH-1:0] data_1
);
  logic [WIDTH-1:0] words[0:WORDS-1];
  always_ff @(posedge clk) begin
    if (read_0) data_0 <= words[address_0];
    if (write_1) words[address_1] <= write_data_1;
    if (read_1) data_1 <= words[address_1];
  end
endmodule
