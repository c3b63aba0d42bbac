// Colour conversion (engine/model/blocks/shared/colour_conversion.hpp): YUV -> RGB by RECONSTRUCTION.md, section 4, in
// four stages. All stages stall while the last one holds a pixel that the output does not take.
//
//     1  the four products by constants (tables in embedded RAM, or logic)      3  second addition of G
//     2  additions                                                              4  clamp
module colour_conversion #(
    parameter int ALPHA_BITS = 2  // of a sample: 2, or 8 from compressed images
) (
    input  logic clk,
    input  logic rst,

    input  logic samples_valid,
    output logic samples_ready,
    input  logic [board::YUV_BITS+ALPHA_BITS-1:0] samples_data,

    output logic pixels_valid,
    input  logic pixels_ready,
    output logic [board::PIXELS_BITS-1:0] pixels_data
);
`include "messages.svh"

  localparam int REST_BITS = 4 + ALPHA_BITS;
  yuv_pixel_t in;
  logic moves;
  logic [board::COLOUR_STAGES:1] valid;
  assign in = samples_data[ALPHA_BITS+:board::YUV_BITS];
  assign pixels_valid = valid[board::COLOUR_STAGES];
  assign moves = !pixels_valid || pixels_ready;
  assign samples_ready = moves;
  always_ff @(posedge clk) begin
    if (rst) valid <= '0;
    else if (moves) valid <= {valid[board::COLOUR_STAGES-1:1], samples_valid};
  end

  // View and alpha of the pixels in stages 1 to 4.
  logic [REST_BITS-1:0] rest_1, rest_2, rest_3, rest_4;
  always_ff @(posedge clk) begin
    if (moves) begin
      rest_1 <= {in.view, samples_data[ALPHA_BITS-1:0]};
      rest_2 <= rest_1;
      rest_3 <= rest_2;
      rest_4 <= rest_3;
    end
  end

  // 16.16 fixed point, 26 bits signed: the sums are below 2^25.
  function automatic logic signed [25:0] product(input logic [7:0] chroma, input logic signed [25:0] factor);
    product = factor * ({18'b0, chroma} - 26'sd128);
  endfunction
  logic signed [25:0] base, r_v, g_u, g_v, b_u;  // stage 1
  logic signed [25:0] r_2, g_2, b_2, g_v_2;
  logic signed [25:0] r_3, g_3, b_3;
  always_ff @(posedge clk) begin
    if (moves) begin
      base <= {2'b0, in.y, 16'h8000};
      r_v <= product(in.v, 26'sd91881);
      g_u <= product(in.u, 26'sd22554);
      g_v <= product(in.v, 26'sd46802);
      b_u <= product(in.u, 26'sd116130);

      r_2 <= base + r_v;
      g_2 <= base - g_u;
      b_2 <= base + b_u;
      g_v_2 <= g_v;

      r_3 <= r_2;
      g_3 <= g_2 - g_v_2;
      b_3 <= b_2;
    end
  end

  // A transparent pixel is 0.
  /* verilator lint_off UNUSEDSIGNAL */
  function automatic logic [7:0] clamped(input logic signed [25:0] sum, input logic is_opaque);
    clamped = sum[25] || !is_opaque ? 8'd0 : sum[24] ? 8'd255 : sum[23:16];
  endfunction
  /* verilator lint_on UNUSEDSIGNAL */
  logic is_opaque;
  logic [7:0] r_4, g_4, b_4;
  assign is_opaque = rest_3[ALPHA_BITS-1:0] != '0;
  always_ff @(posedge clk) begin
    if (moves) begin
      r_4 <= clamped(r_3, is_opaque);
      g_4 <= clamped(g_3, is_opaque);
      b_4 <= clamped(b_3, is_opaque);
    end
  end

  rgba_pixel_t pixel;
  assign pixel.view = rest_4[ALPHA_BITS+:4];
  assign pixel.rgba = {{(8 / ALPHA_BITS) {rest_4[ALPHA_BITS-1:0]}}, b_4, g_4, r_4};
  assign pixels_data = pixel;
endmodule
