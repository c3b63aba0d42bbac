#pragma once
// Decoder of one tile of a dense image: encode/FORMAT.md, section "Dense images". Integer and normative; shared by
// engine and tools.

#include "rayspace/codec/code/dense_code.hpp"
#include "rayspace/image/image.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rs::codec {

/// The coded samples of one image: Y, U, V and alpha, all of the coded size (width and height rounded up to a multiple
/// of 16).
using PlaneViews = std::array<ImageView<std::uint8_t>, 4>;
using ConstPlaneViews = std::array<ConstImageView<std::uint8_t>, 4>;
using Planes = std::array<Image<std::uint8_t>, 4>;

inline PlaneViews plane_views(Planes& planes) {
    return {planes[0].view(), planes[1].view(), planes[2].view(), planes[3].view()};
}
inline ConstPlaneViews plane_views(const Planes& planes) {
    return {planes[0].view(), planes[1].view(), planes[2].view(), planes[3].view()};
}

/// Receives the rectangle [left, right) x [top, bottom), clamped to the coded size, of each read of a reference image
/// before it happens.
class ReferenceListener {
public:
    ReferenceListener() = default;
    ReferenceListener(const ReferenceListener&) = delete;
    ReferenceListener& operator=(const ReferenceListener&) = delete;
    virtual ~ReferenceListener() = default;
    virtual void need(int reference, int left, int top, int right, int bottom) = 0;
};

struct TileRect {
    int left = 0;  // first sample in the image
    int top = 0;
    int width = 0;  // samples, clipped to the coded size
    int height = 0;
};

/// A tile to decode, and the images that it is predicted from.
struct CodedTile {
    const ImageHead& head;  // of the tile's image
    std::span<const std::byte> bytes;
    TileRect place;
    const std::array<ConstPlaneViews, 2>& references;  // [r]: the image head.reference[r]
    ReferenceListener* listener = nullptr;             // may be null
};

/// Decodes a tile into `out`, an image; other threads may write other tiles. Any bytes decode to some samples: there
/// are no errors. Cost: about a microsecond per 64 samples of each plane.
void decode_dense_tile(const DenseCode& code, const CodedTile& tile, const PlaneViews& out);

/// Clears a tile without bytes: transparent.
void clear_tile(const TileRect& place, const PlaneViews& out);
inline constexpr std::uint8_t kEmptySample = 128;  // Y, U and V of transparent samples

}  // namespace rs::codec
