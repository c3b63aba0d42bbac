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

typedef struct packed {
  logic [3:0] view;
  logic [7:0] y;
  logic [7:0] u;
  logic [7:0] v;
  logic [1:0] alpha;
} yuva_pixel_t;

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

// A pixel before hop 0.
typedef struct packed {
  logic [3:0] view;
  logic is_visible;
  logic begins;
  logic is_pending;
  logic [8:0] row;
  logic [2:0] column;
} coded_pixel_t;
