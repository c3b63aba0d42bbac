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
      raster_generator(registers, fifos.jobs, fifos.columns, share),
      ray_position(registers, fifos.columns, fifos.points),
      map_reader(fifos.points, fifos.map_reads, fifos.map_words, fifos.mapped),
      bracket_finder(registers, fifos.mapped, fifos.bracket_reads, fifos.bracket_words, fifos.bracketed),
      image_reader(registers, fifos.bracketed, fifos.line_reads, fifos.line_words, fifos.lined),
      column_setup(registers, fifos.lined, fifos.set_up),
      band_reader(registers, share, fifos.set_up, fifos.stripe_free, fifos.band_reads, fifos.rise_columns,
                  fifos.march_columns, fifos.place_columns),
      pixel_scan(registers, share, fifos.scan_jobs, fifos.patch_free, fifos.view_done_scan, fifos.patches,
                 fifos.scanned),
      ray_rise(registers, fifos.rise_columns, fifos.scanned, fifos.risen),
      cell_march(registers, fifos.march_columns, fifos.band_words, fifos.risen, fifos.again, fifos.met, fifos.empty),
      sample_place(registers, fifos.place_columns, fifos.met, fifos.placed),
      texel_tags(registers, fifos.placed, fifos.fills, fifos.waiting),
      fill_fetch(registers, fifos.fills, chains.hop_fifos[0]->asks, chains.hop_fifos[0]->pixels, fifos.raw_reads,
                 fifos.kinds, fifos.targets),
      double_buffered_codebook(registers, fifos.book_jobs, fifos.view_done_books, chains.complete, fifos.book_reads,
                               fifos.book_words, fifos.samples),
      texel_merge(fifos.kinds, fifos.samples, fifos.raw_words, fifos.merged),
      colour_conversion(fifos.merged, fifos.texels),
      texel_cache(fifos.waiting, fifos.targets, fifos.texels, fifos.quads),
      texel_filter(fifos.quads, fifos.filtered),
      surface_blend(fifos.filtered, fifos.resolved, fifos.again),
      patch_store(registers, fifos.patches, fifos.resolved, fifos.empty, fifos.image_writes, fifos.patch_free,
                  fifos.stripe_free, fifos.view_done_scan, fifos.view_done_books),
      memory("memory_controller", config.memory, sdram, read_ports(*this), fifos.image_writes, fifos.view_written,
             fifos.load_words, fifos.object_loaded) {
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
