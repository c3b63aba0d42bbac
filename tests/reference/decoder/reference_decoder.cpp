#include "tests/reference/decoder/reference_decoder.hpp"

#include "tests/reference/decoder/reference_board_tile.hpp"
#include "tests/reference/decoder/reference_chunks.hpp"
#include "tests/reference/decoder/reference_tile.hpp"

namespace rs::reference {

Images decode_reference(int width, int height, std::span<const std::uint8_t> code_payload,
                        const std::vector<std::vector<std::uint8_t>>& picts) {
    const int views = static_cast<int>(picts.size());
    Code code;
    if (std::string error = read_code(code_payload, views, code); !error.empty()) return {error, {}};
    std::vector<Pict> headers(picts.size());
    for (int view = 0; view < views; ++view) {
        const std::size_t v = static_cast<std::size_t>(view);
        const std::string error = read_pict(picts[v], width, height, view, code, headers[v]);
        if (!error.empty()) return {"view " + std::to_string(view) + ": " + error, {}};
    }

    // References have lower levels, so that they have been decoded before.
    Images result;
    result.views.resize(picts.size());
    for (int level = 0; level <= 3; ++level) {
        for (std::size_t v = 0; v < picts.size(); ++v) {
            if (code.level[v] != level) continue;
            DecodedImage& image = result.views[v];
            image.width = 16 * ceil_div(width, 16);
            image.height = 16 * ceil_div(height, 16);
            const std::size_t samples = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
            for (std::size_t plane = 0; plane < 4; ++plane) {
                image.planes[plane].assign(samples, plane < 3 ? std::uint8_t{128} : std::uint8_t{0});
            }
            std::array<const DecodedImage*, 2> references = {nullptr, nullptr};
            for (std::size_t r = 0; r < 2; ++r) {
                const int reference = headers[v].reference[r];
                if (reference != kNoView) references[r] = &result.views[static_cast<std::size_t>(reference)];
            }
            for (std::size_t t = 0; t < headers[v].tiles.size(); ++t) {
                if (!headers[v].tiles[t]) continue;
                const int number = static_cast<int>(t);
                const Bytes bytes = *headers[v].tiles[t];
                if (code.profile == Profile::kBoard) {
                    BoardTileDecoder(code, references, number, bytes, image).decode();
                } else {
                    TileDecoder(code, headers[v], references, number, bytes, image).decode();
                }
            }
        }
    }
    return result;
}

}  // namespace rs::reference
