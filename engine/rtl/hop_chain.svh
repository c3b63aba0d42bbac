// The chain of records of a hop and its register look-ups, for modules that connect the chains of all hops.
`ifndef RAYSPACE_HOP_CHAIN_SVH
`define RAYSPACE_HOP_CHAIN_SVH

// Register look-ups of a hop.
`define HOP_REGISTERS(hop) \
    output logic [board::VIEW_BITS-1:0] finder_``hop``_view, \
    input  logic [4:0] finder_``hop``_object_tile_columns, \
    input  logic [4:0] finder_``hop``_object_table_pitch, \
    input  logic [board::ADDRESS_BITS-1:0] finder_``hop``_object_tile_table, \
    output logic [board::VIEW_BITS-1:0] reader_``hop``_view, \
    input  logic [31:0] reader_``hop``_object_record_sizes, \
    input  logic [31:0] reader_``hop``_object_predicted_sizes, \
    output logic [board::VIEW_BITS-1:0] motion_``hop``_view, \
    input  logic [63:0] motion_``hop``_object_classes, \
    input  logic [63:0] motion_``hop``_object_predicted_classes, \
    input  logic [board::IMAGE_SIDE_BITS-1:0] motion_``hop``_object_coded_width, \
    input  logic [board::IMAGE_SIDE_BITS-1:0] motion_``hop``_object_coded_height, \
    output logic [board::VIEW_BITS-1:0] select_``hop``_view, \
    input  logic [board::IMAGE_SIDE_BITS-1:0] select_``hop``_object_coded_height

// The chain of a hop. Its requests and pixels are asks_HOP and pixels_HOP, those behind it asks_NEXT and pixels_NEXT.
// `reads` and `writes`: "_out" and "_in" of FIFOs of the memory; nothing if these are ports of the module.
`define HOP_CHAIN(hop, next, reads, writes) \
  logic asks_``next``_valid, asks_``next``_ready, pixels_``next``_valid, pixels_``next``_ready; \
  logic [board::ASKS_BITS-1:0] asks_``next``_data; \
  logic [board::CODED_PIXELS_BITS+board::CODED_COLOUR_BITS+next*board::HOP_LOOKUP_BITS-1:0] pixels_``next``_data; \
  record_chain #( \
      .HOP(hop), \
      .DEPTH(board::FOUND_``hop``_DEPTH), \
      .ASKS_DEPTH(board::ASKS_``hop``_DEPTH), \
      .RECORDS_DEPTH(board::RECORDS_``hop``_DEPTH), \
      .PIXELS_DEPTH(board::PIXELS_``hop``_DEPTH) \
  ) chain_``hop ( \
      .clk(clk), .rst(rst), \
      .asks_valid(asks_``hop``_valid), .asks_ready(asks_``hop``_ready), .asks_data(asks_``hop``_data), \
      .pixels_valid(pixels_``hop``_valid), .pixels_ready(pixels_``hop``_ready), .pixels_data(pixels_``hop``_data), \
      .next_asks_valid(asks_``next``_valid), .next_asks_ready(asks_``next``_ready), \
      .next_asks_data(asks_``next``_data), .next_pixels_valid(pixels_``next``_valid), \
      .next_pixels_ready(pixels_``next``_ready), .next_pixels_data(pixels_``next``_data), \
      .table_reads_valid(table_reads_``hop``writes``_valid), .table_reads_ready(table_reads_``hop``writes``_ready), \
      .table_reads_data(table_reads_``hop``writes``_data), .table_words_valid(table_words_``hop``reads``_valid), \
      .table_words_ready(table_words_``hop``reads``_ready), .table_words_data(table_words_``hop``reads``_data), \
      .tile_reads_valid(tile_reads_``hop``writes``_valid), .tile_reads_ready(tile_reads_``hop``writes``_ready), \
      .tile_reads_data(tile_reads_``hop``writes``_data), .tile_words_valid(tile_words_``hop``reads``_valid), \
      .tile_words_ready(tile_words_``hop``reads``_ready), .tile_words_data(tile_words_``hop``reads``_data), \
      .record_reads_valid(record_reads_``hop``writes``_valid), \
      .record_reads_ready(record_reads_``hop``writes``_ready), \
      .record_reads_data(record_reads_``hop``writes``_data), .record_words_valid(record_words_``hop``reads``_valid), \
      .record_words_ready(record_words_``hop``reads``_ready), .record_words_data(record_words_``hop``reads``_data), \
      .finder_view(finder_``hop``_view), .finder_object_tile_columns(finder_``hop``_object_tile_columns), \
      .finder_object_table_pitch(finder_``hop``_object_table_pitch), \
      .finder_object_tile_table(finder_``hop``_object_tile_table), .reader_view(reader_``hop``_view), \
      .reader_object_record_sizes(reader_``hop``_object_record_sizes), \
      .reader_object_predicted_sizes(reader_``hop``_object_predicted_sizes), .motion_view(motion_``hop``_view), \
      .motion_object_classes(motion_``hop``_object_classes), \
      .motion_object_predicted_classes(motion_``hop``_object_predicted_classes), \
      .motion_object_coded_width(motion_``hop``_object_coded_width), \
      .motion_object_coded_height(motion_``hop``_object_coded_height), .select_view(select_``hop``_view), \
      .select_object_coded_height(select_``hop``_object_coded_height) \
  );

`endif
