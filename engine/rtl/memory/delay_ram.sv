// Delay of STAGES moves in a RAM: the registers of STAGES stages of a pipeline that stalls while `moves` is 0. At least two
// stages.
module delay_ram #(
    parameter int WIDTH = 64,
    parameter int STAGES = 8
) (
    input  logic clk,
    input  logic rst,
    input  logic moves,
    input  logic [WIDTH-1:0] in,
    output logic [WIDTH-1:0] out
);
  localparam int PLACE_BITS = $clog2(STAGES);
  logic [PLACE_BITS-1:0] place;
  always_ff @(posedge clk) begin
    if (rst) place <= '0;
    else if (moves) place <= place + 1'b1;
  end
  dual_port_ram #(
      .WIDTH(WIDTH),
      .ADDRESS_BITS(PLACE_BITS)
  ) ram (
      .clk(clk), .write(moves), .write_address(place), .write_data(in), .read(moves),
      .read_address(place - PLACE_BITS'(STAGES - 1)), .read_data(out)
  );
endmodule
