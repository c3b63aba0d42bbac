#pragma once
// The captured images in the fast core's layout: RGBA, column by column.
//
// YUV is converted to RGB once per stored pixel instead of once per rendered one; the definition converts each texel
// before it interpolates, so the bits are the same. Columns are contiguous because the engine walks images downwards.
//
// Layout: texel (column, row) of image p is texels()[column_start(p, column) + row], and
// column_start(p, column + 1) = column_start(p, column) + column_stride(). Every image has a border one texel wide
// that repeats its edge (column -1 and `width`, row -1 and `height`), so that bilinear reads need no clamps.
// texels()[0] is transparent and belongs to no image; lanes without a ray read it. details() holds each texel's
// detail (definition/texel_detail.hpp) at the same index.
//
// Images that the object holds only compressed are decoded on demand and freed beyond a budget (coded_texels.hpp).

#include "engine/core/fast/coded_texels.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace rs::engine {

// True where the object's images are to be taken from object.coded: no image is unpacked.
bool shows_coded_images(const RaySpaceObject& object);

class TexelStore {
public:
    // Fails where the images and their borders have 2^31 pixels or more (the fast core's indices are 32 bits wide),
    // or coded images cannot be decoded. Images that are not loaded take no room and must not be requested.
    static Result<TexelStore> create(const RaySpaceObject& object, std::int64_t decoded_budget_bytes);

    // Memory of `count` unpacked images of a size.
    static std::int64_t bytes_of_images(int width, int height, std::int64_t count);
    // Memory of this store now.
    [[nodiscard]] std::int64_t memory_bytes() const;

    // Texels may be read only while a Reading exists; several may exist, in any threads.
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

    // Before columns [first, last] of an image are read, or their spans.
    void ensure(int image, int first, int last) const {
        if (coded_ != nullptr) coded_->ensure(image, first, last);
    }
    // True if ensure() may have to decode.
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
