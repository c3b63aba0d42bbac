#include "rayspace/staging.hpp"

#include "rayspace/file_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <set>

namespace rs {
namespace fs = std::filesystem;

namespace staging {
namespace {

struct Registry {
    std::mutex mutex;
    std::set<fs::path> temporaries;
};

Registry& registry() {
    static Registry instance;
    return instance;
}

}  // namespace

std::string reason(int error) {
    switch (error) {
        case ENOSPC:
        case EDQUOT:
            return "no space left on device; free some space or write elsewhere";
        case EACCES:
        case EPERM:
        case EROFS:
            return std::string(std::strerror(error)) + "; choose a place that you may write to";
        case EFBIG:
            return std::string(std::strerror(error)) + "; choose a file system or a file-size limit that allows it";
        default:
            return std::strerror(error);
    }
}

Error failure(const fs::path& path, const std::string& what, int error) {
    return Error{path.string() + ": " + what + ": " + reason(error)};
}

fs::path temporary_name(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    std::string name = ".";
    name += path.filename().string() + ".partial-" + std::to_string(::getpid()) + "-" +
            std::to_string(counter.fetch_add(1)) + path.extension().string();
    return path.parent_path() / name;
}

Status check_parent(const fs::path& path) {
    const fs::path name = path.filename();
    if (name.empty() || name == "." || name == "..") {
        return Error{path.string() + ": names no file or folder to write; give it a name"};
    }
    const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code error;
    const fs::file_status status = fs::status(parent, error);
    if (status.type() == fs::file_type::not_found) {
        return Error{path.string() + ": the folder " + parent.string() + " does not exist; create it first"};
    }
    if (error) return failure(path, "cannot look into the folder " + parent.string(), error.value());
    if (!fs::is_directory(status)) return Error{path.string() + ": " + parent.string() + " is not a folder"};
    return {};
}

void sync_folder_of(const fs::path& path) {
    const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
    const int descriptor = ::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

void remember(const fs::path& temporary) {
    const std::lock_guard lock(registry().mutex);
    registry().temporaries.insert(temporary);
}

void forget(const fs::path& temporary) {
    const std::lock_guard lock(registry().mutex);
    registry().temporaries.erase(temporary);
}

}  // namespace staging

void remove_staged_output() {
    const std::lock_guard lock(staging::registry().mutex);
    for (const fs::path& temporary : staging::registry().temporaries) {
        // Other threads may be putting files into a folder while it is emptied.
        std::error_code error;
        for (int attempt = 0; attempt < 10; ++attempt) {
            fs::remove_all(temporary, error);
            if (!error) break;
        }
    }
}

}  // namespace rs
