// Host DMA (engine/model/blocks/host/host_dma.hpp) of a board with one memory channel: reads a finished image buffer and
// sends it to the bus, each image after a header; frees the buffer when the bus has transferred it.
//
//     cycle  1    take the buffer, or the last word of the image before      3..  a request and a word per cycle
//            2    header
module host_dma (
    input  logic clk,
    input  logic rst,

    input  logic images_ready_valid,
    output logic images_ready_ready,
    input  logic [board::IMAGES_READY_BITS-1:0] images_ready_data,

    output logic host_reads_valid,
    input  logic host_reads_ready,
    output logic [board::HOST_READS_BITS-1:0] host_reads_data,

    input  logic host_words_valid,
    output logic host_words_ready,
    input  logic [board::HOST_WORDS_BITS-1:0] host_words_data,

    output logic image_words_valid,
    input  logic image_words_ready,
    output logic [board::IMAGE_WORDS_BITS-1:0] image_words_data,

    // Its message is the event alone.
    input  logic transferred_valid,
    output logic transferred_ready,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [board::TRANSFERRED_BITS-1:0] transferred_data,
    /* verilator lint_on UNUSEDSIGNAL */

    output logic buffer_free_valid,
    input  logic buffer_free_ready,
    output logic [board::BUFFER_FREE_BITS-1:0] buffer_free_data,

    // Register file: the number of views in `buffer`, and the words of `view` in it.
    output logic buffer,
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::VIEW_BITS-1:0] buffer_views,
    input  logic [board::IMAGE_SIZE_BITS-1:0] buffer_words
);
`include "messages.svh"

  localparam logic [26:0] FIRST = 27'(board::FIRST_IMAGE_WORD);
  localparam logic [26:0] PER_BUFFER = 27'(board::WORDS_PER_IMAGE_BUFFER);
  localparam logic [26:0] PER_IMAGE = 27'(board::WORDS_PER_IMAGE);

  logic active, head_sent;
  logic [board::IMAGE_SIZE_BITS-1:0] to_request, to_send;
  logic [26:0] address;
  logic waits, sends_head, sends_words;
  assign waits = active && view == buffer_views;
  assign sends_head = active && !waits && !head_sent;
  assign sends_words = active && !waits && head_sent;

  memory_read_t read;
  image_word_t word;
  logic sends, requests, frees, is_last;
  assign images_ready_ready = !active;
  assign host_reads_valid = sends_words && to_request != '0;
  assign host_words_ready = sends_words && image_words_ready;
  assign image_words_valid = sends_head || (sends_words && host_words_valid);
  assign transferred_ready = waits && buffer_free_ready;
  assign buffer_free_valid = waits && transferred_valid;
  assign requests = host_reads_valid && host_reads_ready;
  assign sends = host_words_valid && host_words_ready;
  assign frees = buffer_free_valid && buffer_free_ready;
  assign is_last = to_send == 18'd1;

  always_ff @(posedge clk) begin
    if (rst) begin
      active <= 1'b0;
    end else begin
      if (!active) active <= images_ready_valid;
      else if (frees) active <= 1'b0;
    end

    if (!active) begin
      buffer <= images_ready_data;
      view <= '0;
      head_sent <= 1'b0;
    end else if (sends_head) begin
      head_sent <= image_words_ready;
      to_request <= buffer_words;
      to_send <= buffer_words;
      address <= FIRST + (buffer ? PER_BUFFER : 27'd0) + PER_IMAGE * {23'b0, view};
    end else begin
      if (requests) begin
        to_request <= to_request - 18'd1;
        address <= address + 27'd1;
      end
      if (sends) begin
        to_send <= to_send - 18'd1;
        if (is_last) begin
          view <= view + 4'd1;
          head_sent <= 1'b0;
        end
      end
    end
  end

  assign read.address = address;
  assign read.is_null = 1'b0;
  assign host_reads_data = read;
  assign word.data = sends_head ? {28'b0, view, 14'b0, buffer_words} : host_words_data;
  assign word.head = sends_head;
  assign word.last_view = sends_head && view + 4'd1 == buffer_views;
  assign image_words_data = word;
  assign buffer_free_data = buffer;
endmodule
