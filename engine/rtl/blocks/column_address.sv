// Column address (engine/model/blocks/prototype/image_scan.hpp): first words of a photo column's Y, chroma and alpha.
// Five products, one after the other:
//
//     cycle  1       take the column                    29..37  (photo * chroma width + column >> 1) * chroma pitch
//            2..10   photo * width                      38..46  (photo * width + column) * alpha pitch
//            11..19  photo * chroma width               47      + the first word of the photos' alpha
//            20..28  (.. + column) * luma pitch         48      output
module column_address (
    input  logic clk,
    input  logic rst,

    input  logic walks_valid,
    output logic walks_ready,
    input  logic [board::WALKS_BITS-1:0] walks_data,

    output logic placed_valid,
    input  logic placed_ready,
    output logic [board::PLACED_BITS-1:0] placed_data,

    // Register file: the object of `view`.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::IMAGE_SIDE_BITS-1:0] object_width,
    input  logic [board::IMAGE_SIDE_BITS-4:0] object_luma_pitch,    // words of 8 rows
    input  logic [board::IMAGE_SIDE_BITS-4:0] object_chroma_pitch,  // words of 8 rows of the photo
    input  logic [board::IMAGE_SIDE_BITS-6:0] object_alpha_pitch,   // words of 32 rows
    input  logic [board::ADDRESS_BITS-1:0] object_luma,
    input  logic [board::ADDRESS_BITS-1:0] object_chroma,
    input  logic [board::ADDRESS_BITS-1:0] object_alpha
);
`include "messages.svh"

  // Values of `left` at the beginning of each product.
  localparam logic [5:0] TAKEN = 6'(board::COLUMN_ADDRESS_LATENCY - 1);
  localparam logic [5:0] WITHOUT_RAY = 6'(board::NO_RAY_LATENCY - 1);
  localparam logic [5:0] PRODUCT = 6'(board::MULTIPLY_CYCLES);
  localparam logic [5:0] CHROMA_COLUMN = TAKEN - PRODUCT;
  localparam logic [5:0] LUMA_WORD = CHROMA_COLUMN - PRODUCT;
  localparam logic [5:0] CHROMA_WORD = LUMA_WORD - PRODUCT;
  localparam logic [5:0] ALPHA_WORD = CHROMA_WORD - PRODUCT;
  localparam logic [5:0] ALPHA_SUM = ALPHA_WORD - PRODUCT;

  column_walk_t in, walk;
  placed_column_t placed;
  logic [5:0] left;  // cycles to the end of the column; 0: none
  logic [16:0] column;  // of all photos
  logic [16:0] chroma_column;
  logic [26:0] luma, chroma, alpha;
  assign in = walks_data;
  assign view = walk.view;
  assign walks_ready = left == 6'd0;
  assign placed_valid = left == 6'd1;

  logic start;
  logic [16:0] multiplicand;
  logic [9:0] multiplier;
  logic [9:0] chroma_width;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [71:0] product;
  /* verilator lint_on UNUSEDSIGNAL */
  assign chroma_width = {1'b0, object_width[9:1]} + {9'b0, object_width[0]};
  assign start = left == TAKEN || left == CHROMA_COLUMN || left == LUMA_WORD || left == CHROMA_WORD ||
                 left == ALPHA_WORD;
  assign multiplicand = left == TAKEN || left == CHROMA_COLUMN ? {10'b0, walk.image} :
                        left == CHROMA_WORD ? chroma_column : column;
  assign multiplier = left == TAKEN ? object_width :
                      left == CHROMA_COLUMN ? chroma_width :
                      left == LUMA_WORD ? {3'b0, object_luma_pitch} :
                      left == CHROMA_WORD ? {3'b0, object_chroma_pitch} : {5'b0, object_alpha_pitch};
  serial_multiplier multiply (
      .clk(clk),
      .start(start),
      .multiplicand({19'b0, multiplicand}),
      .multiplier({26'b0, multiplier}),
      .product(product)
  );

  always_ff @(posedge clk) begin
    if (rst) begin
      left <= 6'd0;
    end else if (left == 6'd0) begin
      if (walks_valid) left <= in.has_ray ? TAKEN : WITHOUT_RAY;
    end else if (left != 6'd1 || placed_ready) begin
      left <= left - 6'd1;
    end

    if (walks_ready) walk <= in;
    if (left == CHROMA_COLUMN) column <= product[16:0] + {8'b0, walk.column};
    if (left == LUMA_WORD) chroma_column <= product[16:0] + {9'b0, walk.column[8:1]};
    if (left == CHROMA_WORD) luma <= object_luma + product[26:0];
    if (left == ALPHA_WORD) chroma <= object_chroma + product[26:0];
    if (left == ALPHA_SUM) alpha <= object_alpha + product[26:0];
  end

  always_comb begin
    placed = '0;
    placed.view = walk.view;
    if (walk.has_ray) begin
      placed.has_ray = 1'b1;
      placed.row_0_q16 = walk.row_0_q16;
      placed.row_step_q16 = walk.row_step_q16;
      placed.luma = luma;
      placed.chroma = chroma;
      placed.alpha = alpha;
    end
  end
  assign placed_data = placed;
endmodule
