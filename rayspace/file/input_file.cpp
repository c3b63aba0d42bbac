#include "rayspace/file/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <utility>

namespace rs {
namespace fs = std::filesystem;
namespace {

struct Inputs {
    std::mutex mutex;
    bool kept = false;
    struct File {
        fs::path path;  // as the user named it
        bool written = false;
    };
    std::map<std::pair<dev_t, ino_t>, File> files;
};

Inputs& inputs() {
    static Inputs instance;
    return instance;
}

void note(const struct stat& info, const fs::path& path, bool written) {
    const std::lock_guard lock(inputs().mutex);
    if (inputs().kept) inputs().files.emplace(std::pair(info.st_dev, info.st_ino), Inputs::File{path, written});
}

Status check_kind(const struct stat& info, const fs::path& path) {
    if (S_ISREG(info.st_mode)) return {};
    if (S_ISDIR(info.st_mode)) return Error{path.string() + ": is a folder, not a file"};
    return Error{path.string() + ": is no regular file but a pipe or a device; give the name of a file"};
}

bool is_within(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

Result<int> open_input(const fs::path& path, bool is_input) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor < 0) return Error{path.string() + ": cannot be opened: " + std::strerror(errno)};
    struct stat info {};
    Status fine;
    if (::fstat(descriptor, &info) != 0) {
        fine = Error{path.string() + ": cannot be read: " + std::strerror(errno)};
    } else {
        fine = check_kind(info, path);
    }
    if (!fine) {
        ::close(descriptor);
        return fine.error();
    }
    if (is_input) note(info, path, false);
    return descriptor;
}

Status check_input(const fs::path& path) {
    struct stat info {};
    if (::stat(path.c_str(), &info) != 0) {
        return Error{path.string() + (errno == ENOENT ? ": does not exist; check the name"
                                                      : std::string(": cannot be opened: ") + std::strerror(errno))};
    }
    if (Status fine = check_kind(info, path); !fine) return fine;
    note(info, path, false);
    return {};
}

void keep_inputs() {
    const std::lock_guard lock(inputs().mutex);
    inputs().kept = true;
}

Status check_keeps_inputs(const fs::path& output) {
    const std::lock_guard lock(inputs().mutex);
    if (inputs().files.empty()) return {};
    struct stat info {};
    if (::stat(output.c_str(), &info) != 0) return {};
    if (S_ISDIR(info.st_mode)) {
        std::error_code ignored;
        const fs::path folder = fs::weakly_canonical(output, ignored);
        for (const auto& [file, noted] : inputs().files) {
            const fs::path& path = noted.path;
            if (noted.written) continue;
            // Temporaries of this process may have been read and be gone.
            struct stat now {};
            if (::stat(path.c_str(), &now) != 0 || std::pair(now.st_dev, now.st_ino) != file) continue;
            if (!is_within(fs::weakly_canonical(path, ignored), folder)) continue;
            return Error{output.string() + ": would be replaced, and with it " + path.string() +
                         ", which is being read; give another name with -o"};
        }
        return {};
    }
    const auto found = inputs().files.find({info.st_dev, info.st_ino});
    if (found == inputs().files.end()) return {};
    const std::string& named = found->second.path.string();
    if (found->second.written) {
        return Error{output.string() + ": was just written, as " + named +
                     ", and would be replaced; give another name"};
    }
    return Error{output.string() + ": is an input (" + named + ") and would be replaced; give another name"};
}

std::vector<fs::path> noted_inputs() {
    std::vector<fs::path> paths;
    const std::lock_guard lock(inputs().mutex);
    for (const auto& [file, noted] : inputs().files) {
        struct stat now {};
        // Temporaries of this process may have been read and be gone.
        if (noted.written || ::stat(noted.path.c_str(), &now) != 0) continue;
        if (std::pair(now.st_dev, now.st_ino) == file) paths.push_back(fs::absolute(noted.path));
    }
    return paths;
}

void note_written(const fs::path& path) {
    struct stat info {};
    if (::stat(path.c_str(), &info) == 0) note(info, path, true);
}

std::string lower_case_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace rs
