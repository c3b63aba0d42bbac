#pragma once
// A second decoder of coded images, made from encode/FORMAT.md alone and slow on purpose: it follows the document's
// order, quotes the names of its sections and shares no code with rayspace/codec. Where the two differ, one of them or
// the document is wrong.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::reference {

// "Samples, tiles, blocks": Y, U, V and alpha of the coded size, sample (x, y) of plane p at planes[p][y * width + x].
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::array<std::vector<std::uint8_t>, 4> planes;
};

struct Images {
    std::string error;  // the rule that was broken; empty: none
    std::vector<DecodedImage> views;
};

// Width and height are the images' (px, 1 .. 8192), `code` the payload of the chunk `CODE`, `picts[v]` that of `PICT`
// v; there are picts.size() views. Does not throw for any bytes.
[[nodiscard]] Images decode_reference(int width, int height, std::span<const std::uint8_t> code,
                                      const std::vector<std::vector<std::uint8_t>>& picts);

}  // namespace rs::reference
