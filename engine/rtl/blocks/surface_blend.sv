// Surface blend (engine/model/blocks/texels/surface_blend.hpp): blends the one or two samples of a surface, resolves the
// sums to R, G, B and alpha, and composites what the pixel has shown so far over them, in sixteen stages behind the last
// sample. A transparent pixel, or one that its last surface does not cover, returns. All stages stall while the last one
// holds a pixel that its output does not take.
//
//     1 .. 4   first * (256 - weight) + second * weight      5       numerators, alpha
//     6 .. 13  quotients, a bit each                         14      colour; what was shown so far
//     15, 16   over
//
// The colours of returned pixels are read in stage 13 and written behind stage 16: a pixel is not in the stages twice.
module surface_blend (
    input  logic clk,
    input  logic rst,

    input  logic filtered_valid,
    output logic filtered_ready,
    input  logic [board::FILTERED_BITS-1:0] filtered_data,

    output logic resolved_valid,
    input  logic resolved_ready,
    output logic [board::RESOLVED_BITS-1:0] resolved_data,
    output logic again_valid,
    input  logic again_ready,
    output logic [board::AGAIN_BITS-1:0] again_data
);
`include "messages.svh"

  localparam int STAGES = board::SURFACE_BLEND_STAGES;
  localparam int FIRST_BIT = 6;  // stages of the quotients
  localparam int LAST_BIT = 13;
  localparam logic [7:0] COVERING = 8'(board::COVERING_ALPHA);

  filtered_sample_t in;
  sample_head_t head;
  logic moves;
  logic [STAGES:1] valid;
  logic returns_16;
  assign in = filtered_data;
  assign head = in.head;
  assign moves = !valid[STAGES] || (returns_16 ? again_ready : resolved_ready);
  assign filtered_ready = moves;
  assign resolved_valid = valid[STAGES] && !returns_16;
  assign again_valid = valid[STAGES] && returns_16;

  //---- Samples of the surface: whether the point is in the image; R, G, B, alpha of 22 bits, alpha in the low ones ------
  logic takes, ends, exists_0, exists_1, has_0, has_1;
  logic [87:0] kept_0, kept_1, sums, first, second;
  assign takes = moves && filtered_valid;
  assign ends = takes && head.last;
  assign sums = {in.b, in.g, in.r, 8'd0, in.a};
  assign has_0 = head.is_there && !head.second ? in.is_inside : exists_0;
  assign has_1 = head.is_there && head.second ? in.is_inside : exists_1;
  assign first = head.is_there && !head.second ? sums : kept_0;
  assign second = head.is_there && head.second ? sums : kept_1;
  always_ff @(posedge clk) begin
    if (rst) begin
      valid <= '0;
      exists_0 <= 1'b0;
      exists_1 <= 1'b0;
    end else if (moves) begin
      valid <= {valid[STAGES-1:1], ends};
      if (takes) begin
        exists_0 <= has_0 && !head.last;
        exists_1 <= has_1 && !head.last;
      end
    end
    if (takes) begin
      kept_0 <= first;
      kept_1 <= second;
    end
  end

  // Number of the pixel, its continuation, and whether no other surface is tried.
  logic [18:0] heads[1:STAGES];
  always_ff @(posedge clk) begin
    if (moves) begin
      heads[1] <= {head.id, head.next, head.is_final};
      for (int n = 2; n <= STAGES; n = n + 1) heads[n] <= heads[n-1];
    end
  end

  //---- Blend --------------------------------------------------------------------------------------------------------
  logic is_empty;  // no sample, or one that states that the point is not on the object
  logic [8:0] weight_1;
  assign is_empty = !(has_0 || has_1) || (has_0 && first[21:0] == 22'd0) || (has_1 && second[21:0] == 22'd0);
  always_ff @(posedge clk) begin
    if (moves) weight_1 <= head.weight;  // without effect on one sample, which is mixed with itself
  end
  /* verilator lint_off UNUSEDSIGNAL */
  logic [119:0] sums_4;  // [alpha, R, G, B] of 30 bits, alpha in the low ones; alpha has 22
  /* verilator lint_on UNUSEDSIGNAL */
  genvar c;
  generate
    for (c = 0; c < 4; c = c + 1) begin : channels
      logic [21:0] base, other, base_1, base_2, base_3;
      logic signed [22:0] difference_1;
      logic [27:0] low_2;  // these three signed
      logic [24:0] high_2;
      logic [29:0] product_3;
      assign base = is_empty ? 22'd0 : has_0 ? first[22*c+:22] : second[22*c+:22];
      assign other = is_empty ? 22'd0 : has_1 ? second[22*c+:22] : first[22*c+:22];
      always_ff @(posedge clk) begin
        if (moves) begin
          base_1 <= base;
          difference_1 <= {1'b0, other} - {1'b0, base};
          base_2 <= base_1;
          low_2 <= {{5{difference_1[22]}}, difference_1} * {23'd0, weight_1[4:0]};
          high_2 <= {{2{difference_1[22]}}, difference_1} * {21'd0, weight_1[8:5]};
          base_3 <= base_2;
          product_3 <= {{2{low_2[27]}}, low_2} + {high_2, 5'd0};
          sums_4[30*c+:30] <= {base_3, 8'd0} + product_3;
        end
      end
    end
  endgenerate

  //---- Quotients ----------------------------------------------------------------------------------------------------
  logic [21:0] divisors[5:LAST_BIT];
  logic [7:0] alphas[5:LAST_BIT];
  logic [LAST_BIT:5] is_nothing;  // no alpha at all
  logic [21:0] divisor_4;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [21:0] rounded_alpha_4;
  /* verilator lint_on UNUSEDSIGNAL */
  assign divisor_4 = sums_4[21:0];
  assign rounded_alpha_4 = divisor_4 + 22'd8192;
  always_ff @(posedge clk) begin
    if (moves) begin
      divisors[5] <= divisor_4;
      alphas[5] <= rounded_alpha_4[21:14];
      is_nothing <= {is_nothing[LAST_BIT-1:5], divisor_4 == 22'd0};
      for (int n = FIRST_BIT; n <= LAST_BIT; n = n + 1) begin
        divisors[n] <= divisors[n-1];
        alphas[n] <= alphas[n-1];
      end
    end
  end
  logic [23:0] quotients_13;  // [R, G, B]
  genvar bit_stage;
  generate
    for (c = 0; c < 3; c = c + 1) begin : dividers
      // Before a bit: the rest, and the bits of the numerator that are still to come above those of the quotient.
      logic [29:0] states[5:LAST_BIT];
      always_ff @(posedge clk) begin
        if (moves) states[5] <= sums_4[30*c+30+:30] + {9'd0, divisor_4[21:1]};
      end
      for (bit_stage = FIRST_BIT; bit_stage <= LAST_BIT; bit_stage = bit_stage + 1) begin : bits
        logic [22:0] rest;
        logic [21:0] difference;
        logic is_less;
        assign rest = states[bit_stage-1][29:7];
        assign {is_less, difference} = rest - {1'b0, divisors[bit_stage-1]};
        always_ff @(posedge clk) begin
          if (moves) begin
            states[bit_stage] <= {is_less ? rest[21:0] : difference, states[bit_stage-1][6:0], !is_less};
          end
        end
      end
      assign quotients_13[8*c+:8] = states[LAST_BIT][7:0];
    end
  endgenerate

  //---- Over ---------------------------------------------------------------------------------------------------------
  logic [31:0] colour_14, shown, shown_14, so_far_16;  // R in the low byte
  logic [511:0] is_shown;  // pixels with a colour in the memory
  logic has_shown_14, is_nothing_14;
  dual_port_ram #(
      .WIDTH(32),
      .ADDRESS_BITS(9)
  ) colours (
      .clk(clk), .write(again_valid), .write_address(heads[STAGES][18:10]), .write_data(so_far_16), .read(moves),
      .read_address(heads[LAST_BIT][18:10]), .read_data(shown)
  );
  assign shown_14 = has_shown_14 ? shown : 32'd0;
  always_ff @(posedge clk) begin
    if (rst) is_shown <= '0;
    else if (valid[STAGES] && moves) is_shown[heads[STAGES][18:10]] <= returns_16;
    if (moves) begin
      has_shown_14 <= is_shown[heads[LAST_BIT][18:10]];
      colour_14 <= alphas[LAST_BIT] == 8'd0 ? 32'd0 : {alphas[LAST_BIT], quotients_13};
      is_nothing_14 <= is_nothing[LAST_BIT];
    end
  end

  // With weight 0 the result is the farther colour, with 256 the nearer one.
  logic is_behind_14, returns_15;
  logic [8:0] weight_14;
  logic [31:0] nearer_14;
  logic [67:0] nearer_15, farther_15;
  assign is_behind_14 = shown_14[31:24] != 8'd0 && colour_14[31:24] >= COVERING;
  assign weight_14 = shown_14[31:24] == 8'd0 ? 9'd0 : !is_behind_14 ? 9'd256 :
                     {1'b0, shown_14[31:24]} + {8'd0, shown_14[31]};
  assign nearer_14 = {is_behind_14 ? 8'd255 : shown_14[31:24], shown_14[23:0]};
  always_ff @(posedge clk) begin
    if (moves) begin
      // Continues at the foot, behind the last surface.
      returns_15 <= !heads[14][0] && (is_nothing_14 || (heads[14][9] && heads[14][8:1] != 8'd0 &&
                                                        colour_14[31:24] < COVERING));
      returns_16 <= returns_15;
      for (int n = 0; n < 4; n = n + 1) begin
        nearer_15[17*n+:17] <= {9'd0, nearer_14[8*n+:8]} * {8'd0, weight_14};
        farther_15[17*n+:17] <= {9'd0, colour_14[8*n+:8]} * {8'd0, 9'd256 - weight_14};
        so_far_16[8*n+:8] <= 8'((nearer_15[17*n+:17] + farther_15[17*n+:17] + 17'd128) >> 8);
      end
    end
  end
  assign resolved_data = {heads[STAGES][18:10], so_far_16};
  assign again_data = heads[STAGES][18:1];
endmodule
