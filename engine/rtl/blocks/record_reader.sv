// Record reader of a hop (engine/model/blocks/decompression/record_reading.hpp): keeps the first word of the tile, finds
// a block's record behind those of the blocks before it, and requests its words, one per cycle. One cycle more for a new
// tile, in which the sizes of its records are looked up: all requests of a tile are of one object. Those of up to 15
// records are summed in one cycle.
module record_reader (
    input  logic clk,
    input  logic rst,

    input  logic tiles_valid,
    output logic tiles_ready,
    input  logic [board::TILES_BITS-1:0] tiles_data,

    input  logic tile_words_valid,
    output logic tile_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] tile_words_data,

    output logic record_reads_valid,
    input  logic record_reads_ready,
    output logic [board::SAMPLE_READS_BITS-1:0] record_reads_data,

    output logic asked_records_valid,
    input  logic asked_records_ready,
    output logic [board::ASKED_RECORDS_BITS-1:0] asked_records_data,

    // Register file: the object of `view`; half of the bytes of a record of each class, of images without and with
    // references. Class 0 has none.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [31:0] object_record_sizes,
    input  logic [31:0] object_predicted_sizes
);
`include "messages.svh"

  requested_tile_t tile;
  /* verilator lint_off UNUSEDSIGNAL */
  block_request_t request;
  logic [4:0] end_in_word;
  /* verilator lint_on UNUSEDSIGNAL */
  memory_read_t read;
  requested_record_t record;
  logic is_loaded;  // the word of the new tile has been taken
  logic [63:0] word, head;
  logic [26:0] records, last;  // address of the tile's records, and of the last request
  logic [1:0] to_request;  // words
  assign tile = tiles_data;
  assign request = tile.request;
  assign view = request.view;

  logic takes_word, may_send, sends;
  assign takes_word = tiles_valid && to_request == 2'd0 && tile.kind == 2'(board::TILE_READ) && !is_loaded;
  assign may_send = tiles_valid && to_request == 2'd0 && !takes_word;
  assign sends = may_send && asked_records_ready && record_reads_ready;
  assign tile_words_ready = takes_word;
  assign tiles_ready = sends;
  assign asked_records_valid = may_send && record_reads_ready;

  // The record of a block begins behind those of the blocks before it. Sizes and offsets in units of two bytes.
  function automatic logic [3:0] size_of(input logic [2:0] class_number, input logic [31:0] sizes);
    size_of = class_number == 3'd0 ? 4'd0 : sizes[{class_number, 2'b0}+:4];
  endfunction
  logic [3:0] block;
  logic [2:0] class_number;
  logic is_predicted_image, loads_predicted_image;
  logic [31:0] loaded_sizes;  // of the classes
  logic [63:0] sizes;         // of 4 bits: of the records of the tile
  logic [7:0] offset;
  logic [2:0] words;
  assign head = tile.kind == 2'(board::TILE_NOTHING) ? 64'd0 : word;
  assign block = {request.column[4:3], request.block_row[1:0]};
  assign class_number = head[{2'b0, block} * 6'd3+:3];
  assign is_predicted_image = head[55:48] != 8'd255;
  assign loads_predicted_image = tile_words_data[55:48] != 8'd255;
  assign loaded_sizes = loads_predicted_image ? object_predicted_sizes : object_record_sizes;
  // A tree of adders: four levels.
  logic [63:0] addends;  // of 4 bits: the sizes of the blocks before it
  logic [39:0] pairs;    // of 5 bits
  logic [23:0] fours;    // of 6 bits
  genvar n;
  generate
    for (n = 0; n < 15; n = n + 1) begin : blocks
      assign addends[4*n+:4] = 4'(n) < block ? sizes[4*n+:4] : 4'd0;
    end
    for (n = 0; n < 16; n = n + 1) begin : records_of_tile
      always_ff @(posedge clk) if (takes_word) sizes[4*n+:4] <= size_of(tile_words_data[3*n+:3], loaded_sizes);
    end
    for (n = 0; n < 8; n = n + 1) begin : sums_of_pairs
      assign pairs[5*n+:5] = {1'b0, addends[8*n+:4]} + {1'b0, addends[8*n+4+:4]};
    end
    for (n = 0; n < 4; n = n + 1) begin : sums_of_fours
      assign fours[6*n+:6] = {1'b0, pairs[10*n+:5]} + {1'b0, pairs[10*n+5+:5]};
    end
  endgenerate
  assign addends[63:60] = 4'd0;
  assign offset = {1'b0, {1'b0, fours[5:0]} + {1'b0, fours[11:6]}} + {1'b0, {1'b0, fours[17:12]} + {1'b0, fours[23:18]}};
  assign end_in_word = {3'd0, offset[1:0]} + {1'b0, sizes[{block, 2'b0}+:4]} + 5'd3;
  assign words = end_in_word[4:2];

  logic reads_first;
  logic [26:0] first;
  assign reads_first = sends && class_number != 3'd0;
  assign first = records + {21'd0, offset[7:2]};
  assign record_reads_valid = to_request != 2'd0 || (may_send && asked_records_ready && class_number != 3'd0);
  assign read.address = to_request != 2'd0 ? last + 27'd1 : first;
  assign read.is_null = 1'b0;
  assign record_reads_data = read;

  always_ff @(posedge clk) begin
    if (rst) begin
      is_loaded <= 1'b0;
      to_request <= 2'd0;
    end else begin
      if (takes_word && tile_words_valid) is_loaded <= 1'b1;
      if (sends) is_loaded <= 1'b0;
      if (reads_first) to_request <= 2'(words - 3'd1);
      else if (to_request != 2'd0 && record_reads_ready) to_request <= to_request - 2'd1;
    end

    if (takes_word) begin
      word <= tile_words_data;
      records <= tile.address + 27'd1;
    end else if (sends) begin
      word <= head;
    end
    if (record_reads_ready) last <= read.address;
  end

  always_comb begin
    record = '0;
    record.request = tile.request;
    record.class_number = class_number;
    record.is_predicted_image = is_predicted_image;
    record.reference_0 = head[54:48];
    record.reference_1 = head[62:56];
    if (class_number != 3'd0) begin
      record.lane = offset[1:0];
      record.words = words;
    end
  end
  assign asked_records_data = record;
endmodule
