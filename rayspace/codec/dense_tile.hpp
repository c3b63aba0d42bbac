#pragma once
// The decoder of one tile of a dense image: encode/FORMAT.md, section "Dense images". Integer and normative; engine
// and tools share it.

#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rs::codec {

// The samples of one image as they are coded: Y, U, V and alpha, all of the coded size (width and height rounded up
// to a multiple of 16).
using PlaneViews = std::array<ImageView<std::uint8_t>, 4>;
using ConstPlaneViews = std::array<ConstImageView<std::uint8_t>, 4>;
using Planes = std::array<Image<std::uint8_t>, 4>;

inline PlaneViews views_of(Planes& planes) {
    return {planes[0].view(), planes[1].view(), planes[2].view(), planes[3].view()};
}
inline ConstPlaneViews views_of(const Planes& planes) {
    return {planes[0].view(), planes[1].view(), planes[2].view(), planes[3].view()};
}

// Told before samples of an image that predicts are read: the rectangle [left, right) x [top, bottom), clamped to the
// coded size.
class ReferenceListener {
public:
    ReferenceListener() = default;
    ReferenceListener(const ReferenceListener&) = delete;
    ReferenceListener& operator=(const ReferenceListener&) = delete;
    virtual ~ReferenceListener() = default;
    virtual void need(int reference, int left, int top, int right, int bottom) = 0;
};

struct TilePlace {
    int left = 0;  // first sample in the image
    int top = 0;
    int width = 0;  // samples, cut off at the coded size
    int height = 0;
};

// Decodes the tile at `place` into `out`, which may be written by other threads in other tiles.
// references[r] are those of head.reference[r]. Any bytes give some samples: there is nothing to fail. Cost: about a
// microsecond for 64 samples of each plane.
void decode_dense_tile(const DenseCode& code, const ImageHead& head, std::span<const std::byte> bytes,
                       const TilePlace& place, const std::array<ConstPlaneViews, 2>& references,
                       ReferenceListener* listener, const PlaneViews& out);

// What a tile without bytes holds: nothing, transparent.
void clear_tile(const TilePlace& place, const PlaneViews& out);
inline constexpr std::uint8_t kEmptySample = 128;  // of Y, U and V

}  // namespace rs::codec
