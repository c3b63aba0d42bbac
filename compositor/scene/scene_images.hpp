#pragma once
// Images of scene files: each is read once; unreadable ones become warnings.

#include "compositor/scene/material.hpp"
#include "rayspace/base/result.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace rs::compositor {

// Not thread-safe.
class SceneImages {
public:
    /// First readable image of the URLs; null, with the reason in `fault`, if there is none.
    std::shared_ptr<const SceneTexture> read(const std::vector<std::string>& urls, const std::filesystem::path& folder,
                                             bool repeat_s, bool repeat_t, std::string& fault);
    Result<std::shared_ptr<const SceneTexture>> read_file(const std::filesystem::path& path, bool repeat_s,
                                                          bool repeat_t);

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
