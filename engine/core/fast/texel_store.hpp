#pragma once
// Captured images in the layout of the fast core: RGBA, column by column.
//
// YUV is converted to RGB once per stored pixel instead of once per rendered one; the definition converts texels before
// it interpolates, so the result is the same. Columns are contiguous because view columns sample images downwards.
//
// Layout: texel (column, row) of image p is texels()[column_start(p, column) + row], and
// column_start(p, column + 1) = column_start(p, column) + column_stride(). Every image has a border one texel wide
// that repeats its edge (column -1 and `width`, row -1 and `height`), so that bilinear reads need no clamps.
// texels()[0] is transparent and belongs to no image; lanes without a ray read it. details() holds each texel's
// detail (definition/texel_detail.hpp) at the same index.
//
// Compressed images are decoded on demand and freed beyond a budget (coded_texels.hpp).

#include "engine/core/fast/coded_texels.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace rs::engine {

/// True if no image of the object is unpacked, so that object.coded is rendered.
bool has_only_coded_images(const RaySpaceObject& object);

class TexelStore {
public:
    /// Images that are not loaded take no memory and must not be requested. Only coded images can arrive later.
    /// \return error if the images and their borders have 2^31 pixels or more (indices are 32 bits wide), or if coded
    ///         images cannot be decoded
    static Result<TexelStore> create(const RaySpaceObject& object, std::int64_t decoded_budget_bytes,
                                     ImageArrival arrival = ImageArrival::complete);

    /// Memory of a store of `count` unpacked images of width x height pixels.
    static std::int64_t bytes_of_images(int width, int height, std::int64_t count);
    /// Current memory of this store.
    [[nodiscard]] std::int64_t memory_bytes() const;

    // Scope in which texels may be read. Several may exist, in any threads.
    class Reading {
    public:
        explicit Reading(CodedTexels* coded) : coded_(coded) {
            if (coded_ != nullptr) coded_->begin_view();
        }
        Reading(const Reading&) = delete;
        Reading& operator=(const Reading&) = delete;
        ~Reading() {
            if (coded_ != nullptr) coded_->end_view();
        }

    private:
        CodedTexels* coded_;
    };
    [[nodiscard]] Reading read() const { return Reading(coded_.get()); }

    /// Must be called before columns [first, last] of an image, or their spans, are read.
    void ensure(int image, int first, int last) const {
        if (coded_ != nullptr) coded_->ensure(image, first, last);
    }
    /// True if ensure() may decode.
    [[nodiscard]] bool is_coded() const { return coded_ != nullptr; }

    [[nodiscard]] const Rgba8* texels() const { return coded_ != nullptr ? coded_->texels() : texels_.data(); }
    [[nodiscard]] const std::int8_t* details() const { return coded_ != nullptr ? coded_->details() : details_.data(); }
    [[nodiscard]] std::int32_t column_start(int image, int column) const { return layout_.column_start(image, column); }
    [[nodiscard]] std::int32_t column_stride() const { return layout_.column_stride(); }
    [[nodiscard]] RowSpan occupied(int image, int column) const {
        return coded_ != nullptr ? coded_->occupied(image, column) : spans_[layout_.span_index(image, column)];
    }

private:
    TexelLayout layout_;
    std::vector<RowSpan> spans_;
    std::vector<Rgba8> texels_;
    std::vector<std::int8_t> details_;
    std::unique_ptr<CodedTexels> coded_;
};

}  // namespace rs::engine
