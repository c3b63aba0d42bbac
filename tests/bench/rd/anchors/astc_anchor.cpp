#include "tests/bench/rd/anchors/astc_anchor.hpp"

#include "rayspace/image_io/image_io.hpp"
#include "tests/bench/rd/anchors/tool_process.hpp"
#include "tests/bench/rd/background.hpp"

#include <algorithm>
#include <cmath>

namespace rs::bench {
namespace {

constexpr std::uint64_t kAstcBlock_bytes = 16;

struct BlockPlace {
    std::size_t view = 0;
    int x = 0;  // px of the block's corner in the view
    int y = 0;
};

bool is_visible(const Image<Rgba8>& image, const BlockPlace& place, int block_px) {
    for (int y = place.y; y < std::min(place.y + block_px, image.height()); ++y) {
        for (int x = place.x; x < std::min(place.x + block_px, image.width()); ++x) {
            if (image(x, y).a > 0) return true;
        }
    }
    return false;
}

std::vector<BlockPlace> visible_blocks(const ReferenceImages& images, int block_px) {
    std::vector<BlockPlace> places;
    for (std::size_t view = 0; view < images.views.size(); ++view) {
        for (int y = 0; y < images.height; y += block_px) {
            for (int x = 0; x < images.width; x += block_px) {
                const BlockPlace place{view, x, y};
                if (is_visible(images.views[view], place, block_px)) places.push_back(place);
            }
        }
    }
    return places;
}

// Block n of the packed image is in column n % columns, row n / columns.
struct Packing {
    int block_px;
    int columns;
    [[nodiscard]] int x(std::size_t n) const { return static_cast<int>(n) % columns * block_px; }
    [[nodiscard]] int y(std::size_t n) const { return static_cast<int>(n) / columns * block_px; }
};

Image<Rgba8> packed(const std::vector<Image<Rgba8>>& shown, const std::vector<BlockPlace>& places,
                    const Packing& packing) {
    const int rows = (static_cast<int>(places.size()) + packing.columns - 1) / packing.columns;
    Image<Rgba8> atlas(packing.columns * packing.block_px, rows * packing.block_px);
    for (std::size_t n = 0; n < places.size(); ++n) {
        const Image<Rgba8>& from = shown[places[n].view];
        for (int y = 0; y < packing.block_px; ++y) {
            for (int x = 0; x < packing.block_px; ++x) {
                // Pixels are repeated beyond the image's edge, as in astcenc.
                atlas(packing.x(n) + x, packing.y(n) + y) =
                    from(std::min(places[n].x + x, from.width() - 1), std::min(places[n].y + y, from.height() - 1));
            }
        }
    }
    return atlas;
}

std::vector<Image<Rgba8>> unpacked(const ReferenceImages& images, const Image<Rgba8>& atlas,
                                   const std::vector<BlockPlace>& places, const Packing& packing) {
    std::vector<Image<Rgba8>> views(images.views.size(), Image<Rgba8>(images.width, images.height));
    for (std::size_t n = 0; n < places.size(); ++n) {
        Image<Rgba8>& to = views[places[n].view];
        for (int y = 0; y < std::min(packing.block_px, images.height - places[n].y); ++y) {
            for (int x = 0; x < std::min(packing.block_px, images.width - places[n].x); ++x) {
                to(places[n].x + x, places[n].y + y) = atlas(packing.x(n) + x, packing.y(n) + y);
            }
        }
    }
    return views;
}

}  // namespace

Result<Coded> code_astc(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown, int block_px,
                        bool with_alpha, const std::filesystem::path& folder) {
    const std::vector<BlockPlace> places = visible_blocks(images, block_px);
    const Packing packing{block_px, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(places.size()))))};
    Image<Rgba8> atlas = packed(shown, places, packing);
    if (!with_alpha) atlas = made_opaque(std::move(atlas));
    const std::filesystem::path in = folder / "astc-in.png";
    const std::filesystem::path out = folder / "astc-out.png";
    if (Status status = write_png(in, atlas); !status) return status.error();
    const std::string size = std::to_string(block_px) + "x" + std::to_string(block_px);
    const Result<std::string> ran = run_tool({"astcenc", "-ts", in.string(), out.string(), size, "-medium"});
    if (!ran) return ran.error();
    const Result<Image<Rgba8>> decoded = read_image(out);
    if (!decoded) return decoded.error();
    if (decoded->width() != atlas.width() || decoded->height() != atlas.height()) {
        return Error{out.string() + ": differs in size from the input of astcenc; try another version of astcenc"};
    }
    Coded coded;
    coded.bytes = kAstcBlock_bytes * places.size();
    coded.has_alpha = with_alpha;
    const std::vector<Image<Rgba8>> views = unpacked(images, *decoded, places, packing);
    for (std::size_t view = 0; view < views.size(); ++view) coded.error += object_error(images, view, views[view]);
    return coded;
}

}  // namespace rs::bench
