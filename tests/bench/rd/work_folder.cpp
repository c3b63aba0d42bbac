#include "tests/bench/rd/work_folder.hpp"

#include <unistd.h>

#include <string>
#include <system_error>
#include <utility>

namespace rs::bench {

Result<WorkFolder> WorkFolder::open(const std::filesystem::path& folder) {
    WorkFolder work;
    work.folder_ = std::filesystem::absolute(folder);
    const std::filesystem::path scratch = work.folder_ / ("run-" + std::to_string(::getpid()));
    std::error_code error;
    std::filesystem::create_directories(scratch, error);
    if (!error) std::filesystem::create_directories(work.anchors(), error);
    if (error)
        return Error{folder.string() + ": cannot be used as the work folder: " + error.message() +
                     "; choose another --work"};
    work.scratch_ = scratch;
    return work;
}

WorkFolder::WorkFolder(WorkFolder&& other) noexcept
    : folder_(std::move(other.folder_)), scratch_(std::exchange(other.scratch_, {})) {}

WorkFolder::~WorkFolder() {
    std::error_code ignored;
    if (!scratch_.empty()) std::filesystem::remove_all(scratch_, ignored);
}

}  // namespace rs::bench
