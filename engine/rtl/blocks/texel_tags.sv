// Texel tags (engine/model/blocks/texels/texel_tags.hpp): the lines of the texel cache with the up to four blocks of a
// sample. A block without a line gets one and is requested, a cycle each; then the sample passes.
//
// Four banks by the lowest bits of block column and block row: a sample needs at most one set of each. A bank has 16 sets
// of two lines, with tags and numbers of the last samples in memories.
module texel_tags (
    input  logic clk,
    input  logic rst,

    input  logic placed_valid,
    output logic placed_ready,
    input  logic [board::PLACED_SAMPLES_BITS-1:0] placed_data,

    output logic fills_valid,
    input  logic fills_ready,
    output logic [board::FILLS_BITS-1:0] fills_data,
    output logic waiting_valid,
    input  logic waiting_ready,
    output logic [board::WAITING_BITS-1:0] waiting_data,

    // Register file: the object of `view`.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [31:0] object_serial  // of its load, from 1
);
`include "messages.svh"

  placed_sample_t in;
  logic has_right, has_bottom;  // texels with a weight
  logic [8:0] right, bottom;
  assign in = placed_data;
  assign view = in.view;
  assign has_right = in.fx != 3'd0;
  assign has_bottom = in.fy != 3'd0;
  assign right = in.left + 9'(!in.right_is_left);
  assign bottom = in.top + 9'(!in.bottom_is_top);

  //---- Banks --------------------------------------------------------------------------------------------------------
  logic [31:0] serial;  // of the object
  logic is_other;
  logic [9:0] samples, next_sample;  // number of the last one that has passed, modulo 1024
  logic [9:0] most_waiting;
  logic replaces, passes;
  logic [1:0] missing_bank;
  logic [3:0] is_used, is_hit, hit_way, older_way;  // bank
  logic [39:0] guards;                              // [bank], of the older line
  assign is_other = placed_valid && in.is_inside && object_serial != serial;
  assign next_sample = samples + 10'd1;
  assign most_waiting = 10'(board::WAITING_SAMPLES);
  genvar bank, way;
  generate
    for (bank = 0; bank < 4; bank = bank + 1) begin : banks
      localparam int COLUMN = bank / 2;
      localparam int ROW = bank % 2;
      logic [4:0] column, row;  // without the bit that selects the bank
      logic [3:0] set;
      logic [12:0] tag;
      logic [31:0] valid, valid_next;            // [set][way]
      logic [31:0] used, used_next, used_before;  // in these 512 samples, in the last ones
      logic [15:0] older;                        // [set]: way
      logic [1:0] hits;
      logic [19:0] last_uses;
      logic [9:0] last_use, age;
      logic replaces_line, uses_line, is_recent;
      assign column = in.left[3] == 1'(COLUMN) ? in.left[8:4] : right[8:4];
      assign row = in.top[3] == 1'(ROW) ? in.top[8:4] : bottom[8:4];
      assign set = {in.image[1:0], column[0], row[0]};
      assign tag = {in.image[6:2], column[4:1], row[4:1]};
      for (way = 0; way < 2; way = way + 1) begin : ways
        logic [12:0] stored;
        register_ram #(
            .WIDTH(13),
            .DEPTH(16)
        ) tags (
            .clk(clk), .write(replaces_line && older_way[bank] == 1'(way)), .write_place(set), .write_data(tag),
            .read_place(set), .read_data(stored)
        );
        register_ram #(
            .WIDTH(10),
            .DEPTH(16)
        ) numbers (
            .clk(clk), .write(uses_line && hit_way[bank] == 1'(way)), .write_place(set), .write_data(next_sample),
            .read_place(set), .read_data(last_uses[10*way+:10])
        );
        assign hits[way] = valid[{set, 1'(way)}] && stored == tag && !is_other;
      end
      assign is_hit[bank] = hits != 2'd0;
      assign hit_way[bank] = hits[1];
      assign older_way[bank] = older[set];

      // A guard more than 512 samples ago is sent as one 512 samples ago.
      assign is_recent = used[{set, older_way[bank]}] || used_before[{set, older_way[bank]}];
      assign last_use = older_way[bank] ? last_uses[19:10] : last_uses[9:0];
      assign age = samples - last_use;
      assign guards[10*bank+:10] = is_recent && age < most_waiting ? last_use : samples - most_waiting;

      assign replaces_line = replaces && missing_bank == 2'(bank);
      assign uses_line = passes && is_used[bank];
      always_comb begin
        valid_next = is_other ? 32'd0 : valid;
        if (replaces_line) valid_next[{set, older_way[bank]}] = 1'b1;
        used_next = next_sample[8:0] == 9'd0 ? 32'd0 : used;
        if (uses_line) used_next[{set, hit_way[bank]}] = 1'b1;
      end
      always_ff @(posedge clk) begin
        if (rst) begin
          valid <= 32'd0;
          used <= 32'd0;
          used_before <= 32'd0;
          older <= 16'd0;
        end else begin
          valid <= valid_next;
          if (passes) begin
            used <= used_next;
            if (next_sample[8:0] == 9'd0) used_before <= used;
          end
          if (replaces_line) older[set] <= !older_way[bank];
          if (uses_line) older[set] <= !hit_way[bank];
        end
      end
    end
  endgenerate

  //---- Texels -------------------------------------------------------------------------------------------------------
  logic [3:0] is_needed, is_missing;  // texel
  logic [1:0] missing;                // the first one
  logic [27:0] lines;                 // [texel]
  logic [23:0] places;                // [texel]
  genvar n;
  generate
    for (n = 0; n < 4; n = n + 1) begin : texels
      localparam bit RIGHT = n / 2 == 1;
      localparam bit BOTTOM = n % 2 == 1;
      logic [4:0] x, y;
      logic [1:0] bank_of;
      assign x = RIGHT ? right[4:0] : in.left[4:0];
      assign y = BOTTOM ? bottom[4:0] : in.top[4:0];
      assign bank_of = {x[3], y[3]};
      assign is_needed[n] = in.is_inside && (!RIGHT || has_right) && (!BOTTOM || has_bottom);
      assign is_missing[n] = is_needed[n] && !is_hit[bank_of];
      assign lines[7*n+:7] = is_needed[n] ? {in.image[1:0], x[4:3], y[4:3], hit_way[bank_of]} : 7'd0;
      assign places[6*n+:6] = is_needed[n] ? {x[2:0], y[2:0]} : 6'd0;
    end
  endgenerate
  assign is_used = (is_needed[0] ? 4'd1 << {in.left[3], in.top[3]} : 4'd0) |
                   (is_needed[1] ? 4'd1 << {in.left[3], bottom[3]} : 4'd0) |
                   (is_needed[2] ? 4'd1 << {right[3], in.top[3]} : 4'd0) |
                   (is_needed[3] ? 4'd1 << {right[3], bottom[3]} : 4'd0);
  assign missing = is_missing[0] ? 2'd0 : is_missing[1] ? 2'd1 : is_missing[2] ? 2'd2 : 2'd3;
  assign missing_bank = {missing[1] ? right[3] : in.left[3], missing[0] ? bottom[3] : in.top[3]};

  //---- Control ------------------------------------------------------------------------------------------------------
  logic [2:0] new_fills;  // of the sample
  assign fills_valid = placed_valid && is_missing != 4'd0;
  assign waiting_valid = placed_valid && is_missing == 4'd0;
  assign placed_ready = waiting_ready && is_missing == 4'd0;
  assign replaces = fills_valid && fills_ready;
  assign passes = waiting_valid && waiting_ready;
  always_ff @(posedge clk) begin
    if (rst) begin
      serial <= 32'd0;
      samples <= 10'd0;
      new_fills <= 3'd0;
    end else begin
      if (is_other) serial <= object_serial;
      if (passes) samples <= next_sample;
      new_fills <= passes ? 3'd0 : new_fills + 3'(replaces);
    end
  end

  texel_fill_t fill;
  waiting_sample_t out;
  logic [5:0] block_column, block_row;
  assign block_column = missing[1] ? right[8:3] : in.left[8:3];
  assign block_row = missing[0] ? bottom[8:3] : in.top[8:3];
  assign fill.view = in.view;
  assign fill.image = in.image;
  assign fill.block_column = block_column;
  assign fill.block_row = block_row;
  assign fill.line = {in.image[1:0], block_column[1:0], block_row[1:0], older_way[missing_bank]};
  assign fill.guard = guards[{4'd0, missing_bank} * 6'd10+:10];
  assign fills_data = fill;
  assign out.head = in.head;
  assign out.is_inside = in.is_inside;
  assign out.fx = in.fx;
  assign out.fy = in.fy;
  assign out.lines = lines;
  assign out.texels = places;
  assign out.fills = new_fills;
  assign waiting_data = out;
endmodule
