#pragma once
// The folder that a run of the bench works in: answers kept for the next run, and temporary files of this one.

#include "rayspace/base/result.hpp"

#include <filesystem>

namespace rs::bench {

// Temporary files stand in a folder of this process, so that two runs may share the answers; it is removed at the end.
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
