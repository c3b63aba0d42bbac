#include "engine/model/parallel_pipe.hpp"

namespace rs::engine::model {
namespace {

// Read ports in order of service: the host, whose bus is slow; the columns, which are few; blocks of texels, those
// first that others wait for; codebooks last, which are prefetched.
std::vector<ReadPort> read_ports(ParallelPipe& pipe) {
    ParallelFifos& f = pipe.fifos;
    std::vector<ReadPort> ports = {{"host_dma", &f.host_reads, &f.host_words},
                                   {"map_reader", &f.map_reads, &f.map_words},
                                   {"bracket_finder", &f.bracket_reads, &f.bracket_words},
                                   {"picture_reader", &f.line_reads, &f.line_words},
                                   {"band_reader", &f.band_reads, &f.band_words}};
    pipe.chains.add_chain_ports(ports);
    ports.push_back({"fill_fetch", &f.raw_reads, &f.raw_words});
    ports.push_back({"double_buffered_codebook", &f.book_reads, &f.book_words});
    return ports;
}

std::string suffix_of(const StripeShare& share) {
    return "_p" + std::to_string(share.pipe);
}

}  // namespace

ParallelPipe::ParallelPipe(const BoardConfig& config, const RegisterFile& registers, const StripeShare& share)
    : fifos(suffix_of(share)),
      chains(registers, suffix_of(share)),
      sdram(config.memory.shape, config.memory.timing),
      raster_generator(registers, share, {.jobs = fifos.jobs, .columns = fifos.columns}),
      ray_position(registers, {.in = fifos.columns, .out = fifos.points}),
      map_reader({.in = fifos.points, .requests = fifos.map_reads, .answers = fifos.map_words, .out = fifos.mapped}),
      bracket_finder(registers, {.in = fifos.mapped,
                                 .requests = fifos.bracket_reads,
                                 .answers = fifos.bracket_words,
                                 .out = fifos.bracketed}),
      image_reader(
          registers,
          {.in = fifos.bracketed, .requests = fifos.line_reads, .answers = fifos.line_words, .out = fifos.lined}),
      column_setup(registers, {.in = fifos.lined, .out = fifos.set_up}),
      band_reader(registers, share,
                  {.in = fifos.set_up,
                   .stripe_free = fifos.stripe_free,
                   .requests = fifos.band_reads,
                   .to_rise = fifos.rise_columns,
                   .to_march = fifos.march_columns,
                   .to_place = fifos.place_columns}),
      pixel_scan(registers, share,
                 {.jobs = fifos.scan_jobs,
                  .patch_free = fifos.patch_free,
                  .view_done = fifos.view_done_scan,
                  .patches = fifos.patches,
                  .pixels = fifos.scanned}),
      ray_rise(registers, {.columns = fifos.rise_columns, .in = fifos.scanned, .out = fifos.risen}),
      cell_march(registers, {.columns = fifos.march_columns,
                             .words = fifos.band_words,
                             .in = fifos.risen,
                             .again = fifos.again,
                             .met = fifos.met,
                             .empty = fifos.empty}),
      sample_place(registers, {.columns = fifos.place_columns, .in = fifos.met, .out = fifos.placed}),
      texel_tags(registers, {.in = fifos.placed, .fills = fifos.fills, .out = fifos.waiting}),
      fill_fetch(registers, {.in = fifos.fills,
                             .asks = chains.hop_fifos[0]->asks,
                             .pixels = chains.hop_fifos[0]->pixels,
                             .raw_reads = fifos.raw_reads,
                             .kinds = fifos.kinds,
                             .targets = fifos.targets}),
      double_buffered_codebook(registers, {.jobs = fifos.book_jobs,
                                           .view_done = fifos.view_done_books,
                                           .in = chains.complete,
                                           .requests = fifos.book_reads,
                                           .words = fifos.book_words,
                                           .out = fifos.samples}),
      texel_merge({.kinds = fifos.kinds, .coded = fifos.samples, .raw_words = fifos.raw_words, .out = fifos.merged}),
      colour_conversion({.in = fifos.merged, .out = fifos.texels}),
      texel_cache({.in = fifos.waiting, .targets = fifos.targets, .texels = fifos.texels, .out = fifos.quads}),
      texel_filter({.in = fifos.quads, .out = fifos.filtered}),
      surface_blend({.in = fifos.filtered, .out = fifos.resolved, .again = fifos.again}),
      patch_store(registers, {.patches = fifos.patches,
                              .pixels = fifos.resolved,
                              .empty = fifos.empty,
                              .image_writes = fifos.image_writes,
                              .patch_free = fifos.patch_free,
                              .stripe_free = fifos.stripe_free,
                              .view_done_scan = fifos.view_done_scan,
                              .view_done_books = fifos.view_done_books}),
      memory("memory_controller", config.memory, sdram,
             {.read_ports = read_ports(*this),
              .image_writes = fifos.image_writes,
              .view_written = fifos.view_written,
              .loads = fifos.load_words,
              .object_loaded = fifos.object_loaded}) {
    for (Block* block : blocks()) block->append_to_name(suffix_of(share));
}

std::vector<Block*> ParallelPipe::blocks() {
    return {&raster_generator,
            &ray_position,
            &map_reader,
            &bracket_finder,
            &image_reader,
            &column_setup,
            &band_reader,
            &pixel_scan,
            &ray_rise,
            &cell_march,
            &sample_place,
            &texel_tags,
            &fill_fetch,
            &double_buffered_codebook,
            &texel_merge,
            &colour_conversion,
            &texel_cache,
            &texel_filter,
            &surface_blend,
            &patch_store,
            &memory};
}

void ParallelPipe::add_to(Simulator& simulator) {
    for (Block* block : blocks()) simulator.add(Domain::board, *block);
    simulator.add(Domain::board, fifos);
    chains.add_to(simulator);
}

PipeMemoryBits pipe_memory_bits(ParallelPipe& pipe) {
    constexpr int kShortest = 64;  // shallower FIFOs are built from logic cells
    PipeMemoryBits bits;
    bits.books = DoubleBufferedCodebook::kBits;
    bits.cells = CellMarch::kCellBits;
    bits.held_words = CellMarch::kHeldBits;
    bits.march_pixels = CellMarch::kPixelBits;
    bits.effective_depths = CellMarch::kDepthBits;
    bits.rim_pixels = SurfaceBlend::kKeptBits;
    bits.texels = static_cast<std::size_t>(TexelCache::kBits);
    bits.patches = static_cast<std::size_t>(PatchStore::kBits);
    bits.columns = static_cast<std::size_t>(
        kStripeSlots * kStripeColumns * (ColumnSetup::kRiseBits + ColumnSetup::kMarchBits + ColumnSetup::kPlaceBits));
    const auto add = [&](const FifoState& fifo) {
        if (fifo.depth() >= kShortest) bits.fifos += static_cast<std::size_t>(fifo.depth() * fifo.width_bits());
    };
    for (const FifoState* fifo : pipe.fifos.fifos()) add(*fifo);
    for (const auto& hop : pipe.chains.hop_fifos) add(hop->pixels);
    return bits;
}

}  // namespace rs::engine::model
