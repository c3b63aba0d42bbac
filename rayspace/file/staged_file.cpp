#include "rayspace/file/file_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace rs {
namespace fs = std::filesystem;
namespace {

Status write_all(int descriptor, const fs::path& path, std::span<const std::byte> bytes, std::uint64_t offset) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        // A device that writes nothing without an error is full.
        if (written <= 0) return output_error(path, "cannot write", written == 0 ? ENOSPC : errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += static_cast<std::uint64_t>(written);
    }
    return {};
}

}  // namespace

StagedFile::StagedFile(fs::path path, Temporary temporary) : path_(std::move(path)), temporary_(std::move(temporary)) {}

Result<StagedFile> StagedFile::create(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return Error{path.string() + ": is a folder; give the name of a file"};
    // A rename would replace the device or pipe itself.
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
        return Error{path.string() + ": is no regular file and cannot be replaced; give another name"};
    }
    RS_ASSIGN_OR_RETURN(Temporary temporary, Temporary::create(path, Temporary::Kind::kFile));
    return StagedFile(path, std::move(temporary));
}

Status StagedFile::write(std::span<const std::byte> bytes) {
    RS_CHECK(temporary_.descriptor() >= 0);
    RS_TRY(write_all(temporary_.descriptor(), path_, bytes, size_bytes_));
    size_bytes_ += bytes.size();
    return {};
}

Status StagedFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
    RS_CHECK(temporary_.descriptor() >= 0);
    RS_CHECK(offset <= size_bytes_ && bytes.size() <= size_bytes_ - offset);
    return write_all(temporary_.descriptor(), path_, bytes, offset);
}

Status StagedFile::commit() {
    RS_CHECK(temporary_.descriptor() >= 0);
    // A library that wrote temporary_path() itself may have replaced the file that the descriptor holds open.
    const int written = ::open(temporary_.path().c_str(), O_RDONLY | O_CLOEXEC);
    if (written < 0) return output_error(path_, "cannot be finished", errno);
    // Network file systems may report a full disk only here.
    const int error = ::fsync(written) != 0 ? errno : 0;
    if (::close(written) != 0 || error != 0)
        return output_error(path_, "cannot be finished", error != 0 ? error : errno);
    return temporary_.move_to(path_);
}

}  // namespace rs
