#pragma once
// What a farm can make, and the items that it is cut into.

#include "compositor/farm/schedule/item.hpp"
#include "rayspace/base/result.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rs::farm {

// How many pixels an input stands for, times how often each is worked at.
struct Extent {
    double images = 0;
    double pixels = 0;   // of an image
    double samples = 1;  // of a pixel
};

// One result for each input.
struct WorkKind {
    const char* name;  // the command of rs-farm
    const char* tool;
    const char* command;  // of the tool
    const char* input;    // what it takes, for people
    const char* ending;   // of a result's name
    bool reads_folder;
    Result<Extent> (*extent_of)(const std::filesystem::path& input, const std::vector<std::string>& options);
    // What the tool takes: so much, and of every image's pixel, and of one image's. Of encode as measured (8 x
    // 64x64: 142 MB, 35 x 914x892: 507 MB), of import as capture/photos/import.hpp states it, for two photographs at a
    // time.
    double base_bytes;
    double bytes_per_pixel;
    double bytes_per_image_pixel;
};
extern const std::array<WorkKind, 3> kWorkKinds;  // encode, import, synth

struct FarmRequest {
    std::vector<std::string> inputs;                // as the user named them
    std::filesystem::path output;                   // folder
    std::vector<std::string> options;               // of the tool, for all items
    std::optional<std::int64_t> item_memory_bytes;  // in place of what is expected
};

// What the farm keeps beside the results: the manifest, and a folder for each item.
std::filesystem::path state_folder(const std::filesystem::path& output);

// Refuses inputs of one name, names that are not UTF-8, and options that name one place for all results. An input that
// cannot be read becomes an item, which will fail and report why.
Result<std::vector<Item>> items_of(const WorkKind& kind, const FarmRequest& request);

struct RenderRequest {
    std::string scene;                 // empty where the options name all objects
    std::filesystem::path output;      // .png, .mp4 or a folder
    std::vector<std::string> options;  // of rs-view
    std::optional<std::int64_t> item_memory_bytes;
    std::filesystem::path tools;  // folder
};

// Tiles of each frame, and after them the frames; of images that are not traced the frames alone. Asks rs-view what
// it would draw, which reads the scene. Tiles are the same however many ranks there are; those of other requests are
// removed.
Result<std::vector<Item>> render_items(const RenderRequest& request, const std::filesystem::path& state);

}  // namespace rs::farm
