#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/file/staging.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace rs {
namespace fs = std::filesystem;
using namespace staging;
namespace {

Status write_all(int descriptor, const fs::path& path, std::span<const std::byte> bytes, std::uint64_t offset) {
    while (!bytes.empty()) {
        const ssize_t written = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) continue;
        // A device that takes nothing without saying why is full.
        if (written <= 0) return failure(path, "cannot write", written == 0 ? ENOSPC : errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
        offset += static_cast<std::uint64_t>(written);
    }
    return {};
}

}  // namespace

Result<StagedFile> StagedFile::create(const fs::path& path) {
    if (const Status parent = check_parent(path); !parent) return parent.error();
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) {
        return Error{path.string() + ": is a folder; give the name of a file"};
    }
    // A rename would put a file in the place of the device or pipe itself.
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
        return Error{path.string() + ": is no regular file and cannot be replaced; give another name"};
    }
    if (Status kept = check_keeps_inputs(path); !kept) return kept.error();
    remove_left_behind(path);
    StagedFile file;
    file.path_ = path;
    file.temporary_ = temporary_name(path);
    file.descriptor_ = ::open(file.temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file.descriptor_ < 0) {
        const int error = errno;
        file.temporary_.clear();
        return failure(path, "cannot be created", error);
    }
    remember(file.temporary_);
    return file;
}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      size_bytes_(std::exchange(other.size_bytes_, 0)) {
    other.temporary_.clear();
}

StagedFile& StagedFile::operator=(StagedFile&& other) noexcept {
    // The swapped-out file is dropped, and with it its temporary, when `other` ends.
    std::swap(path_, other.path_);
    std::swap(temporary_, other.temporary_);
    std::swap(descriptor_, other.descriptor_);
    std::swap(size_bytes_, other.size_bytes_);
    return *this;
}

StagedFile::~StagedFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (temporary_.empty()) return;
    ::unlink(temporary_.c_str());
    forget(temporary_);
}

Status StagedFile::write(std::span<const std::byte> bytes) {
    RS_CHECK(descriptor_ >= 0);
    if (Status status = write_all(descriptor_, path_, bytes, size_bytes_); !status) return status;
    size_bytes_ += bytes.size();
    return {};
}

Status StagedFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
    RS_CHECK(descriptor_ >= 0);
    RS_CHECK(offset <= size_bytes_ && bytes.size() <= size_bytes_ - offset);
    return write_all(descriptor_, path_, bytes, offset);
}

Status StagedFile::commit() {
    RS_CHECK(descriptor_ >= 0);
    if (Status kept = check_keeps_inputs(path_); !kept) return kept;
    // A library that wrote temporary_path() itself may have replaced the file that our descriptor holds open.
    const int written = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
    if (written < 0) return failure(path_, "cannot be finished", errno);
    const bool synced = ::fsync(written) == 0;
    const int sync_error = errno;
    ::close(written);
    if (!synced) return failure(path_, "cannot be finished", sync_error);

    const int descriptor = std::exchange(descriptor_, -1);
    // Network file systems report a full disk as late as here.
    if (::close(descriptor) != 0) return failure(path_, "cannot be finished", errno);
    if (const int error = put_in_place(temporary_, path_, false); error != 0) {
        return failure(path_, "cannot be put in place", error);
    }
    temporary_.clear();
    note_written(path_);
    sync_folder_of(path_);
    return {};
}

}  // namespace rs
