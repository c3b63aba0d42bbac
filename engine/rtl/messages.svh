// Messages in the FIFOs between the blocks: engine/model/signals/messages.hpp, field by field, the first one in the
// highest bits. Included in the body of each module that uses them, since Icarus 11 and Yosys 0.23 do not support
// structures of packages. Fields are unsigned vectors; those marked "signed" hold two's complement.

typedef struct packed {
  logic [3:0] view;
} view_job_t;

typedef struct packed {
  logic [3:0] view;
  logic has_ray;
  logic [3:0] plane;
  logic [30:0] n_q28;
  logic [31:0] t_q28;  // signed
} column_ray_t;

typedef struct packed {
  logic [3:0] view;
  logic has_ray;
  logic [3:0] plane;
  logic [22:0] x_q20;  // signed
  logic [28:0] lambda_q20;
  logic [29:0] cell_byte;
} ray_point_t;

typedef struct packed {
  logic [3:0] view;
  logic has_ray;
  logic [3:0] plane;
  logic [22:0] x_q20;  // signed
  logic [28:0] lambda_q20;
  logic [6:0] image;
} mapped_ray_t;

typedef struct packed {
  logic [3:0] view;
  logic has_ray;
  logic [22:0] x_q20;  // signed
  logic [28:0] lambda_q20;
  logic [6:0] image;
  logic [31:0] cx_q16;  // these eight signed
  logic [31:0] cy_q16;
  logic [31:0] fl_y_q16;
  logic [31:0] height_q20;
  logic [31:0] l0_q20;
  logic [31:0] l1_q30;
  logic [31:0] q0_q16;
  logic [31:0] q1_q16;
} ray_line_t;

typedef struct packed {
  logic [3:0] view;
  logic has_ray;
  logic [6:0] image;
  logic [8:0] column;
  logic [45:0] row_0_q16;     // signed
  logic [35:0] row_step_q16;  // signed
} column_walk_t;

typedef struct packed {
  logic [3:0] view;
  logic has_ray;
  logic [45:0] row_0_q16;     // signed
  logic [35:0] row_step_q16;  // signed
  logic [26:0] luma;
  logic [26:0] chroma;
  logic [26:0] alpha;
} placed_column_t;

typedef struct packed {
  logic [3:0] view;
  logic is_visible_0;
  logic is_visible_1;
  logic [8:0] row_0;
  logic [8:0] row_1;
  logic [26:0] luma;
  logic [26:0] chroma;
  logic [26:0] alpha;
} pixel_pair_t;

typedef struct packed {
  logic [26:0] address;
  logic is_null;
} memory_read_t;

typedef struct packed {
  logic [26:0] address;
  logic [63:0] data;
  logic last;
} memory_write_t;

typedef struct packed {
  logic [3:0] view;
  logic [1:0] kind;  // TAG_ALPHA, TAG_CHROMA, TAG_LUMA
  logic pixel;
  logic [5:0] lane_0;  // the number of the lane, and in the highest bit whether the word has this pixel's alpha
  logic [5:0] lane_1;
} sample_tag_t;

// Followed by alpha: 2 bits from uncompressed images, 8 from compressed ones.
typedef struct packed {
  logic [3:0] view;
  logic [7:0] y;
  logic [7:0] u;
  logic [7:0] v;
} yuv_pixel_t;

typedef struct packed {
  logic [3:0] view;
  logic [31:0] rgba;  // R in the low byte
} rgba_pixel_t;

typedef struct packed {
  logic [63:0] data;
  logic head;
  logic last_view;
} image_word_t;

// Block decompression: engine/model/signals/coded_messages.hpp.

typedef struct packed {
  logic [3:0] view;
  logic first;
  logic down;
  logic [6:0] image;
  logic [8:0] column;
  logic [5:0] block_row;
  logic [7:0] rows;
} block_request_t;

typedef struct packed {
  logic [35:0] request;  // block_request_t
  logic is_same;
  logic is_high;
} found_tile_t;

typedef struct packed {
  logic [35:0] request;
  logic [1:0] kind;  // TILE_SAME, TILE_NOTHING, TILE_READ
  logic [26:0] address;
} requested_tile_t;

typedef struct packed {
  logic [35:0] request;
  logic [2:0] class_number;
  logic is_predicted_image;
  logic [6:0] reference_0;
  logic [6:0] reference_1;
  logic [1:0] lane;  // half of the first byte's number in its word
  logic [2:0] words;
} requested_record_t;

// A record, split into its fields. Arrays have index 0 in the low bits; fields that the class lacks are 0.
typedef struct packed {
  logic [5:0] block_row;
  logic is_empty;
  logic [7:0] record_class;  // record_class_t
  logic [6:0] motion_y;      // signed
  logic [2:0] reference_column;
  logic [23:0] flat;         // [Y, U, V]
  logic [15:0] block;        // [stage]
  logic [127:0] quarter;     // [stage][quarter of the block]
  logic [31:0] alpha;        // [quarter]
} block_record_t;

// A class of records, as in the file and in the register file.
typedef struct packed {
  logic [3:0] quarter_stages;
  logic [1:0] block_stages;
  logic has_alpha;
  logic is_predicted;
} record_class_t;

// A pixel on its way through the hops is a coded_pixel_t, behind hop 0 followed by a coded_colour_t and a hop_lookup_t
// of each hop that it has passed, hop 0 first.
typedef struct packed {
  logic [3:0] view;
  logic is_visible;
  logic begins;
  logic is_pending;
  logic [8:0] row;
  logic [2:0] column;
} coded_pixel_t;

typedef struct packed {
  logic [23:0] flat;  // [Y, U, V], Y in the low byte
  logic [1:0] alpha;  // ALPHA_NONE, ALPHA_FULL, ALPHA_BOOK
  logic [7:0] alpha_entry;
} coded_colour_t;

typedef struct packed {
  logic is_predicted;
  logic [1:0] block_stages;
  logic [2:0] quarter_stages;
  logic [15:0] block;    // [stage]
  logic [31:0] quarter;  // [stage], of the pixel's quarter
  logic [2:0] x;
  logic [2:0] y;
} hop_lookup_t;

// Texels and patches of `parallel`: engine/model/signals/parallel_messages.hpp.

typedef struct packed {
  logic [8:0] id;
  logic is_there;
  logic second;
  logic [8:0] weight;
  logic last;
  logic is_final;
  logic [8:0] next;
} sample_head_t;

typedef struct packed {
  logic [3:0] view;
  logic [6:0] image;
  logic [5:0] block_column;
  logic [5:0] block_row;
  logic [6:0] line;
  logic [9:0] guard;
} texel_fill_t;

typedef struct packed {
  logic [30:0] head;  // sample_head_t
  logic is_inside;
  logic [2:0] fx;
  logic [2:0] fy;
  logic [127:0] rgba;  // [texel], R in the low byte
} texel_quad_t;

typedef struct packed {
  logic [30:0] head;
  logic is_inside;
  logic [13:0] a;
  logic [21:0] r;
  logic [21:0] g;
  logic [21:0] b;
} filtered_sample_t;

typedef struct packed {
  logic [3:0] view;
  logic [1:0] slot;
  logic [4:0] stripe;     // first column / 16
  logic [5:0] patch_row;  // first row / 8
  logic [4:0] columns;
  logic [3:0] rows;
  logic ends_stripe;
  logic ends_view;
} patch_job_t;

typedef struct packed {
  logic [8:0] id;
  logic [3:0] view;
  logic [1:0] stripe;
  logic [8:0] row;
  logic [27:0] rise_q24;  // signed
} scanned_pixel_t;

typedef struct packed {
  logic [3:0] view;
  logic [1:0] kind;  // RAY_NONE, RAY_PLANE, RAY_FOOT, RAY_SHAPE
  logic [3:0] plane;
  logic [22:0] x_q20;  // signed
  logic [28:0] lambda_q20;
  logic [30:0] n_q28;
  logic [31:0] t_q28;  // signed
  logic [6:0] first;
  logic [6:0] second;
  logic [30:0] from_first_q20;
  logic [30:0] width_q20;
  logic [10:0] lines;
  logic [26:0] first_line;
  logic lines_before;
  logic lines_behind;
} bracketed_ray_t;

// A bracketed_ray_t is followed by the lines of its first and its second image.
typedef struct packed {
  logic [31:0] cx_q16;  // all signed
  logic [31:0] cy_q16;
  logic [31:0] fl_y_q16;
  logic [31:0] height_q20;
  logic [31:0] l0_q20;
  logic [31:0] l1_q30;
  logic [31:0] q0_q16;
  logic [31:0] q1_q16;
  logic [31:0] l2_q30;
  logic [31:0] q2_q16;
} image_line_t;

typedef struct packed {
  logic [6:0] image;
  logic [29:0] l0_q20;  // these eight signed
  logic [19:0] l1_q24;
  logic [30:0] q0_q12;
  logic [21:0] q1_q12;
  logic [30:0] cx_q16;
  logic [30:0] cy_q16;
  logic [30:0] fl_y_q16;
  logic [28:0] height_q20;
} image_setup_t;

// Column set-up; band_reader sets stripe and column.
typedef struct packed {
  logic [3:0] view;
  logic [1:0] kind;  // RAY_NONE, RAY_PLANE, RAY_FOOT, RAY_SHAPE
  logic [1:0] stripe;
  logic [3:0] column;
  logic [6:0] image;
  logic [8:0] image_column;
  logic [45:0] row_0_q16;     // signed
  logic [35:0] row_step_q16;  // signed
  logic [231:0] image_1;      // image_setup_t
  logic [231:0] image_0;
  logic [8:0] weight;
  logic [29:0] lambda_foot_q20;  // these two signed
  logic [30:0] lambda0_q20;
  logic [28:0] lambda1_q21;
  logic [24:0] inverse_r_q20;
  logic [21:0] inverse_rho_q20;
  logic [53:0] map_line;   // [line]
  logic [25:0] map_place;  // [p]
  logic [2:0] line_part;
  logic [2:0] p_part;
} column_setup_t;

// A column's part for ray_rise.
typedef struct packed {
  logic [3:0] view;
  logic [1:0] kind;  // RAY_NONE, RAY_PLANE, RAY_FOOT, RAY_SHAPE
  logic [1:0] stripe;
  logic [3:0] column;
  logic [29:0] lambda_foot_q20;  // signed
  logic [24:0] inverse_r_q20;
  logic [21:0] inverse_rho_q20;
} rise_column_t;

// A column's part for cell_march.
typedef struct packed {
  logic [3:0] view;
  logic [1:0] kind;
  logic [1:0] stripe;
  logic [3:0] column;
  logic [8:0] weight;
  logic [2:0] line_part;
  logic [2:0] p_part;
  logic same_cells;
} march_column_t;

typedef struct packed {
  logic [51:0] pixel;      // scanned_pixel_t
  logic [29:0] foot_q12;   // signed
  logic [23:0] per_d_q20;  // signed
} band_ray_t;

typedef struct packed {
  logic [51:0] pixel;
  logic [10:0] depth_q3;
  logic is_final;
  logic [8:0] next;
  logic [4:0] lean;
} surface_hit_t;

typedef struct packed {
  logic [8:0] id;
  logic [8:0] begin_d;
} returned_pixel_t;

// A column's part for sample_place: of an object without a shape map image_0.image and the rows.
typedef struct packed {
  logic [3:0] view;
  logic [1:0] kind;
  logic [1:0] stripe;
  logic [3:0] column;
  logic [45:0] row_0_q16;     // signed
  logic [35:0] row_step_q16;  // signed
  logic [8:0] image_column;
  logic [231:0] image_1;      // image_setup_t
  logic [231:0] image_0;
  logic [8:0] weight;
  logic [30:0] lambda0_q20;   // signed
  logic [21:0] lambda1_q21;
} place_column_t;

typedef struct packed {
  logic [30:0] head;  // sample_head_t
  logic [3:0] view;
  logic is_inside;
  logic [6:0] image;
  logic [8:0] left;
  logic [8:0] top;
  logic [2:0] fx;
  logic [2:0] fy;
  logic right_is_left;
  logic bottom_is_top;
} placed_sample_t;

typedef struct packed {
  logic [30:0] head;
  logic is_inside;
  logic [2:0] fx;
  logic [2:0] fy;
  logic [27:0] lines;   // [texel]: (left, top), (left, bottom), (right, top), (right, bottom)
  logic [23:0] texels;  // [texel]: column and row in the block
  logic [2:0] fills;
} waiting_sample_t;
