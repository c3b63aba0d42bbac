#pragma once
// Texel store for compressed images. A column of tiles is decoded when one of its columns is first needed. Between
// views the least recently used images are freed to keep the decoded ones within a budget.

#include "engine/core/fast/done_flag.hpp"
#include "engine/core/fast/reserved_memory.hpp"
#include "engine/core/fast/sample_store.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace rs::engine {

// Rows [begin, end) of a column hold all of its texels with alpha above 0; begin == end for an empty column.
struct RowSpan {
    std::int32_t begin = 0;
    std::int32_t end = 0;
};

// Colour and detail of a texel.
inline constexpr std::size_t kTexelBytes = sizeof(Rgba8) + sizeof(std::int8_t);

// Memory layout of the texels (texel_store.hpp).
struct TexelLayout {
    // shape_walk.hpp reads this many texels of a column at once, also of shorter columns.
    static constexpr std::int32_t kMinColumnStride = 17;

    int width = 0;
    int height = 0;
    std::vector<std::int32_t> image_start;  // index of texel (-1, -1)

    // Columns include a border texel at both ends.
    [[nodiscard]] std::int32_t column_stride() const { return std::max(height + 2, kMinColumnStride); }
    [[nodiscard]] std::int64_t image_texels() const { return (std::int64_t{width} + 2) * column_stride(); }
    [[nodiscard]] std::int32_t column_start(int image, int column) const {
        return image_start[static_cast<std::size_t>(image)] + (column + 1) * column_stride() + 1;
    }
    // Index of a column's RowSpan.
    [[nodiscard]] std::size_t span_index(int image, int column) const {
        return static_cast<std::size_t>(image) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
    }
};

// Error for images that exceed 32-bit texel indices.
inline Error too_many_texels(const std::string& name) {
    return {name +
            ": its images have more than 2^31 pixels, which the renderer cannot address; "
            "encode the object with fewer or smaller images"};
}

class CodedTexels {
public:
    /// \param budget_bytes  samples and texels together; images of views being rendered are kept even beyond it
    static Result<std::unique_ptr<CodedTexels>> create(std::shared_ptr<const codec::CodedImages> coded,
                                                       const std::string& name, std::int64_t budget_bytes,
                                                       ImageArrival arrival = ImageArrival::complete);

    /// No two images share a memory page, and none shares one with texel 0 (texel_store.hpp).
    [[nodiscard]] const TexelLayout& layout() const { return layout_; }
    [[nodiscard]] const Rgba8* texels() const { return texel(0); }
    [[nodiscard]] const std::int8_t* details() const { return detail(0); }
    [[nodiscard]] RowSpan occupied(int image, int column) const { return spans_[layout_.span_index(image, column)]; }

    /// Must be called before and after every rendered view; ensure() and reads of texels are allowed only in between.
    void begin_view();
    void end_view();

    /// Computes the texels, details, borders and spans of columns [first, last] of a loaded image unless they are valid
    /// already; 0 <= first <= last < width. Thread-safe.
    void ensure(int image, int first, int last);

    /// Memory of the decoded samples and texels of all images.
    [[nodiscard]] std::int64_t decoded_bytes() const;

private:
    CodedTexels(std::unique_ptr<SampleStore> samples, TexelLayout layout, ReservedMemory memory, ReservedMemory details,
                std::int64_t budget_bytes);
    [[nodiscard]] Rgba8* texel(std::ptrdiff_t index) const { return reinterpret_cast<Rgba8*>(memory_.data()) + index; }
    [[nodiscard]] std::int8_t* detail(std::ptrdiff_t index) const {
        return reinterpret_cast<std::int8_t*>(details_.data()) + index;
    }
    [[nodiscard]] std::int64_t decoded_bytes_of(int image) const;
    void fill_tile_column(int image, int tile_column);
    void decode_tile_column(int image, int tile_column);
    void convert_tile(int image, const codec::TileRect& place);
    void compute_details(int image, int column, int top, int bottom);
    void free_over_budget();
    void free_image(int image);

    std::unique_ptr<SampleStore> samples_;
    TexelLayout layout_;
    ReservedMemory memory_;
    ReservedMemory details_;
    std::int64_t budget_bytes_;
    std::vector<RowSpan> spans_;
    std::vector<DoneFlag> tile_columns_;                  // [image][tile column]
    std::vector<std::atomic<std::int64_t>> texel_bytes_;  // [image]: memory of valid texels
    std::mutex mutex_;
    int active_views_ = 0;
};

}  // namespace rs::engine
