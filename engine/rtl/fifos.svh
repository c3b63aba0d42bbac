// FIFOs between blocks, for modules that connect blocks. Depth and width are constants of the package `board`.
`ifndef RAYSPACE_FIFOS_SVH
`define RAYSPACE_FIFOS_SVH

// A FIFO between two blocks: NAME_in is written by one, NAME_out is read by the other.
`define FIFO(name, width, depth) \
  logic name``_in_valid, name``_in_ready, name``_out_valid, name``_out_ready; \
  logic [(width)-1:0] name``_in_data, name``_out_data; \
  /* verilator lint_off UNUSEDSIGNAL */ \
  logic [$clog2((depth)+1)-1:0] name``_count; \
  /* verilator lint_on UNUSEDSIGNAL */ \
  fifo #( \
      .WIDTH(width), \
      .DEPTH(depth) \
  ) name``_fifo ( \
      .clk(clk), \
      .rst(rst), \
      .in_valid(name``_in_valid), \
      .in_ready(name``_in_ready), \
      .in_data(name``_in_data), \
      .out_valid(name``_out_valid), \
      .out_ready(name``_out_ready), \
      .out_data(name``_out_data), \
      .count(name``_count) \
  );
`define PIPE_FIFO(name, NAME) `FIFO(name, board::NAME``_BITS, board::NAME``_DEPTH)

// Likewise between two clocks. `NAME_count`: messages that the reader sees.
`define CROSSING_FIFO(name, NAME, in, out) \
  logic name``_in_valid, name``_in_ready, name``_out_valid, name``_out_ready; \
  logic [board::NAME``_BITS-1:0] name``_in_data, name``_out_data; \
  /* verilator lint_off UNUSEDSIGNAL */ \
  logic [$clog2(board::NAME``_DEPTH+1)-1:0] name``_count; \
  /* verilator lint_on UNUSEDSIGNAL */ \
  crossing_fifo #( \
      .WIDTH(board::NAME``_BITS), \
      .DEPTH(board::NAME``_DEPTH) \
  ) name``_fifo ( \
      .in_clk(in``clk), \
      .in_rst(in``rst), \
      .in_valid(name``_in_valid), \
      .in_ready(name``_in_ready), \
      .in_data(name``_in_data), \
      .out_clk(out``clk), \
      .out_rst(out``rst), \
      .out_valid(name``_out_valid), \
      .out_ready(name``_out_ready), \
      .out_data(name``_out_data), \
      .out_count(name``_count) \
  );

// Ports of a block that writes, of one that reads, and of one at a FIFO of the surroundings.
`define PIPE_WRITES(name) \
  .name``_valid(name``_in_valid), .name``_ready(name``_in_ready), .name``_data(name``_in_data)
`define PIPE_READS(name) \
  .name``_valid(name``_out_valid), .name``_ready(name``_out_ready), .name``_data(name``_out_data)
`define PIPE_PORT(name) .name``_valid(name``_valid), .name``_ready(name``_ready), .name``_data(name``_data)

`endif
