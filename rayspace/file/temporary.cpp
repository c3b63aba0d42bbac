#include "rayspace/file/temporary.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace rs {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxNameBytes = 60;  // of the target's name; file systems allow 255 in all
constexpr std::size_t kMaxExtensionBytes = 16;

struct Registry {
    std::mutex mutex;
    std::set<fs::path> temporaries;
};

Registry& registry() {
    static Registry instance;
    return instance;
}

fs::path parent_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

Status check_parent(const fs::path& path) {
    const fs::path name = path.filename();
    if (name.empty() || name == "." || name == "..") {
        return Error{path.string() + ": names no file or folder to write; give it a name"};
    }
    const fs::path parent = parent_of(path);
    std::error_code error;
    const fs::file_status status = fs::status(parent, error);
    if (status.type() == fs::file_type::not_found) {
        return Error{path.string() + ": the folder " + parent.string() + " does not exist; create it first"};
    }
    if (error) return output_error(path, "cannot look into the folder " + parent.string(), error.value());
    if (!fs::is_directory(status)) return Error{path.string() + ": " + parent.string() + " is not a folder"};
    return {};
}

// ".NAME.MARK-", the first part of the name of temporaries of `path`.
std::string stem_of(const fs::path& path, const char* mark) {
    std::string name = path.filename().string();
    if (name.size() > kMaxNameBytes) {
        std::size_t end = kMaxNameBytes;
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80) --end;  // UTF-8 boundary
        name.resize(end);
    }
    return "." + name + "." + mark + "-";
}

// Keeps the extension, from which libraries choose the format.
fs::path random_name(const fs::path& path, const char* mark) {
    std::random_device random;
    char digits[20];
    std::snprintf(digits, sizeof digits, "%08x%08x", random(), random());
    const std::string extension = path.extension().string();
    return path.parent_path() /
           (stem_of(path, mark) + digits + (extension.size() <= kMaxExtensionBytes ? extension : std::string()));
}

// Removes temporaries of `target` that are not locked by a running process. Removes nothing if locks are unsupported.
void remove_stale_temporaries(const fs::path& target) {
    const std::string stem = stem_of(target, "partial");
    std::error_code error;
    std::vector<fs::path> found;
    for (auto at = fs::directory_iterator(parent_of(target), error); !error && at != fs::directory_iterator();
         at.increment(error)) {
        if (at->path().filename().string().starts_with(stem)) found.push_back(at->path());
    }
    for (const fs::path& path : found) {
        // Network file systems lock only files that are open for writing.
        int descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        if (descriptor < 0) descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_DIRECTORY | O_CLOEXEC);
        if (descriptor < 0) continue;
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) fs::remove_all(path, error);
        ::close(descriptor);
    }
}

// Makes a rename durable. Errors are ignored: some file systems do not support it, and the rename itself has succeeded.
void sync_folder(const fs::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

}  // namespace

Error output_error(const fs::path& path, const std::string& what, int error) {
    std::string reason = std::strerror(error);
    if (error == ENOSPC || error == EDQUOT) {
        reason = "no space left on device; free some space or write elsewhere";
    } else if (error == EACCES || error == EPERM || error == EROFS) {
        reason += "; choose a writable folder";
    } else if (error == EFBIG) {
        reason += "; choose a file system or a file-size limit that allows it";
    }
    return Error{path.string() + ": " + what + ": " + reason};
}

Result<Temporary> Temporary::create(const fs::path& target, Kind kind) {
    RS_TRY(check_parent(target));
    remove_stale_temporaries(target);
    const bool is_folder = kind == Kind::kFolder;
    const int flags = is_folder ? O_RDONLY | O_DIRECTORY : O_RDWR | O_CREAT | O_EXCL;
    for (;;) {
        Temporary temporary;
        const fs::path path = random_name(target, "partial");
        if (is_folder && ::mkdir(path.c_str(), 0777) != 0) return output_error(target, "cannot be created", errno);
        temporary.descriptor_ = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
        const int error = errno;
        temporary.path_ = path;
        if (temporary.descriptor_ >= 0) ::flock(temporary.descriptor_, LOCK_EX);
        // Another process may have removed it as stale before it was locked.
        std::error_code ignored;
        if (temporary.descriptor_ >= 0 && fs::exists(path, ignored)) {
            const std::lock_guard lock(registry().mutex);
            registry().temporaries.insert(path);
            return temporary;
        }
        if (temporary.descriptor_ < 0 && !(is_folder && error == ENOENT)) {
            return output_error(target, "cannot be created", error);
        }
    }
}

Temporary::Temporary(Temporary&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {
    other.path_.clear();
}

Temporary& Temporary::operator=(Temporary&& other) noexcept {
    std::swap(path_, other.path_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

Temporary::~Temporary() {
    remove();
}

void Temporary::remove() {
    if (!path_.empty()) {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
        const std::lock_guard lock(registry().mutex);
        registry().temporaries.erase(path_);
        path_.clear();
    }
    if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

Status Temporary::move_to(const fs::path& target) {
    const auto rename = [](const fs::path& from, const fs::path& to, unsigned flags) {
        return ::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0 ? 0 : errno;
    };
    std::error_code ignored;
    const bool exchanges = fs::is_directory(path_, ignored) && fs::is_directory(fs::symlink_status(target, ignored));
    {
        // remove_temporaries() waits for this, or has removed the file already.
        const std::lock_guard lock(registry().mutex);
        int error = rename(path_, target, exchanges ? RENAME_EXCHANGE : 0);
        if (exchanges && (error == EINVAL || error == ENOSYS)) {
            const fs::path old = random_name(target, "old");
            error = rename(target, old, 0);
            if (error == 0) {
                error = rename(path_, target, 0);
                rename(old, error == 0 ? path_ : target, 0);
            }
        }
        if (error != 0) return output_error(target, "cannot be put in place", error);
        if (!exchanges) {
            registry().temporaries.erase(path_);
            path_.clear();
        }
    }
    sync_folder(parent_of(target));
    remove();  // the replaced folder, if any
    return {};
}

void remove_temporaries() {
    const std::lock_guard lock(registry().mutex);
    for (const fs::path& path : registry().temporaries) {
        // Other threads may be adding files to a folder while it is emptied.
        std::error_code error;
        for (int attempt = 0; attempt < 10; ++attempt) {
            fs::remove_all(path, error);
            if (!error) break;
        }
    }
}

}  // namespace rs
