// Cell march (engine/model/blocks/parallel/cell_march.hpp): follows a pixel's ray through the surface between the cells
// beside it, a turn of two looks (A, B) at a time, and outputs the first hit. The stages are a ring: a ray that goes on
// leaves the last one for the first. All stages stall while the last one holds a pixel that its output does not take;
// cells are loaded nevertheless.
//
//     1     ray of a continued, returned or new pixel     8       nearest and farthest
//     2, 3  size of a step, depths of the looks           9       groups, products
//     4     effective depths                              10, 11  means
//     5, 6  bands                                         12      hit test
//     7     cells
//
// Writes to the memories of cells pass the stages beside the turn that enters in their cycle, which has one look: look B
// and the write use the same port. While the stages stall, new writes are done at once, since nothing is read. Effective
// depths are written in cycles in which look B does not read that memory.
module cell_march (
    input  logic clk,
    input  logic rst,

    input  logic march_columns_valid,
    output logic march_columns_ready,
    input  logic [board::MARCH_COLUMNS_BITS-1:0] march_columns_data,
    input  logic band_words_valid,
    output logic band_words_ready,
    input  logic [board::SAMPLE_WORDS_BITS-1:0] band_words_data,
    input  logic risen_valid,
    output logic risen_ready,
    input  logic [board::RISEN_BITS-1:0] risen_data,
    input  logic again_valid,
    output logic again_ready,
    input  logic [board::AGAIN_BITS-1:0] again_data,

    output logic met_valid,
    input  logic met_ready,
    output logic [board::MET_BITS-1:0] met_data,
    output logic empty_valid,
    input  logic empty_ready,
    output logic [board::EMPTY_BITS-1:0] empty_data,

    // Register file: the object of the view whose cells are loaded.
    output logic [board::VIEW_BITS-1:0] loading_view,
    input  logic [8:0] loading_shape_bands,
    input  logic [7:0] loading_shape_jump,
    // The object of the turn in stage 4.
    output logic [board::VIEW_BITS-1:0] view,
    input  logic [board::OBJECT_BITS-1:0] view_object,
    input  logic [8:0] object_shape_bands,
    input  logic [7:0] object_shape_jump,
    input  logic [7:0] object_shape_thickness,
    input  logic [10:0] object_shape_foot_d_q3,

    // Effective depths of an object that is being loaded: its number, a depth, and 13 bits (signed).
    input  logic effective_depths_valid,
    output logic effective_depths_ready,
    input  logic [board::OBJECT_BITS+20:0] effective_depths_data
);
`include "messages.svh"

  localparam int STAGES = board::CELL_MARCH_STAGES;
  localparam logic [8:0] FOOT = 9'(board::MARCH_AT_FOOT);
  localparam logic [8:0] BEHIND = FOOT + 9'd1;
  localparam logic [8:0] FARTHEST = FOOT + 9'd2;
  localparam logic [1:0] NO_RAY = 2'(board::RAY_NONE);
  localparam logic [1:0] SHAPE = 2'(board::RAY_SHAPE);
  localparam int CELL_BITS = 26;
  localparam int WORDS_PER_COLUMN = 96;  // words of two cells, in each of the four memories
  localparam int CELL_WORDS = 32 * WORDS_PER_COLUMN;

  // The ray of a pixel under way.
  typedef struct packed {
    logic [3:0] view;
    logic [1:0] stripe;
    logic [29:0] foot_q12;   // these two signed
    logic [23:0] per_d_q20;
  } ray_t;
  // The surfaces at the foot of a ray, from its first look there to the last one.
  typedef struct packed {
    logic exists;
    logic [7:0] depth;       // of the nearest one, whole steps
    logic has_chosen;        // the one that the ray meets in its state
    logic [10:0] depth_q3;
    logic [4:0] lean;
    logic has_behind;        // others that it meets then
    logic has_farthest;
  } foot_t;
  // A turn in the stages. It marches from begin_a to end_a and, if it marches in look B, to end_b.
  typedef struct packed {
    logic [8:0] id;
    logic [3:0] view;
    logic [1:0] stripe;
    logic [8:0] begin_a;     // or the state at the foot
    logic [8:0] end_a;
    logic [8:0] end_b;
    logic march_b;
    logic foot_b;
    logic has_ray;
    logic has_bands;
    logic is_alone;
    logic [27:0] foot;       // foot_t
  } turn_t;
  localparam int RAY_BITS = 60;
  localparam int TURN_BITS = 75;

  logic moves;
  logic [STAGES:1] valid;

  //---- Loading: cells between two lines -------------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  march_column_t in_column, loading, stored;
  logic [8:0] bands_less_1;
  logic [63:0] word, first_word;  // bits of a cell that are always 0
  /* verilator lint_on UNUSEDSIGNAL */
  logic loads, steps, is_second, of_second_place, is_last_word, writes, ends, stores;
  logic [6:0] word_number;
  logic [8:0] held_number;
  logic [63:0] held;
  assign in_column = march_columns_data;
  assign loading_view = loading.view;
  assign march_columns_ready = !loads;
  assign band_words_ready = loads && !loading.same_cells;
  assign steps = loads && (loading.same_cells || band_words_valid);
  assign word = loading.same_cells ? held : band_words_data;
  assign bands_less_1 = loading_shape_bands - 9'd1;
  assign is_last_word = word_number == bands_less_1[8:2];
  assign writes = steps && is_second;
  assign ends = writes && of_second_place && is_last_word;
  assign stores = loads ? ends : march_columns_valid && in_column.kind != SHAPE;
  assign stored = loads ? loading : in_column;
  always_ff @(posedge clk) begin
    if (rst) loads <= 1'b0;
    else loads <= loads ? !ends : march_columns_valid && in_column.kind == SHAPE;
    if (!loads) begin
      loading <= in_column;
      is_second <= 1'b0;
      of_second_place <= 1'b0;
      word_number <= 7'd0;
      held_number <= 9'd0;
    end else if (steps) begin
      is_second <= !is_second;
      held_number <= held_number + 9'd1;
      if (is_second) begin
        word_number <= is_last_word ? 7'd0 : word_number + 7'd1;
        if (is_last_word) of_second_place <= 1'b1;
      end else begin
        first_word <= word;
      end
    end
  end
  dual_port_ram #(
      .WIDTH(64),
      .ADDRESS_BITS(9)
  ) held_words (
      .clk(clk), .write(steps && !loading.same_cells), .write_address(held_number), .write_data(word), .read(1'b1),
      .read_address(loads ? held_number + 9'd1 : 9'd0), .read_data(held)
  );

  // Twice the lean / 8 of RECONSTRUCTION.md: 0, 1, 2 if the first image, both, the second image show the cell.
  function automatic logic [4:0] lean_of(input logic [1:0] shown);
    lean_of = shown == 2'd1 ? 5'd0 : shown == 2'd2 ? 5'd2 : 5'd1;
  endfunction
  function automatic logic [7:0] deeper(input logic [7:0] a, input logic [7:0] b);
    deeper = a < b ? b : a;
  endfunction
  logic [103:0] new_cells;
  genvar n;
  generate
    for (n = 0; n < 4; n = n + 1) begin : lines
      logic [7:0] first_depth, second_depth;
      logic [1:0] first_shown, second_shown;
      logic has_first, has_second, is_weighted, is_near, takes_second;
      logic [8:0] apart, distance;
      logic [3:0] part;  // weight of the second line
      logic [7:0] deepest;
      logic [4:0] lean;
      logic [10:0] depth_q3;
      assign {first_shown, first_depth} = first_word[16*n+:10];
      assign {second_shown, second_depth} = word[16*n+:10];
      assign has_first = first_shown != 2'd0;
      assign has_second = second_shown != 2'd0;
      assign is_weighted = has_second && loading.line_part != 3'd0;
      assign apart = {1'b0, second_depth} - {1'b0, first_depth};
      assign distance = apart[8] ? -apart : apart;
      assign is_near = distance <= {1'b0, loading_shape_jump};
      assign takes_second = !has_first || (is_weighted && loading.line_part[2]);
      assign part = has_first && is_weighted && is_near ? {1'b0, loading.line_part} : {takes_second, 3'd0};
      assign deepest = deeper(has_first ? first_depth : 8'd0, has_second ? second_depth : 8'd0);
      assign lean = {1'b0, 4'd8 - part} * lean_of(first_shown) + {1'b0, part} * lean_of(second_shown);
      assign depth_q3 = {first_depth, 3'd0} + {7'd0, part} * {{2{apart[8]}}, apart};
      assign new_cells[CELL_BITS*n+:CELL_BITS] = {has_first && has_second, deepest, lean, has_first || is_weighted,
                                                  depth_q3};
    end
  endgenerate

  //---- Columns of two stripes -------------------------------------------------------------------------------------------
  logic [31:0] is_stored, is_odd;  // [slot of the stripe, column]; is_odd: the higher bit of the stripe's number
  logic [4:0] stored_place, in_place, place_1;
  logic holds;
  band_ray_t in;
  scanned_pixel_t in_pixel;
  assign in = risen_data;
  assign in_pixel = in.pixel;
  assign stored_place = {stored.stripe[0], stored.column};
  assign in_place = {in_pixel.stripe[0], in_pixel.id[3:0]};
  // A column is there in the cycle of its last cells.
  assign holds = stores && stored_place == in_place ? stored.stripe[1] == in_pixel.stripe[1] :
                                                      is_stored[in_place] && is_odd[in_place] == in_pixel.stripe[1];
  always_ff @(posedge clk) begin
    if (rst) begin
      is_stored <= '0;
    end else if (stores) begin
      // The first column of a stripe removes the columns of the one before it in this slot.
      if (stored.column == 4'd0) is_stored[16*stored.stripe[0]+:16] <= 16'd0;
      is_stored[stored_place] <= 1'b1;
    end
    if (stores) is_odd[stored_place] <= stored.stripe[1];
  end
  logic [5:0] column_1;
  register_ram #(
      .WIDTH(6),
      .DEPTH(32)
  ) columns (
      .clk(clk), .write(stores), .write_place(stored_place),
      .write_data({stored.kind, stored.weight == 9'd0 || stored.weight == 9'd256, stored.p_part}),
      .read_place(place_1), .read_data(column_1)
  );

  //---- Stage 1: the next turn -------------------------------------------------------------------------------------------
  logic is_met_12, is_empty_12, continues_12, continues, returns, takes, enters;
  logic [8:0] next_12;  // of the hit, or of the ray that goes on
  logic [8:0] id_12;
  foot_t foot_1, foot_12;
  returned_pixel_t again;
  ray_t new_ray, new_ray_1, kept_ray_1, ray_1;
  logic is_level;  // crosses less than a band: one step
  logic is_new_1, has_look_b_1;
  logic [8:0] id_1, begin_1;
  assign again = again_data;
  assign continues_12 = !is_met_12 && !is_empty_12;
  assign moves = !valid[STAGES] || continues_12 || (is_met_12 ? met_ready : empty_ready);
  assign continues = valid[STAGES] && continues_12;
  assign again_ready = moves && !continues;
  assign risen_ready = again_ready && !again_valid && holds;
  assign returns = again_ready && again_valid;
  assign takes = risen_ready && risen_valid;
  assign enters = continues || again_valid || (risen_valid && holds);
  assign new_ray = {in_pixel.view, in_pixel.stripe, in.foot_q12, in.per_d_q20};
  assign is_level = in.per_d_q20[23:11] == 13'd0 || (in.per_d_q20[23:11] == 13'h1FFF && in.per_d_q20[10:0] != 11'd0);
  always_ff @(posedge clk) begin
    if (rst) valid <= '0;
    else if (moves) valid <= {valid[STAGES-1:1], enters};
    if (moves) begin
      is_new_1 <= takes;
      has_look_b_1 <= !writes;
      new_ray_1 <= new_ray;
      id_1 <= continues ? id_12 : returns ? again.id : in_pixel.id;
      begin_1 <= continues ? next_12 : returns ? again.begin_d : is_level ? FOOT : 9'd0;
      foot_1 <= continues ? foot_12 : '0;
    end
  end
  dual_port_ram #(
      .WIDTH(RAY_BITS),
      .ADDRESS_BITS(9)
  ) rays (
      .clk(clk), .write(takes), .write_address(in_pixel.id), .write_data(new_ray), .read(moves),
      .read_address(continues ? id_12 : again.id), .read_data(kept_ray_1)
  );

  //---- Stage 2: number of steps, column -----------------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  logic [23:0] slope_size;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [5:0] more_steps_2;  // than one
  logic has_look_b_2;
  logic [8:0] id_2, begin_2;
  foot_t foot_2;
  ray_t ray_2;
  logic [5:0] column_2;  // kind, whether only one image is used, p_part
  assign ray_1 = is_new_1 ? new_ray_1 : kept_ray_1;
  assign place_1 = {ray_1.stripe[0], id_1[3:0]};
  assign slope_size = ray_1.per_d_q20[23] ? -ray_1.per_d_q20 : ray_1.per_d_q20;
  always_ff @(posedge clk) begin
    if (moves) begin
      id_2 <= id_1;
      begin_2 <= begin_1;
      foot_2 <= foot_1;
      ray_2 <= ray_1;
      has_look_b_2 <= has_look_b_1;
      column_2 <= column_1;
      more_steps_2 <= slope_size[23:17] != 7'd0 ? 6'd63 : slope_size[16:11];
    end
  end

  //---- Stage 3: depths of the looks, in the middle of a step ----------------------------------------------------------------
  logic [511:0] step_sizes;
  logic [7:0] size;
  logic is_march_2;
  logic [8:0] end_a_2, middle_a_2, middle_b_2;
  turn_t turn_2;
  generate
    for (n = 0; n < 64; n = n + 1) begin : table_of_sizes
      assign step_sizes[8*n+:8] = 8'(256 / (n + 1));
    end
  endgenerate
  assign size = step_sizes[8*more_steps_2+:8];
  assign is_march_2 = !begin_2[8];
  assign end_a_2 = begin_2 + {1'b0, size};
  assign middle_a_2 = begin_2 + {2'b0, size[7:1]};
  assign middle_b_2 = end_a_2 + {2'b0, size[7:1]};
  function automatic logic [7:0] at_most_255(input logic [8:0] depth);
    at_most_255 = depth[7:0] | {8{depth[8]}};
  endfunction
  assign turn_2.id = id_2;
  assign turn_2.view = ray_2.view;
  assign turn_2.stripe = ray_2.stripe;
  assign turn_2.begin_a = begin_2;
  assign turn_2.end_a = end_a_2;
  assign turn_2.end_b = end_a_2 + {1'b0, size};
  assign turn_2.march_b = has_look_b_2 && is_march_2 && !end_a_2[8];
  assign turn_2.foot_b = has_look_b_2 && is_march_2 && end_a_2[8];
  assign turn_2.has_ray = column_2[5:4] != NO_RAY;
  assign turn_2.has_bands = column_2[5:4] == SHAPE;
  assign turn_2.is_alone = column_2[3];
  assign turn_2.foot = foot_2;

  logic [TURN_BITS-1:0] turns[3:STAGES-1];
  logic [7:0] depth_a_3, depth_b_3;
  logic [2:0] p_part[3:7];
  logic [30:0] middle_foot[3:5];      // band at the foot minus 1/2; signed
  logic signed [20:0] slope_3, slope_4;  // per_d >> 3
  always_ff @(posedge clk) begin
    if (moves) begin
      turns[3] <= turn_2;
      for (int k = 4; k < STAGES; k = k + 1) turns[k] <= turns[k-1];
      depth_a_3 <= is_march_2 ? at_most_255(middle_a_2) : foot_2.depth;
      depth_b_3 <= at_most_255(middle_b_2);
      p_part[3] <= column_2[2:0];
      for (int k = 4; k <= 7; k = k + 1) p_part[k] <= p_part[k-1];
      middle_foot[3] <= {ray_2.foot_q12[29], ray_2.foot_q12} - 31'd2048;
      for (int k = 4; k <= 5; k = k + 1) middle_foot[k] <= middle_foot[k-1];
      slope_3 <= ray_2.per_d_q20[23:3];
      slope_4 <= slope_3;
    end
  end

  //---- Stage 4: registers, effective depths ---------------------------------------------------------------------------
  localparam int DEPTH_BITS = 13;
  localparam int DEPTH_WORDS = 256 * board::OBJECTS;
  localparam int DEPTH_PLACE_BITS = board::OBJECT_BITS + 8;
  /* verilator lint_off UNUSEDSIGNAL */
  turn_t turn_3;
  foot_t foot_3;
  /* verilator lint_on UNUSEDSIGNAL */
  logic reads_depth_b, writes_depth, is_foot_a_4, is_foot_b_4;
  logic [2*DEPTH_BITS-1:0] depths_4;  // [look], signed
  logic [8:0] bands[4:6];
  logic [7:0] jump[4:8], thickness[4:8];
  logic [10:0] foot_d_q3[4:11];
  assign turn_3 = turns[3];
  assign foot_3 = turn_3.foot;
  assign view = turn_3.view;
  assign reads_depth_b = moves && valid[3] && turn_3.march_b;
  assign effective_depths_ready = !reads_depth_b;
  assign writes_depth = effective_depths_valid && effective_depths_ready;
  true_dual_port_ram #(
      .WIDTH(DEPTH_BITS),
      .WORDS(DEPTH_WORDS)
  ) effective_depths (
      .clk(clk), .read_0(moves), .address_0({view_object, depth_a_3}), .data_0(depths_4[0+:DEPTH_BITS]),
      .read_1(reads_depth_b), .write_1(writes_depth),
      .address_1(writes_depth ? effective_depths_data[DEPTH_BITS+:DEPTH_PLACE_BITS] : {view_object, depth_b_3}),
      .write_data_1(effective_depths_data[DEPTH_BITS-1:0]), .data_1(depths_4[DEPTH_BITS+:DEPTH_BITS])
  );
  always_ff @(posedge clk) begin
    if (moves) begin
      is_foot_a_4 <= turn_3.begin_a[8] && !foot_3.exists;
      is_foot_b_4 <= turn_3.foot_b;
      bands[4] <= object_shape_bands;
      for (int k = 5; k <= 6; k = k + 1) bands[k] <= bands[k-1];
      jump[4] <= object_shape_jump;
      thickness[4] <= object_shape_thickness;
      for (int k = 5; k <= 8; k = k + 1) begin
        jump[k] <= jump[k-1];
        thickness[k] <= thickness[k-1];
      end
      foot_d_q3[4] <= object_shape_foot_d_q3;
      for (int k = 5; k <= 11; k = k + 1) foot_d_q3[k] <= foot_d_q3[k-1];
    end
  end

  //---- Writes of cells, beside the turns in stages 1 to 6 -----------------------------------------------------------------
  // Second place in p, address, even and odd bands.
  localparam int WRITE_BITS = 1 + 12 + 104;
  function automatic logic [11:0] first_address(input logic [4:0] place);  // 96 words to a column
    first_address = {1'b0, place, 6'd0} + {2'd0, place, 5'd0};
  endfunction
  logic [6:1] is_pending;
  logic [WRITE_BITS-1:0] new_write, written;
  logic [WRITE_BITS-1:0] pending[1:6];
  logic writes_now;
  assign new_write = {of_second_place, first_address({loading.stripe[0], loading.column}) + {5'd0, word_number},
                      new_cells[2*CELL_BITS+:CELL_BITS], new_cells[0+:CELL_BITS],
                      new_cells[3*CELL_BITS+:CELL_BITS], new_cells[CELL_BITS+:CELL_BITS]};
  assign written = moves ? pending[6] : new_write;
  assign writes_now = moves ? is_pending[6] : writes;
  always_ff @(posedge clk) begin
    if (rst) is_pending <= '0;
    else if (moves) is_pending <= {is_pending[5:1], writes};
    if (moves) begin
      pending[1] <= new_write;
      for (int k = 2; k <= 6; k = k + 1) pending[k] <= pending[k-1];
    end
  end

  //---- Stages 5 to 7: bands and cells of both looks -----------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  turn_t turn_6;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [1:0] is_foot_4;                          // these [look]
  logic [23:0] even_address, odd_address;
  logic [1:0] is_odd_7, even_half_7, odd_half_7;
  logic [3:0] is_band_7;                          // [look][h]
  logic [5:0] h_part_7;                           // [look]
  assign turn_6 = turns[6];
  assign is_foot_4 = {is_foot_b_4, is_foot_a_4};
  genvar look, p;
  generate
    for (look = 0; look < 2; look = look + 1) begin : looks
      logic [12:0] depth_4;
      logic [27:0] low_5;   // these two signed
      logic [26:0] high_5;
      logic [11:0] first;
      /* verilator lint_off UNUSEDSIGNAL */
      logic [33:0] product_5;
      logic [30:0] middle_6;  // band minus 1/2; signed
      logic [18:0] next;
      /* verilator lint_on UNUSEDSIGNAL */
      logic [18:0] band;
      assign depth_4 = is_foot_4[look] ? 13'd0 : depths_4[DEPTH_BITS*look+:DEPTH_BITS];
      assign product_5 = {{6{low_5[27]}}, low_5} + {high_5, 7'd0};
      assign band = middle_6[30:12];
      assign next = band + 19'd1;
      assign first = first_address({turn_6.stripe[0], turn_6.id[3:0]});
      assign even_address[12*look+:12] = first + {5'd0, next[8:2]};
      assign odd_address[12*look+:12] = first + {5'd0, band[8:2]};
      always_ff @(posedge clk) begin
        if (moves) begin
          low_5 <= {{7{slope_4[20]}}, slope_4} * {21'd0, depth_4[6:0]};
          high_5 <= {{6{slope_4[20]}}, slope_4} * {{21{depth_4[12]}}, depth_4[12:7]};
          middle_6 <= middle_foot[5] + {{5{product_5[33]}}, product_5[33:8]};
          is_odd_7[look] <= band[0];
          even_half_7[look] <= next[1];
          odd_half_7[look] <= band[1];
          is_band_7[2*look] <= band[18:9] == 10'd0 && band[8:0] < bands[6];
          is_band_7[2*look+1] <= next[18:9] == 10'd0 && next[8:0] < bands[6];
          h_part_7[3*look+:3] <= middle_6[11:9];
        end
      end
    end
  endgenerate

  logic [207:0] even_7, odd_7;  // [look][p]
  generate
    for (p = 0; p < 2; p = p + 1) begin : places
      logic write;
      logic [51:0] even_a_7, odd_a_7;
      assign write = writes_now && written[WRITE_BITS-1] == 1'(p);
      true_dual_port_ram #(
          .WIDTH(2 * CELL_BITS),
          .WORDS(CELL_WORDS)
      ) even_cells (
          .clk(clk), .read_0(moves), .address_0(even_address[11:0]), .data_0(even_a_7), .read_1(moves && !write),
          .write_1(write), .address_1(write ? written[104+:12] : even_address[23:12]),
          .write_data_1(written[52+:52]), .data_1(even_7[104+52*p+:52])
      );
      true_dual_port_ram #(
          .WIDTH(2 * CELL_BITS),
          .WORDS(CELL_WORDS)
      ) odd_cells (
          .clk(clk), .read_0(moves), .address_0(odd_address[11:0]), .data_0(odd_a_7), .read_1(moves && !write),
          .write_1(write), .address_1(write ? written[104+:12] : odd_address[23:12]),
          .write_data_1(written[0+:52]), .data_1(odd_7[104+52*p+:52])
      );
      if (p == 0) begin : read
        assign even_7[0+:52] = even_a_7;
        assign odd_7[0+:52] = odd_a_7;
      end else begin : read_or_written
        // The last cells of a column are written beside the first turn that may read them.
        logic is_even_written_7, is_odd_written_7;
        logic [103:0] written_7;
        always_ff @(posedge clk) begin
          if (moves) begin
            is_even_written_7 <= write && written[104+:12] == even_address[11:0];
            is_odd_written_7 <= write && written[104+:12] == odd_address[11:0];
            written_7 <= written[103:0];
          end
        end
        assign even_7[52+:52] = is_even_written_7 ? written_7[103:52] : even_a_7;
        assign odd_7[52+:52] = is_odd_written_7 ? written_7[51:0] : odd_a_7;
      end
    end
  endgenerate

  //---- Stages 8 to 11: surfaces -----------------------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  turn_t turn_8, turn_9;
  logic [15:0] deepest_8, deepest_9;  // these [look]
  logic [7:0] is_first_9, is_behind_9;
  /* verilator lint_on UNUSEDSIGNAL */
  logic [17:0] begins_8;
  logic [1:0] all_have_one_9, has_first_9, has_behind_9, is_behind_begin_9;
  logic [55:0] weights_9;
  logic [135:0] depths_9;
  logic [87:0] leans_9;
  assign turn_8 = turns[8];
  assign turn_9 = turns[9];
  assign begins_8 = {turn_8.end_a, turn_8.begin_a};
  generate
    for (look = 0; look < 2; look = look + 1) begin : surfaces
      surface_groups groups (
          .clk(clk), .enable(moves), .even_7(even_7[104*look+:104]), .odd_7(odd_7[104*look+:104]),
          .is_odd_7(is_odd_7[look]), .even_half_7(even_half_7[look]), .odd_half_7(odd_half_7[look]),
          .is_band_7(is_band_7[2*look+:2]), .p_part_7(p_part[7]), .h_part_7(h_part_7[3*look+:3]), .jump_8(jump[8]),
          .deepest_8(deepest_8[8*look+:8]), .deepest_9(deepest_9[8*look+:8]), .all_have_one_9(all_have_one_9[look]),
          .has_first_9(has_first_9[look]), .has_behind_9(has_behind_9[look]), .is_first_9(is_first_9[4*look+:4]),
          .is_behind_9(is_behind_9[4*look+:4]), .weights_9(weights_9[28*look+:28]), .depths_9(depths_9[68*look+:68]),
          .leans_9(leans_9[44*look+:44])
      );
      always_ff @(posedge clk) begin
        // The step begins behind the object.
        if (moves) begin
          is_behind_begin_9[look] <= {1'b0, deepest_8[8*look+:8]} + {1'b0, thickness[8]} < begins_8[9*look+:9];
        end
      end
    end
  endgenerate

  // Look B is not used at the end of a ray: the surface behind that of look A has its mean then.
  logic at_foot_9;
  logic [10:0] depth_a_11, depth_b_11;
  logic [4:0] lean_a_11, lean_b_11;
  assign at_foot_9 = turn_9.begin_a[8];
  surface_mean mean_a (
      .clk(clk), .enable(moves), .is_in_group_9(is_first_9[3:0]), .weights_9(weights_9[27:0]),
      .depths_9(depths_9[67:0]), .leans_9(leans_9[43:0]), .depth_q3_11(depth_a_11), .lean_11(lean_a_11)
  );
  surface_mean mean_b (
      .clk(clk), .enable(moves), .is_in_group_9(at_foot_9 ? is_behind_9[3:0] : is_first_9[7:4]),
      .weights_9(at_foot_9 ? weights_9[27:0] : weights_9[55:28]),
      .depths_9(at_foot_9 ? depths_9[67:0] : depths_9[135:68]), .leans_9(at_foot_9 ? leans_9[43:0] : leans_9[87:44]),
      .depth_q3_11(depth_b_11), .lean_11(lean_b_11)
  );
  // [all have one, behind, first, is behind begin] of A and B; deepest of A
  logic [15:0] facts_10, facts_11;
  logic all_have_one_a, has_behind_a, has_first_a, is_late_a, all_have_one_b, has_behind_b, has_first_b, is_late_b;
  logic [7:0] deepest_a_11;
  always_ff @(posedge clk) begin
    if (moves) begin
      facts_10 <= {deepest_9[7:0], all_have_one_9[0], has_behind_9[0], has_first_9[0], is_behind_begin_9[0],
                  all_have_one_9[1], has_behind_9[1], has_first_9[1], is_behind_begin_9[1]};
      facts_11 <= facts_10;
    end
  end
  assign {deepest_a_11, all_have_one_a, has_behind_a, has_first_a, is_late_a, all_have_one_b, has_behind_b, has_first_b,
          is_late_b} = facts_11;

  //---- Stage 12: hit test -----------------------------------------------------------------------------------------------
  turn_t turn_11;
  /* verilator lint_off UNUSEDSIGNAL */
  foot_t foot_11, foot_of_a, foot_of_b, last;
  /* verilator lint_on UNUSEDSIGNAL */
  logic is_march_a, is_foot_a, meets_a, meets_b, ends_ray, meets_last;
  assign turn_11 = turns[11];
  assign foot_11 = turn_11.foot;
  assign is_march_a = !turn_11.begin_a[8];
  assign is_foot_a = !is_march_a && !foot_11.exists;
  function automatic logic is_met(input logic [10:0] depth_q3, input logic [8:0] end_of_step);
    is_met = {1'b0, depth_q3} <= {end_of_step, 3'd0};
  endfunction
  assign meets_a = is_march_a && has_first_a && !is_late_a && is_met(depth_a_11, turn_11.end_a);
  assign meets_b = turn_11.march_b && has_first_b && !is_late_b && is_met(depth_b_11, turn_11.end_b);

  // The surfaces of look A or B as those at the foot, and what the ray meets of them in its state.
  assign foot_of_a.exists = has_first_a;
  assign foot_of_a.depth = depth_a_11[10:3];
  assign foot_of_a.has_chosen = turn_11.begin_a == FOOT ? has_first_a :
                                turn_11.begin_a == BEHIND ? has_behind_a : all_have_one_a;
  assign foot_of_a.depth_q3 = turn_11.begin_a == FOOT ? depth_a_11 :
                              turn_11.begin_a == BEHIND ? depth_b_11 : {deepest_a_11, 3'd0};
  assign foot_of_a.lean = turn_11.begin_a == FOOT ? lean_a_11 : turn_11.begin_a == BEHIND ? lean_b_11 : 5'd8;
  assign foot_of_a.has_behind = turn_11.begin_a == FOOT && has_behind_a;
  assign foot_of_a.has_farthest = turn_11.begin_a != FARTHEST && all_have_one_a;
  assign foot_of_b = {has_first_b, depth_b_11[10:3], has_first_b, depth_b_11, lean_b_11, has_behind_b, all_have_one_b};
  assign last = is_march_a ? foot_of_b : has_first_a || !foot_11.exists ? foot_of_a : foot_11;
  // Without a surface at the foot, or with the look at the depth of that.
  assign ends_ray = is_march_a ? turn_11.foot_b && !has_first_b : foot_11.exists || !has_first_a;
  assign meets_last = last.has_chosen || turn_11.is_alone;

  function automatic logic [8:0] at_most_foot(input logic [8:0] depth);
    at_most_foot = depth[8] ? FOOT : depth;
  endfunction
  function automatic logic [10:0] from(input logic [7:0] begin_of_step, input logic [10:0] depth_q3);
    from = begin_of_step > depth_q3[10:3] ? {begin_of_step, 3'd0} : depth_q3;
  endfunction
  logic is_final_12;
  logic [10:0] depth_12;
  logic [4:0] lean_12;
  logic [5:0] stripe_of_view_12;
  logic [36:0] rise_12;
  always_ff @(posedge clk) begin
    if (moves) begin
      id_12 <= turn_11.id;
      stripe_of_view_12 <= {turn_11.view, turn_11.stripe};
      foot_12 <= is_foot_a ? foot_of_a : turn_11.foot_b ? foot_of_b : '0;
      is_met_12 <= 1'b1;
      is_empty_12 <= 1'b0;
      is_final_12 <= turn_11.is_alone;
      if (!turn_11.has_bands) begin
        is_met_12 <= turn_11.has_ray;
        is_empty_12 <= !turn_11.has_ray;
        is_final_12 <= 1'b1;
        depth_12 <= 11'd0;
        lean_12 <= 5'd8;
        next_12 <= turn_11.begin_a;
      end else if (meets_a) begin
        depth_12 <= from(turn_11.begin_a[7:0], depth_a_11);
        lean_12 <= lean_a_11;
        next_12 <= at_most_foot(turn_11.end_a);
      end else if (meets_b) begin
        depth_12 <= from(turn_11.end_a[7:0], depth_b_11);
        lean_12 <= lean_b_11;
        next_12 <= at_most_foot(turn_11.end_b);
      end else if (ends_ray) begin
        is_met_12 <= meets_last;
        is_empty_12 <= !meets_last;
        is_final_12 <= turn_11.is_alone || !(last.has_behind || last.has_farthest);
        depth_12 <= last.has_chosen ? last.depth_q3 : foot_d_q3[11];
        lean_12 <= last.has_chosen ? last.lean : 5'd8;
        next_12 <= last.has_behind ? BEHIND : FARTHEST;
      end else begin
        is_met_12 <= 1'b0;
        depth_12 <= 11'd0;
        lean_12 <= 5'd8;
        next_12 <= !is_march_a ? turn_11.begin_a : at_most_foot(turn_11.march_b ? turn_11.end_b : turn_11.end_a);
      end
    end
  end
  dual_port_ram #(
      .WIDTH(37),
      .ADDRESS_BITS(9)
  ) rises (
      .clk(clk), .write(takes), .write_address(in_pixel.id), .write_data({in_pixel.row, in_pixel.rise_q24}), .read(moves),
      .read_address(turn_11.id), .read_data(rise_12)
  );

  assign met_valid = valid[STAGES] && is_met_12;
  assign empty_valid = valid[STAGES] && is_empty_12;
  assign met_data = {id_12, stripe_of_view_12, rise_12, depth_12, is_final_12, next_12, lean_12};
  assign empty_data = id_12;
endmodule
