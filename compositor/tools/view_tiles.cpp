#include "compositor/tools/view_tiles.hpp"

#include "rayspace/file/file_output.hpp"
#include "rayspace/image_io/image_io.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <string_view>

namespace rs::compositor {
namespace {

namespace fs = std::filesystem;

// "A:B" taken apart at the marks; nothing where a number or a mark is missing.
template <std::size_t Count>
std::optional<std::array<int, Count>> numbers_between(std::string_view text, std::string_view marks) {
    std::array<int, Count> numbers{};
    for (std::size_t i = 0; i < Count; ++i) {
        const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), numbers.at(i));
        if (wrong != std::errc{} || numbers.at(i) < 0) return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (i + 1 == Count) break;
        if (text.empty() || text.front() != marks.at(i)) return std::nullopt;
        text.remove_prefix(1);
    }
    if (!text.empty()) return std::nullopt;
    return numbers;
}

}  // namespace

Result<TileRequest> parse_tile(const std::string& text, const std::vector<Camera>& cameras) {
    const auto numbers = numbers_between<5>(text, ":,,x");
    if (!numbers) return Error{"--tile " + text + ": give FRAME:X,Y,WIDTHxHEIGHT, such as 0:256,0,128x64"};
    const auto [frame, x, y, width, height] = *numbers;
    if (static_cast<std::size_t>(frame) >= cameras.size()) {
        return Error{"--tile " + text + ": there are " + std::to_string(cameras.size()) + " frames; give one of 0.." +
                     std::to_string(cameras.size() - 1)};
    }
    const Camera& camera = cameras[static_cast<std::size_t>(frame)];
    if (width < 1 || height < 1 || width > camera.width || x > camera.width - width || height > camera.height ||
        y > camera.height - height) {
        return Error{"--tile " + text + ": lies outside of the frame of " + std::to_string(camera.width) + "x" +
                     std::to_string(camera.height)};
    }
    return TileRequest{static_cast<std::size_t>(frame), {x, y, x + width, y + height}};
}

std::string tile_name(const TileRequest& tile) {
    return std::to_string(tile.frame) + "-" + std::to_string(tile.place.x0) + "-" + std::to_string(tile.place.y0) +
           ".png";
}

Status write_plan(const ViewArguments& arguments, const std::vector<Camera>& cameras) {
    const nlohmann::json plan{{"frames", cameras.size()},
                              {"width", cameras.front().width},
                              {"height", cameras.front().height},
                              {"traced", arguments.renderer != "raster"}};
    return write_file(arguments.plan, plan.dump(2) + "\n");
}

Status write_tile(const ViewArguments& arguments, const TileRequest& tile, const Image<Rgba8>& traced) {
    const auto& [x0, y0, x1, y1] = tile.place;
    Image<Rgba8> image(x1 - x0, y1 - y0);
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) image(x - x0, y - y0) = traced(x, y);
    }
    return write_png(arguments.output, image);
}

Result<Image<Rgba8>> read_tiles(const ViewArguments& arguments, std::size_t frame, const Camera& camera) {
    Image<Rgba8> image(camera.width, camera.height);
    Image<std::uint8_t> covered(camera.width, camera.height);
    const std::string begin = std::to_string(frame) + "-";
    std::vector<fs::path> tiles;
    std::error_code error;
    for (auto at = fs::directory_iterator(arguments.tiles, error); !error && at != fs::directory_iterator();
         at.increment(error)) {
        if (at->path().filename().string().starts_with(begin)) tiles.push_back(at->path());
    }
    if (error) return Error{arguments.tiles + ": cannot be looked into: " + error.message()};
    std::ranges::sort(tiles);
    for (const fs::path& path : tiles) {
        const auto place = numbers_between<3>(path.stem().string(), "--");
        if (!place) return Error{path.string() + ": is no tile's name, such as 0-256-0.png; remove it"};
        const Result<Image<Rgba8>> tile = read_image(path);
        if (!tile) return tile.error();
        const auto [number, x0, y0] = *place;
        if (x0 > camera.width - tile->width() || y0 > camera.height - tile->height()) {
            return Error{path.string() + ": lies outside of the frame; remove it"};
        }
        for (int y = 0; y < tile->height(); ++y) {
            for (int x = 0; x < tile->width(); ++x) {
                if (++covered(x0 + x, y0 + y) > 1) return Error{path.string() + ": lies over another; remove one"};
                image(x0 + x, y0 + y) = (*tile)(x, y);
            }
        }
    }
    if (std::ranges::count(covered.pixels(), std::uint8_t{0}) > 0) {
        return Error{arguments.tiles + ": lacks tiles of frame " + std::to_string(frame) + "; trace them with --tile"};
    }
    return image;
}

}  // namespace rs::compositor
