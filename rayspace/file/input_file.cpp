#include "rayspace/file/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <compare>
#include <cstdint>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>

namespace rs {
namespace fs = std::filesystem;
namespace {

// Which file it is, by whatever name. A number of a file that is gone may be given to a new one: the time of its birth,
// 0 where the file system keeps none, tells them apart.
struct Identity {
    std::uint64_t device = 0, number = 0;
    std::int64_t born_s = 0;
    std::uint32_t born_ns = 0;

    auto operator<=>(const Identity&) const = default;
};

struct FileInfo {
    Identity identity;
    mode_t mode = 0;
};

// Of the file that `path`, or where that is empty the descriptor, leads to; nothing, and errno, where it cannot be
// known.
std::optional<FileInfo> info_of(const char* path, int descriptor = AT_FDCWD) {
    const int flags = descriptor == AT_FDCWD ? 0 : AT_EMPTY_PATH;
    struct statx found {};
    if (::statx(descriptor, path, flags, STATX_TYPE | STATX_INO | STATX_BTIME, &found) != 0) {
        // Old containers forbid it.
        struct stat plain {};
        if ((errno != EPERM && errno != ENOSYS) || ::fstatat(descriptor, path, &plain, flags) != 0) return {};
        return FileInfo{{plain.st_dev, plain.st_ino, 0, 0}, plain.st_mode};
    }
    FileInfo info{{(std::uint64_t{found.stx_dev_major} << 32U) | found.stx_dev_minor, found.stx_ino, 0, 0},
                  found.stx_mode};
    if ((found.stx_mask & STATX_BTIME) != 0) {
        info.identity.born_s = found.stx_btime.tv_sec;
        info.identity.born_ns = found.stx_btime.tv_nsec;
    }
    return info;
}

struct Inputs {
    std::mutex mutex;
    bool kept = false;
    struct File {
        fs::path path;  // as the user named it
        bool written = false;
    };
    std::map<Identity, File> files;

    // Temporaries of this process may have been read and be gone.
    static bool is_there(const Identity& identity, const File& file) {
        const std::optional<FileInfo> now = info_of(file.path.c_str());
        return now && now->identity == identity;
    }
};

Inputs& inputs() {
    static Inputs instance;
    return instance;
}

void note(const FileInfo& info, const fs::path& path, bool written) {
    const std::lock_guard lock(inputs().mutex);
    if (inputs().kept) inputs().files.emplace(info.identity, Inputs::File{path, written});
}

Status check_kind(const FileInfo& info, const fs::path& path) {
    if (S_ISREG(info.mode)) return {};
    if (S_ISDIR(info.mode)) return Error{path.string() + ": is a folder, not a file"};
    return Error{path.string() + ": is no regular file but a pipe or a device; give the name of a file"};
}

bool is_within(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

Result<int> open_input(const fs::path& path, bool is_input) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor < 0) return Error{path.string() + ": cannot be opened: " + std::strerror(errno)};
    const std::optional<FileInfo> info = info_of("", descriptor);
    const Status fine =
        info ? check_kind(*info, path) : Error{path.string() + ": cannot be read: " + std::strerror(errno)};
    if (!fine) {
        ::close(descriptor);
        return fine.error();
    }
    if (is_input) note(*info, path, false);
    return descriptor;
}

Status check_input(const fs::path& path) {
    const std::optional<FileInfo> info = info_of(path.c_str());
    if (!info) {
        return Error{path.string() + (errno == ENOENT ? ": does not exist; check the name"
                                                      : std::string(": cannot be opened: ") + std::strerror(errno))};
    }
    if (Status fine = check_kind(*info, path); !fine) return fine;
    note(*info, path, false);
    return {};
}

void keep_inputs() {
    const std::lock_guard lock(inputs().mutex);
    inputs().kept = true;
}

Status check_keeps_inputs(const fs::path& output) {
    const std::lock_guard lock(inputs().mutex);
    if (inputs().files.empty()) return {};
    const std::optional<FileInfo> info = info_of(output.c_str());
    if (!info) return {};
    if (S_ISDIR(info->mode)) {
        std::error_code ignored;
        const fs::path folder = fs::weakly_canonical(output, ignored);
        for (const auto& [identity, noted] : inputs().files) {
            const fs::path& path = noted.path;
            if (noted.written || !Inputs::is_there(identity, noted)) continue;
            if (!is_within(fs::weakly_canonical(path, ignored), folder)) continue;
            return Error{output.string() + ": would be replaced, and with it " + path.string() +
                         ", which is being read; give another name with -o"};
        }
        return {};
    }
    const auto found = inputs().files.find(info->identity);
    if (found == inputs().files.end()) return {};
    const std::string& named = found->second.path.string();
    if (found->second.written) {
        return Error{output.string() + ": was just written, as " + named +
                     ", and would be replaced; give another name"};
    }
    return Error{output.string() + ": is an input (" + named + ") and would be replaced; give another name"};
}

void note_written(const fs::path& path) {
    if (const std::optional<FileInfo> info = info_of(path.c_str())) note(*info, path, true);
}

std::string lower_case_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace rs
