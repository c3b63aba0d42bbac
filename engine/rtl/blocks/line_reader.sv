// Line reader (engine/model/blocks/prototype/line_reader.hpp): camera and line of a photo, four words of its record:
//
//     9 cycles      photo * (1 + planes), the place of its record
//     4 or more     a request per cycle; answers are taken beside them
//     1             output
//
// A column without a ray takes one cycle.
module line_reader (
    input  logic clk,
    input  logic rst,

    input  logic mapped_valid,
    output logic mapped_ready,
    input  logic [board::MAPPED_BITS-1:0] mapped_data,

    output logic line_reads_valid,
    input  logic line_reads_ready,
    output logic [board::LINE_READS_BITS-1:0] line_reads_data,

    input  logic line_words_valid,
    output logic line_words_ready,
    input  logic [board::LINE_WORDS_BITS-1:0] line_words_data,

    output logic lines_valid,
    input  logic lines_ready,
    output logic [board::LINES_BITS-1:0] lines_data,

    // Register file: the object of `view`.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::PLANE_BITS-1:0] object_planes,
    input  logic [board::ADDRESS_BITS-1:0] object_lines
);
`include "messages.svh"

  localparam logic [3:0] MULTIPLIED = 4'(board::MULTIPLY_CYCLES);
  localparam logic [2:0] WORDS = 3'd4;

  mapped_ray_t ray;
  logic has_ray;
  logic [3:0] multiplied;  // cycles of the product
  logic [2:0] requested, answered;
  logic [63:0] words[0:3];
  assign ray = mapped_data;
  assign view = ray.view;
  assign has_ray = mapped_valid && ray.has_ray;
  assign line_reads_valid = has_ray && multiplied == MULTIPLIED && requested != WORDS;
  assign line_words_ready = has_ray && multiplied == MULTIPLIED && answered != WORDS;
  assign lines_valid = mapped_valid && (!ray.has_ray || answered == WORDS);
  assign mapped_ready = lines_valid && lines_ready;

  /* verilator lint_off UNUSEDSIGNAL */
  logic [71:0] product;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [4:0] record_length;
  assign record_length = {1'b0, object_planes} + 5'd1;
  serial_multiplier multiply (
      .clk(clk),
      .start(has_ray && multiplied == 4'd0),
      .multiplicand({29'b0, ray.image}),
      .multiplier({31'b0, record_length}),
      .product(product)
  );

  // Pairs of words: the photo's camera, then its line of the plane.
  memory_read_t read;
  logic [25:0] pair;
  assign pair = requested[1] ? product[25:0] + {22'b0, ray.plane} + 26'd1 : product[25:0];
  assign read = {object_lines + {pair, requested[0]}, 1'b0};
  assign line_reads_data = read;

  always_ff @(posedge clk) begin
    if (rst || mapped_ready) begin
      multiplied <= 4'd0;
      requested <= 3'd0;
      answered <= 3'd0;
    end else begin
      if (has_ray && multiplied != MULTIPLIED) multiplied <= multiplied + 4'd1;
      if (line_reads_valid && line_reads_ready) requested <= requested + 3'd1;
      if (line_words_valid && line_words_ready) answered <= answered + 3'd1;
    end
    if (line_words_valid && line_words_ready) words[answered[1:0]] <= line_words_data;
  end

  ray_line_t line;
  always_comb begin
    line = '0;
    line.view = ray.view;
    if (ray.has_ray) begin
      line.has_ray = 1'b1;
      line.x_q20 = ray.x_q20;
      line.lambda_q20 = ray.lambda_q20;
      line.image = ray.image;
      line.cx_q16 = words[0][31:0];
      line.cy_q16 = words[0][63:32];
      line.fl_y_q16 = words[1][31:0];
      line.height_q20 = words[1][63:32];
      line.l0_q20 = words[2][31:0];
      line.l1_q30 = words[2][63:32];
      line.q0_q16 = words[3][31:0];
      line.q1_q16 = words[3][63:32];
    end
  end
  assign lines_data = line;
endmodule
