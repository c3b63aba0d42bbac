// RAM with a write port and a read port that answers in the same cycle, as embedded RAM of the board's FPGA and the
// distributed RAM of later ones do. A written word is read from the next cycle on. The one place for a vendor's RAM in
// the register file.
module register_ram #(
    parameter int WIDTH = 32,
    parameter int DEPTH = 48,
    parameter int PLACE_BITS = $clog2(DEPTH)
) (
    input  logic clk,
    input  logic write,
    input  logic [PLACE_BITS-1:0] write_place,
    input  logic [WIDTH-1:0] write_data,
    input  logic [PLACE_BITS-1:0] read_place,
    output logic [WIDTH-1:0] read_data
);
  logic [WIDTH-1:0] words[0:DEPTH-1];
  assign read_data = words[read_place];
  always_ff @(posedge clk) begin
    if (write) words[write_place] <= write_data;
  end
endmodule
