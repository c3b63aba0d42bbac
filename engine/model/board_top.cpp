#include "engine/model/board_top.hpp"

#include <algorithm>
#include <bit>

namespace rs::engine::model {
namespace {

Simulator::Options simulator_options(const BoardConfig& config, std::uint64_t shuffle_seed) {
    const BoardConfig::Periods periods = config.clock_periods();
    return {periods.board, periods.bus, config.no_progress_cycles, shuffle_seed};
}

// Read ports in order of service.
template <class Reading>
std::vector<ReadPort> read_ports(SingleBoard<Reading>& board) {
    PipeFifos& f = board.fifos;
    std::vector<ReadPort> ports = {{"host_dma", &board.host_reads, &board.host_words},
                                   {"map_reader", &f.map_reads, &f.map_words},
                                   {"line_reader", &f.line_reads, &f.line_words}};
    board.reading.add_ports(ports);
    return ports;
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
    file.words_per_buffer = static_cast<WordAddress>(file.views_per_cycle * file.words_per_view);
    // If the two buffers have banks of their own, drawing and delivering use different banks.
    if (const MemoryRegions& regions = config.memory.regions; regions.image_parts > 1) {
        const auto banks = static_cast<std::uint64_t>(regions.images.count / regions.image_parts);
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

std::vector<DispatchPort> dispatch_ports(const std::vector<std::unique_ptr<ParallelPipe>>& pipes) {
    std::vector<DispatchPort> ports;
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

std::unique_ptr<BoardBody> body_of(const BoardConfig& config, const RegisterFile& registers,
                                   Fifo<MemoryWrite>& load_words, Fifo<Done>& object_loaded) {
    switch (config.limits.kind) {
        case BoardKind::raw_images:
            return std::make_unique<SingleBoard<SampleReading>>(config, registers, load_words, object_loaded);
        case BoardKind::coded_images:
            return std::make_unique<SingleBoard<BlockDecompression>>(config, registers, load_words, object_loaded);
        case BoardKind::any_object:
            break;
    }
    return std::make_unique<ParallelBoard>(config, registers, load_words, object_loaded);
}

}  // namespace

SampleReading::SampleReading(const RegisterFile& registers, Fifo<ColumnWalk>& walks, Fifo<YuvaPixel>& samples)
    : column_address(registers, {.in = walks, .out = placed}),
      row_scan(registers, {.in = placed, .out = pairs}),
      sample_fetch({.in = pairs, .requests = sample_reads, .tags = tags}),
      sample_select({.tags = tags, .words = sample_words, .out = samples}) {}

void SampleReading::add_to(Simulator& simulator) {
    for (Block* block : std::initializer_list<Block*>{&column_address, &row_scan, &sample_fetch, &sample_select}) {
        simulator.add(Domain::board, *block);
    }
    simulator.add(Domain::board, *this);
}

void SampleReading::add_ports(std::vector<ReadPort>& ports) {
    ports.push_back({"sample_fetch", &sample_reads, &sample_words});
}

template <class Reading>
SingleBoard<Reading>::SingleBoard(const BoardConfig& config, const RegisterFile& registers,
                                  Fifo<MemoryWrite>& load_words, Fifo<Done>& object_loaded)
    : sdram(config.memory.shape, config.memory.timing),
      raster_generator(registers, {}, {.jobs = fifos.jobs, .columns = fifos.columns}),
      ray_position(registers, {.in = fifos.columns, .out = fifos.points}),
      map_reader({.in = fifos.points, .requests = fifos.map_reads, .answers = fifos.map_words, .out = fifos.mapped}),
      line_reader(registers,
                  {.in = fifos.mapped, .requests = fifos.line_reads, .answers = fifos.line_words, .out = fifos.lines}),
      vertical_compensation(registers, {.in = fifos.lines, .out = fifos.walks}),
      reading(registers, fifos.walks, fifos.samples),
      colour_conversion({.in = fifos.samples, .out = fifos.pixels}),
      image_writer(registers, {.in = fifos.pixels, .out = fifos.image_writes}),
      memory("memory_controller", config.memory, sdram,
             {.read_ports = read_ports(*this),
              .image_writes = fifos.image_writes,
              .view_written = fifos.view_written,
              .loads = load_words,
              .object_loaded = object_loaded}) {}

template <class Reading>
void SingleBoard<Reading>::add_pipes(Simulator& simulator) {
    for (Block* block : std::initializer_list<Block*>{&raster_generator, &ray_position, &map_reader, &line_reader,
                                                      &vertical_compensation}) {
        simulator.add(Domain::board, *block);
    }
    reading.add_to(simulator);
    for (Block* block : std::initializer_list<Block*>{&colour_conversion, &image_writer}) {
        simulator.add(Domain::board, *block);
    }
    simulator.add(Domain::board, fifos);
    simulator.add(Domain::board, memory);
}

ParallelBoard::ParallelBoard(const BoardConfig& config, const RegisterFile& registers, Fifo<MemoryWrite>& load_words,
                             Fifo<Done>& object_loaded)
    : pipes(all_pipes(config, registers)),
      view_dispatcher(registers, {.in = jobs, .pipes = dispatch_ports(pipes), .view_written = view_written}),
      load_broadcast({.in = load_words, .channels = load_ports(pipes), .loaded = object_loaded}) {}

std::vector<DmaPort> ParallelBoard::dma_ports() {
    std::vector<DmaPort> ports;
    for (const auto& pipe : pipes) ports.push_back({&pipe->fifos.host_reads, &pipe->fifos.host_words});
    return ports;
}

void ParallelBoard::add_pipes(Simulator& simulator) {
    simulator.add(Domain::board, view_dispatcher);
    for (const auto& pipe : pipes) pipe->add_to(simulator);
}

BoardTop::BoardTop(const BoardConfig& board_config, std::uint64_t shuffle_seed)
    : config(board_config),
      registers(register_file(config)),
      object_ready(*this, "object_ready", 2,
                   std::max(1, static_cast<int>(std::bit_width(registers.objects.size() - 1)))),
      body(body_of(config, registers, load_words, object_loaded)),
      render_control(config, registers, programs,
                     {.commands = commands,
                      .jobs = body->views_in(),
                      .view_written = body->views_out(),
                      .images_ready = images_ready,
                      .buffer_free = buffer_free,
                      .object_ready = object_ready}),
      host_dma(registers, {.images_ready = images_ready,
                           .channels = body->dma_ports(),
                           .words = image_words,
                           .transferred = transferred,
                           .buffer_free = buffer_free}),
      disk_controller(config.disk, registers,
                      {.words = load_words, .loaded = object_loaded, .object_ready = object_ready}),
      host_bus(config.pci, programs, {.words = image_words, .commands = commands, .transferred = transferred}),
      simulator(simulator_options(config, shuffle_seed)) {
    simulator.add(Domain::board, render_control);
    body->add_pipes(simulator);
    simulator.add(Domain::board, host_dma);
    body->add_loading(simulator);
    simulator.add(Domain::board, disk_controller);
    simulator.add(Domain::board, *this);
    simulator.add(Domain::board, *body);
    simulator.add(Domain::pci, host_bus);
    simulator.add_crossing(Domain::pci, commands);
    simulator.add_crossing(Domain::board, image_words);
    simulator.add_crossing(Domain::pci, transferred);
}

}  // namespace rs::engine::model
