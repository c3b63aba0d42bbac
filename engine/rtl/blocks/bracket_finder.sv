// Bracket finder (engine/model/blocks/parallel/bracket_finder.hpp): finds the two captured rays that enclose a view ray.
// Starts at the image of the RS map and steps along the ring, at most as often as it has images. One ray at a time:
//
//     NEAR          X of the image of the RS map: the ray is in the gap behind it or in the one before it
//     GAP_WORD      S and first_line of the gap; no other word is needed if it has no lines
//     FIRST, SECOND X of both ends, of those that are not known from the gap before
//     DECIDE        output, or the next gap
//
// A word takes a cycle for the request and the memory's latency; X takes 9 cycles behind its word for a product. Rays of
// objects without a shape map take one cycle.
module bracket_finder (
    input  logic clk,
    input  logic rst,

    input  logic mapped_valid,
    output logic mapped_ready,
    input  logic [board::MAPPED_BITS+board::DIRECTION_BITS-1:0] mapped_data,

    output logic bracket_reads_valid,
    input  logic bracket_reads_ready,
    output logic [board::MAP_READS_BITS-1:0] bracket_reads_data,

    input  logic bracket_words_valid,
    output logic bracket_words_ready,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [board::MAP_WORDS_BITS-1:0] bracket_words_data,  // viewpoints are below 2^28 in magnitude
    /* verilator lint_on UNUSEDSIGNAL */

    output logic bracketed_valid,
    input  logic bracketed_ready,
    output logic [board::BRACKETED_BITS-1:0] bracketed_data,

    // Register file: the object of `view`.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic object_has_shape,
    input  logic [board::IMAGE_BITS-1:0] object_images,
    input  logic [board::PLANE_BITS-1:0] object_planes,
    input  logic [board::ADDRESS_BITS-1:0] object_lines
);
`include "messages.svh"

  localparam logic [2:0] NEAR = 3'd0;
  localparam logic [2:0] GAP_WORD = 3'd1;
  localparam logic [2:0] FIRST = 3'd2;
  localparam logic [2:0] SECOND = 3'd3;
  localparam logic [2:0] DECIDE = 3'd4;
  localparam logic [3:0] MULTIPLIED = 4'(board::MULTIPLY_CYCLES);

  mapped_ray_t ray;
  logic [29:0] u_q28;  // signed
  logic [30:0] n_q28;
  logic [31:0] t_q28;  // signed
  logic has_shape;
  assign {ray, u_q28, n_q28, t_q28} = mapped_data;
  assign view = ray.view;
  assign has_shape = ray.has_ray && object_has_shape;

  logic [2:0] step;
  logic [6:0] gap, behind, looks;  // image at which the gap begins, and the one at which it ends
  logic first_known, second_known;
  logic signed [30:0] first_q20, second_q20;  // X of both

  //---- Words of image records ---------------------------------------------------------------------------------------
  logic reads, is_crossing, requested, answers, multiplies;
  logic [3:0] multiplied;  // cycles of the product
  assign reads = mapped_valid && has_shape && step != DECIDE && multiplied == 4'd0;
  assign is_crossing = step != GAP_WORD;
  assign bracket_reads_valid = reads && !requested;
  assign bracket_words_ready = reads && requested;
  assign answers = bracket_words_ready && bracket_words_valid;
  assign multiplies = answers && is_crossing;

  // Records are 1 + K groups of four words: the gap is in the first group, the viewpoint in that of the plane.
  memory_read_t read;
  logic [6:0] image;
  logic [10:0] record, group;
  assign image = step == NEAR ? ray.image : step == SECOND ? behind : gap;
  assign record = {4'b0, image} * ({7'b0, object_planes} + 11'd1);
  assign group = is_crossing ? record + {7'b0, ray.plane} + 11'd1 : record;
  assign read = {object_lines + {14'b0, group, is_crossing ? 2'd3 : 2'd2}, 1'b0};
  assign bracket_reads_data = read;

  //---- Crossing of an image's parallel ray --------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  logic [71:0] product;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [30:0] viewpoint_q20, shift_q20;  // along the tangent, signed
  logic signed [30:0] x_q20, crossing_q20;
  logic crosses;  // the crossing is known at the end of this cycle
  serial_multiplier multiply (
      .clk(clk),
      .start(multiplies),
      .multiplicand({{6{u_q28[29]}}, u_q28}),
      .multiplier({{4{bracket_words_data[63]}}, bracket_words_data[63:32]}),
      .product(product)
  );
  assign shift_q20 = product[58:28];
  assign crossing_q20 = viewpoint_q20 + shift_q20;
  assign x_q20 = {{8{ray.x_q20[22]}}, ray.x_q20};
  assign crosses = multiplied == MULTIPLIED;

  always_ff @(posedge clk) begin
    if (rst) begin
      requested <= 1'b0;
      multiplied <= 4'd0;
    end else begin
      if (bracket_reads_valid && bracket_reads_ready) requested <= 1'b1;
      else if (answers) requested <= 1'b0;
      if (multiplies) multiplied <= 4'd1;
      else if (crosses) multiplied <= 4'd0;
      else if (multiplied != 4'd0) multiplied <= multiplied + 4'd1;
    end
    if (multiplies) viewpoint_q20 <= bracket_words_data[30:0];
  end

  //---- Steps --------------------------------------------------------------------------------------------------------
  logic is_before, is_behind, is_found, ends, moves;
  logic [6:0] gap_before, behind_next, image_before;
  assign is_before = x_q20 < first_q20;
  assign is_behind = x_q20 >= second_q20;

  function automatic logic [6:0] previous(input logic [6:0] number, input logic [6:0] count);
    previous = (number == 7'd0 ? count : number) - 7'd1;
  endfunction
  function automatic logic [6:0] following(input logic [6:0] number, input logic [6:0] count);
    following = number + 7'd1 == count ? 7'd0 : number + 7'd1;
  endfunction
  assign gap_before = previous(gap, object_images);
  assign behind_next = following(behind, object_images);
  assign image_before = previous(ray.image, object_images);

  logic [10:0] lines;
  logic [26:0] first_line;
  logic lines_before, lines_behind;
  logic has_lines, is_nearest_behind;
  assign has_lines = lines != 11'd0;
  assign is_found = has_lines && !is_before && !is_behind;
  assign ends = !has_lines || is_found || looks + 7'd1 == object_images;
  assign moves = mapped_valid && step == DECIDE && !ends;
  assign is_nearest_behind = crossing_q20 > x_q20;  // the ray is before the image of the RS map

  always_ff @(posedge clk) begin
    if (rst || mapped_ready) begin
      step <= NEAR;
      looks <= 7'd0;
      first_known <= 1'b0;
      second_known <= 1'b0;
    end else begin
      if (crosses) begin
        case (step)
          NEAR: begin
            step <= GAP_WORD;
            first_known <= !is_nearest_behind;
            second_known <= is_nearest_behind;
          end
          FIRST: begin
            step <= second_known ? DECIDE : SECOND;
            first_known <= 1'b1;
          end
          default: begin
            step <= DECIDE;
            second_known <= 1'b1;
          end
        endcase
      end
      if (answers && !is_crossing) begin
        if (bracket_words_data[10:0] == 11'd0) step <= DECIDE;
        else step <= !first_known ? FIRST : !second_known ? SECOND : DECIDE;
      end
      if (moves) begin
        step <= GAP_WORD;
        looks <= looks + 7'd1;
        first_known <= !is_before;
        second_known <= is_before;
      end
    end

    if (crosses && step == NEAR) begin
      gap <= is_nearest_behind ? image_before : ray.image;
      behind <= is_nearest_behind ? ray.image : following(ray.image, object_images);
    end else if (moves) begin
      gap <= is_before ? gap_before : behind;
      behind <= is_before ? gap : behind_next;
    end
    if (answers && !is_crossing) begin
      lines <= bracket_words_data[10:0];
      lines_before <= bracket_words_data[16];
      lines_behind <= bracket_words_data[17];
      first_line <= bracket_words_data[58:32];
    end
    if (crosses && (step == FIRST || (step == NEAR && !is_nearest_behind))) first_q20 <= crossing_q20;
    else if (moves && !is_before) first_q20 <= second_q20;
    if (crosses && (step == SECOND || (step == NEAR && is_nearest_behind))) second_q20 <= crossing_q20;
    else if (moves && is_before) second_q20 <= first_q20;
  end

  //---- Output -------------------------------------------------------------------------------------------------------
  bracketed_ray_t bracketed;
  assign bracketed_valid = mapped_valid && (!has_shape || (step == DECIDE && ends));
  assign mapped_ready = bracketed_valid && bracketed_ready;
  assign bracketed_data = bracketed;
  always_comb begin
    bracketed = '0;
    bracketed.view = ray.view;
    bracketed.kind = ray.has_ray ? 2'(board::RAY_PLANE) : 2'(board::RAY_NONE);
    bracketed.plane = ray.plane;
    bracketed.x_q20 = ray.x_q20;
    bracketed.lambda_q20 = ray.lambda_q20;
    bracketed.first = ray.image;
    bracketed.second = ray.image;
    if (has_shape) begin
      bracketed.kind = 2'(board::RAY_FOOT);
      bracketed.n_q28 = n_q28;
      bracketed.t_q28 = t_q28;
      if (is_found) begin
        bracketed.kind = 2'(board::RAY_SHAPE);
        bracketed.first = gap;
        bracketed.second = behind;
        bracketed.from_first_q20 = x_q20 - first_q20;
        bracketed.width_q20 = second_q20 - first_q20;
        bracketed.lines = lines;
        bracketed.first_line = first_line;
        bracketed.lines_before = lines_before;
        bracketed.lines_behind = lines_behind;
      end
    end
  end
endmodule
