// Memory controller (engine/model/blocks/memory/memory_controller.hpp): one 64-bit port to SDRAM, a command per cycle.
//
// A command is decided in cycle t and on the pins in t + 1. Read data are on the pins SDRAM_READ_LATENCY cycles later,
// pass a register, and are in the answer FIFO READ_CYCLES cycles after t.
//
// The timing rules are kept by the commands of the last cycles: a rule "n cycles from A to B" forbids B while A is one
// of the last n - 1 commands. A bank that was closed since has kept the rules of its commands before. With the times of
// prototype-2000, a client that opens a row uses it before the row may be closed, so that the rules from ACTIVATE matter
// in front of a window only.
module memory_controller (
    input  logic clk,
    input  logic rst,

    // Read ports in their order of service. The space in an answer FIFO is reserved before a read is accepted, so that
    // its `ready` is not used.
    input  logic host_reads_valid,
    output logic host_reads_ready,
    input  logic [board::HOST_READS_BITS-1:0] host_reads_data,
    input  logic map_reads_valid,
    output logic map_reads_ready,
    input  logic [board::MAP_READS_BITS-1:0] map_reads_data,
    input  logic line_reads_valid,
    output logic line_reads_ready,
    input  logic [board::LINE_READS_BITS-1:0] line_reads_data,
    input  logic sample_reads_valid,
    output logic sample_reads_ready,
    input  logic [board::SAMPLE_READS_BITS-1:0] sample_reads_data,

    /* verilator lint_off UNUSEDSIGNAL */
    output logic host_words_valid,
    input  logic host_words_ready,
    output logic [board::HOST_WORDS_BITS-1:0] host_words_data,
    input  logic [$clog2(board::HOST_WORDS_DEPTH+1)-1:0] host_words_room,
    output logic map_words_valid,
    input  logic map_words_ready,
    output logic [board::MAP_WORDS_BITS-1:0] map_words_data,
    input  logic [$clog2(board::MAP_WORDS_DEPTH+1)-1:0] map_words_room,
    output logic line_words_valid,
    input  logic line_words_ready,
    output logic [board::LINE_WORDS_BITS-1:0] line_words_data,
    input  logic [$clog2(board::LINE_WORDS_DEPTH+1)-1:0] line_words_room,
    output logic sample_words_valid,
    input  logic sample_words_ready,
    output logic [board::SAMPLE_WORDS_BITS-1:0] sample_words_data,
    input  logic [$clog2(board::SAMPLE_WORDS_DEPTH+1)-1:0] sample_words_room,
    /* verilator lint_on UNUSEDSIGNAL */

    input  logic image_writes_valid,
    output logic image_writes_ready,
    input  logic [board::IMAGE_WRITES_BITS-1:0] image_writes_data,
    input  logic [$clog2(board::IMAGE_WRITES_DEPTH+1)-1:0] image_writes_count,
    output logic view_written_valid,
    input  logic view_written_ready,
    output logic [board::VIEW_WRITTEN_BITS-1:0] view_written_data,

    input  logic load_words_valid,
    output logic load_words_ready,
    input  logic [board::LOAD_WORDS_BITS-1:0] load_words_data,
    output logic object_loaded_valid,
    input  logic object_loaded_ready,
    output logic [board::OBJECT_LOADED_BITS-1:0] object_loaded_data,

    // Pins of the SDRAM. Commands: 0 none, else 1 + SdramCommand.
    output logic [2:0] sdram_command,
    output logic [board::SDRAM_BANK_BITS-1:0] sdram_bank,
    output logic [board::SDRAM_ROW_BITS-1:0] sdram_row,
    output logic [board::SDRAM_COLUMN_BITS-1:0] sdram_column,
    output logic [63:0] sdram_write_data,
    input  logic [63:0] sdram_read_data
);
`include "messages.svh"

  localparam logic [2:0] NONE = 3'd0;
  localparam logic [2:0] ACTIVATE = 3'd1;
  localparam logic [2:0] READ = 3'd2;
  localparam logic [2:0] WRITE = 3'd3;
  localparam logic [2:0] PRECHARGE = 3'd4;
  localparam logic [2:0] PRECHARGE_ALL = 3'd5;
  localparam logic [2:0] REFRESH = 3'd6;

  localparam int BANK_BITS = board::SDRAM_BANK_BITS;
  localparam int BANKS = 1 << BANK_BITS;
  localparam int ROW_BITS = board::SDRAM_ROW_BITS;
  localparam int COLUMN_BITS = board::SDRAM_COLUMN_BITS;

  //---- Arriving words -----------------------------------------------------------------------------------------------
  // In place 0 the read of the last cycle, in place FLIGHT - 1 the one whose word is in the input register.
  localparam int FLIGHT = board::SDRAM_READ_LATENCY + board::SDRAM_INTERFACE_LATENCY;
  logic [FLIGHT-1:0] flight_host, flight_map, flight_line, flight_sample, flight_null;
  logic reads_host, reads_map, reads_line, reads_sample, reads_null;  // accepted in this cycle
  logic [63:0] read_data, arriving;
  always_ff @(posedge clk) begin
    if (rst) begin
      flight_host <= '0;
      flight_map <= '0;
      flight_line <= '0;
      flight_sample <= '0;
    end else begin
      flight_host <= {flight_host[FLIGHT-2:0], reads_host};
      flight_map <= {flight_map[FLIGHT-2:0], reads_map};
      flight_line <= {flight_line[FLIGHT-2:0], reads_line};
      flight_sample <= {flight_sample[FLIGHT-2:0], reads_sample};
    end
    flight_null <= {flight_null[FLIGHT-2:0], reads_null};
    read_data <= sdram_read_data;
  end
  assign arriving = flight_null[FLIGHT-1] ? 64'd0 : read_data;
  assign host_words_valid = flight_host[FLIGHT-1];
  assign map_words_valid = flight_map[FLIGHT-1];
  assign line_words_valid = flight_line[FLIGHT-1];
  assign sample_words_valid = flight_sample[FLIGHT-1];
  assign host_words_data = arriving;
  assign map_words_data = arriving;
  assign line_words_data = arriving;
  assign sample_words_data = arriving;

  function automatic logic [4:0] outstanding(input logic [FLIGHT-1:0] flight);
    outstanding = 5'd0;
    for (int n = 0; n < FLIGHT; n = n + 1) outstanding = outstanding + {4'd0, flight[n]};
  endfunction

  //---- Maintenance window -------------------------------------------------------------------------------------------
  localparam logic [1:0] SERVING = 2'd0;
  localparam logic [1:0] CLOSING = 2'd1;
  localparam logic [1:0] REFRESHING = 2'd2;
  localparam logic [1:0] LOADING = 2'd3;
  localparam int FIRST_WORD = board::SDRAM_REFRESH_TO_ANY + board::SDRAM_ACTIVATE_TO_COLUMN;
  localparam int END_OF_WORDS = FIRST_WORD + board::LOAD_WORDS_PER_WINDOW;
  localparam int CLOSES = END_OF_WORDS + board::SDRAM_WRITE_TO_PRECHARGE;
  localparam int LAST = CLOSES + board::SDRAM_PRECHARGE_TO_ACTIVATE - 1;
  localparam int AT_BITS = $clog2(LAST + 1);
  localparam int INTERVAL_BITS = $clog2(board::MAINTENANCE_INTERVAL + 1);
  logic [1:0] state;
  logic [AT_BITS-1:0] at;  // cycles since the refresh
  logic [INTERVAL_BITS-1:0] to_window;
  logic load_row_open;
  logic in_window, closes_all, refreshes, activates_load, loads, closes_load;

  //---- Client: a batch of image writes, the read ports in order, other image writes -----------------------------------
  localparam logic [2:0] HOST = 3'd0;
  localparam logic [2:0] MAP = 3'd1;
  localparam logic [2:0] LINE = 3'd2;
  localparam logic [2:0] SAMPLE = 3'd3;
  localparam logic [2:0] IMAGE = 3'd4;
  localparam logic [2:0] NO_CLIENT = 3'd5;
  localparam int BATCH_BITS = $clog2(board::WRITE_BATCH + 1);
  localparam logic [BATCH_BITS-1:0] FULL_BATCH = BATCH_BITS'(board::WRITE_BATCH);
  localparam int COUNT_BITS = $clog2(board::IMAGE_WRITES_DEPTH + 1);
  localparam logic [COUNT_BITS-1:0] BATCH_COUNT = COUNT_BITS'(board::WRITE_BATCH);
  logic [2:0] chosen, port, client;  // `chosen`: keeps the port until its word is transferred
  logic [BATCH_BITS-1:0] batch_left, batch_before, batch;
  logic is_full_batch;
  assign is_full_batch = image_writes_count >= BATCH_COUNT;
  assign port = host_reads_valid && 5'(host_words_room) > outstanding(flight_host) ? HOST :
                map_reads_valid && 5'(map_words_room) > outstanding(flight_map) ? MAP :
                line_reads_valid && 5'(line_words_room) > outstanding(flight_line) ? LINE :
                sample_reads_valid && sample_words_room > outstanding(flight_sample) ? SAMPLE : NO_CLIENT;
  assign batch_before = batch_left == '0 && is_full_batch ? FULL_BATCH : batch_left;
  always_comb begin
    client = chosen;
    batch = batch_left;
    if (chosen == NO_CLIENT) begin
      if (batch_before != '0 && image_writes_valid) begin
        client = IMAGE;
        batch = batch_before;
      end else if (port != NO_CLIENT) begin
        client = port;
        batch = '0;
      end else if (image_writes_valid) begin
        client = IMAGE;
        batch = is_full_batch ? FULL_BATCH : BATCH_BITS'(image_writes_count);
      end else begin
        batch = '0;
      end
    end
  end

  memory_read_t read;
  memory_write_t image_write, load;
  assign image_write = image_writes_data;
  assign load = load_words_data;
  assign read = client == HOST ? host_reads_data : client == MAP ? map_reads_data :
                client == LINE ? line_reads_data : sample_reads_data;
  logic serves_read, serves_image;
  assign serves_read = !in_window && client[2] == 1'b0;
  assign serves_image = !in_window && client == IMAGE;

  //---- Banks and timing rules ---------------------------------------------------------------------------------------
  localparam int HISTORY = 3;
  logic [3*HISTORY-1:0] past_commands;  // the last one in the low bits
  logic [BANK_BITS*HISTORY-1:0] past_banks;
  function automatic logic recent(input logic [2:0] wanted, input int cycles, input logic [3*HISTORY-1:0] commands);
    recent = 1'b0;
    for (int n = 0; n < HISTORY; n = n + 1) if (n < cycles && commands[3*n+:3] == wanted) recent = 1'b1;
  endfunction
  function automatic logic recent_in(input logic [2:0] wanted, input int cycles, input logic [BANK_BITS-1:0] wanted_bank,
                                     input logic [3*HISTORY-1:0] commands, input logic [BANK_BITS*HISTORY-1:0] banks);
    recent_in = 1'b0;
    for (int n = 0; n < HISTORY; n = n + 1) begin
      if (n < cycles && commands[3*n+:3] == wanted && banks[BANK_BITS*n+:BANK_BITS] == wanted_bank) recent_in = 1'b1;
    end
  endfunction

  logic [BANKS-1:0] is_open;
  logic [ROW_BITS-1:0] open_rows[0:BANKS-1];
  logic [26:0] address;
  logic [BANK_BITS-1:0] bank;
  logic [ROW_BITS-1:0] row;
  assign address = in_window ? load.address : client == IMAGE ? image_write.address : read.address;
  assign bank = address[COLUMN_BITS+ROW_BITS+:BANK_BITS];
  assign row = address[COLUMN_BITS+:ROW_BITS];

  logic may_any, has_row, may_activate, may_read, may_write, may_precharge, may_precharge_all, may_refresh;
  assign may_any = !recent(REFRESH, board::SDRAM_REFRESH_TO_ANY - 1, past_commands);
  assign has_row = is_open[bank] && open_rows[bank] == row;
  assign may_activate = may_any && !is_open[bank] &&
      !recent_in(ACTIVATE, board::SDRAM_ACTIVATE_TO_ACTIVATE - 1, bank, past_commands, past_banks) &&
      !recent_in(PRECHARGE, board::SDRAM_PRECHARGE_TO_ACTIVATE - 1, bank, past_commands, past_banks) &&
      !recent(PRECHARGE_ALL, board::SDRAM_PRECHARGE_TO_ACTIVATE - 1, past_commands);
  assign may_read = may_any && has_row &&
      !recent_in(ACTIVATE, board::SDRAM_ACTIVATE_TO_COLUMN - 1, bank, past_commands, past_banks);
  // After a read, one idle cycle follows on the data bus.
  assign may_write = may_read && !recent(READ, board::SDRAM_READ_LATENCY + 1, past_commands);
  assign may_precharge = may_any &&
      !recent_in(ACTIVATE, board::SDRAM_ACTIVATE_TO_PRECHARGE - 1, bank, past_commands, past_banks) &&
      !recent_in(WRITE, board::SDRAM_WRITE_TO_PRECHARGE, bank, past_commands, past_banks);
  assign may_precharge_all = may_any && !recent(ACTIVATE, board::SDRAM_ACTIVATE_TO_PRECHARGE - 1, past_commands) &&
      !recent(WRITE, board::SDRAM_WRITE_TO_PRECHARGE, past_commands);
  assign may_refresh = may_any && is_open == '0 &&
      !recent(ACTIVATE, board::SDRAM_ACTIVATE_TO_ACTIVATE - 1, past_commands) &&
      !recent(PRECHARGE, board::SDRAM_PRECHARGE_TO_ACTIVATE - 1, past_commands) &&
      !recent(PRECHARGE_ALL, board::SDRAM_PRECHARGE_TO_ACTIVATE - 1, past_commands);

  //---- Command of this cycle ----------------------------------------------------------------------------------------
  logic closing, load_time, writes_image, read_done;
  assign closing = state == CLOSING || (state == SERVING && to_window == '0);
  assign in_window = state != SERVING || closing;
  assign closes_all = closing && may_precharge_all;
  assign refreshes = state == REFRESHING && may_refresh;
  assign load_time = state == LOADING && at >= AT_BITS'(FIRST_WORD) && at < AT_BITS'(END_OF_WORDS);
  assign activates_load = state == LOADING && at == AT_BITS'(board::SDRAM_REFRESH_TO_ANY) && load_words_valid;
  assign loads = load_time && load_row_open && load_words_valid && may_write && (!load.last || object_loaded_ready);
  assign closes_load = state == LOADING && at == AT_BITS'(CLOSES) && load_row_open;
  assign writes_image = serves_image && may_write && (!image_write.last || view_written_ready);
  assign read_done = serves_read && (read.is_null || may_read);

  logic [2:0] command;
  always_comb begin
    command = NONE;
    if (closes_all || closes_load) command = PRECHARGE_ALL;
    else if (refreshes) command = REFRESH;
    else if (activates_load) command = ACTIVATE;
    else if (loads || writes_image) command = WRITE;
    else if (read_done) command = read.is_null ? NONE : READ;
    else if ((serves_image || serves_read) && !has_row) begin
      if (is_open[bank] && may_precharge) command = PRECHARGE;
      if (may_activate) command = ACTIVATE;
    end
  end

  assign host_reads_ready = read_done && client == HOST;
  assign map_reads_ready = read_done && client == MAP;
  assign line_reads_ready = read_done && client == LINE;
  assign sample_reads_ready = read_done && client == SAMPLE;
  assign reads_host = host_reads_ready;
  assign reads_map = map_reads_ready;
  assign reads_line = line_reads_ready;
  assign reads_sample = sample_reads_ready;
  assign reads_null = read.is_null;
  assign image_writes_ready = writes_image;
  assign load_words_ready = loads;
  assign view_written_valid = writes_image && image_write.last;
  assign view_written_data = '0;
  assign object_loaded_valid = loads && load.last;
  assign object_loaded_data = '0;

  always_ff @(posedge clk) begin
    if (rst) begin
      state <= SERVING;
      to_window <= INTERVAL_BITS'(board::MAINTENANCE_INTERVAL);
      chosen <= NO_CLIENT;
      batch_left <= '0;
      is_open <= '0;
      past_commands <= '0;
      sdram_command <= NONE;
    end else begin
      to_window <= to_window == '0 ? INTERVAL_BITS'(board::MAINTENANCE_INTERVAL - 1) : to_window - INTERVAL_BITS'(1);
      if (closing) state <= closes_all ? REFRESHING : CLOSING;
      if (refreshes) state <= LOADING;
      if (state == LOADING && at == AT_BITS'(LAST)) state <= SERVING;
      if (!in_window) begin
        chosen <= writes_image || read_done ? NO_CLIENT : client;
        batch_left <= writes_image ? batch - BATCH_BITS'(1) : batch;
      end
      if (command == ACTIVATE) is_open[bank] <= 1'b1;
      if (command == PRECHARGE) is_open[bank] <= 1'b0;
      if (command == PRECHARGE_ALL) is_open <= '0;
      past_commands <= {past_commands[3*(HISTORY-1)-1:0], command};
      sdram_command <= command;
    end

    at <= refreshes ? AT_BITS'(1) : at + AT_BITS'(1);
    if (refreshes) load_row_open <= 1'b0;
    if (activates_load) load_row_open <= 1'b1;
    if (command == ACTIVATE) open_rows[bank] <= row;
    past_banks <= {past_banks[BANK_BITS*(HISTORY-1)-1:0], bank};
    sdram_bank <= bank;
    sdram_row <= row;
    sdram_column <= address[COLUMN_BITS-1:0];
    sdram_write_data <= in_window ? load.data : image_write.data;
  end
endmodule
