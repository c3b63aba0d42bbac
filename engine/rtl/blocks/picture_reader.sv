// Picture reader (engine/model/blocks/parallel/image_reader.hpp): camera, and line of the ray's plane, of one or two
// images, from the records of these:
//
//     9 cycles      image * (1 + planes), the places of both records
//     4, 5 or 10    a request per cycle; answers are taken beside them
//     1             output
//
// Four words without a shape map, five with one and no gap, ten in a gap. A column without a ray takes one cycle.
module picture_reader (
    input  logic clk,
    input  logic rst,

    input  logic bracketed_valid,
    output logic bracketed_ready,
    input  logic [board::BRACKETED_BITS-1:0] bracketed_data,

    output logic line_reads_valid,
    input  logic line_reads_ready,
    output logic [board::LINE_READS_BITS-1:0] line_reads_data,

    input  logic line_words_valid,
    output logic line_words_ready,
    input  logic [board::LINE_WORDS_BITS-1:0] line_words_data,

    output logic lined_valid,
    input  logic lined_ready,
    output logic [board::LINED_BITS-1:0] lined_data,

    // Register file: the object of `view`.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::PLANE_BITS-1:0] object_planes,
    input  logic [board::ADDRESS_BITS-1:0] object_lines
);
`include "messages.svh"

  localparam logic [3:0] MULTIPLIED = 4'(board::MULTIPLY_CYCLES);
  localparam logic [3:0] WORDS = 4'd5;  // of an image

  /* verilator lint_off UNUSEDSIGNAL */
  bracketed_ray_t ray;
  /* verilator lint_on UNUSEDSIGNAL */
  logic is_none, is_plane, is_shape, reads;
  logic [3:0] multiplied;  // cycles of the product
  logic [3:0] words, requested, answered;
  assign ray = bracketed_data;
  assign view = ray.view;
  assign is_none = ray.kind == 2'(board::RAY_NONE);
  assign is_plane = ray.kind == 2'(board::RAY_PLANE);
  assign is_shape = ray.kind == 2'(board::RAY_SHAPE);
  assign words = is_none ? 4'd0 : is_plane ? WORDS - 4'd1 : is_shape ? 4'd2 * WORDS : WORDS;
  assign reads = bracketed_valid && !is_none && multiplied == MULTIPLIED;
  assign line_reads_valid = reads && requested != words;
  assign line_words_ready = reads && answered != words;
  assign lined_valid = bracketed_valid && answered == words;
  assign bracketed_ready = lined_valid && lined_ready;

  // Both products in one: the numbers of the images are 16 bits apart.
  /* verilator lint_off UNUSEDSIGNAL */
  logic [71:0] product;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [4:0] record_length;
  assign record_length = {1'b0, object_planes} + 5'd1;
  serial_multiplier multiply (
      .clk(clk),
      .start(bracketed_valid && !is_none && multiplied == 4'd0),
      .multiplicand({13'b0, ray.second, 9'b0, ray.first}),
      .multiplier({31'b0, record_length}),
      .product(product)
  );

  // Groups of four words: two of the camera, then three of the plane.
  memory_read_t read;
  logic is_second, is_of_plane;
  logic [2:0] word;
  logic [10:0] record, group;
  assign is_second = requested >= WORDS;
  assign word = is_second ? 3'(requested - WORDS) : requested[2:0];
  assign is_of_plane = word >= 3'd2;
  assign record = is_second ? product[26:16] : product[10:0];
  assign group = is_of_plane ? record + {7'b0, ray.plane} + 11'd1 : record;
  assign read = {object_lines + {14'b0, group, word[1] ^ is_of_plane, word[0]}, 1'b0};
  assign line_reads_data = read;

  logic [63:0] line_words[0:9];
  always_ff @(posedge clk) begin
    if (rst || bracketed_ready) begin
      multiplied <= 4'd0;
      requested <= 4'd0;
      answered <= 4'd0;
    end else begin
      if (bracketed_valid && !is_none && multiplied != MULTIPLIED) multiplied <= multiplied + 4'd1;
      if (line_reads_valid && line_reads_ready) requested <= requested + 4'd1;
      if (line_words_valid && line_words_ready) answered <= answered + 4'd1;
    end
    if (line_words_valid && line_words_ready) line_words[answered] <= line_words_data;
  end

  // Fields that no word gives are 0.
  image_line_t line_0, line_1;
  always_comb begin
    line_0 = '0;
    line_1 = '0;
    if (!is_none) begin
      {line_0.cy_q16, line_0.cx_q16} = line_words[0];
      {line_0.height_q20, line_0.fl_y_q16} = line_words[1];
      {line_0.l1_q30, line_0.l0_q20} = line_words[2];
      {line_0.q1_q16, line_0.q0_q16} = line_words[3];
      if (!is_plane) {line_0.q2_q16, line_0.l2_q30} = line_words[4];
    end
    if (is_shape) begin
      {line_1.cy_q16, line_1.cx_q16} = line_words[5];
      {line_1.height_q20, line_1.fl_y_q16} = line_words[6];
      {line_1.l1_q30, line_1.l0_q20} = line_words[7];
      {line_1.q1_q16, line_1.q0_q16} = line_words[8];
      {line_1.q2_q16, line_1.l2_q30} = line_words[9];
    end
  end
  assign lined_data = {bracketed_data, line_0, line_1};
endmodule
