#include "engine/core/fast/coded_texels.hpp"

#include "engine/core/definition/texel_detail.hpp"
#include "rayspace/object/yuv.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace rs::engine {
namespace {

// Distance of consecutive images in texels: whole pages both of colours and of details.
std::size_t texels_per_image(const codec::CodedImages& coded) {
    const std::int64_t texels = TexelLayout{coded.width, coded.height, {}}.image_texels();
    return ReservedMemory::whole_pages(static_cast<std::size_t>(texels));
}

}  // namespace

Result<std::unique_ptr<CodedTexels>> CodedTexels::create(std::shared_ptr<const codec::CodedImages> coded,
                                                         const std::string& name, std::int64_t budget_bytes,
                                                         ImageArrival arrival) {
    // Lanes without a ray read texel 0, which belongs to no image.
    TexelLayout layout{coded->width, coded->height, {}};
    const std::size_t per_image = texels_per_image(*coded);
    std::size_t size = ReservedMemory::whole_pages(1);
    for (const codec::CodedImage& image : coded->images) {
        layout.image_start.push_back(static_cast<std::int32_t>(size));
        if (image.loaded() || arrival == ImageArrival::later) size += per_image;
        if (size > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) return too_many_texels(name);
    }
    RS_ASSIGN_OR_RETURN(ReservedMemory memory, ReservedMemory::create(size * sizeof(Rgba8), name));
    RS_ASSIGN_OR_RETURN(
        ReservedMemory details,
        ReservedMemory::create(ReservedMemory::whole_pages(size + TexelLayout::kMinColumnStride), name));
    RS_ASSIGN_OR_RETURN(std::unique_ptr<SampleStore> samples, SampleStore::create(std::move(coded), name, arrival));
    return std::unique_ptr<CodedTexels>(
        new CodedTexels(std::move(samples), std::move(layout), std::move(memory), std::move(details), budget_bytes));
}

CodedTexels::CodedTexels(std::unique_ptr<SampleStore> samples, TexelLayout layout, ReservedMemory memory,
                         ReservedMemory details, std::int64_t budget_bytes)
    : samples_(std::move(samples)),
      layout_(std::move(layout)),
      memory_(std::move(memory)),
      details_(std::move(details)),
      budget_bytes_(budget_bytes),
      spans_(layout_.image_start.size() * static_cast<std::size_t>(layout_.width)),
      tile_columns_(layout_.image_start.size() * static_cast<std::size_t>(samples_->coded().tile_columns())),
      texel_bytes_(layout_.image_start.size()) {}

void CodedTexels::ensure(int image, int first, int last) {
    const codec::CodedImages& coded = samples_->coded();
    samples_->mark_used(image);
    for (int column = first >> coded.tile_width_log2; column <= last >> coded.tile_width_log2; ++column) {
        DoneFlag& flag = tile_columns_[static_cast<std::size_t>(image * coded.tile_columns() + column)];
        if (!flag.done()) flag.ensure([&] { fill_tile_column(image, column); });
    }
}

void CodedTexels::decode_tile_column(int image, int tile_column) {
    const codec::CodedImages& coded = samples_->coded();
    if (tile_column < 0 || tile_column >= coded.tile_columns()) return;
    const codec::CodedImage& from = coded.images[static_cast<std::size_t>(image)];
    for (int row = 0; row < coded.tile_rows(); ++row) {
        const int tile = row * coded.tile_columns() + tile_column;
        if (from.tiles[static_cast<std::size_t>(tile)].present) samples_->ensure_tile(image, tile);
    }
}

// Texels of tiles that are not present are never written and stay transparent.
void CodedTexels::fill_tile_column(int image, int tile_column) {
    const codec::CodedImages& coded = samples_->coded();
    const codec::CodedImage& from = coded.images[static_cast<std::size_t>(image)];
    const int first = tile_column << coded.tile_width_log2;
    const int last = std::min(first + coded.tile_width(), layout_.width) - 1;
    // Details at the edges of the tile column depend on the adjacent pixels.
    for (const int needed : {tile_column - 1, tile_column, tile_column + 1}) decode_tile_column(image, needed);
    int top = layout_.height;
    int bottom = 0;
    for (int row = 0; row < coded.tile_rows(); ++row) {
        const int tile = row * coded.tile_columns() + tile_column;
        if (!from.tiles[static_cast<std::size_t>(tile)].present) continue;
        codec::TileRect place = codec::tile_rect(coded, static_cast<std::size_t>(tile));
        place.width = std::min(place.width, layout_.width - place.left);
        place.height = std::min(place.height, layout_.height - place.top);
        convert_tile(image, place);
        top = std::min(top, place.top);
        bottom = place.top + place.height;
    }
    for (int column = first; column <= last; ++column) {
        Rgba8* const texels = texel(layout_.column_start(image, column));
        RowSpan span{top, std::max(top, bottom)};
        while (span.begin < span.end && texels[span.begin].a == 0) ++span.begin;
        while (span.begin < span.end && texels[span.end - 1].a == 0) --span.end;
        spans_[layout_.span_index(image, column)] = span.begin < span.end ? span : RowSpan{};
        compute_details(image, column, span.begin, span.end);
    }
    texel_bytes_[static_cast<std::size_t>(image)].fetch_add(
        static_cast<std::int64_t>(kTexelBytes) * (last - first + 1) * layout_.column_stride(),
        std::memory_order_relaxed);
}

void CodedTexels::convert_tile(int image, const codec::TileRect& place) {
    const codec::ConstPlaneViews planes = samples_->planes(image);
    // ConvertedScene row by row into a buffer, in the order of the samples, then copied column by column.
    constexpr int kMaxTileSide = 1 << codec::kMaxTileLog2;
    Rgba8 tile[kMaxTileSide * kMaxTileSide];
    for (int y = 0; y < place.height; ++y) {
        const auto row = [&](std::size_t plane) { return planes[plane].row(place.top + y) + place.left; };
        const std::uint8_t* const luma = row(0);
        const std::uint8_t* const u = row(1);
        const std::uint8_t* const v = row(2);
        const std::uint8_t* const alpha = row(3);
        for (int x = 0; x < place.width; ++x) {
            tile[y * kMaxTileSide + x] = rgba_from_yuva(luma[x], u[x], v[x], alpha[x]);
        }
    }
    const int bottom = place.top + place.height;
    for (int x = 0; x < place.width; ++x) {
        Rgba8* const texels = texel(layout_.column_start(image, place.left + x));
        for (int y = 0; y < place.height; ++y) texels[place.top + y] = tile[y * kMaxTileSide + x];
        if (place.top == 0) texels[-1] = texels[0];
        if (bottom == layout_.height) texels[bottom] = texels[bottom - 1];
    }
    const int border_top = place.top - (place.top == 0 ? 1 : 0);
    const int border_bottom = bottom + (bottom == layout_.height ? 1 : 0);
    const auto repeat = [&](int from, int to) {
        std::copy(texel(layout_.column_start(image, from)) + border_top,
                  texel(layout_.column_start(image, from)) + border_bottom,
                  texel(layout_.column_start(image, to)) + border_top);
    };
    if (place.left == 0) repeat(0, -1);
    if (place.left + place.width == layout_.width) repeat(layout_.width - 1, layout_.width);
}

// Computes the details of rows [top, bottom) of a column.
void CodedTexels::compute_details(int image, int column, int top, int bottom) {
    const codec::ConstPlaneViews planes = samples_->planes(image);
    const auto luma = [&](int x, int y) { return int{planes[0].row(y)[x]}; };
    const auto alpha = [&](int x, int y) { return int{planes[3].row(y)[x]}; };
    std::int8_t* const details = detail(layout_.column_start(image, column));
    for (int row = top; row < bottom; ++row) {
        details[row] = texel_detail_at(layout_.width, layout_.height, column, row, luma, alpha);
    }
}

void CodedTexels::begin_view() {
    const std::lock_guard lock(mutex_);
    samples_->advance_clock();
    if (active_views_ == 0) free_over_budget();
    ++active_views_;
}

void CodedTexels::end_view() {
    const std::lock_guard lock(mutex_);
    --active_views_;
}

std::int64_t CodedTexels::decoded_bytes_of(int image) const {
    return samples_->decoded_bytes(image) +
           texel_bytes_[static_cast<std::size_t>(image)].load(std::memory_order_relaxed);
}

std::int64_t CodedTexels::decoded_bytes() const {
    std::int64_t bytes = 0;
    for (int p = 0; p < static_cast<int>(texel_bytes_.size()); ++p) bytes += decoded_bytes_of(p);
    return bytes;
}

void CodedTexels::free_over_budget() {
    std::int64_t bytes = decoded_bytes();
    if (bytes <= budget_bytes_) return;
    std::vector<std::pair<std::int64_t, int>> images;  // time of last use, index
    for (int p = 0; p < static_cast<int>(texel_bytes_.size()); ++p) {
        if (decoded_bytes_of(p) > 0) images.emplace_back(samples_->last_used(p), p);
    }
    std::sort(images.begin(), images.end());
    for (const auto& [used, image] : images) {
        if (bytes <= budget_bytes_) return;
        bytes -= decoded_bytes_of(image);
        free_image(image);
    }
}

void CodedTexels::free_image(int image) {
    samples_->forget(image);
    const std::size_t texels = texels_per_image(samples_->coded());
    const auto start = static_cast<std::size_t>(layout_.image_start[static_cast<std::size_t>(image)]);
    memory_.release(start * sizeof(Rgba8), texels * sizeof(Rgba8));
    details_.release(start, texels);
    texel_bytes_[static_cast<std::size_t>(image)].store(0, std::memory_order_relaxed);
    const int columns = samples_->coded().tile_columns();
    for (int c = 0; c < columns; ++c) tile_columns_[static_cast<std::size_t>(image * columns + c)].reset();
}

}  // namespace rs::engine
