#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace rs {

Result<std::vector<std::byte>> read_file(const std::filesystem::path& path, std::uint64_t cap_bytes) {
    RS_ASSIGN_OR_RETURN(const int descriptor, open_input(path));
    struct Closer {
        int descriptor;
        ~Closer() { ::close(descriptor); }
    } const closer{descriptor};

    struct stat info {};
    if (::fstat(descriptor, &info) != 0) return Error{path.string() + ": cannot be read: " + std::strerror(errno)};
    const Error too_large{path.string() + ": is larger than " + std::to_string(cap_bytes) +
                          " bytes, the most that is read here; check that it is the right file"};
    if (static_cast<std::uint64_t>(info.st_size) > cap_bytes) return too_large;

    // Files of /proc state size 0: read until the end in any case, growing as bytes arrive.
    std::vector<std::byte> bytes(static_cast<std::size_t>(info.st_size));
    std::size_t filled = 0;
    for (;;) {
        if (filled == bytes.size()) {
            std::byte probe{};
            const ssize_t count = ::read(descriptor, &probe, 1);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) return Error{path.string() + ": cannot be read: " + std::strerror(errno)};
            if (count == 0) return bytes;
            if (filled >= cap_bytes) return too_large;
            bytes.push_back(probe);
            ++filled;
            bytes.resize(
                static_cast<std::size_t>(std::min<std::uint64_t>(cap_bytes, 2 * std::uint64_t{filled} + 4096)));
        }
        const ssize_t count = ::read(descriptor, bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return Error{path.string() + ": cannot be read: " + std::strerror(errno)};
        if (count == 0) {
            bytes.resize(filled);
            return bytes;
        }
        filled += static_cast<std::size_t>(count);
    }
}

Status write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    RS_ASSIGN_OR_RETURN(StagedFile file, StagedFile::create(path));
    RS_TRY(file.write(bytes));
    return file.commit();
}

Status write_file(const std::filesystem::path& path, const std::string& text) {
    return write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace rs
