// Block motion of a hop (engine/model/blocks/decompression/block_motion.hpp): collects the words of a record, a word
// per cycle, splits it into its fields in one more, and requests its references: the needed rows of one column of one
// or two blocks. The record leaves with the first of these requests; a second one takes another cycle.
//
// At the last hop `asks_ready` is 0: no record is predicted there.
module block_motion (
    input  logic clk,
    input  logic rst,

    input  logic asked_records_valid,
    output logic asked_records_ready,
    input  logic [board::ASKED_RECORDS_BITS-1:0] asked_records_data,

    input  logic record_words_valid,
    output logic record_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] record_words_data,

    output logic records_valid,
    input  logic records_ready,
    output logic [board::RECORDS_BITS-1:0] records_data,

    output logic asks_valid,
    input  logic asks_ready,
    output logic [board::ASKS_BITS-1:0] asks_data,

    // Register file: the object of `view`. Class n is byte n; classes of images without and with references. The sizes
    // are multiples of 8.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [63:0] object_classes,
    input  logic [63:0] object_predicted_classes,
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_coded_width,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_coded_height
    /* verilator lint_on UNUSEDSIGNAL */
);
`include "messages.svh"

  requested_record_t requested;
  /* verilator lint_off UNUSEDSIGNAL */
  block_request_t request;  // its image is not used
  /* verilator lint_on UNUSEDSIGNAL */
  assign requested = asked_records_data;
  assign request = requested.request;
  assign view = request.view;

  //---- Words of the record ------------------------------------------------------------------------------------------
  logic [255:0] words;
  logic [2:0] collected;
  logic has_second;  // `second` is still to be sent
  logic is_complete, is_empty, is_predicted, sends;
  record_class_t record_class;
  assign record_words_ready = asked_records_valid && !has_second && collected != requested.words;
  assign is_complete = asked_records_valid && !has_second && collected == requested.words;
  assign is_empty = requested.class_number == 3'd0;
  assign record_class = requested.is_predicted_image ? object_predicted_classes[{requested.class_number, 3'b0}+:8] :
                        object_classes[{requested.class_number, 3'b0}+:8];
  assign is_predicted = !is_empty && record_class.is_predicted;
  assign sends = is_complete && records_ready && (!is_predicted || asks_ready);
  assign asked_records_ready = sends;
  assign records_valid = is_complete && (!is_predicted || asks_ready);

  //---- Parts of the record ---------------------------------------------------------------------------------------------
  // The record from its first byte, behind the motion or the flat colour, behind the blocks, behind the quarters.
  logic [207:0] bytes;
  logic [191:0] stages;
  logic [175:0] quarters;
  logic [31:0] alpha;
  assign bytes = words[{2'b0, requested.lane, 4'b0}+:208];
  assign stages = record_class.is_predicted ? bytes[16+:192] : {8'd0, bytes[24+:184]};
  assign quarters = record_class.block_stages == 2'd0 ? stages[175:0] :
                    record_class.block_stages == 2'd1 ? stages[183:8] : stages[191:16];
  assign alpha = quarters[{record_class.quarter_stages[2:0], 5'b0}+:32];

  //---- References ---------------------------------------------------------------------------------------------------
  logic [7:0] motion_x;  // signed
  logic [6:0] motion_y;  // signed
  logic [10:0] column, top_row;  // signed, of the reference of row 0
  logic [board::IMAGE_SIDE_BITS-1:0] last_column;
  logic [6:0] last_block;
  assign motion_x = {!bytes[14], bytes[13:7]};
  assign motion_y = {!bytes[6], bytes[5:0]};
  assign column = {2'b0, request.column} + {{3{motion_x[7]}}, motion_x};
  assign top_row = {2'b0, request.block_row, 3'b0} + {{4{motion_y[6]}}, motion_y};
  assign last_column = object_coded_width - 10'd1;
  assign last_block = object_coded_height[9:3] - 7'd1;

  // The rows lie in two blocks, one above the other. A block outside of the image is the first or the last one, whose
  // first or last row is used instead.
  function automatic logic [13:0] clamped(input logic [7:0] block, input logic [7:0] rows, input logic [6:0] last);
    clamped = block[7] ? {6'd0, 7'd0, rows != 8'd0} : block[6:0] > last ? {last[5:0], rows != 8'd0, 7'd0} :
              {block[5:0], rows};
  endfunction
  logic [15:0] rows;
  logic [5:0] upper_block, lower_block;
  logic [7:0] upper_rows, lower_rows;
  logic is_same_block, has_two, upper_first;
  assign rows = {8'd0, request.rows} << top_row[2:0];
  assign {upper_block, upper_rows} = clamped(top_row[10:3], rows[7:0], last_block);
  assign {lower_block, lower_rows} = clamped(top_row[10:3] + 8'd1, rows[15:8], last_block);
  assign is_same_block = upper_block == lower_block;
  assign has_two = !is_same_block && upper_rows != 8'd0 && lower_rows != 8'd0;
  assign upper_first = is_same_block || (upper_rows != 8'd0 && (request.down || lower_rows == 8'd0));

  logic is_first;  // a view column has begun, and nothing was requested in it
  block_request_t reference, second;
  always_comb begin
    reference.view = request.view;
    reference.first = is_first || request.first;
    reference.down = request.down;
    reference.image = bytes[15] ? requested.reference_1 : requested.reference_0;
    reference.column = column[10] ? 9'd0 : column[9:0] > last_column ? last_column[8:0] : column[8:0];
    reference.block_row = upper_first ? upper_block : lower_block;
    reference.rows = is_same_block ? upper_rows | lower_rows : upper_first ? upper_rows : lower_rows;
  end
  assign asks_valid = has_second || (is_complete && records_ready && is_predicted);
  assign asks_data = has_second ? second : reference;

  logic [15:0] block_entries;
  logic [127:0] quarter_entries;
  always_comb begin
    block_entries = '0;
    quarter_entries = '0;
    for (int n = 0; n < 2; n = n + 1) begin
      if (2'(n) < record_class.block_stages) block_entries[8*n+:8] = stages[8*n+:8];
    end
    for (int n = 0; n < 4; n = n + 1) begin
      if (4'(n) < record_class.quarter_stages) quarter_entries[32*n+:32] = quarters[32*n+:32];
    end
  end
  block_record_t record;
  always_comb begin
    record = '0;
    record.block_row = request.block_row;
    record.is_empty = is_empty;
    if (!is_empty) begin
      record.record_class = record_class;
      if (record_class.is_predicted) begin
        record.motion_y = motion_y;
        record.reference_column = reference.column[2:0];
      end else begin
        record.flat = bytes[23:0];
      end
      record.block = block_entries;
      record.quarter = quarter_entries;
      if (record_class.has_alpha) record.alpha = alpha;
    end
  end
  assign records_data = record;

  always_ff @(posedge clk) begin
    if (rst) begin
      collected <= 3'd0;
      has_second <= 1'b0;
      is_first <= 1'b0;
    end else begin
      if (record_words_ready && record_words_valid) collected <= collected + 3'd1;
      if (sends) begin
        collected <= 3'd0;
        is_first <= !is_predicted && (is_first || request.first);
      end
      if (has_second) has_second <= !asks_ready;
      else has_second <= sends && is_predicted && has_two;
    end

    if (record_words_ready) words[{collected[1:0], 6'b0}+:64] <= record_words_data;
    if (sends) begin
      second <= reference;
      second.first <= 1'b0;
      second.block_row <= upper_first ? lower_block : upper_block;
      second.rows <= upper_first ? lower_rows : upper_rows;
    end
  end
endmodule
