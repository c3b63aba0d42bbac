#include "engine/model/parallel_pipe.hpp"

namespace rs::engine::model {
namespace {

// The order of the list is the order of service: the host, whose bus is slow; the columns, of which there are few; then
// blocks of texels, what others wait for first; books last, which are read ahead.
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

ParallelFifos::ParallelFifos(const std::string& suffix)
    : jobs("jobs" + suffix, 16, ViewJob::kBits),
      scan_jobs("scan_jobs" + suffix, 16, ViewJob::kBits),
      book_jobs("book_jobs" + suffix, 16, ViewJob::kBits),
      columns("columns" + suffix, 2, ColumnRay::kBits),
      points("points" + suffix, 2, RayPoint::kBitsWithDirection),
      map_reads("map_reads" + suffix, 2, MemoryRead::kBits),
      map_words("map_words" + suffix, 2, MemoryWord::kBits),
      mapped("mapped" + suffix, 2, MappedRay::kBitsWithDirection),
      bracket_reads("bracket_reads" + suffix, 2, MemoryRead::kBits),
      bracket_words("bracket_words" + suffix, 2, MemoryWord::kBits),
      bracketed("bracketed" + suffix, 2, BracketedRay::kBits),
      line_reads("line_reads" + suffix, 4, MemoryRead::kBits),
      line_words("line_words" + suffix, 8, MemoryWord::kBits),
      lined("lined" + suffix, 2, LinedRay::kBits),
      set_up("set_up" + suffix, 2, ColumnSetup::kBits),
      band_reads("band_reads" + suffix, 4, MemoryRead::kBits),
      band_words("band_words" + suffix, 8, MemoryWord::kBits),
      rise_columns("rise_columns" + suffix, 2, ColumnSetup::kRiseBits),
      march_columns("march_columns" + suffix, 2, ColumnSetup::kMarchBits),
      place_columns("place_columns" + suffix, 2, ColumnSetup::kPlaceBits),
      stripe_free("stripe_free" + suffix, 2, Done::kBits),
      patches("patches" + suffix, 4, PatchJob::kBits),
      patch_free("patch_free" + suffix, 4, Done::kBits),
      view_done_scan("view_done_scan" + suffix, 2, Done::kBits),
      view_done_books("view_done_books" + suffix, 2, Done::kBits),
      scanned("scanned" + suffix, 4, ScannedPixel::kBits),
      risen("risen" + suffix, 4, RisenPixel::kBits),
      again("again" + suffix, 512, MarchAgain::kBits),
      empty("empty" + suffix, 4, FinishedPixel::kBitsOfEmpty),
      met("met" + suffix, 8, MetSurface::kBits),
      placed("placed" + suffix, 4, PlacedSample::kBits),
      fills("fills" + suffix, 8, TexelFill::kBits),
      waiting("waiting" + suffix, 512, WaitingSample::kBits),
      targets("targets" + suffix, 16, FillTarget::kBits),
      kinds("kinds" + suffix, 16, FillKind::kBits),
      raw_reads("raw_reads" + suffix, 8, MemoryRead::kBits),
      raw_words("raw_words" + suffix, 32, MemoryWord::kBits),
      book_reads("book_reads" + suffix, 4, MemoryRead::kBits),
      book_words("book_words" + suffix, 8, MemoryWord::kBits),
      samples("samples" + suffix, 4, YuvaPixel::kBitsOfCoded),
      merged("merged" + suffix, 4, YuvaPixel::kBitsOfCoded),
      texels("texels" + suffix, 16, RgbaPixel::kBits),
      quads("quads" + suffix, 4, TexelQuad::kBits),
      filtered("filtered" + suffix, 4, FilteredSample::kBits),
      resolved("resolved" + suffix, 4, FinishedPixel::kBits),
      image_writes("image_writes" + suffix, 32, MemoryWrite::kBits),
      view_written("view_written" + suffix, 2, Done::kBits),
      host_reads("host_reads" + suffix, 4, MemoryRead::kBits),
      host_words("host_words" + suffix, 8, MemoryWord::kBits),
      load_words("load_words" + suffix, 32, MemoryWrite::kBits),
      object_loaded("object_loaded" + suffix, 2, Done::kBits) {}

std::vector<FifoState*> ParallelFifos::all() {
    return {
        &jobs,       &scan_jobs,     &book_jobs,      &columns,         &points,        &map_reads,     &map_words,
        &mapped,     &bracket_reads, &bracket_words,  &bracketed,       &line_reads,    &line_words,    &lined,
        &set_up,     &band_reads,    &band_words,     &rise_columns,    &march_columns, &place_columns, &stripe_free,
        &patches,    &patch_free,    &view_done_scan, &view_done_books, &scanned,       &risen,         &again,
        &empty,      &met,           &placed,         &fills,           &waiting,       &targets,       &kinds,
        &raw_reads,  &raw_words,     &book_reads,     &book_words,      &samples,       &merged,        &texels,
        &quads,      &filtered,      &resolved,       &image_writes,    &view_written,  &host_reads,    &host_words,
        &load_words, &object_loaded};
}

ParallelPipe::ParallelPipe(const BoardConfig& config, const RegisterFile& registers, const StripeShare& share)
    : fifos(suffix_of(share)),
      chains(registers, suffix_of(share)),
      sdram(config.memory.shape, config.memory.timing),
      raster_generator(registers, fifos.jobs, fifos.columns, share),
      ray_position(registers, fifos.columns, fifos.points),
      map_reader(fifos.points, fifos.map_reads, fifos.map_words, fifos.mapped),
      bracket_finder(registers, fifos.mapped, fifos.bracket_reads, fifos.bracket_words, fifos.bracketed),
      picture_reader(registers, fifos.bracketed, fifos.line_reads, fifos.line_words, fifos.lined),
      column_setup(registers, fifos.lined, fifos.set_up),
      band_reader(registers, share, fifos.set_up, fifos.stripe_free, fifos.band_reads, fifos.rise_columns,
                  fifos.march_columns, fifos.place_columns),
      pixel_scan(registers, share, fifos.scan_jobs, fifos.patch_free, fifos.view_done_scan, fifos.patches,
                 fifos.scanned),
      ray_rise(registers, fifos.rise_columns, fifos.scanned, fifos.risen),
      cell_march(registers, fifos.march_columns, fifos.band_words, fifos.risen, fifos.again, fifos.met, fifos.empty),
      sample_place(registers, fifos.place_columns, fifos.met, fifos.placed),
      texel_tags(registers, fifos.placed, fifos.fills, fifos.waiting),
      fill_fetch(registers, fifos.fills, chains.fifos[0]->asks, chains.fifos[0]->pixels, fifos.raw_reads, fifos.kinds,
                 fifos.targets),
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
            &picture_reader,
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
    for (FifoState* fifo : fifos.all()) simulator.add(Domain::board, *fifo);
    chains.add_chains_to(simulator);
    simulator.add(Domain::board, chains.complete);
}

PipeMemoryBits pipe_memory_bits(ParallelPipe& pipe) {
    constexpr int kShortest = 64;  // FIFOs below are of logic cells
    PipeMemoryBits bits;
    bits.books = DoubleBufferedCodebook::kBits;
    bits.cells = CellMarch::kCellBits;
    bits.held_words = CellMarch::kHeldBits;
    bits.march_pixels = CellMarch::kPixelBits;
    bits.texels = static_cast<std::size_t>(TexelCache::kBits);
    bits.patches = static_cast<std::size_t>(PatchStore::kBits);
    bits.columns = static_cast<std::size_t>(
        kStripeSlots * kStripeColumns * (ColumnSetup::kRiseBits + ColumnSetup::kMarchBits + ColumnSetup::kPlaceBits));
    const auto add = [&](const FifoState& fifo) {
        if (fifo.depth() >= kShortest) bits.fifos += static_cast<std::size_t>(fifo.depth() * fifo.width_bits());
    };
    for (const FifoState* fifo : pipe.fifos.all()) add(*fifo);
    for (const auto& hop : pipe.chains.fifos) add(hop->pixels);
    return bits;
}

}  // namespace rs::engine::model
