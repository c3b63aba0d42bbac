#include "engine/model/board_top.hpp"

#include <bit>

namespace rs::engine::model {
namespace {

Simulator::Options simulator_options(const BoardConfig& config, std::uint64_t shuffle_seed) {
    return {config.clock_period, config.pci.period, config.no_progress_cycles, shuffle_seed};
}

// The order of the list is the order of service.
std::vector<ReadPort> read_ports(SingleBoard& board) {
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
    for (Block* block : std::initializer_list<Block*>{&pipe.raster_generator, &pipe.ray_position, &pipe.map_reader,
                                                      &pipe.line_reader, &pipe.vertical_compensation}) {
        simulator.add(Domain::board, *block);
    }
    if (pipe.sample_reading) {
        pipe.sample_reading->add_to(simulator);
    } else {
        pipe.block_decompression->add_to(simulator);
    }
    for (Block* block : std::initializer_list<Block*>{&pipe.colour_conversion, &pipe.image_writer}) {
        simulator.add(Domain::board, *block);
    }
    simulator.add(Domain::board, pipe.fifos);
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
    // Of a parallel board the two buffers lie in banks of their own: what is drawn meets not what is delivered.
    file.words_per_buffer = static_cast<WordAddress>(file.views_per_cycle * file.words_per_view);
    if (config.pipes > 0) {
        const auto banks = static_cast<std::uint64_t>(config.memory.regions.images.count / 2);
        file.words_per_buffer = static_cast<WordAddress>(banks * config.memory.shape.words_per_bank());
    }
    return file;
}

std::vector<std::unique_ptr<ParallelPipe>> all_pipes(const BoardConfig& config, const RegisterFile& registers) {
    std::vector<std::unique_ptr<ParallelPipe>> pipes;
    for (int n = 0; n < config.pipes; ++n) {
        pipes.push_back(std::make_unique<ParallelPipe>(config, registers, StripeShare{n, config.pipes}));
    }
    return pipes;
}

std::vector<FanPort> fan_ports(const std::vector<std::unique_ptr<ParallelPipe>>& pipes) {
    std::vector<FanPort> ports;
    for (const auto& pipe : pipes) {
        ParallelFifos& f = pipe->fifos;
        ports.push_back({&f.jobs, &f.scan_jobs, &f.book_jobs, &f.view_written});
    }
    return ports;
}

std::vector<LoadPort> load_ports(const std::vector<std::unique_ptr<ParallelPipe>>& pipes) {
    std::vector<LoadPort> ports;
    for (const auto& pipe : pipes) ports.push_back({&pipe->fifos.load_words, &pipe->fifos.object_loaded});
    return ports;
}

std::vector<DmaPort> dma_ports(BoardTop& board) {
    if (board.single) return {{&board.single->host_reads, &board.single->host_words}};
    std::vector<DmaPort> ports;
    for (const auto& pipe : board.parallel->pipes) ports.push_back({&pipe->fifos.host_reads, &pipe->fifos.host_words});
    return ports;
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
    simulator.add(Domain::board, *this);
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

SingleBoard::SingleBoard(const BoardConfig& config, const RegisterFile& registers, Fifo<MemoryWrite>& load_words,
                         Fifo<Done>& object_loaded)
    : sdram(config.memory.shape, config.memory.timing),
      pipe(registers, config.limits.unpacks()),
      memory("memory_controller", config.memory, sdram, read_ports(*this), pipe.fifos.image_writes,
             pipe.fifos.view_written, load_words, object_loaded) {}

ParallelBoard::ParallelBoard(const BoardConfig& config, const RegisterFile& registers, Fifo<MemoryWrite>& load_words,
                             Fifo<Done>& object_loaded)
    : pipes(all_pipes(config, registers)),
      view_dispatcher(registers, jobs, fan_ports(pipes), view_written),
      load_broadcast(load_words, load_ports(pipes), object_loaded) {}

BoardTop::BoardTop(const BoardConfig& board_config, std::uint64_t shuffle_seed)
    : config(board_config),
      registers(register_file(config)),
      object_ready(*this, "object_ready", 2, static_cast<int>(std::bit_width(registers.objects.size() - 1))),
      single(config.pipes == 0 ? std::make_unique<SingleBoard>(config, registers, load_words, object_loaded) : nullptr),
      parallel(config.pipes > 0 ? std::make_unique<ParallelBoard>(config, registers, load_words, object_loaded)
                                : nullptr),
      render_control(config, registers, programs, commands, parallel ? parallel->jobs : single->pipe.fifos.jobs,
                     parallel ? parallel->view_written : single->pipe.fifos.view_written, images_ready, buffer_free,
                     object_ready),
      host_dma(registers, images_ready, dma_ports(*this), image_words, transferred, buffer_free),
      disk_controller(config.disk, registers, load_words, object_loaded, object_ready),
      host_bus(config.pci, programs, image_words, commands, transferred),
      simulator(simulator_options(config, shuffle_seed)) {
    simulator.add(Domain::board, render_control);
    if (single) {
        add_pipe(simulator, single->pipe);
        simulator.add(Domain::board, single->memory);
    } else {
        simulator.add(Domain::board, parallel->view_dispatcher);
        for (const auto& pipe : parallel->pipes) pipe->add_to(simulator);
    }
    simulator.add(Domain::board, host_dma);
    if (parallel) simulator.add(Domain::board, parallel->load_broadcast);
    simulator.add(Domain::board, disk_controller);
    simulator.add(Domain::board, *this);
    simulator.add(Domain::board, single ? static_cast<FifoRack&>(*single) : *parallel);
    simulator.add(Domain::pci, host_bus);
    simulator.add_crossing(Domain::pci, commands);
    simulator.add_crossing(Domain::board, image_words);
    simulator.add_crossing(Domain::pci, transferred);
}

}  // namespace rs::engine::model
