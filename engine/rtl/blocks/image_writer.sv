// Image writer (engine/model/blocks/memory/image_writer.hpp): takes a pixel per cycle, and writes a word of two pixels
// every second cycle to the image of its view in the active buffer, column by column.
module image_writer (
    input  logic clk,
    input  logic rst,

    input  logic pixels_valid,
    output logic pixels_ready,
    input  logic [board::PIXELS_BITS-1:0] pixels_data,

    output logic image_writes_valid,
    input  logic image_writes_ready,
    output logic [board::IMAGE_WRITES_BITS-1:0] image_writes_data,

    // Register file: `view`, and the buffer that is written.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::VIEW_SIDE_BITS-1:0] view_width,
    input  logic [board::VIEW_SIDE_BITS-1:0] view_height,
    input  logic active_buffer
);
`include "messages.svh"

  localparam logic [26:0] FIRST = 27'(board::FIRST_IMAGE_WORD);
  localparam logic [26:0] PER_BUFFER = 27'(board::WORDS_PER_IMAGE_BUFFER);
  localparam logic [26:0] PER_IMAGE = 27'(board::WORDS_PER_IMAGE);

  rgba_pixel_t in;
  memory_write_t write;
  logic has_first, in_view;  // a pixel waits for its second; a word of the view is missing
  logic [31:0] first;
  logic [26:0] address;
  logic [board::VIEW_SIDE_BITS-1:0] columns, rows;  // left, including the present one; rows: pixels
  logic writes, is_last_row, is_last;
  assign in = pixels_data;
  assign pixels_ready = !has_first || image_writes_ready;
  assign image_writes_valid = has_first && pixels_valid;
  assign writes = image_writes_valid && image_writes_ready;
  assign is_last_row = rows <= 10'd2;
  assign is_last = is_last_row && columns == 10'd1;

  // The view's size is looked up while its first word waits for its second pixel.
  logic is_first_word;
  logic [board::VIEW_SIDE_BITS-1:0] columns_left, rows_left;
  assign columns = is_first_word ? view_width : columns_left;
  assign rows = is_first_word ? view_height : rows_left;

  always_ff @(posedge clk) begin
    if (rst) begin
      has_first <= 1'b0;
      in_view <= 1'b0;
    end else if (!has_first) begin
      has_first <= pixels_valid;
      in_view <= in_view || pixels_valid;
    end else if (writes) begin
      has_first <= 1'b0;
      in_view <= !is_last;
    end

    if (!has_first) first <= in.rgba;
    if (!in_view) begin
      view <= in.view;
      address <= FIRST + (active_buffer ? PER_BUFFER : 27'd0) + PER_IMAGE * {23'b0, in.view};
      is_first_word <= 1'b1;
    end else if (writes) begin
      address <= address + 27'd1;
      is_first_word <= 1'b0;
      rows_left <= is_last_row ? view_height : rows - 10'd2;
      columns_left <= is_last_row ? columns - 10'd1 : columns;
    end
  end

  assign write.address = address;
  assign write.data = {in.rgba, first};
  assign write.last = is_last;
  assign image_writes_data = write;
endmodule
