#pragma once
// Synthesized views in memory. Most of their pixels are transparent, and many views are kept while they are encoded.

#include "rayspace/image/image.hpp"

#include <cstddef>
#include <vector>

namespace rs::encode {

/// A view made from other photos (encode/posed), with its surface's depth.
struct SynthesizedView {
    Image<Rgba8> image;
    Image<float> depth;  // axial, in the rig's units; 0: no surface
};

/// A synthesized view without the pixels of each row before its first visible pixel and behind its last one. Lossless
/// if the pixels outside have only zeros. 8 bytes per stored pixel. Thread-safe.
class PackedView {
public:
    explicit PackedView(const SynthesizedView& view);

    [[nodiscard]] Image<Rgba8> image() const;
    [[nodiscard]] Image<float> depth() const;

private:
    // Columns [begin, end) of a row, stored from `first` on.
    struct Row {
        int begin = 0, end = 0;
        std::size_t first = 0;
    };
    template <class T>
    [[nodiscard]] Image<T> unpacked(const std::vector<T>& stored) const;

    int width_ = 0;
    std::vector<Row> rows_;
    std::vector<Rgba8> colours_;
    std::vector<float> depths_;
};

}  // namespace rs::encode
