#pragma once
// The images that scene files name: each is read once, and what cannot be read becomes a warning.

#include "compositor/scene/material.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

// The file that a URL of a scene file names, or nothing where it is not one on this machine. Relative ones are looked
// for in `folder`. "file:" is taken off, %XX stands for a byte.
std::optional<std::filesystem::path> local_path(const std::string& url, const std::filesystem::path& folder);

// Not thread-safe.
class SceneImages {
public:
    // The first of the URLs that can be read; null, with a reason in `fault`, where none can.
    std::shared_ptr<const SceneTexture> read(const std::vector<std::string>& urls, const std::filesystem::path& folder,
                                             bool repeat_s, bool repeat_t, std::string& fault);

private:
    struct Key {
        std::filesystem::path path;
        bool repeat_s;
        bool repeat_t;
        auto operator<=>(const Key&) const = default;
    };
    std::map<Key, std::shared_ptr<const SceneTexture>> read_;
    std::int64_t pixels_ = 0;
};

}  // namespace rs::compositor
