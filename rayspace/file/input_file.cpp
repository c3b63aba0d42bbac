#include "rayspace/file/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>

namespace rs {
namespace fs = std::filesystem;
namespace {

Status check_kind(const struct stat& info, const fs::path& path) {
    if (S_ISREG(info.st_mode)) return {};
    if (S_ISDIR(info.st_mode)) return Error{path.string() + ": is a folder, not a file"};
    return Error{path.string() + ": is no regular file but a pipe or a device; give the name of a file"};
}

}  // namespace

Result<int> open_input(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor < 0) return Error{path.string() + ": cannot be opened: " + std::strerror(errno)};
    struct stat info {};
    Status status = ::fstat(descriptor, &info) == 0
                        ? check_kind(info, path)
                        : Status(Error{path.string() + ": cannot be read: " + std::strerror(errno)});
    if (status) return descriptor;
    ::close(descriptor);
    return status.error();
}

Status check_input(const fs::path& path) {
    struct stat info {};
    if (::stat(path.c_str(), &info) == 0) return check_kind(info, path);
    if (errno == ENOENT) return Error{path.string() + ": does not exist; check the name"};
    return Error{path.string() + ": cannot be opened: " + std::strerror(errno)};
}

std::string_view without_byte_order_mark(std::string_view text) {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    return text.substr(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0);
}

std::string lower_case_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace rs
