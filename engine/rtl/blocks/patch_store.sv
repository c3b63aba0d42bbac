// Patch store (engine/model/blocks/parallel/patch_store.hpp): collects the pixels of four patches in any order, and writes
// a complete patch into the image buffer, column by column, two pixels to a word: a pixel and a word per cycle.
//
// Even and odd rows are in two memories, which are read in the cycle before their word is sent; a pixel that is written
// in that cycle goes around the memory.
module patch_store (
    input  logic clk,
    input  logic rst,

    input  logic patches_valid,
    output logic patches_ready,
    input  logic [board::PATCHES_BITS-1:0] patches_data,
    input  logic resolved_valid,
    output logic resolved_ready,
    input  logic [board::RESOLVED_BITS-1:0] resolved_data,
    input  logic empty_valid,
    output logic empty_ready,
    input  logic [board::EMPTY_BITS-1:0] empty_data,

    output logic image_writes_valid,
    input  logic image_writes_ready,
    output logic [board::IMAGE_WRITES_BITS-1:0] image_writes_data,
    output logic patch_free_valid,
    input  logic patch_free_ready,
    output logic patch_free_data,
    output logic stripe_free_valid,
    input  logic stripe_free_ready,
    output logic stripe_free_data,
    output logic view_done_scan_valid,
    input  logic view_done_scan_ready,
    output logic view_done_scan_data,
    output logic view_done_books_valid,
    input  logic view_done_books_ready,
    output logic view_done_books_data,

    // Register file: `view`, and the address of its image.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::VIEW_SIDE_BITS-1:0] view_height,
    input  logic [board::ADDRESS_BITS-1:0] view_image
);
`include "messages.svh"

  //---- Slots --------------------------------------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  patch_job_t in, job;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [4*board::PATCHES_BITS-1:0] jobs;  // [slot]
  logic [3:0] used;
  logic [31:0] left;  // [slot]: outstanding pixels
  logic [8:0] id;
  logic [31:0] rgba;
  logic takes_pixel;
  assign in = patches_data;
  assign patches_ready = 1'b1;
  assign resolved_ready = 1'b1;
  assign empty_ready = !resolved_valid;
  assign takes_pixel = resolved_valid || empty_valid;
  assign id = resolved_valid ? resolved_data[40:32] : empty_data;
  assign rgba = resolved_valid ? resolved_data[31:0] : 32'd0;

  //---- Words --------------------------------------------------------------------------------------------------------
  logic [1:0] writing, writing_next;  // slot
  logic [3:0] column, column_next;
  logic [1:0] pair, pair_next;
  logic is_last_pair, ends, is_complete, has_space, writes;
  assign job = jobs[{3'b0, writing} * 7'(board::PATCHES_BITS)+:board::PATCHES_BITS];
  assign view = job.view;
  assign is_complete = used[writing] && left[{writing, 3'b0}+:8] == 8'd0;
  assign is_last_pair = {1'b0, pair} + 3'd1 == job.rows[3:1] + {2'b0, job.rows[0]};
  assign ends = is_last_pair && {1'b0, column} + 5'd1 == job.columns;
  assign has_space = !ends || (patch_free_ready && stripe_free_ready && view_done_scan_ready && view_done_books_ready);
  assign image_writes_valid = is_complete && has_space;
  assign writes = image_writes_valid && image_writes_ready;
  assign patch_free_valid = writes && ends;
  assign stripe_free_valid = writes && ends && job.ends_stripe;
  assign view_done_scan_valid = writes && ends && job.ends_view;
  assign view_done_books_valid = writes && ends && job.ends_view;
  assign patch_free_data = 1'b0;
  assign stripe_free_data = 1'b0;
  assign view_done_scan_data = 1'b0;
  assign view_done_books_data = 1'b0;
  assign writing_next = writing + 2'(writes && ends);
  assign pair_next = !writes ? pair : is_last_pair ? 2'd0 : pair + 2'd1;
  assign column_next = !(writes && is_last_pair) ? column : ends ? 4'd0 : column + 4'd1;

  always_ff @(posedge clk) begin
    if (rst) begin
      used <= 4'd0;
      writing <= 2'd0;
      column <= 4'd0;
      pair <= 2'd0;
    end else begin
      if (writes && ends) used[writing] <= 1'b0;
      if (patches_valid) used[in.slot] <= 1'b1;
      writing <= writing_next;
      column <= column_next;
      pair <= pair_next;
    end

    if (takes_pixel) left[{id[8:7], 3'b0}+:8] <= left[{id[8:7], 3'b0}+:8] - 8'd1;
    if (patches_valid) begin
      jobs[{3'b0, in.slot} * 7'(board::PATCHES_BITS)+:board::PATCHES_BITS] <= patches_data;
      left[{in.slot, 3'b0}+:8] <= {3'b0, in.columns} * {4'b0, in.rows};
    end
  end

  //---- Memories -----------------------------------------------------------------------------------------------------
  logic [7:0] write_place, read_place;  // slot, pair of rows, column
  logic [31:0] even_word, odd_word, even, odd, passed;
  logic passes_even, passes_odd;
  assign write_place = {id[8:7], id[6:5], id[3:0]};
  assign read_place = {writing_next, pair_next, column_next};
  dual_port_ram #(
      .WIDTH(32),
      .ADDRESS_BITS(8)
  ) even_rows (
      .clk(clk), .write(takes_pixel && !id[4]), .write_address(write_place), .write_data(rgba), .read(1'b1),
      .read_address(read_place), .read_data(even_word)
  );
  dual_port_ram #(
      .WIDTH(32),
      .ADDRESS_BITS(8)
  ) odd_rows (
      .clk(clk), .write(takes_pixel && id[4]), .write_address(write_place), .write_data(rgba), .read(1'b1),
      .read_address(read_place), .read_data(odd_word)
  );
  always_ff @(posedge clk) begin
    passes_even <= takes_pixel && !id[4] && write_place == read_place;
    passes_odd <= takes_pixel && id[4] && write_place == read_place;
    passed <= rgba;
  end
  assign even = passes_even ? passed : even_word;
  assign odd = {pair, 1'b1} >= job.rows[2:0] && !job.rows[3] ? 32'd0 : passes_odd ? passed : odd_word;

  memory_write_t word;
  logic [17:0] column_words;
  assign column_words = {9'b0, job.stripe, column} * {9'b0, view_height[9:1] + {8'b0, view_height[0]}};
  assign word.address = view_image + {9'b0, column_words} + {19'b0, job.patch_row, pair};
  assign word.data = {odd, even};
  assign word.last = ends && job.ends_view;
  assign image_writes_data = word;
endmodule
