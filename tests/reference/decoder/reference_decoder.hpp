#pragma once
// Reference decoder of coded images, written from encode/FORMAT.md only and deliberately simple: it follows the
// document's order, quotes its section names and shares no code with rayspace/codec. A difference between both decoders
// is an error in one of them or in the document.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rs::reference {

/// "Samples, tiles, blocks": Y, U, V and alpha of the coded size, sample (x, y) of plane p at planes[p][y * width + x].
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::array<std::vector<std::uint8_t>, 4> planes;
};

struct Images {
    std::string error;  // the violated rule; empty: none
    std::vector<DecodedImage> views;
};

/// Decodes images of width x height (px, 1 .. 8192). `code` is the payload of the chunk `CODE`, `picts[v]` that of
/// `PICT` v; there are picts.size() views. Never throws.
[[nodiscard]] Images decode_reference(int width, int height, std::span<const std::uint8_t> code,
                                      const std::vector<std::vector<std::uint8_t>>& picts);

}  // namespace rs::reference
