#include "rayspace/file/staging.hpp"

#include "rayspace/file/file_output.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <functional>
#include <mutex>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

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

namespace {

constexpr std::size_t kMostNameBytes = 60;  // of the target's, in the temporary's: 255 are all that a file system takes
constexpr std::size_t kMostExtensionBytes = 16;

// Of temporaries of this target on this host, before the process' number.
std::string temporary_stem(const fs::path& path) {
    std::string name = path.filename().string();
    if (name.size() > kMostNameBytes) {
        std::size_t end = kMostNameBytes;
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80) --end;  // whole UTF-8 characters
        name.resize(end);
    }
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    char number[16];
    std::snprintf(number, sizeof number, "%08x", static_cast<unsigned>(std::hash<std::string_view>{}(host)));
    return "." + name + ".partial-" + number + "-";
}

}  // namespace

fs::path temporary_name(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    std::string name = temporary_stem(path) + std::to_string(::getpid()) + "-" + std::to_string(counter.fetch_add(1));
    const std::string extension = path.extension().string();
    if (extension.size() <= kMostExtensionBytes) name += extension;
    return path.parent_path() / name;
}

void remove_left_behind(const fs::path& path) {
    const std::string stem = temporary_stem(path);
    std::error_code error;
    std::vector<fs::path> left;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (auto at = fs::directory_iterator(folder, error); !error && at != fs::directory_iterator();
         at.increment(error)) {
        const std::string name = at->path().filename().string();
        if (!name.starts_with(stem)) continue;
        pid_t process = 0;
        const char* const end = name.data() + name.size();
        const auto [rest, wrong] = std::from_chars(name.data() + stem.size(), end, process);
        if (wrong != std::errc{} || rest == end || *rest != '-' || process <= 0) continue;
        if (::kill(process, 0) != 0 && errno == ESRCH) left.push_back(at->path());
    }
    for (const fs::path& temporary : left) fs::remove_all(temporary, error);
}

int put_in_place(const fs::path& temporary, const fs::path& path, bool exchanged) {
    const std::lock_guard lock(registry().mutex);
    const unsigned flags = exchanged ? RENAME_EXCHANGE : 0;
    if (::renameat2(AT_FDCWD, temporary.c_str(), AT_FDCWD, path.c_str(), flags) != 0) return errno;
    if (!exchanged) registry().temporaries.erase(temporary);
    return 0;
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
