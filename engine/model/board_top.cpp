#include "engine/model/board_top.hpp"

#include <bit>

namespace rs::engine::model {
namespace {

Simulator::Options simulator_options(const BoardConfig& config, std::uint64_t shuffle_seed) {
    return {config.clock_period, config.pci.period, config.no_progress_cycles, shuffle_seed};
}

// The order of the list is the order of service.
std::vector<ReadPort> read_ports(BoardTop& board) {
    Pipe& pipe = board.pipe;
    PipeFifos& f = pipe.fifos;
    std::vector<ReadPort> ports = {{"host_dma", &board.host_reads, &board.host_words},
                                   {"map_reader", &f.map_reads, &f.map_words},
                                   {"line_reader", &f.line_reads, &f.line_words}};
    if (pipe.sample_reading) {
        ports.push_back({"sample_fetch", &pipe.sample_reading->sample_reads, &pipe.sample_reading->sample_words});
    } else {
        pipe.block_decompression->add_ports(ports);
    }
    return ports;
}

void add_pipe(Simulator& simulator, Pipe& pipe) {
    PipeFifos& f = pipe.fifos;
    for (Block* block : std::initializer_list<Block*>{&pipe.raster_generator, &pipe.ray_position, &pipe.map_reader,
                                                      &pipe.line_reader, &pipe.vertical_compensation}) {
        simulator.add(Domain::board, *block);
    }
    for (FifoState* fifo :
         std::initializer_list<FifoState*>{&f.jobs, &f.columns, &f.points, &f.mapped, &f.lines, &f.walks}) {
        simulator.add(Domain::board, *fifo);
    }
    if (pipe.sample_reading) {
        pipe.sample_reading->add_to(simulator);
    } else {
        pipe.block_decompression->add_to(simulator);
    }
    for (Block* block : std::initializer_list<Block*>{&pipe.colour_conversion, &pipe.image_writer}) {
        simulator.add(Domain::board, *block);
    }
    for (FifoState* fifo :
         std::initializer_list<FifoState*>{&f.samples, &f.pixels, &f.map_reads, &f.map_words, &f.line_reads,
                                           &f.line_words, &f.image_writes, &f.view_written}) {
        simulator.add(Domain::board, *fifo);
    }
}

RegisterFile register_file(const BoardConfig& config) {
    RegisterFile file;
    file.objects.resize(static_cast<std::size_t>(config.limits.objects));
    file.loaded.resize(file.objects.size());
    const auto side = config.limits.image_buffer_side_px;
    file.images = static_cast<WordAddress>(static_cast<std::uint64_t>(config.memory.regions.images.first) *
                                           config.memory.shape.words_per_bank());
    file.words_per_view = side * ((side + 1) / 2);
    file.views_per_cycle = config.limits.views_per_cycle;
    return file;
}

}  // namespace

SampleReading::SampleReading(const RegisterFile& registers, PipeFifos& pipe)
    : column_address(registers, pipe.walks, placed),
      row_scan(registers, placed, pairs),
      sample_fetch(pairs, sample_reads, tags),
      sample_select(tags, sample_words, pipe.samples) {}

void SampleReading::add_to(Simulator& simulator) {
    for (Block* block : std::initializer_list<Block*>{&column_address, &row_scan, &sample_fetch, &sample_select}) {
        simulator.add(Domain::board, *block);
    }
    for (FifoState* fifo : std::initializer_list<FifoState*>{&placed, &pairs, &tags, &sample_reads, &sample_words}) {
        simulator.add(Domain::board, *fifo);
    }
}

Pipe::Pipe(const RegisterFile& registers, bool coded_pictures)
    : fifos(coded_pictures),
      raster_generator(registers, fifos.jobs, fifos.columns),
      ray_position(registers, fifos.columns, fifos.points),
      map_reader(fifos.points, fifos.map_reads, fifos.map_words, fifos.mapped),
      line_reader(registers, fifos.mapped, fifos.line_reads, fifos.line_words, fifos.lines),
      vertical_compensation(registers, fifos.lines, fifos.walks),
      colour_conversion(fifos.samples, fifos.pixels),
      image_writer(registers, fifos.pixels, fifos.image_writes) {
    if (coded_pictures) {
        block_decompression.emplace(registers, fifos.walks, fifos.samples);
    } else {
        sample_reading.emplace(registers, fifos);
    }
}

BoardTop::BoardTop(const BoardConfig& board_config, std::uint64_t shuffle_seed)
    : config(board_config),
      registers(register_file(config)),
      sdram(config.memory.shape, config.memory.timing),
      object_ready("object_ready", 2, static_cast<int>(std::bit_width(registers.objects.size() - 1))),
      pipe(registers, config.limits.coded_pictures),
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
