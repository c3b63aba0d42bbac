#include "engine/model/board_top.hpp"

namespace rs::engine::model {
namespace {

Simulator::Options simulator_options(const BoardConfig& config, std::uint64_t shuffle_seed) {
    return {config.clock_period, config.pci.period, config.no_progress_cycles, shuffle_seed};
}

// The order of the list is the order of service.
std::vector<ReadPort> read_ports(BoardTop& board) {
    PipeFifos& f = board.pipe.fifos;
    return {{"host_dma", &board.host_reads, &board.host_words},
            {"map_reader", &f.map_reads, &f.map_words},
            {"line_reader", &f.line_reads, &f.line_words},
            {"sample_fetch", &f.sample_reads, &f.sample_words}};
}

void add_pipe(Simulator& simulator, Pipe& pipe) {
    PipeFifos& f = pipe.fifos;
    for (Block* block : std::initializer_list<Block*>{
             &pipe.raster_generator, &pipe.ray_position, &pipe.map_reader, &pipe.line_reader,
             &pipe.vertical_compensation, &pipe.column_address, &pipe.row_scan, &pipe.sample_fetch, &pipe.sample_select,
             &pipe.colour_conversion, &pipe.image_writer}) {
        simulator.add(Domain::board, *block);
    }
    for (FifoState* fifo : std::initializer_list<FifoState*>{
             &f.jobs, &f.columns, &f.points, &f.mapped, &f.lines, &f.walks, &f.placed, &f.pairs, &f.tags, &f.samples,
             &f.pixels, &f.map_reads, &f.map_words, &f.line_reads, &f.line_words, &f.sample_reads, &f.sample_words,
             &f.image_writes, &f.view_written}) {
        simulator.add(Domain::board, *fifo);
    }
}

RegisterFile register_file(const BoardConfig& config) {
    RegisterFile file;
    const auto side = config.limits.image_buffer_side_px;
    file.images = static_cast<WordAddress>(static_cast<std::uint64_t>(config.memory.regions.images.first) *
                                           config.memory.shape.words_per_bank());
    file.words_per_view = side * ((side + 1) / 2);
    file.views_per_cycle = config.limits.views_per_cycle;
    return file;
}

}  // namespace

Pipe::Pipe(const RegisterFile& registers)
    : raster_generator(registers, fifos.jobs, fifos.columns),
      ray_position(registers, fifos.columns, fifos.points),
      map_reader(fifos.points, fifos.map_reads, fifos.map_words, fifos.mapped),
      line_reader(registers, fifos.mapped, fifos.line_reads, fifos.line_words, fifos.lines),
      vertical_compensation(registers, fifos.lines, fifos.walks),
      column_address(registers, fifos.walks, fifos.placed),
      row_scan(registers, fifos.placed, fifos.pairs),
      sample_fetch(fifos.pairs, fifos.sample_reads, fifos.tags),
      sample_select(fifos.tags, fifos.sample_words, fifos.samples),
      colour_conversion(fifos.samples, fifos.pixels),
      image_writer(registers, fifos.pixels, fifos.image_writes) {}

BoardTop::BoardTop(const BoardConfig& board_config, std::uint64_t shuffle_seed)
    : config(board_config),
      registers(register_file(config)),
      sdram(config.memory.shape, config.memory.timing),
      pipe(registers),
      render_control(config, registers, programs, commands, pipe.fifos.jobs, pipe.fifos.view_written, images_ready,
                     buffer_free, object_ready),
      memory("memory_controller", config.memory, sdram, read_ports(*this), pipe.fifos.image_writes,
             pipe.fifos.view_written, load_words, object_loaded),
      host_dma(registers, images_ready, host_reads, host_words, image_words, transferred, buffer_free),
      disk_controller(config.disk, registers, load_words, object_loaded, object_ready),
      host_bus(config.pci, programs, image_words, commands, transferred),
      simulator(simulator_options(config, shuffle_seed)) {
    simulator.add(Domain::board, render_control);
    add_pipe(simulator, pipe);
    for (Block* block : std::initializer_list<Block*>{&memory, &host_dma, &disk_controller}) {
        simulator.add(Domain::board, *block);
    }
    for (FifoState* fifo : std::initializer_list<FifoState*>{&images_ready, &buffer_free, &host_reads, &host_words,
                                                             &load_words, &object_loaded, &object_ready}) {
        simulator.add(Domain::board, *fifo);
    }
    simulator.add(Domain::pci, host_bus);
    simulator.add_crossing(Domain::pci, commands);
    simulator.add_crossing(Domain::board, image_words);
    simulator.add_crossing(Domain::pci, transferred);
}

}  // namespace rs::engine::model
