// Record select of a hop (engine/model/blocks/decompression/record_select.hpp): joins pixels with records, a pixel per
// cycle. The first pixel that needs a record takes it; the record remains valid for the following pixels. A pixel
// without a record at this hop passes.
module record_select #(
    parameter int HOP = 0
) (
    input  logic clk,
    // No register needs a reset: the first pixel has `begins`.
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic rst,
    /* verilator lint_on UNUSEDSIGNAL */

    input  logic coded_pixels_valid,
    output logic coded_pixels_ready,
    input  logic [board::CODED_PIXELS_BITS+(HOP > 0 ? board::CODED_COLOUR_BITS+HOP*board::HOP_LOOKUP_BITS : 0)-1:0] coded_pixels_data,

    input  logic records_valid,
    output logic records_ready,
    input  logic [board::RECORDS_BITS-1:0] records_data,

    output logic next_pixels_valid,
    input  logic next_pixels_ready,
    output logic [board::CODED_PIXELS_BITS+board::CODED_COLOUR_BITS+(HOP+1)*board::HOP_LOOKUP_BITS-1:0] next_pixels_data,

    // Register file: the object of `view`. The height is a multiple of 8.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_coded_height
);
`include "messages.svh"

  localparam int LOOKUPS_BITS = HOP * board::HOP_LOOKUP_BITS;
  localparam int BEHIND_BITS = HOP > 0 ? board::CODED_COLOUR_BITS + LOOKUPS_BITS : 0;

  coded_pixel_t in, out;
  coded_colour_t passed, after;
  hop_lookup_t lookup;
  /* verilator lint_off UNUSEDSIGNAL */
  block_record_t kept, record;
  /* verilator lint_on UNUSEDSIGNAL */
  record_class_t record_class;
  assign in = coded_pixels_data[BEHIND_BITS+:board::CODED_PIXELS_BITS];
  assign view = in.view;

  logic is_new, takes;  // a record
  assign is_new = in.begins || in.row[8:3] != kept.block_row;
  assign takes = in.is_pending && is_new;
  assign next_pixels_valid = coded_pixels_valid && (!takes || records_valid);
  assign coded_pixels_ready = next_pixels_ready && (!takes || records_valid);
  assign records_ready = coded_pixels_valid && next_pixels_ready && takes;
  assign record = is_new ? records_data : kept;
  assign record_class = record.record_class;
  always_ff @(posedge clk) begin
    if (records_ready && records_valid) kept <= records_data;
  end

  // Row of the reference, in the image.
  logic [10:0] row;  // signed
  logic [board::IMAGE_SIDE_BITS-1:0] last_row;
  logic [8:0] clamped_row;
  assign row = {2'b0, in.row} + {{4{record.motion_y[6]}}, record.motion_y};
  assign last_row = object_coded_height - 10'd1;
  assign clamped_row = row[10] ? 9'd0 : row[9:0] > last_row ? last_row[8:0] : row[8:0];

  logic [1:0] quarter;
  logic continues;  // at the next hop
  logic [7:0] alpha_entry;
  logic [31:0] alpha_entries, quarter_entries;
  logic [127:0] all_quarter_entries;
  assign alpha_entries = record.alpha;
  assign alpha_entry = alpha_entries[{quarter, 3'b0}+:8];
  assign all_quarter_entries = record.quarter;
  genvar stage;
  generate
    for (stage = 0; stage < 4; stage = stage + 1) begin : stages
      assign quarter_entries[8*stage+:8] = all_quarter_entries[{2'(stage), quarter, 3'b0}+:8];
    end
  endgenerate
  assign quarter = {in.row[2], in.column[2]};
  assign continues = in.is_pending && record_class.is_predicted;
  always_comb begin
    out = in;
    out.is_pending = continues;
    if (in.is_pending) out.begins = continues && is_new;
    if (continues) begin
      out.row = clamped_row;
      out.column = record.reference_column;
    end
  end

  always_comb begin
    after = passed;
    if (in.is_pending && record.is_empty) after.flat = {3{8'(board::EMPTY_SAMPLE)}};
    else if (in.is_pending && !record_class.is_predicted) after.flat = record.flat;
    if (HOP == 0 && in.is_pending && !record.is_empty) begin  // alpha comes from the first hop
      after.alpha = record_class.has_alpha ? 2'(board::ALPHA_BOOK) : 2'(board::ALPHA_FULL);
      after.alpha_entry = alpha_entry;
    end
  end

  always_comb begin
    lookup = '0;
    if (in.is_pending) begin
      lookup.is_predicted = record_class.is_predicted;
      lookup.block_stages = record_class.block_stages;
      lookup.quarter_stages = record_class.quarter_stages[2:0];
      lookup.block = record.block;
      lookup.quarter = quarter_entries;
      lookup.x = in.column;
      lookup.y = in.row[2:0];
    end
  end

  generate
    if (HOP == 0) begin : first_hop
      assign passed = '0;
      assign next_pixels_data = {out, after, lookup};
    end else begin : later_hop
      assign passed = coded_pixels_data[LOOKUPS_BITS+:board::CODED_COLOUR_BITS];
      assign next_pixels_data = {out, after, coded_pixels_data[LOOKUPS_BITS-1:0], lookup};
    end
  endgenerate
endmodule
