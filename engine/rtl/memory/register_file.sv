// Register file (engine/model/signals/registers.hpp): objects, and banks of 15 views. A RAM per register and reader, so
// that every block gets its registers in the cycle in which it puts out the number of a view.
//
// The model copies the views of a program to a bank when render_control accepts it. Here they are three banks whose
// roles change: two have programs of render_control, one is written by the host. Accepting a program exchanges
// `next_bank` with the written one; refusing it leaves its words to be written over.
//
// A program is checked while the host writes it (register_error() of the model); that its objects are loaded, when its
// start command arrives. Writes are 3 cycles apart or more.
//
// Registers of the host, in the order in which they must be written; 64-bit numbers in two, the low half first:
//
//     {view, 15, n}     0: object, 1: height | width, 2: b, 3, 4: s0, 5, 6: sy
//     {view, plane, n}  0, 1: n0, 2, 3: nx, 4, 5: t0, 6, 7: tx, 8: a, 9: c
//     {15, 15, 15}      number of views: starts the program
//
// Registers of an object, written by the firmware of the disk's card:
//
//     0: planes | height | width    1: u_cells, x_cells    2..5: x_half, u_half, x_cells_per_unit, u_cells_per_unit
//     6: pitches of alpha, chroma, luma    7..11: addresses of luma, chroma, alpha, map, lines    12: valid
module register_file (
    input  logic clk,
    input  logic rst,

    // A register write of the host. The start comes in the cycle in which its command is in front of `commands`.
    input  logic host_writes,
    input  logic [11:0] host_address,
    input  logic [31:0] host_data,

    // A register write of the disk's card.
    input  logic card_writes,
    input  logic [board::OBJECT_BITS-1:0] card_object,
    input  logic [3:0] card_register,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [31:0] card_data,
    /* verilator lint_on UNUSEDSIGNAL */

    // Render control.
    output logic program_is_valid,
    output logic [board::VIEW_BITS-1:0] program_views,
    input  logic accepts_program,
    input  logic next_bank,
    input  logic active_bank,
    input  logic validates_object,
    input  logic [board::OBJECT_BITS-1:0] loaded_object,
    input  logic view_starts,
    input  logic [board::VIEW_BITS-1:0] started_view,

    // Readers.
    input  logic buffer,
    input  logic [board::VIEW_BITS-1:0] buffer_view,
    output logic [board::VIEW_BITS-1:0] buffer_views,
    output logic [board::IMAGE_SIZE_BITS-1:0] buffer_words,

    input  logic [board::VIEW_BITS-1:0] raster_view,
    input  logic [board::PLANE_BITS-1:0] raster_plane,
    output logic [board::VIEW_SIDE_BITS-1:0] raster_view_width,
    output logic [board::PLANE_BITS-1:0] raster_object_planes,
    output logic [28:0] raster_plane_c_q20,
    output logic [35:0] raster_plane_n0_q32,
    output logic [35:0] raster_plane_nx_q32,
    output logic [35:0] raster_plane_t0_q32,
    output logic [35:0] raster_plane_tx_q32,

    input  logic [board::VIEW_BITS-1:0] position_view,
    input  logic [board::PLANE_BITS-1:0] position_plane,
    output logic [board::MAP_SIDE_BITS-1:0] position_object_x_cells,
    output logic [board::MAP_SIDE_BITS-1:0] position_object_u_cells,
    output logic [31:0] position_object_x_half_q20,
    output logic [31:0] position_object_u_half_q28,
    output logic [31:0] position_object_x_cells_per_unit_q12,
    output logic [31:0] position_object_u_cells_per_unit_q12,
    output logic [board::ADDRESS_BITS-1:0] position_object_map,
    output logic [28:0] position_plane_a_q20,
    output logic [28:0] position_plane_c_q20,

    input  logic [board::VIEW_BITS-1:0] line_view,
    output logic [board::PLANE_BITS-1:0] line_object_planes,
    output logic [board::ADDRESS_BITS-1:0] line_object_lines,

    input  logic [board::VIEW_BITS-1:0] compensation_view,
    output logic [28:0] compensation_view_b_q20,
    output logic [31:0] compensation_view_s0_q28,
    output logic [33:0] compensation_view_sy_q32,
    output logic [board::IMAGE_SIDE_BITS-1:0] compensation_object_width,

    input  logic [board::VIEW_BITS-1:0] address_view,
    output logic [board::IMAGE_SIDE_BITS-1:0] address_object_width,
    output logic [board::IMAGE_SIDE_BITS-4:0] address_object_luma_pitch,
    output logic [board::IMAGE_SIDE_BITS-4:0] address_object_chroma_pitch,
    output logic [board::IMAGE_SIDE_BITS-6:0] address_object_alpha_pitch,
    output logic [board::ADDRESS_BITS-1:0] address_object_luma,
    output logic [board::ADDRESS_BITS-1:0] address_object_chroma,
    output logic [board::ADDRESS_BITS-1:0] address_object_alpha,

    input  logic [board::VIEW_BITS-1:0] scan_view,
    output logic [board::VIEW_SIDE_BITS-1:0] scan_view_height,
    output logic [board::IMAGE_SIDE_BITS-1:0] scan_object_height,

    input  logic [board::VIEW_BITS-1:0] writer_view,
    output logic [board::VIEW_SIDE_BITS-1:0] writer_view_width,
    output logic [board::VIEW_SIDE_BITS-1:0] writer_view_height
);
  localparam int VIEW_BITS = board::VIEW_BITS;
  localparam int PLANE_BITS = board::PLANE_BITS;
  localparam int SIDE_BITS = board::VIEW_SIDE_BITS;
  localparam int OBJECT_BITS = board::OBJECT_BITS;
  localparam int SIZE_BITS = board::IMAGE_SIZE_BITS;
  localparam int BANK_BITS = 2;
  localparam int VIEW_PLACES = 3 << VIEW_BITS;
  localparam int PLANE_PLACES = 3 << (VIEW_BITS + PLANE_BITS);
  localparam logic [3:0] OF_VIEW = 4'd15;
  localparam logic [11:0] START = 12'hfff;

  //---- Banks --------------------------------------------------------------------------------------------------------
  logic [BANK_BITS-1:0] bank_0, bank_1, written_bank, drawn_bank;
  logic [VIEW_BITS-1:0] views_0, views_1;  // of the programs
  assign drawn_bank = active_bank ? bank_1 : bank_0;
  always_ff @(posedge clk) begin
    if (rst) begin
      bank_0 <= 2'd0;
      bank_1 <= 2'd1;
      written_bank <= 2'd2;
    end else if (accepts_program) begin
      written_bank <= next_bank ? bank_1 : bank_0;
      if (next_bank) bank_1 <= written_bank;
      else bank_0 <= written_bank;
    end
    if (accepts_program && !next_bank) views_0 <= program_views;
    if (accepts_program && next_bank) views_1 <= program_views;
  end

  //---- Writes of the host -------------------------------------------------------------------------------------------
  logic [VIEW_BITS-1:0] view;
  logic [PLANE_BITS-1:0] plane;
  logic [3:0] number;
  logic of_view, of_plane;
  assign view = host_address[11:8];
  assign plane = host_address[7:4];
  assign number = host_address[3:0];
  assign of_view = host_writes && view < VIEW_BITS'(board::VIEWS) && plane == OF_VIEW;
  assign of_plane = host_writes && view < VIEW_BITS'(board::VIEWS) && plane < PLANE_BITS'(board::PLANES);

  logic writes_object, writes_size, writes_b, writes_s0, writes_sy;
  assign writes_object = of_view && number == 4'd0;
  assign writes_size = of_view && number == 4'd1;
  assign writes_b = of_view && number == 4'd2;
  assign writes_s0 = of_view && number == 4'd4;
  assign writes_sy = of_view && number == 4'd6;
  logic writes_n0, writes_nx, writes_t0, writes_tx, writes_a, writes_c;
  assign writes_n0 = of_plane && number == 4'd1;
  assign writes_nx = of_plane && number == 4'd3;
  assign writes_t0 = of_plane && number == 4'd5;
  assign writes_tx = of_plane && number == 4'd7;
  assign writes_a = of_plane && number == 4'd8;
  assign writes_c = of_plane && number == 4'd9;

  logic [31:0] low;  // the host's write before
  logic [35:0] wide;
  logic [SIDE_BITS-1:0] width, height;
  logic [SIZE_BITS-1:0] words;  // of the image buffer
  assign wide = {host_data[3:0], low};
  assign width = host_data[SIDE_BITS-1:0];
  assign height = host_data[16+:SIDE_BITS];
  logic [SIDE_BITS-1:0] pairs;  // of rows
  assign pairs = {1'b0, height[SIDE_BITS-1:1]} + {{SIDE_BITS - 1{1'b0}}, height[0]};
  assign words = SIZE_BITS'(width) * SIZE_BITS'(pairs);
  always_ff @(posedge clk) if (host_writes) low <= host_data;

  //---- Checks of the program ----------------------------------------------------------------------------------------
  // A signed number in a register of 29, 34 or 36 bits.
  logic fits_29, fits_34, fits_36, fits_size, fits_object;
  assign fits_29 = &host_data[31:28] || ~|host_data[31:28];
  assign fits_34 = &host_data[31:1] || ~|host_data[31:1];
  assign fits_36 = &host_data[31:3] || ~|host_data[31:3];
  assign fits_size = host_data[15:0] != 16'd0 && host_data[15:0] <= 16'(board::IMAGE_BUFFER_SIDE_PX) &&
                     host_data[31:16] != 16'd0 && host_data[31:16] <= 16'(board::IMAGE_BUFFER_SIDE_PX);
  assign fits_object = host_data < 32'(board::OBJECTS);

  // N and T of the last column, in the two cycles after the write of their step.
  logic [SIDE_BITS-1:0] last_column;
  logic signed [35:0] origin, step;
  logic signed [46:0] at_end;
  logic has_step, has_end, leaves_range;
  assign step = wide;
  assign leaves_range = !(&at_end[46:35] || ~|at_end[46:35]);
  always_ff @(posedge clk) begin
    if (writes_size) last_column <= width - SIDE_BITS'(1);
    if (writes_n0 || writes_t0) origin <= wide;
    if (has_step) at_end <= at_end + 47'(origin);
    else at_end <= 47'(step) * $signed({37'd0, last_column});
    has_step <= !rst && (writes_nx || writes_tx);
    has_end <= !rst && has_step;
  end

  logic fails;
  assign fails = (writes_object && !fits_object) || (writes_size && !fits_size) || (writes_s0 && !fits_36) ||
                 (writes_sy && !fits_34) || ((writes_b || writes_a || writes_c) && !fits_29) ||
                 ((writes_n0 || writes_nx || writes_t0 || writes_tx) && !fits_36) || (has_end && leaves_range);

  // State of the program that the host writes.
  logic is_sound, starts;
  logic [board::OBJECTS-1:0] used_objects, object_is_valid;
  logic [4:0] written_views;
  assign starts = host_writes && host_address == START;
  always_ff @(posedge clk) begin
    if (rst || starts) begin
      is_sound <= 1'b1;
      used_objects <= '0;
      written_views <= '0;
    end else begin
      if (fails) is_sound <= 1'b0;
      if (writes_object && fits_object) used_objects[host_data[OBJECT_BITS-1:0]] <= 1'b1;
      if (writes_object) written_views <= written_views + 5'd1;
    end
  end
  assign program_views = host_data[VIEW_BITS-1:0];
  assign program_is_valid = starts && is_sound && (used_objects & ~object_is_valid) == '0 && host_data != 32'd0 &&
                            host_data <= 32'(board::VIEWS) && host_data[4:0] == written_views;

  //---- Loaded objects -----------------------------------------------------------------------------------------------
  always_ff @(posedge clk) begin
    if (rst) begin
      object_is_valid <= '0;
    end else begin
      if (card_writes && card_register == 4'd12) object_is_valid[card_object] <= card_data[0];
      if (validates_object) object_is_valid[loaded_object] <= 1'b1;
    end
  end

  //---- RAMs ---------------------------------------------------------------------------------------------------------
  logic [BANK_BITS+VIEW_BITS-1:0] view_place;
  logic [BANK_BITS+VIEW_BITS+PLANE_BITS-1:0] plane_place;
  assign view_place = {written_bank, view};
  assign plane_place = {written_bank, view, plane};

  // A register of a view: its RAM for one reader.
  `define VIEW_REGISTER(name, width, is_written, value, reader) \
    register_ram #(.WIDTH(width), .DEPTH(VIEW_PLACES)) name``_ram ( \
        .clk(clk), .write(is_written), .write_place(view_place), .write_data(value), \
        .read_place({drawn_bank, reader}), .read_data(name) \
    );
  // Likewise of a plane, and of an object.
  `define PLANE_REGISTER(name, width, is_written, value, reader) \
    register_ram #(.WIDTH(width), .DEPTH(PLANE_PLACES)) name``_ram ( \
        .clk(clk), .write(is_written), .write_place(plane_place), .write_data(value), \
        .read_place({drawn_bank, reader``_view, reader``_plane}), .read_data(name) \
    );
  `define OBJECT_REGISTER(name, width, number, value, object) \
    register_ram #(.WIDTH(width), .DEPTH(board::OBJECTS)) name``_ram ( \
        .clk(clk), .write(card_writes && card_register == number), .write_place(card_object), .write_data(value), \
        .read_place(object), .read_data(name) \
    );

  `VIEW_REGISTER(raster_view_width, SIDE_BITS, writes_size, width, raster_view)
  `VIEW_REGISTER(compensation_view_b_q20, 29, writes_b, host_data[28:0], compensation_view)
  `VIEW_REGISTER(compensation_view_s0_q28, 32, writes_s0, wide[35:4], compensation_view)
  `VIEW_REGISTER(compensation_view_sy_q32, 34, writes_sy, wide[33:0], compensation_view)
  `VIEW_REGISTER(scan_view_height, SIDE_BITS, writes_size, height, scan_view)
  `VIEW_REGISTER(writer_view_width, SIDE_BITS, writes_size, width, writer_view)
  `VIEW_REGISTER(writer_view_height, SIDE_BITS, writes_size, height, writer_view)

  `PLANE_REGISTER(raster_plane_c_q20, 29, writes_c, host_data[28:0], raster)
  `PLANE_REGISTER(raster_plane_n0_q32, 36, writes_n0, wide, raster)
  `PLANE_REGISTER(raster_plane_nx_q32, 36, writes_nx, wide, raster)
  `PLANE_REGISTER(raster_plane_t0_q32, 36, writes_t0, wide, raster)
  `PLANE_REGISTER(raster_plane_tx_q32, 36, writes_tx, wide, raster)
  `PLANE_REGISTER(position_plane_a_q20, 29, writes_a, host_data[28:0], position)
  `PLANE_REGISTER(position_plane_c_q20, 29, writes_c, host_data[28:0], position)

  // Objects of the views, then their registers.
  logic [OBJECT_BITS-1:0] raster_object, position_object, line_object, compensation_object, address_object, scan_object;
  `VIEW_REGISTER(raster_object, OBJECT_BITS, writes_object, host_data[OBJECT_BITS-1:0], raster_view)
  `VIEW_REGISTER(position_object, OBJECT_BITS, writes_object, host_data[OBJECT_BITS-1:0], position_view)
  `VIEW_REGISTER(line_object, OBJECT_BITS, writes_object, host_data[OBJECT_BITS-1:0], line_view)
  `VIEW_REGISTER(compensation_object, OBJECT_BITS, writes_object, host_data[OBJECT_BITS-1:0], compensation_view)
  `VIEW_REGISTER(address_object, OBJECT_BITS, writes_object, host_data[OBJECT_BITS-1:0], address_view)
  `VIEW_REGISTER(scan_object, OBJECT_BITS, writes_object, host_data[OBJECT_BITS-1:0], scan_view)

  `OBJECT_REGISTER(raster_object_planes, PLANE_BITS, 4'd0, card_data[20+:PLANE_BITS], raster_object)
  `OBJECT_REGISTER(line_object_planes, PLANE_BITS, 4'd0, card_data[20+:PLANE_BITS], line_object)
  `OBJECT_REGISTER(compensation_object_width, board::IMAGE_SIDE_BITS, 4'd0, card_data[0+:board::IMAGE_SIDE_BITS],
                   compensation_object)
  `OBJECT_REGISTER(address_object_width, board::IMAGE_SIDE_BITS, 4'd0, card_data[0+:board::IMAGE_SIDE_BITS],
                   address_object)
  `OBJECT_REGISTER(scan_object_height, board::IMAGE_SIDE_BITS, 4'd0, card_data[10+:board::IMAGE_SIDE_BITS], scan_object)
  `OBJECT_REGISTER(position_object_x_cells, board::MAP_SIDE_BITS, 4'd1, card_data[0+:board::MAP_SIDE_BITS],
                   position_object)
  `OBJECT_REGISTER(position_object_u_cells, board::MAP_SIDE_BITS, 4'd1, card_data[16+:board::MAP_SIDE_BITS],
                   position_object)
  `OBJECT_REGISTER(position_object_x_half_q20, 32, 4'd2, card_data, position_object)
  `OBJECT_REGISTER(position_object_u_half_q28, 32, 4'd3, card_data, position_object)
  `OBJECT_REGISTER(position_object_x_cells_per_unit_q12, 32, 4'd4, card_data, position_object)
  `OBJECT_REGISTER(position_object_u_cells_per_unit_q12, 32, 4'd5, card_data, position_object)
  `OBJECT_REGISTER(address_object_luma_pitch, board::IMAGE_SIDE_BITS - 3, 4'd6,
                   card_data[0+:board::IMAGE_SIDE_BITS-3], address_object)
  `OBJECT_REGISTER(address_object_chroma_pitch, board::IMAGE_SIDE_BITS - 3, 4'd6,
                   card_data[8+:board::IMAGE_SIDE_BITS-3], address_object)
  `OBJECT_REGISTER(address_object_alpha_pitch, board::IMAGE_SIDE_BITS - 5, 4'd6,
                   card_data[16+:board::IMAGE_SIDE_BITS-5], address_object)
  `OBJECT_REGISTER(address_object_luma, board::ADDRESS_BITS, 4'd7, card_data[board::ADDRESS_BITS-1:0], address_object)
  `OBJECT_REGISTER(address_object_chroma, board::ADDRESS_BITS, 4'd8, card_data[board::ADDRESS_BITS-1:0], address_object)
  `OBJECT_REGISTER(address_object_alpha, board::ADDRESS_BITS, 4'd9, card_data[board::ADDRESS_BITS-1:0], address_object)
  `OBJECT_REGISTER(position_object_map, board::ADDRESS_BITS, 4'd10, card_data[board::ADDRESS_BITS-1:0], position_object)
  `OBJECT_REGISTER(line_object_lines, board::ADDRESS_BITS, 4'd11, card_data[board::ADDRESS_BITS-1:0], line_object)

  //---- Images in the two buffers ------------------------------------------------------------------------------------
  // Copied when a view starts: the host reads a buffer while its bank may have the next program.
  logic [SIZE_BITS-1:0] started_words;
  logic [VIEW_BITS-1:0] buffer_views_0, buffer_views_1;
  `VIEW_REGISTER(started_words, SIZE_BITS, writes_size, words, started_view)
  register_ram #(.WIDTH(SIZE_BITS), .DEPTH(2 << VIEW_BITS)) buffer_words_ram (
      .clk(clk), .write(view_starts), .write_place({active_bank, started_view}), .write_data(started_words),
      .read_place({buffer, buffer_view}), .read_data(buffer_words)
  );
  always_ff @(posedge clk) begin
    if (view_starts && !active_bank) buffer_views_0 <= views_0;
    if (view_starts && active_bank) buffer_views_1 <= views_1;
  end
  assign buffer_views = buffer ? buffer_views_1 : buffer_views_0;
endmodule
