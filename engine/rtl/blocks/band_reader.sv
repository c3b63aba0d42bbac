// Band reader (engine/model/blocks/parallel/band_reader.hpp): assigns a column its place in the stripe, sends a part of
// its set-up to each of three blocks, and requests the four columns of cells beside its ray:
//
//     18 cycles     only with a shape: (line * p_cells + place) * words, two products, for each of the two lines
//     1             output to the three blocks
//     a word each   for both places in p: word by word, first that of the first line, then that of the second
//
// A ray beside the same cells as the previous one with a shape requests nothing. The first column of a stripe waits until
// the second to last stripe is drawn. The number of pipes must be a power of two.
module band_reader #(
    parameter int PIPE = 0,
    parameter int PIPES = 16
) (
    input  logic clk,
    input  logic rst,

    input  logic set_up_valid,
    output logic set_up_ready,
    input  logic [board::SET_UP_BITS-1:0] set_up_data,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic stripe_free_valid,
    output logic stripe_free_ready,
    input  logic stripe_free_data,  // without content
    /* verilator lint_on UNUSEDSIGNAL */

    output logic band_reads_valid,
    input  logic band_reads_ready,
    output logic [board::MAP_READS_BITS-1:0] band_reads_data,
    output logic rise_columns_valid,
    input  logic rise_columns_ready,
    output logic [board::RISE_COLUMNS_BITS-1:0] rise_columns_data,
    output logic march_columns_valid,
    input  logic march_columns_ready,
    output logic [board::MARCH_COLUMNS_BITS-1:0] march_columns_data,
    output logic place_columns_valid,
    input  logic place_columns_ready,
    output logic [board::PLACE_COLUMNS_BITS-1:0] place_columns_data,

    // Register file: `view`, and the shape map of its object.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::VIEW_SIDE_BITS-1:0] view_width,
    input  logic [12:0] shape_p_cells,
    input  logic [8:0] shape_bands,
    input  logic [board::ADDRESS_BITS-1:0] shape_cells
);
`include "messages.svh"

  localparam logic [4:0] FIRST_PRODUCT = 5'(board::MULTIPLY_CYCLES);
  localparam logic [4:0] SECOND_PRODUCT = 5'(2 * board::MULTIPLY_CYCLES);

  /* verilator lint_off UNUSEDSIGNAL */
  column_setup_t in;
  /* verilator lint_on UNUSEDSIGNAL */
  logic is_shape, requests, may_begin, works, is_known, sends;
  logic [4:0] multiplied;  // cycles of the products
  assign in = set_up_data;
  assign view = in.view;
  assign is_shape = in.kind == 2'(board::RAY_SHAPE);

  //---- Place of the column ------------------------------------------------------------------------------------------
  logic in_view;
  logic [1:0] free_stripes, free_now;  // with the one that becomes free in this cycle
  logic [1:0] kept_number, number;     // of the stripe, modulo 4
  logic [3:0] column;
  logic [5:0] kept_stripe, stripe;     // first column of the view / 16
  logic [9:0] next_column;             // of the view
  assign stripe_free_ready = 1'b1;
  assign free_now = free_stripes + 2'(stripe_free_valid);
  assign may_begin = column != 4'd0 || free_now != 2'd0;
  assign number = column == 4'd0 ? kept_number + 2'd1 : kept_number;
  // The first pipe of a view is another one than that of the view before.
  assign stripe = in_view ? kept_stripe : 6'(PIPE - board::STRIPE_TURN * in.view) & 6'(PIPES - 1);
  assign next_column = column == 4'd15 ? {stripe + 6'(PIPES), 4'd0} : {stripe, column + 4'd1};

  assign works = set_up_valid && !requests && may_begin;
  assign is_known = works && (!is_shape || multiplied == SECOND_PRODUCT);
  assign sends = is_known && rise_columns_ready && march_columns_ready && place_columns_ready;
  assign rise_columns_valid = is_known && march_columns_ready && place_columns_ready;
  assign march_columns_valid = is_known && rise_columns_ready && place_columns_ready;
  assign place_columns_valid = is_known && rise_columns_ready && march_columns_ready;
  assign set_up_ready = sends;

  always_ff @(posedge clk) begin
    if (rst) begin
      in_view <= 1'b0;
      free_stripes <= 2'd2;
      kept_number <= 2'd3;
      column <= 4'd0;
      multiplied <= 5'd0;
    end else begin
      free_stripes <= free_now - 2'(sends && column == 4'd0);
      if (sends) begin
        kept_number <= number;
        in_view <= next_column < view_width;
        column <= next_column < view_width ? next_column[3:0] : 4'd0;
        multiplied <= 5'd0;
      end else if (works && is_shape && multiplied != SECOND_PRODUCT) begin
        multiplied <= multiplied + 5'd1;
      end
    end
    if (sends) kept_stripe <= next_column[9:4];
  end

  //---- Columns of cells ---------------------------------------------------------------------------------------------
  // The second place in p is the first one or the next.
  /* verilator lint_off UNUSEDSIGNAL */
  logic [8:0] words_times_4;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [6:0] column_words, words;  // of a column of cells; of those that are requested
  logic is_next_place, starts;
  logic [12:0] place;
  assign words_times_4 = shape_bands + 9'd3;
  assign column_words = words_times_4[8:2];
  assign place = in.map_place[12:0];
  assign is_next_place = place != in.map_place[25:13];
  assign starts = works && is_shape && (multiplied == 5'd0 || multiplied == FIRST_PRODUCT);

  logic held_next_place, holds_cells, same_cells;
  logic [1:0] same_columns;
  logic is_second_line, is_second_place;  // of the next request
  logic ends_place;
  logic [6:0] word;
  logic [53:0] addresses;                 // [line], of the next requests
  logic [26:0] step;                      // to the next words
  genvar n;
  generate
    for (n = 0; n < 2; n = n + 1) begin : lines
      /* verilator lint_off UNUSEDSIGNAL */
      logic [71:0] product;
      /* verilator lint_on UNUSEDSIGNAL */
      logic [26:0] held;  // product of the cells that are requested
      serial_multiplier multiply (
          .clk(clk),
          .start(starts),
          .multiplicand(multiplied == 5'd0 ? {9'd0, in.map_line[27*n+:27]} : {1'b0, product[34:0]} + {23'd0, place}),
          .multiplier(multiplied == 5'd0 ? {23'd0, shape_p_cells} : {29'd0, column_words}),
          .product(product)
      );
      assign same_columns[n] = product[26:0] == held;
      always_ff @(posedge clk) begin
        if (sends && is_shape) begin
          held <= product[26:0];
          addresses[27*n+:27] <= shape_cells + product[26:0];
        end else if (band_reads_valid && band_reads_ready && is_second_line) begin
          addresses[27*n+:27] <= addresses[27*n+:27] + step;
        end
      end
    end
  endgenerate
  assign same_cells = is_shape && in_view && holds_cells && &same_columns && is_next_place == held_next_place;

  memory_read_t read;
  assign ends_place = word + 7'd1 == words;
  assign step = ends_place && !held_next_place ? 27'd1 - {20'd0, words} : 27'd1;
  assign read = {is_second_line ? addresses[53:27] : addresses[26:0], 1'b0};
  assign band_reads_valid = requests;
  assign band_reads_data = read;
  always_ff @(posedge clk) begin
    if (rst) begin
      requests <= 1'b0;
      holds_cells <= 1'b0;
    end else begin
      if (sends && is_shape) requests <= !same_cells;
      else if (band_reads_ready && is_second_line && ends_place && is_second_place) requests <= 1'b0;
      if (sends) holds_cells <= is_shape || (in_view && holds_cells);  // the next view may have another object
    end
    if (sends) begin
      is_second_line <= 1'b0;
      is_second_place <= 1'b0;
      word <= 7'd0;
    end else if (band_reads_valid && band_reads_ready) begin
      is_second_line <= !is_second_line;
      if (is_second_line) word <= ends_place ? 7'd0 : word + 7'd1;
      if (is_second_line && ends_place) is_second_place <= 1'b1;
    end
    if (sends && is_shape) begin
      held_next_place <= is_next_place;
      words <= column_words;
    end
  end

  //---- Output -------------------------------------------------------------------------------------------------------
  rise_column_t rise;
  march_column_t march;
  place_column_t sample;
  /* verilator lint_off UNUSEDSIGNAL */
  image_setup_t image_0;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [6:0] image;
  assign image_0 = in.image_0;
  assign image = in.kind == 2'(board::RAY_PLANE) ? in.image : image_0.image;
  assign rise = {in.view, in.kind, number, column, in.lambda_foot_q20, in.inverse_r_q20, in.inverse_rho_q20};
  assign march = {in.view, in.kind, number, column, in.weight, in.line_part, in.p_part, same_cells};
  assign sample = {in.view, in.kind, number, column, in.row_0_q16, in.row_step_q16, in.image_column, in.image_1, image,
                   in.image_0[224:0], in.weight, in.lambda0_q20, in.lambda1_q21[21:0]};
  assign rise_columns_data = rise;
  assign march_columns_data = march;
  assign place_columns_data = sample;
endmodule
