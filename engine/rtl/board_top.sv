// The board `prototype-2000`: the pipe, the register file and the host side, with their FIFOs. Outside are the clocks, the
// host behind its bus, the SDRAM, and the disk with the card that drives it (engine/rtl/simulation has models of them).
`include "fifos.svh"

module board_top (
    input  logic clk,
    input  logic rst,
    input  logic pci_clk,
    input  logic pci_rst,

    // Host bus, on `pci_clk`. The host has a program: its number of register writes, and address and data of the next one
    // (memory/register_file.sv), taken when `program_writes_register` is set.
    input  logic program_available,
    input  logic [15:0] program_writes,
    input  logic [11:0] program_address,
    input  logic [31:0] program_data,
    output logic program_writes_register,
    output logic [2:0] pci_state,
    input  logic pci_retry,
    output logic pci_head,
    output logic pci_transfer,
    output logic [31:0] pci_data,

    // Events of the status registers, on `clk`: a program is accepted or refused, a rendering cycle begins, and is in the
    // image buffer.
    output logic program_accepted,
    output logic program_refused,
    output logic cycle_begins,
    output logic cycle_ends,

    // Pins of the SDRAM. Commands: 0 none, else 1 + SdramCommand.
    output logic [2:0] sdram_command,
    output logic [board::SDRAM_BANK_BITS-1:0] sdram_bank,
    output logic [board::SDRAM_ROW_BITS-1:0] sdram_row,
    output logic [board::SDRAM_COLUMN_BITS-1:0] sdram_column,
    output logic [63:0] sdram_write_data,
    input  logic [63:0] sdram_read_data,

    // Disk and its card: loads (blocks/disk_controller.sv), and writes of object registers (memory/register_file.sv).
    input  logic load_available,
    input  logic [board::OBJECT_BITS-1:0] load_object,
    input  logic [31:0] timeout_cycles,
    input  logic drive_has_data,
    input  logic [15:0] drive_data,
    input  logic [board::ADDRESS_BITS-1:0] drive_address,
    input  logic drive_is_last,
    output logic drive_takes,
    output logic load_begins,
    output logic load_ends,
    output logic load_fails,
    input  logic card_writes,
    input  logic [board::OBJECT_BITS-1:0] card_object,
    input  logic [3:0] card_register,
    input  logic [31:0] card_data
);
  //---- FIFOs --------------------------------------------------------------------------------------------------------
  `PIPE_FIFO(jobs, JOBS)
  `PIPE_FIFO(view_written, VIEW_WRITTEN)
  `PIPE_FIFO(images_ready, IMAGES_READY)
  `PIPE_FIFO(buffer_free, BUFFER_FREE)
  `PIPE_FIFO(host_reads, HOST_READS)
  `PIPE_FIFO(host_words, HOST_WORDS)
  `PIPE_FIFO(load_words, LOAD_WORDS)
  `PIPE_FIFO(object_loaded, OBJECT_LOADED)
  `PIPE_FIFO(object_ready, OBJECT_READY)
  `CROSSING_FIFO(commands, COMMANDS, pci_, )
  `CROSSING_FIFO(image_words, IMAGE_WORDS, , pci_)
  `CROSSING_FIFO(transferred, TRANSFERRED, pci_, )

  // Register writes cross the clocks beside `commands`, so that a start and its command arrive together. Writes are
  // PCI_REGISTER_CLOCKS apart, and there is always space.
  logic write_valid;
  logic [11:0] write_address;
  logic [31:0] write_data;
  /* verilator lint_off UNUSEDSIGNAL */
  logic write_ready;
  logic [1:0] write_count;
  /* verilator lint_on UNUSEDSIGNAL */
  crossing_fifo #(
      .WIDTH(44),
      .DEPTH(2)
  ) register_writes_fifo (
      .in_clk(pci_clk), .in_rst(pci_rst), .in_valid(program_writes_register), .in_ready(write_ready),
      .in_data({program_address, program_data}),
      .out_clk(clk), .out_rst(rst), .out_valid(write_valid), .out_ready(1'b1),
      .out_data({write_address, write_data}), .out_count(write_count)
  );

  //---- Register file ------------------------------------------------------------------------------------------------
  logic program_is_valid, next_bank, active_bank, validates_object;
  logic [board::VIEW_BITS-1:0] program_views;
  logic [board::OBJECT_BITS-1:0] loaded_object;
  logic buffer;
  logic [board::VIEW_BITS-1:0] buffer_view, buffer_views;
  logic [board::IMAGE_SIZE_BITS-1:0] buffer_words;

  logic [board::VIEW_BITS-1:0] raster_view, position_view, line_view, compensation_view, address_view, scan_view,
                               writer_view;
  logic [board::PLANE_BITS-1:0] raster_plane, position_plane, raster_object_planes, line_object_planes;
  logic [board::VIEW_SIDE_BITS-1:0] raster_view_width, scan_view_height, writer_view_width, writer_view_height;
  logic [28:0] raster_plane_c_q20, position_plane_a_q20, position_plane_c_q20, compensation_view_b_q20;
  logic [35:0] raster_plane_n0_q32, raster_plane_nx_q32, raster_plane_t0_q32, raster_plane_tx_q32;
  logic [board::MAP_SIDE_BITS-1:0] position_object_x_cells, position_object_u_cells;
  logic [31:0] position_object_x_half_q20, position_object_u_half_q28, position_object_x_cells_per_unit_q12,
               position_object_u_cells_per_unit_q12, compensation_view_s0_q28;
  logic [33:0] compensation_view_sy_q32;
  logic [board::ADDRESS_BITS-1:0] position_object_map, line_object_lines, address_object_luma, address_object_chroma,
                                  address_object_alpha;
  logic [board::IMAGE_SIDE_BITS-1:0] compensation_object_width, address_object_width, scan_object_height;
  logic [board::IMAGE_SIDE_BITS-4:0] address_object_luma_pitch, address_object_chroma_pitch;
  logic [board::IMAGE_SIDE_BITS-6:0] address_object_alpha_pitch;

  `define BOARD_LOOK_UPS \
      .raster_view(raster_view), .raster_plane(raster_plane), .raster_view_width(raster_view_width), \
      .raster_object_planes(raster_object_planes), .raster_plane_c_q20(raster_plane_c_q20), \
      .raster_plane_n0_q32(raster_plane_n0_q32), .raster_plane_nx_q32(raster_plane_nx_q32), \
      .raster_plane_t0_q32(raster_plane_t0_q32), .raster_plane_tx_q32(raster_plane_tx_q32), \
      .position_view(position_view), .position_plane(position_plane), \
      .position_object_x_cells(position_object_x_cells), .position_object_u_cells(position_object_u_cells), \
      .position_object_x_half_q20(position_object_x_half_q20), \
      .position_object_u_half_q28(position_object_u_half_q28), \
      .position_object_x_cells_per_unit_q12(position_object_x_cells_per_unit_q12), \
      .position_object_u_cells_per_unit_q12(position_object_u_cells_per_unit_q12), \
      .position_object_map(position_object_map), .position_plane_a_q20(position_plane_a_q20), \
      .position_plane_c_q20(position_plane_c_q20), .line_view(line_view), .line_object_planes(line_object_planes), \
      .line_object_lines(line_object_lines), .compensation_view(compensation_view), \
      .compensation_view_b_q20(compensation_view_b_q20), .compensation_view_s0_q28(compensation_view_s0_q28), \
      .compensation_view_sy_q32(compensation_view_sy_q32), .compensation_object_width(compensation_object_width), \
      .address_view(address_view), .address_object_width(address_object_width), \
      .address_object_luma_pitch(address_object_luma_pitch), \
      .address_object_chroma_pitch(address_object_chroma_pitch), \
      .address_object_alpha_pitch(address_object_alpha_pitch), .address_object_luma(address_object_luma), \
      .address_object_chroma(address_object_chroma), .address_object_alpha(address_object_alpha), \
      .scan_view(scan_view), .scan_view_height(scan_view_height), .scan_object_height(scan_object_height), \
      .writer_view(writer_view), .writer_view_width(writer_view_width), .writer_view_height(writer_view_height)

  register_file register_file_block (
      .clk(clk), .rst(rst), .host_writes(write_valid), .host_address(write_address), .host_data(write_data),
      .card_writes(card_writes), .card_object(card_object), .card_register(card_register), .card_data(card_data),
      .program_is_valid(program_is_valid), .program_views(program_views), .accepts_program(program_accepted),
      .next_bank(next_bank), .active_bank(active_bank), .validates_object(validates_object),
      .loaded_object(loaded_object), .view_starts(jobs_in_valid && jobs_in_ready), .started_view(jobs_in_data),
      .buffer(buffer), .buffer_view(buffer_view), .buffer_views(buffer_views), .buffer_words(buffer_words),
      `BOARD_LOOK_UPS
  );

  //---- Blocks -------------------------------------------------------------------------------------------------------
  /* verilator lint_off UNUSEDSIGNAL */
  logic bank_of_cycle;  // becomes `active_bank`
  /* verilator lint_on UNUSEDSIGNAL */
  render_control render_control_block (
      .clk(clk), .rst(rst), `PIPE_READS(commands), .program_is_valid(program_is_valid), .program_views(program_views),
      `PIPE_WRITES(jobs), `PIPE_READS(view_written), `PIPE_WRITES(images_ready), `PIPE_READS(buffer_free),
      `PIPE_READS(object_ready), .accepts_program(program_accepted), .refuses_program(program_refused),
      .next_bank(next_bank), .activates_bank(cycle_begins), .bank_of_cycle(bank_of_cycle), .active_bank(active_bank),
      .validates_object(validates_object), .loaded_object(loaded_object)
  );
  assign cycle_ends = images_ready_in_valid && images_ready_in_ready;

  logic [$clog2(board::HOST_WORDS_DEPTH+1)-1:0] host_words_room;
  assign host_words_room = $clog2(board::HOST_WORDS_DEPTH + 1)'(board::HOST_WORDS_DEPTH) - host_words_count;
  pipe pipe_block (
      .clk(clk), .rst(rst), `PIPE_READS(jobs), `PIPE_WRITES(view_written), `PIPE_READS(host_reads),
      `PIPE_WRITES(host_words), .host_words_room(host_words_room), `PIPE_READS(load_words),
      `PIPE_WRITES(object_loaded), .sdram_command(sdram_command), .sdram_bank(sdram_bank), .sdram_row(sdram_row),
      .sdram_column(sdram_column), .sdram_write_data(sdram_write_data), .sdram_read_data(sdram_read_data),
      .active_buffer(active_bank), `BOARD_LOOK_UPS
  );
  host_dma host_dma_block (
      .clk(clk), .rst(rst), `PIPE_READS(images_ready), `PIPE_WRITES(host_reads), `PIPE_READS(host_words),
      `PIPE_WRITES(image_words), `PIPE_READS(transferred), `PIPE_WRITES(buffer_free),
      .buffer(buffer), .view(buffer_view), .buffer_views(buffer_views), .buffer_words(buffer_words)
  );
  disk_controller disk_controller_block (
      .clk(clk), .rst(rst), `PIPE_WRITES(load_words), `PIPE_READS(object_loaded), `PIPE_WRITES(object_ready),
      .load_available(load_available), .load_object(load_object), .timeout_cycles(timeout_cycles),
      .drive_has_data(drive_has_data), .drive_data(drive_data), .drive_address(drive_address),
      .drive_is_last(drive_is_last), .drive_takes(drive_takes), .load_begins(load_begins), .load_ends(load_ends),
      .load_fails(load_fails)
  );
  host_bus host_bus_block (
      .clk(pci_clk), .rst(pci_rst), `PIPE_READS(image_words), .image_words_visible(image_words_count),
      `PIPE_WRITES(commands), `PIPE_WRITES(transferred), .program_available(program_available),
      .program_writes(program_writes), .program_writes_register(program_writes_register), .pci_state(pci_state),
      .pci_retry(pci_retry), .pci_head(pci_head), .pci_transfer(pci_transfer), .pci_data(pci_data)
  );
endmodule
