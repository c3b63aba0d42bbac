// Render control (engine/model/blocks/prototype/render_control.hpp): a queue of two rendering cycles, which bank of
// views is rendered, and which image buffer is free. Bank and image buffer of a cycle have the same number.
//
// The register file checks the registers of a program while the host writes them: `program_is_valid` and
// `program_views` belong to the command at the front of `commands`. An accepted program is copied to bank `next_bank`.
module render_control (
    input  logic clk,
    input  logic rst,

    // The number of a program is that of its registers; the command is the event alone.
    input  logic commands_valid,
    output logic commands_ready,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [board::COMMANDS_BITS-1:0] commands_data,
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic program_is_valid,
    input  logic [board::VIEW_BITS-1:0] program_views,

    output logic jobs_valid,
    input  logic jobs_ready,
    output logic [board::JOBS_BITS-1:0] jobs_data,

    input  logic view_written_valid,
    output logic view_written_ready,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [board::VIEW_WRITTEN_BITS-1:0] view_written_data,
    /* verilator lint_on UNUSEDSIGNAL */

    output logic images_ready_valid,
    input  logic images_ready_ready,
    output logic [board::IMAGES_READY_BITS-1:0] images_ready_data,

    input  logic buffer_free_valid,
    output logic buffer_free_ready,
    input  logic [board::BUFFER_FREE_BITS-1:0] buffer_free_data,

    input  logic object_ready_valid,
    output logic object_ready_ready,
    input  logic [board::OBJECT_READY_BITS-1:0] object_ready_data,

    // Register file.
    output logic accepts_program,
    output logic refuses_program,
    output logic next_bank,       // an accepted program goes there
    output logic activates_bank,  // `bank_of_cycle` is rendered from the next clock cycle on
    output logic bank_of_cycle,
    output logic active_bank,
    output logic validates_object,  // the registers of a loaded object become valid
    output logic [board::OBJECT_BITS-1:0] loaded_object
);
  logic rendering;
  logic [1:0] queued;  // the first one is rendered if `rendering`
  logic [1:0] buffer_busy, buffer_busy_now;
  logic [board::VIEW_BITS-1:0] views_0, views_1, views;  // of the banks, of the active one
  logic [board::VIEW_BITS-1:0] next_view, written_views;

  assign commands_ready = 1'b1;
  assign accepts_program = commands_valid && queued < 2'(board::QUEUE_CYCLES) && program_is_valid;
  assign refuses_program = commands_valid && !accepts_program;
  assign buffer_free_ready = 1'b1;
  assign object_ready_ready = 1'b1;
  assign validates_object = object_ready_valid;
  assign loaded_object = object_ready_data;

  // A view ends. The last one needs space for the event of the cycle.
  logic is_last_written, view_ends, cycle_ends;
  assign views = active_bank ? views_1 : views_0;
  assign is_last_written = written_views + 4'd1 == views;
  assign view_written_ready = rendering && (!is_last_written || images_ready_ready);
  assign view_ends = view_written_valid && view_written_ready;
  assign cycle_ends = view_ends && is_last_written;
  assign images_ready_valid = rendering && view_written_valid && is_last_written;
  assign images_ready_data = active_bank;

  // A view starts.
  assign jobs_valid = rendering && !cycle_ends && next_view < views;
  assign jobs_data = next_view;

  // A cycle starts, also one that is accepted in this clock cycle. Banks alternate.
  assign bank_of_cycle = next_bank ^ queued[0];
  assign buffer_busy_now = buffer_busy & ~(buffer_free_valid ? (buffer_free_data ? 2'b10 : 2'b01) : 2'b00);
  assign activates_bank = !rendering && (queued != 2'd0 || accepts_program) && !buffer_busy_now[bank_of_cycle];

  always_ff @(posedge clk) begin
    if (rst) begin
      rendering <= 1'b0;
      queued <= 2'd0;
      next_bank <= 1'b0;
      buffer_busy <= 2'b00;
      active_bank <= 1'b0;
    end else begin
      if (activates_bank) rendering <= 1'b1;
      if (cycle_ends) rendering <= 1'b0;
      if (accepts_program && !cycle_ends) queued <= queued + 2'd1;
      if (cycle_ends && !accepts_program) queued <= queued - 2'd1;
      if (accepts_program) next_bank <= !next_bank;
      buffer_busy <= buffer_busy_now | (activates_bank ? (bank_of_cycle ? 2'b10 : 2'b01) : 2'b00);
      if (activates_bank) active_bank <= bank_of_cycle;
    end

    if (accepts_program && !next_bank) views_0 <= program_views;
    if (accepts_program && next_bank) views_1 <= program_views;
    if (activates_bank) begin
      next_view <= '0;
      written_views <= '0;
    end else begin
      if (jobs_valid && jobs_ready) next_view <= next_view + 4'd1;
      if (view_ends) written_views <= written_views + 4'd1;
    end
  end
endmodule
