// Disk controller (engine/model/blocks/memory/disk_controller.hpp): joins four transfers of the private bus to a word of
// object memory, one transfer every DISK_CYCLES_PER_TRANSFER cycles. An object becomes valid after its last word is in
// memory; a load without data for `timeout_cycles` fails.
//
// The drive and the firmware of the card are the environment: they give the number of the object, the bytes, and the
// address of each word.
module disk_controller (
    input  logic clk,
    input  logic rst,

    output logic load_words_valid,
    input  logic load_words_ready,
    output logic [board::LOAD_WORDS_BITS-1:0] load_words_data,

    input  logic object_loaded_valid,
    output logic object_loaded_ready,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [board::OBJECT_LOADED_BITS-1:0] object_loaded_data,
    /* verilator lint_on UNUSEDSIGNAL */

    output logic object_ready_valid,
    input  logic object_ready_ready,
    output logic [board::OBJECT_READY_BITS-1:0] object_ready_data,

    // The card. `drive_takes` takes two bytes, the low ones of a word first.
    input  logic load_available,
    input  logic [board::OBJECT_BITS-1:0] load_object,
    input  logic [31:0] timeout_cycles,
    input  logic drive_has_data,
    input  logic [15:0] drive_data,
    input  logic [board::ADDRESS_BITS-1:0] drive_address,
    input  logic drive_is_last,  // word of the load
    output logic drive_takes,
    output logic load_begins,
    output logic load_ends,
    output logic load_fails
);
`include "messages.svh"

  localparam logic [1:0] IDLE = 2'd0;
  localparam logic [1:0] TRANSFERRING = 2'd1;
  localparam logic [1:0] LOADED = 2'd2;
  localparam int WAIT_BITS = $clog2(board::DISK_CYCLES_PER_TRANSFER + 1);

  memory_write_t word;
  logic [1:0] state;
  logic [board::OBJECT_BITS-1:0] object;
  logic [WAIT_BITS-1:0] left;  // cycles to the next transfer
  logic [31:0] silent;         // cycles since the last byte
  logic [1:0] quarter;         // of the word
  logic [47:0] low;
  logic may_transfer, ends_word;
  assign may_transfer = state == TRANSFERRING && left == WAIT_BITS'(1);
  assign ends_word = quarter == 2'd3;
  assign drive_takes = may_transfer && drive_has_data && (!ends_word || load_words_ready);
  assign load_fails = may_transfer && !drive_has_data && silent >= timeout_cycles;
  assign load_begins = state == IDLE && load_available;
  assign load_ends = load_fails || (object_ready_valid && object_ready_ready);

  assign word.address = drive_address;
  assign word.data = {drive_data, low};
  assign word.last = drive_is_last;
  assign load_words_valid = may_transfer && drive_has_data && ends_word;
  assign load_words_data = word;
  assign object_loaded_ready = state == LOADED && object_ready_ready;
  assign object_ready_valid = state == LOADED && object_loaded_valid;
  assign object_ready_data = object;

  always_ff @(posedge clk) begin
    if (rst) begin
      state <= IDLE;
    end else begin
      if (load_begins) state <= TRANSFERRING;
      if (drive_takes && ends_word && drive_is_last) state <= LOADED;
      if (load_ends) state <= IDLE;
    end

    if (load_begins) object <= load_object;
    if (load_begins || drive_takes) left <= WAIT_BITS'(board::DISK_CYCLES_PER_TRANSFER);
    else if (!may_transfer) left <= left - WAIT_BITS'(1);
    silent <= load_begins || (may_transfer && drive_has_data) ? 32'd1 : silent + 32'd1;
    if (load_begins) quarter <= 2'd0;
    else if (drive_takes) quarter <= quarter + 2'd1;
    if (drive_takes) low <= {drive_data, low[47:16]};
  end
endmodule
