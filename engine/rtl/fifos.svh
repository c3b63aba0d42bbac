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

// Ports of a block that writes, of one that reads, and of one at a FIFO of the surroundings.
`define PIPE_WRITES(name) \
  .name``_valid(name``_in_valid), .name``_ready(name``_in_ready), .name``_data(name``_in_data)
`define PIPE_READS(name) \
  .name``_valid(name``_out_valid), .name``_ready(name``_out_ready), .name``_data(name``_out_data)
`define PIPE_PORT(name) .name``_valid(name``_valid), .name``_ready(name``_ready), .name``_data(name``_data)

`endif
