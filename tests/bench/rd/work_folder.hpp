#pragma once
// Work folder of the benchmark: cached results for the next run, and temporary files of this one.

#include "rayspace/base/result.hpp"

#include <filesystem>

namespace rs::bench {

/// Temporary files are in a folder of this process, so that concurrent runs can share the cache; the destructor removes
/// it.
class WorkFolder {
public:
    static Result<WorkFolder> open(const std::filesystem::path& folder);
    WorkFolder(WorkFolder&& other) noexcept;
    WorkFolder& operator=(WorkFolder&&) = delete;
    ~WorkFolder();

    [[nodiscard]] std::filesystem::path anchors() const { return folder_ / "anchors"; }
    [[nodiscard]] const std::filesystem::path& scratch() const { return scratch_; }

private:
    WorkFolder() = default;
    std::filesystem::path folder_;
    std::filesystem::path scratch_;
};

}  // namespace rs::bench
