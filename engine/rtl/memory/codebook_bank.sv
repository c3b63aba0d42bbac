// The codebook of one stage: the words with Y, U and V of an entry in one cycle. An entry has 2^ROW_BITS words of Y, and
// two each of U and V, of eight samples.
module codebook_bank #(
    parameter int ROW_BITS = 3,  // 3: blocks of 8x8 samples, with U and V for 2x2 of them; 1: quarters of 4x4
    parameter int ENTRY_BITS = 8
) (
    input  logic clk,

    input  logic write_y,
    input  logic write_u,
    input  logic write_v,
    input  logic [ENTRY_BITS-1:0] write_entry,
    input  logic [ROW_BITS-1:0] write_row,
    input  logic [63:0] write_data,

    input  logic read,
    input  logic [ENTRY_BITS-1:0] entry,
    input  logic [ROW_BITS-1:0] row,
    input  logic chroma_row,
    output logic [63:0] y,
    output logic [63:0] u,
    output logic [63:0] v
);
  dual_port_ram #(
      .WIDTH(64),
      .ADDRESS_BITS(ENTRY_BITS + ROW_BITS)
  ) y_ram (
      .clk(clk),
      .write(write_y),
      .write_address({write_entry, write_row}),
      .write_data(write_data),
      .read(read),
      .read_address({entry, row}),
      .read_data(y)
  );
  dual_port_ram #(
      .WIDTH(64),
      .ADDRESS_BITS(ENTRY_BITS + 1)
  ) u_ram (
      .clk(clk),
      .write(write_u),
      .write_address({write_entry, write_row[0]}),
      .write_data(write_data),
      .read(read),
      .read_address({entry, chroma_row}),
      .read_data(u)
  );
  dual_port_ram #(
      .WIDTH(64),
      .ADDRESS_BITS(ENTRY_BITS + 1)
  ) v_ram (
      .clk(clk),
      .write(write_v),
      .write_address({write_entry, write_row[0]}),
      .write_data(write_data),
      .read(read),
      .read_address({entry, chroma_row}),
      .read_data(v)
  );
endmodule
