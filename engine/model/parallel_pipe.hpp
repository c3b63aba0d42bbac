#pragma once
// A pipe of the parallel board with its memory channel: from the columns of its stripes to their pixels in its part of
// the image buffer. N pipes run side by side and share only the registers, the private bus and the host.
//
//     raster_generator -> ray_position -> map_reader -> bracket_finder -> image_reader -> column_setup -> band_reader
//                                                                                   columns, cells |
//     pixel_scan -> ray_rise -> cell_march -> sample_place -> texel_tags ----> texel_cache -> texel_filter -+
//                                  ^                               | fills         ^ texels                |
//                                  |              fill_fetch <-----+               |                       |
//                                  | again        [record chains] -> double_buffered_codebook -> texel_merge -> colour
//                                  |
//                                  +------------------------------------------------------------ surface_blend
//                                  empty -> patch_store -> memory                       | resolved
//                                           ^-------------------------------------------+

#include "engine/model/block_decompression.hpp"
#include "engine/model/blocks/memory/memory_controller.hpp"
#include "engine/model/blocks/parallel/band_reader.hpp"
#include "engine/model/blocks/parallel/bracket_finder.hpp"
#include "engine/model/blocks/parallel/cell_march.hpp"
#include "engine/model/blocks/parallel/column_setup.hpp"
#include "engine/model/blocks/parallel/image_reader.hpp"
#include "engine/model/blocks/parallel/patch_store.hpp"
#include "engine/model/blocks/parallel/pixel_rays.hpp"
#include "engine/model/blocks/shared/colour_conversion.hpp"
#include "engine/model/blocks/shared/map_reader.hpp"
#include "engine/model/blocks/shared/view_rays.hpp"
#include "engine/model/blocks/texels/double_buffered_codebook.hpp"
#include "engine/model/blocks/texels/sample_place.hpp"
#include "engine/model/blocks/texels/surface_blend.hpp"
#include "engine/model/blocks/texels/texel_cache.hpp"
#include "engine/model/blocks/texels/texel_fills.hpp"
#include "engine/model/blocks/texels/texel_tags.hpp"

#include <string>
#include <vector>

namespace rs::engine::model {

struct ParallelFifos : FifoGroup {
    using FifoGroup::FifoGroup;

    Fifo<ViewJob> jobs{*this, "jobs", 16, ViewJob::kBits};
    Fifo<ViewJob> scan_jobs{*this, "scan_jobs", 16, ViewJob::kBits};
    Fifo<ViewJob> book_jobs{*this, "book_jobs", 16, ViewJob::kBits};
    Fifo<ColumnRay> columns{*this, "columns", 2, ColumnRay::kBits};
    Fifo<RayPoint> points{*this, "points", 2, RayPoint::kBitsWithDirection};
    Fifo<MemoryRead> map_reads{*this, "map_reads", 2, MemoryRead::kBits};
    Fifo<MemoryWord> map_words{*this, "map_words", 2, MemoryWord::kBits};
    Fifo<MappedRay> mapped{*this, "mapped", 2, MappedRay::kBitsWithDirection};
    Fifo<MemoryRead> bracket_reads{*this, "bracket_reads", 2, MemoryRead::kBits};
    Fifo<MemoryWord> bracket_words{*this, "bracket_words", 2, MemoryWord::kBits};
    Fifo<BracketedRay> bracketed{*this, "bracketed", 2, BracketedRay::kBits};
    Fifo<MemoryRead> line_reads{*this, "line_reads", 4, MemoryRead::kBits};
    Fifo<MemoryWord> line_words{*this, "line_words", 8, MemoryWord::kBits};
    Fifo<RayWithLines> lined{*this, "lined", 2, RayWithLines::kBits};
    Fifo<ColumnSetup> set_up{*this, "set_up", 2, ColumnSetup::kBits};
    Fifo<MemoryRead> band_reads{*this, "band_reads", 4, MemoryRead::kBits};
    Fifo<MemoryWord> band_words{*this, "band_words", 8, MemoryWord::kBits};
    Fifo<ColumnSetup> rise_columns{*this, "rise_columns", 2, ColumnSetup::kRiseBits};
    Fifo<ColumnSetup> march_columns{*this, "march_columns", 2, ColumnSetup::kMarchBits};
    Fifo<ColumnSetup> place_columns{*this, "place_columns", 2, ColumnSetup::kPlaceBits};
    Fifo<Done> stripe_free{*this, "stripe_free", 2, Done::kBits};
    Fifo<PatchJob> patches{*this, "patches", 4, PatchJob::kBits};
    Fifo<Done> patch_free{*this, "patch_free", 4, Done::kBits};
    Fifo<Done> view_done_scan{*this, "view_done_scan", 2, Done::kBits};
    Fifo<Done> view_done_books{*this, "view_done_books", 2, Done::kBits};
    Fifo<ScannedPixel> scanned{*this, "scanned", 4, ScannedPixel::kBits};
    Fifo<PixelBandRay> risen{*this, "risen", 4, PixelBandRay::kBits};
    Fifo<ReturnedPixel> again{*this, "again", 512, ReturnedPixel::kBits};
    Fifo<FinishedPixel> empty{*this, "empty", 4, FinishedPixel::kBitsOfEmpty};
    Fifo<SurfaceHit> met{*this, "met", 8, SurfaceHit::kBits};
    Fifo<PlacedSample> placed{*this, "placed", 4, PlacedSample::kBits};
    Fifo<TexelFill> fills{*this, "fills", 8, TexelFill::kBits};
    Fifo<WaitingSample> waiting{*this, "waiting", kWaitingSamples, WaitingSample::kBits};
    Fifo<FillTarget> targets{*this, "targets", 16, FillTarget::kBits};
    Fifo<FillKind> kinds{*this, "kinds", 16, FillKind::kBits};
    Fifo<MemoryRead> raw_reads{*this, "raw_reads", 8, MemoryRead::kBits};
    Fifo<MemoryWord> raw_words{*this, "raw_words", 32, MemoryWord::kBits};
    Fifo<MemoryRead> book_reads{*this, "book_reads", 4, MemoryRead::kBits};
    Fifo<MemoryWord> book_words{*this, "book_words", 8, MemoryWord::kBits};
    Fifo<YuvaPixel> samples{*this, "samples", 4, YuvaPixel::kBitsOfCoded};
    Fifo<YuvaPixel> merged{*this, "merged", 4, YuvaPixel::kBitsOfCoded};
    Fifo<RgbaPixel> texels{*this, "texels", 16, RgbaPixel::kBits};
    Fifo<TexelQuad> quads{*this, "quads", 4, TexelQuad::kBits};
    Fifo<FilteredSample> filtered{*this, "filtered", 4, FilteredSample::kBits};
    Fifo<FinishedPixel> resolved{*this, "resolved", 4, FinishedPixel::kBits};
    Fifo<MemoryWrite> image_writes{*this, "image_writes", 32, MemoryWrite::kBits};
    Fifo<Done> view_written{*this, "view_written", 2, Done::kBits};
    Fifo<MemoryRead> host_reads{*this, "host_reads", 4, MemoryRead::kBits};
    Fifo<MemoryWord> host_words{*this, "host_words", 8, MemoryWord::kBits};
    Fifo<MemoryWrite> load_words{*this, "load_words", 32, MemoryWrite::kBits};
    Fifo<Done> object_loaded{*this, "object_loaded", 2, Done::kBits};
};

struct ParallelPipe {
    // Pipe `share.pipe` of `share.pipes`; the names of its blocks and FIFOs end in "_p" and its number.
    ParallelPipe(const BoardConfig& config, const RegisterFile& registers, const StripeShare& share);
    ParallelPipe(const ParallelPipe&) = delete;
    ParallelPipe& operator=(const ParallelPipe&) = delete;
    void add_to(Simulator& simulator);
    std::vector<Block*> blocks();  // without the blocks of the record chains

    ParallelFifos fifos;
    RecordChains chains;
    Sdram sdram;
    RasterGenerator raster_generator;
    RayPosition ray_position;
    MapReader map_reader;
    BracketFinder bracket_finder;
    ImageReader image_reader;
    ColumnSetupStage column_setup;
    BandReader band_reader;
    PixelScan pixel_scan;
    RayRise ray_rise;
    CellMarch cell_march;
    SamplePlace sample_place;
    TexelTags texel_tags;
    FillFetch fill_fetch;
    DoubleBufferedCodebook double_buffered_codebook;
    TexelMerge texel_merge;
    ColourConversion colour_conversion;
    TexelCache texel_cache;
    TexelFilter texel_filter;
    SurfaceBlend surface_blend;
    PatchStore patch_store;
    MemoryController memory;
};

// Bits of block RAM in a pipe: codebooks, cells, texels, patches, and the FIFOs that are deep enough to use block RAM.
struct PipeMemoryBits {
    std::size_t books = 0, cells = 0, held_words = 0, march_pixels = 0, effective_depths = 0, rim_pixels = 0,
                texels = 0, patches = 0, columns = 0, fifos = 0;
    [[nodiscard]] std::size_t all() const {
        return books + cells + held_words + march_pixels + effective_depths + rim_pixels + texels + patches + columns +
               fifos;
    }
};
PipeMemoryBits pipe_memory_bits(ParallelPipe& pipe);

}  // namespace rs::engine::model
