#pragma once
// A pipe of the parallel board with its memory channel: from the columns of its stripes to their pixels in its part of
// the image buffer. N of them stand side by side and share nothing but the registers, the private bus and the host.
//
//     raster_generator -> ray_position -> map_reader -> bracket_finder -> picture_reader -> column_setup -> band_reader
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
#include "engine/model/blocks/parallel/patch_store.hpp"
#include "engine/model/blocks/parallel/picture_reader.hpp"
#include "engine/model/blocks/parallel/pixel_scan.hpp"
#include "engine/model/blocks/parallel/ray_rise.hpp"
#include "engine/model/blocks/shared/colour_conversion.hpp"
#include "engine/model/blocks/shared/map_reader.hpp"
#include "engine/model/blocks/shared/raster_generator.hpp"
#include "engine/model/blocks/shared/ray_position.hpp"
#include "engine/model/blocks/texels/double_buffered_codebook.hpp"
#include "engine/model/blocks/texels/fill_fetch.hpp"
#include "engine/model/blocks/texels/sample_place.hpp"
#include "engine/model/blocks/texels/surface_blend.hpp"
#include "engine/model/blocks/texels/texel_cache.hpp"
#include "engine/model/blocks/texels/texel_filter.hpp"
#include "engine/model/blocks/texels/texel_merge.hpp"
#include "engine/model/blocks/texels/texel_tags.hpp"

#include <string>
#include <vector>

namespace rs::engine::model {

struct ParallelFifos {
    explicit ParallelFifos(const std::string& suffix);
    std::vector<FifoState*> all();

    Fifo<ViewJob> jobs;
    Fifo<ViewJob> scan_jobs;
    Fifo<ViewJob> book_jobs;
    Fifo<ColumnRay> columns;
    Fifo<RayPoint> points;
    Fifo<MemoryRead> map_reads;
    Fifo<MemoryWord> map_words;
    Fifo<MappedRay> mapped;
    Fifo<MemoryRead> bracket_reads;
    Fifo<MemoryWord> bracket_words;
    Fifo<BracketedRay> bracketed;
    Fifo<MemoryRead> line_reads;
    Fifo<MemoryWord> line_words;
    Fifo<LinedRay> lined;
    Fifo<ColumnSetup> set_up;
    Fifo<MemoryRead> band_reads;
    Fifo<MemoryWord> band_words;
    Fifo<ColumnSetup> rise_columns;
    Fifo<ColumnSetup> march_columns;
    Fifo<ColumnSetup> place_columns;
    Fifo<Done> stripe_free;
    Fifo<PatchJob> patches;
    Fifo<Done> patch_free;
    Fifo<Done> view_done_scan;
    Fifo<Done> view_done_books;
    Fifo<ScannedPixel> scanned;
    Fifo<RisenPixel> risen;
    Fifo<MarchAgain> again;
    Fifo<FinishedPixel> empty;
    Fifo<MetSurface> met;
    Fifo<PlacedSample> placed;
    Fifo<TexelFill> fills;
    Fifo<WaitingSample> waiting;
    Fifo<FillTarget> targets;
    Fifo<FillKind> kinds;
    Fifo<MemoryRead> raw_reads;
    Fifo<MemoryWord> raw_words;
    Fifo<MemoryRead> book_reads;
    Fifo<MemoryWord> book_words;
    Fifo<YuvaPixel> samples;
    Fifo<YuvaPixel> merged;
    Fifo<RgbaPixel> texels;
    Fifo<TexelQuad> quads;
    Fifo<FilteredSample> filtered;
    Fifo<FinishedPixel> resolved;
    Fifo<MemoryWrite> image_writes;
    Fifo<Done> view_written;
    Fifo<MemoryRead> host_reads;
    Fifo<MemoryWord> host_words;
    Fifo<MemoryWrite> load_words;
    Fifo<Done> object_loaded;
};

struct ParallelPipe {
    // Pipe `share.pipe` of `share.pipes`; its names end in "_p" and that number.
    ParallelPipe(const BoardConfig& config, const RegisterFile& registers, const StripeShare& share);
    ParallelPipe(const ParallelPipe&) = delete;
    ParallelPipe& operator=(const ParallelPipe&) = delete;
    void add_to(Simulator& simulator);
    std::vector<Block*> blocks();  // but those of the record chains

    ParallelFifos fifos;
    RecordChains chains;
    Sdram sdram;
    RasterGenerator raster_generator;
    RayPosition ray_position;
    MapReader map_reader;
    BracketFinder bracket_finder;
    PictureReader picture_reader;
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

// Bits of block RAM in a pipe: codebooks, cells, texels, patches, and the FIFOs that are long enough to be one.
struct PipeMemoryBits {
    std::size_t books = 0, cells = 0, held_words = 0, march_pixels = 0, texels = 0, patches = 0, columns = 0, fifos = 0;
    [[nodiscard]] std::size_t all() const {
        return books + cells + held_words + march_pixels + texels + patches + columns + fifos;
    }
};
PipeMemoryBits pipe_memory_bits(ParallelPipe& pipe);

}  // namespace rs::engine::model
