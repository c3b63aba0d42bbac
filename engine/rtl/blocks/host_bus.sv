// Host bus (engine/model/blocks/host/host_bus.hpp) on the clock of the bus: arbitrates between the register writes of
// the host and the image bursts of the board, and counts the clocks of both. A shared bus of 32 bits without
// compression, as prototype-2000 has it; grant and register write take two clocks at least.
//
//     grant | address | target | per transfer: wait states, transfer | turnaround, or after an image the interrupt
//
// A bus interface of a vendor takes the place of this module behind the ports of its FIFOs.
module host_bus (
    input  logic clk,
    input  logic rst,

    input  logic image_words_valid,
    output logic image_words_ready,
    input  logic [board::IMAGE_WORDS_BITS-1:0] image_words_data,
    input  logic [$clog2(board::IMAGE_WORDS_DEPTH+1)-1:0] image_words_visible,  // words in the FIFO

    output logic commands_valid,
    input  logic commands_ready,
    output logic [board::COMMANDS_BITS-1:0] commands_data,

    // There is always space for the one event of a rendering cycle.
    output logic transferred_valid,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic transferred_ready,
    /* verilator lint_on UNUSEDSIGNAL */
    output logic [board::TRANSFERRED_BITS-1:0] transferred_data,

    // The host: a program is waiting, and its number of register writes, at least 1.
    input  logic program_available,
    input  logic [15:0] program_writes,
    output logic program_writes_register,  // in the last clock of a register write, whose address and data are on the bus

    // The bus. A target that is busy sets `pci_retry` in the last clock of TARGET. The header of an image comes in one
    // clock, with the number of its words; words come in two transfers, the low half first.
    output logic [2:0] pci_state,
    input  logic pci_retry,
    output logic pci_head,
    output logic pci_transfer,
    output logic [31:0] pci_data
);
`include "messages.svh"

  localparam logic [2:0] IDLE = 3'd0;
  localparam logic [2:0] GRANT = 3'd1;
  localparam logic [2:0] ADDRESS = 3'd2;
  localparam logic [2:0] TARGET = 3'd3;
  localparam logic [2:0] DATA = 3'd4;
  localparam logic [2:0] TURNAROUND = 3'd5;
  localparam logic [2:0] REGISTER = 3'd6;
  localparam logic [2:0] INTERRUPT = 3'd7;
  localparam int LEFT_BITS = $clog2(board::PCI_INTERRUPT_CLOCKS + 2);
  localparam logic [LEFT_BITS-1:0] ONE = LEFT_BITS'(1);
  localparam int BURST_BITS = $clog2(board::PCI_BURST_WORDS + 1);
  localparam int VISIBLE_BITS = $clog2(board::IMAGE_WORDS_DEPTH + 1);
  localparam logic [BURST_BITS-1:0] FULL_BURST = BURST_BITS'(board::PCI_BURST_WORDS);

  image_word_t word;
  logic [2:0] state;
  logic [LEFT_BITS-1:0] left;  // clocks of the state
  logic host_was_last, is_last_view, program_begun, program_number, is_high_half;
  logic [15:0] registers_left;
  logic [board::IMAGE_SIZE_BITS-1:0] words_left;
  logic [BURST_BITS-1:0] burst_left, next_burst;  // words
  assign word = image_words_data;
  assign pci_state = state;

  //---- Arbitration --------------------------------------------------------------------------------------------------
  logic takes_head, host_wins, board_wins, board_requests;
  assign next_burst = words_left >= 18'(board::PCI_BURST_WORDS) ? FULL_BURST : words_left[BURST_BITS-1:0];
  assign board_requests = words_left != '0 && image_words_visible >= VISIBLE_BITS'(next_burst);
  assign takes_head = state == IDLE && words_left == '0 && image_words_valid && word.head;
  assign host_wins = state == IDLE && !takes_head && program_available && (!board_requests || !host_was_last);
  assign board_wins = state == IDLE && !takes_head && !host_wins && board_requests;

  //---- Ends of the states -------------------------------------------------------------------------------------------
  logic ends, program_ends, word_ends, burst_ends, image_ends, stalls;
  assign ends = left == ONE;
  assign program_ends = state == REGISTER && ends && registers_left == '0;
  assign stalls = program_ends && !commands_ready;
  assign word_ends = pci_transfer && is_high_half;
  assign burst_ends = word_ends && burst_left == BURST_BITS'(1);
  assign image_ends = burst_ends && words_left == 18'd1;
  assign commands_valid = program_ends;
  assign program_writes_register = state == REGISTER && ends && !stalls;
  assign commands_data = program_number;
  assign transferred_valid = image_ends && is_last_view;
  assign transferred_data = '0;
  assign image_words_ready = takes_head || word_ends;
  assign pci_head = takes_head;
  assign pci_transfer = state == DATA && ends;
  assign pci_data = is_high_half ? word.data[63:32] : word.data[31:0];

  always_ff @(posedge clk) begin
    if (rst) begin
      state <= IDLE;
      host_was_last <= 1'b0;
      program_begun <= 1'b0;
      program_number <= 1'b0;
      words_left <= '0;
      is_high_half <= 1'b0;
    end else begin
      if (host_wins) state <= REGISTER;
      if (board_wins) state <= GRANT;
      if (state == GRANT && ends) state <= ADDRESS;
      if (state == ADDRESS && ends) state <= TARGET;
      if (state == TARGET && ends) state <= pci_retry ? TURNAROUND : DATA;
      if ((state == TURNAROUND || state == INTERRUPT || state == REGISTER) && ends && !stalls) state <= IDLE;
      if (burst_ends) state <= image_ends ? INTERRUPT : TURNAROUND;

      if (host_wins) host_was_last <= 1'b1;
      if (board_wins) host_was_last <= 1'b0;
      if (host_wins) program_begun <= 1'b1;
      if (program_ends && commands_ready) begin
        program_begun <= 1'b0;
        program_number <= !program_number;
      end
      if (takes_head) words_left <= word.data[17:0];
      if (word_ends) words_left <= words_left - 18'd1;
      if (board_wins) is_high_half <= 1'b0;
      else if (pci_transfer) is_high_half <= !is_high_half;
    end

    if (!stalls) left <= left - ONE;
    if (host_wins) left <= LEFT_BITS'(board::PCI_REGISTER_CLOCKS - 1);
    if (board_wins) left <= LEFT_BITS'(board::PCI_GRANT_CLOCKS - 1);
    if (state == GRANT && ends) left <= ONE;
    if (state == ADDRESS && ends) left <= LEFT_BITS'(board::PCI_TARGET_CLOCKS);
    if (state == TARGET && ends) left <= pci_retry ? LEFT_BITS'(2) : LEFT_BITS'(1 + board::PCI_WAIT_PER_TRANSFER);
    if (pci_transfer) left <= LEFT_BITS'(1 + board::PCI_WAIT_PER_TRANSFER);
    if (burst_ends) left <= image_ends ? LEFT_BITS'(1 + board::PCI_INTERRUPT_CLOCKS) : ONE;

    if (host_wins) registers_left <= (program_begun ? registers_left : program_writes) - 16'd1;
    if (takes_head) is_last_view <= word.last_view;
    if (board_wins) burst_left <= next_burst;
    else if (word_ends) burst_left <= burst_left - BURST_BITS'(1);
  end
endmodule
