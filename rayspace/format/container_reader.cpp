#include "rayspace/file/input_file.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/format/container_index.hpp"
#include "rayspace/format/container_layout.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace rs {

using namespace container_layout;

struct ContainerReader::Source {
    std::string where;
    std::uint64_t size_bytes = 0;
    int descriptor = -1;            // the file, or -1
    std::vector<std::byte> memory;  // the bytes if there is no file
    ContainerIndex index;

    Source() = default;
    Source(const Source&) = delete;
    Source& operator=(const Source&) = delete;
    ~Source() {
        if (descriptor >= 0) ::close(descriptor);
    }

    // [offset, offset + size) must be inside the file as it was when opened. Thread-safe, since pread has no file
    // position.
    [[nodiscard]] Result<std::vector<std::byte>> bytes_at(std::uint64_t offset, std::uint64_t size) const {
        RS_CHECK(offset <= size_bytes && size <= size_bytes - offset);
        if (descriptor < 0) {
            const auto first = memory.begin() + static_cast<std::ptrdiff_t>(offset);
            return std::vector<std::byte>(first, first + static_cast<std::ptrdiff_t>(size));
        }
        std::vector<std::byte> bytes(static_cast<std::size_t>(size));
        for (std::size_t filled = 0; filled < bytes.size();) {
            const ssize_t count =
                ::pread(descriptor, bytes.data() + filled, bytes.size() - filled, static_cast<off_t>(offset + filled));
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) return Error{where + ": cannot be read: " + std::strerror(errno)};
            if (count == 0) return Error{where + ": became shorter while it was read; try again"};
            filled += static_cast<std::size_t>(count);
        }
        return bytes;
    }
};

ContainerReader::ContainerReader(std::shared_ptr<const Source> source) : source_(std::move(source)) {}

Result<ContainerReader> ContainerReader::open_source(std::shared_ptr<Source> source) {
    RS_ASSIGN_OR_RETURN(const auto start, source->bytes_at(0, std::min(source->size_bytes, kHeader_bytes)));
    RS_ASSIGN_OR_RETURN(source->index, ContainerIndex::from_header(start, source->size_bytes, source->where));
    RS_ASSIGN_OR_RETURN(const auto table,
                        source->bytes_at(kTableOffset_bytes, source->index.end_bytes() - kTableOffset_bytes));
    RS_TRY(source->index.read_table(table));
    return ContainerReader(std::move(source));
}

Result<ContainerReader> ContainerReader::open(const std::filesystem::path& path) {
    auto source = std::make_shared<Source>();
    source->where = path.string();
    RS_ASSIGN_OR_RETURN(const int opened, open_input(path));
    source->descriptor = opened;
    struct stat info {};
    if (::fstat(source->descriptor, &info) != 0) {
        return Error{source->where + ": cannot be read: " + std::strerror(errno)};
    }
    source->size_bytes = static_cast<std::uint64_t>(info.st_size);
    return open_source(std::move(source));
}

Result<ContainerReader> ContainerReader::over(std::vector<std::byte> bytes, std::string where) {
    auto source = std::make_shared<Source>();
    source->where = std::move(where);
    source->size_bytes = bytes.size();
    source->memory = std::move(bytes);
    return open_source(std::move(source));
}

std::span<const ChunkEntry> ContainerReader::table() const {
    return source_->index.table();
}

const ChunkEntry* ContainerReader::find(ChunkName name, std::uint32_t index) const {
    return source_->index.find(name, index);
}

Result<std::vector<std::byte>> ContainerReader::read(const ChunkEntry& entry) const {
    // The padding belongs to the chunk before it, so that reading every chunk checks every byte of the file.
    RS_ASSIGN_OR_RETURN(auto bytes, source_->bytes_at(entry.offset_bytes, aligned(entry.size_bytes)));
    return source_->index.checked_payload(entry, std::move(bytes));
}

const std::string& ContainerReader::where() const {
    return source_->where;
}

std::uint64_t ContainerReader::size_bytes() const {
    return source_->size_bytes;
}

}  // namespace rs
