// RS map reader (engine/model/blocks/shared/map_reader.hpp): a byte of the map is the photo of a column, 255: none. One
// column at a time: a cycle for the request, the memory's latency, a cycle to pass it on; one cycle without a ray.
module map_reader #(
    parameter int WITH_DIRECTION = 0  // 1: `parallel`, whose messages end with slope and direction
) (
    input  logic clk,
    input  logic rst,

    input  logic points_valid,
    output logic points_ready,
    input  logic [board::POINTS_BITS+WITH_DIRECTION*board::DIRECTION_BITS-1:0] points_data,

    output logic map_reads_valid,
    input  logic map_reads_ready,
    output logic [board::MAP_READS_BITS-1:0] map_reads_data,

    input  logic map_words_valid,
    output logic map_words_ready,
    input  logic [board::MAP_WORDS_BITS-1:0] map_words_data,

    output logic mapped_valid,
    input  logic mapped_ready,
    output logic [board::MAPPED_BITS+WITH_DIRECTION*board::DIRECTION_BITS-1:0] mapped_data
);
`include "messages.svh"

  localparam logic [7:0] NO_IMAGE = 8'd255;

  ray_point_t point;
  memory_read_t read;
  mapped_ray_t mapped;
  logic requested;
  logic [7:0] image;
  assign point = points_data[WITH_DIRECTION*board::DIRECTION_BITS+:board::POINTS_BITS];
  assign map_reads_valid = points_valid && point.has_ray && !requested;
  assign mapped_valid = points_valid && (!point.has_ray || (requested && map_words_valid));
  assign points_ready = mapped_valid && mapped_ready;
  assign map_words_ready = points_valid && point.has_ray && requested && mapped_ready;

  always_ff @(posedge clk) begin
    if (rst) requested <= 1'b0;
    else if (map_reads_valid && map_reads_ready) requested <= 1'b1;
    else if (points_ready) requested <= 1'b0;
  end

  assign read = {point.cell_byte[29:3], 1'b0};
  assign map_reads_data = read;

  assign image = map_words_data[{point.cell_byte[2:0], 3'b0} +: 8];
  always_comb begin
    mapped.view = point.view;
    mapped.has_ray = point.has_ray && image != NO_IMAGE;
    mapped.plane = point.plane;
    mapped.x_q20 = point.x_q20;
    mapped.lambda_q20 = point.lambda_q20;
    mapped.image = point.has_ray ? image[6:0] : 7'd0;
  end
  generate
    if (WITH_DIRECTION == 0) begin : without_direction
      assign mapped_data = mapped;
    end else begin : with_direction
      assign mapped_data = {mapped, points_data[board::DIRECTION_BITS-1:0]};
    end
  endgenerate
endmodule
