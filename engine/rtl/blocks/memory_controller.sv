// Memory controller (engine/model/blocks/memory/memory_controller.hpp): one 64-bit port to SDRAM, a command per cycle.
//
// A command is decided in cycle t and on the pins in t + 1. Read data are on the pins SDRAM_READ_LATENCY cycles later,
// pass a register, and are in the answer FIFO READ_CYCLES cycles after t.
//
// The timing rules are kept by the commands of the last cycles: a rule "n cycles from A to B" forbids B while A is one
// of the last n - 1 commands. A bank that was closed since has kept the rules of its commands before. With the times of
// prototype-2000, a client that opens a row uses it before the row may be closed, so that the rules from ACTIVATE matter
// in front of a window only.
module memory_controller #(
    parameter int PORTS = 4,      // read ports
    parameter int ROOM_BITS = 5,  // of the space in an answer FIFO
    parameter int IMAGE_WRITES_DEPTH = board::IMAGE_WRITES_DEPTH
) (
    input  logic clk,
    input  logic rst,

    // Read ports in their order of service, the first one in the low bits. The space in an answer FIFO is reserved before
    // a read is accepted, so that the answers have no `ready`. All answers are on the same lines.
    input  logic [PORTS-1:0] reads_valid,
    output logic [PORTS-1:0] reads_ready,
    input  logic [PORTS*board::SAMPLE_READS_BITS-1:0] reads_data,
    output logic [PORTS-1:0] words_valid,
    output logic [board::SAMPLE_WORDS_BITS-1:0] words_data,
    input  logic [PORTS*ROOM_BITS-1:0] words_room,

    input  logic image_writes_valid,
    output logic image_writes_ready,
    input  logic [board::IMAGE_WRITES_BITS-1:0] image_writes_data,
    input  logic [$clog2(IMAGE_WRITES_DEPTH+1)-1:0] image_writes_count,
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
  // A bit for each read port: in the low bits of `flight` the port of the read of the last cycle, in the high ones that
  // whose word is in the input register.
  localparam int FLIGHT = board::SDRAM_READ_LATENCY + board::SDRAM_INTERFACE_LATENCY;
  localparam int FLIGHT_BITS = $clog2(FLIGHT + 1);
  logic [PORTS*FLIGHT-1:0] flight;
  logic [FLIGHT-1:0] flight_null;
  logic [PORTS-1:0] accepts, delivers;
  logic reads_null;
  logic [63:0] read_data;
  assign delivers = flight[PORTS*(FLIGHT-1)+:PORTS];
  always_ff @(posedge clk) begin
    if (rst) flight <= '0;
    else flight <= {flight[PORTS*(FLIGHT-1)-1:0], accepts};
    flight_null <= {flight_null[FLIGHT-2:0], reads_null};
    read_data <= sdram_read_data;
  end
  assign words_valid = delivers;
  assign words_data = flight_null[FLIGHT-1] ? 64'd0 : read_data;

  // Words of each port on their way. Counted, because to add up the bits of `flight` would be in front of the choice.
  logic [PORTS*FLIGHT_BITS-1:0] outstanding;
  genvar port;
  generate
    for (port = 0; port < PORTS; port = port + 1) begin : ports
      logic [FLIGHT_BITS-1:0] without, with_read;
      assign without = outstanding[FLIGHT_BITS*port+:FLIGHT_BITS] - FLIGHT_BITS'(delivers[port]);
      assign with_read = without + FLIGHT_BITS'(1);
      always_ff @(posedge clk) begin
        if (rst) outstanding[FLIGHT_BITS*port+:FLIGHT_BITS] <= '0;
        else outstanding[FLIGHT_BITS*port+:FLIGHT_BITS] <= accepts[port] ? with_read : without;
      end
    end
  endgenerate

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
  localparam int BATCH_BITS = $clog2(board::WRITE_BATCH + 1);
  localparam logic [BATCH_BITS-1:0] FULL_BATCH = BATCH_BITS'(board::WRITE_BATCH);
  localparam int COUNT_BITS = $clog2(IMAGE_WRITES_DEPTH + 1);
  localparam logic [COUNT_BITS-1:0] BATCH_COUNT = COUNT_BITS'(board::WRITE_BATCH);
  // A client keeps the port until its word is transferred: `is_chosen`, and `chosen`, a bit for each client. Image
  // writes are the client behind the read ports.
  logic is_chosen;
  logic [PORTS:0] chosen, first, client;
  logic [PORTS-1:0] may_ask;
  logic [BATCH_BITS-1:0] batch_left, batch;
  logic is_full_batch, continues_batch, writes_first, is_image;
  assign is_full_batch = image_writes_count >= BATCH_COUNT;
  assign continues_batch = image_writes_valid && (is_full_batch || batch_left != '0);
  generate
    for (port = 0; port < PORTS; port = port + 1) begin : choice
      localparam logic [PORTS-1:0] BEFORE = PORTS'((1 << port) - 1);
      assign may_ask[port] = reads_valid[port] &&
          words_room[ROOM_BITS*port+:ROOM_BITS] > ROOM_BITS'(outstanding[FLIGHT_BITS*port+:FLIGHT_BITS]);
      assign first[port] = !continues_batch && may_ask[port] && (may_ask & BEFORE) == '0;
    end
  endgenerate
  assign writes_first = image_writes_valid && (continues_batch || may_ask == '0);
  assign first[PORTS] = writes_first;
  assign client = is_chosen ? chosen : first;
  assign is_image = client[PORTS];
  always_comb begin
    if (is_chosen) batch = batch_left;
    else if (!writes_first) batch = '0;
    else if (batch_left != '0) batch = batch_left;
    else batch = is_full_batch ? FULL_BATCH : BATCH_BITS'(image_writes_count);
  end

  memory_read_t read;
  memory_write_t image_write, load;
  assign image_write = image_writes_data;
  assign load = load_words_data;
  logic [board::SAMPLE_READS_BITS-1:0] selected;
  always_comb begin
    selected = '0;
    for (int n = 0; n < PORTS; n = n + 1) begin
      if (client[n]) selected = selected | reads_data[board::SAMPLE_READS_BITS*n+:board::SAMPLE_READS_BITS];
    end
  end
  assign read = selected;

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

  logic [BANKS-1:0] is_open, is_bank, has_rows;
  logic [ROW_BITS*BANKS-1:0] open_rows;  // of closed banks: any
  logic [26:0] address;  // of the client
  logic [BANK_BITS-1:0] bank;
  logic [ROW_BITS-1:0] row;
  logic is_open_bank;
  genvar number;
  assign address = read.address | (is_image ? image_write.address : '0);
  assign bank = address[COLUMN_BITS+ROW_BITS+:BANK_BITS];
  assign row = address[COLUMN_BITS+:ROW_BITS];
  generate
    for (number = 0; number < BANKS; number = number + 1) begin : banks
      assign is_bank[number] = bank == BANK_BITS'(number);
      assign has_rows[number] = open_rows[ROW_BITS*number+:ROW_BITS] == row;
      always_ff @(posedge clk) begin
        if (is_bank[number] && !is_open[number]) open_rows[ROW_BITS*number+:ROW_BITS] <= row;  // may be activated in this cycle
      end
    end
  endgenerate
  assign is_open_bank = (is_open & is_bank) != '0;

  logic may_any, has_row, may_activate, may_read, may_write, may_precharge, may_precharge_all, may_refresh;
  assign may_any = !recent(REFRESH, board::SDRAM_REFRESH_TO_ANY - 1, past_commands);
  assign has_row = (is_open & is_bank & has_rows) != '0;
  assign may_activate = may_any && !is_open_bank &&
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
  logic closing, load_time, writes_image, reads, activates, precharges;
  assign closing = state == CLOSING || (state == SERVING && to_window == '0);
  assign in_window = state != SERVING || closing;
  assign closes_all = closing && may_precharge_all;
  assign refreshes = state == REFRESHING && may_refresh;

  // All rows are closed then, and the times are kept by the places in the window.
  logic [BANK_BITS+ROW_BITS-1:0] load_row;
  assign load_time = state == LOADING && at >= AT_BITS'(FIRST_WORD) && at < AT_BITS'(END_OF_WORDS);
  assign activates_load = state == LOADING && at == AT_BITS'(board::SDRAM_REFRESH_TO_ANY) && load_words_valid;
  assign loads = load_time && load_row_open && load_words_valid && load.address[26:COLUMN_BITS] == load_row &&
      (!load.last || object_loaded_ready);
  assign closes_load = state == LOADING && at == AT_BITS'(CLOSES) && load_row_open;

  assign writes_image = !in_window && is_image && may_write && (!image_write.last || view_written_ready);
  assign reads = !in_window && may_read && !read.is_null && client[PORTS-1:0] != '0;
  assign reads_null = !in_window && read.is_null;
  assign accepts = reads || reads_null ? client[PORTS-1:0] : '0;
  assign activates = !in_window && client != '0 && !reads_null && may_activate;
  assign precharges = !in_window && client != '0 && !reads_null && is_open_bank && !has_row && may_precharge;

  logic [2:0] window_command, command;
  assign window_command = closes_all || closes_load ? PRECHARGE_ALL : refreshes ? REFRESH :
                          activates_load ? ACTIVATE : loads ? WRITE : NONE;
  assign command = window_command | (writes_image ? WRITE : NONE) | (reads ? READ : NONE) |
                   (activates ? ACTIVATE : NONE) | (precharges ? PRECHARGE : NONE);

  assign reads_ready = accepts;
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
      is_chosen <= 1'b0;
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
        is_chosen <= client != '0 && !(writes_image || reads || reads_null);
        batch_left <= writes_image ? batch - BATCH_BITS'(1) : batch;
      end
      is_open <= closes_all ? '0 : (is_open | (activates ? is_bank : '0)) & ~(precharges ? is_bank : '0);
      past_commands <= {past_commands[3*(HISTORY-1)-1:0], command};
      sdram_command <= command;
    end

    if (!in_window) chosen <= client;
    at <= refreshes ? AT_BITS'(1) : at + AT_BITS'(1);
    if (refreshes) load_row_open <= 1'b0;
    if (activates_load) begin
      load_row_open <= 1'b1;
      load_row <= load.address[26:COLUMN_BITS];
    end
    past_banks <= {past_banks[BANK_BITS*(HISTORY-1)-1:0], bank};
    {sdram_bank, sdram_row, sdram_column} <= in_window ? load.address : address;
    sdram_write_data <= in_window ? load.data : image_write.data;
  end
endmodule
