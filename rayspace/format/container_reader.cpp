#include "rayspace/base/byte_stream.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/format/container_layout.hpp"

#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

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
    std::vector<ChunkEntry> table;
    std::vector<std::uint32_t> by_name;  // positions in the table, sorted by (name, index)

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

    // `rest` states what is wrong: "FILE: chunk PICT 3: ..." or "FILE: ...".
    [[nodiscard]] Error wrong(const std::string& rest) const { return Error{where + ": " + rest}; }

    Status read_header(std::uint32_t& chunk_count, std::uint64_t& table_checksum) const;
    Status read_table(std::uint32_t chunk_count, std::uint64_t table_checksum);
    Status check_entries() const;
    Status index_by_name();
};

namespace {

constexpr const char* kDamaged = "; the file is damaged, copy it again or encode it anew";

std::string place(const ChunkEntry& entry) {
    return "chunk " + to_string(entry.name) + " " + std::to_string(entry.index) + ": ";
}

Status check_magic(std::span<const std::byte> start, const std::string& where) {
    const auto same = [&](std::size_t count) {
        return start.size() >= count && std::memcmp(start.data(), kMagic.data(), count) == 0;
    };
    if (same(kMagic.size())) return {};
    if (same(4)) {
        return Error{where + ": was damaged by a transfer in text mode; copy it again in binary mode"};
    }
    return Error{where + ": is not a ray-space object (.rso)"};
}

}  // namespace

Status ContainerReader::Source::read_header(std::uint32_t& chunk_count, std::uint64_t& table_checksum) const {
    RS_ASSIGN_OR_RETURN(const auto start, bytes_at(0, std::min(size_bytes, kHeader_bytes)));
    RS_TRY(check_magic(start, where));
    if (start.size() < kHeader_bytes) return wrong("ends inside its header" + std::string(kDamaged));

    ByteReader header(start);
    header.take(kMagic.size());
    const auto major = header.get<std::uint16_t>();
    const auto minor = header.get<std::uint16_t>();  // newer minor versions only add chunks that may be skipped
    // Other major versions may have a different header, so nothing after these fields is read.
    if (major > kVersionMajor) {
        return wrong("is written in format version " + std::to_string(major) + ", newer than the " +
                     std::to_string(kVersionMajor) + " that is read here; update these tools");
    }
    if (major == 1) {
        return wrong("is written in format 1." + std::to_string(minor) +
                     ", which is read no more; encode its set anew with these tools (rs-encode build)");
    }
    chunk_count = header.get<std::uint32_t>();
    const auto table_offset = header.get<std::uint64_t>();
    const auto stated_size = header.get<std::uint64_t>();
    table_checksum = header.get<std::uint64_t>();
    const auto checksum = header.get<std::uint64_t>();
    if (checksum != XXH64(start.data(), kHeaderChecked_bytes, 0)) {
        return wrong("the header's checksum does not match" + std::string(kDamaged));
    }
    if (major == 0) return wrong("claims format version 0, which never was");
    if (stated_size != size_bytes) {
        return wrong("is " + std::to_string(size_bytes) + " bytes long instead of " + std::to_string(stated_size) +
                     kDamaged);
    }
    if (table_offset != kTableOffset_bytes) return wrong("its table is not where it must be");
    if (chunk_count < 1 || chunk_count > kMaxChunks) {
        return wrong("claims " + std::to_string(chunk_count) + " chunks; 1.." + std::to_string(kMaxChunks) +
                     " are possible");
    }
    if (chunk_count * kEntry_bytes > size_bytes - kTableOffset_bytes) {
        return wrong("its table reaches beyond the end of the file");
    }
    return {};
}

Status ContainerReader::Source::read_table(std::uint32_t chunk_count, std::uint64_t table_checksum) {
    RS_ASSIGN_OR_RETURN(const auto bytes, bytes_at(kTableOffset_bytes, chunk_count * kEntry_bytes));
    if (table_checksum != XXH64(bytes.data(), bytes.size(), 0)) {
        return wrong("the table's checksum does not match" + std::string(kDamaged));
    }
    ByteReader reader(bytes);
    table.resize(chunk_count);
    for (ChunkEntry& entry : table) {
        std::memcpy(entry.name.data(), reader.take(entry.name.size()).data(), entry.name.size());
        entry.index = reader.get<std::uint32_t>();
        entry.offset_bytes = reader.get<std::uint64_t>();
        entry.size_bytes = reader.get<std::uint64_t>();
        entry.checksum = reader.get<std::uint64_t>();
    }
    return {};
}

Status ContainerReader::Source::check_entries() const {
    std::uint64_t expected_offset = kTableOffset_bytes + table.size() * kEntry_bytes;
    for (std::size_t i = 0; i < table.size(); ++i) {
        const ChunkEntry& entry = table[i];
        // Messages contain only checked names.
        if (!is_valid(entry.name))
            return wrong("table entry " + std::to_string(i) + ": its name is not letters and digits");
        if (entry.offset_bytes != expected_offset) {
            return wrong(place(entry) + "does not begin where the one before it ends");
        }
        if (entry.size_bytes > kMaxChunk_bytes) return wrong(place(entry) + "is larger than 1 GiB");
        if (aligned(entry.size_bytes) > size_bytes - expected_offset) {
            return wrong(place(entry) + "reaches beyond the end of the file");
        }
        expected_offset += aligned(entry.size_bytes);
    }
    if (expected_offset != size_bytes) return wrong("holds bytes behind its last chunk");
    return {};
}

Status ContainerReader::Source::index_by_name() {
    by_name.resize(table.size());
    for (std::uint32_t i = 0; i < by_name.size(); ++i) by_name[i] = i;
    const auto key = [this](std::uint32_t i) { return std::pair(table[i].name, table[i].index); };
    std::sort(by_name.begin(), by_name.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    const auto twin = std::adjacent_find(by_name.begin(), by_name.end(),
                                         [&](std::uint32_t a, std::uint32_t b) { return key(a) == key(b); });
    if (twin != by_name.end()) return wrong(place(table[*twin]) + "is there twice");
    return {};
}

ContainerReader::ContainerReader(std::shared_ptr<const Source> source) : source_(std::move(source)) {}

Result<ContainerReader> ContainerReader::open_source(std::shared_ptr<Source> source) {
    if (source->size_bytes > kMaxContainer_bytes) return source->wrong("is larger than 64 GiB, the most that is read");
    std::uint32_t chunk_count = 0;
    std::uint64_t table_checksum = 0;
    RS_TRY(source->read_header(chunk_count, table_checksum));
    RS_TRY(source->read_table(chunk_count, table_checksum));
    RS_TRY(source->check_entries());
    RS_TRY(source->index_by_name());
    return ContainerReader(std::move(source));
}

Result<ContainerReader> ContainerReader::open(const std::filesystem::path& path) {
    auto source = std::make_shared<Source>();
    source->where = path.string();
    RS_ASSIGN_OR_RETURN(const int opened, open_input(path));
    source->descriptor = opened;
    struct stat info {};
    if (::fstat(source->descriptor, &info) != 0) {
        return source->wrong(std::string("cannot be read: ") + std::strerror(errno));
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
    return source_->table;
}

const ChunkEntry* ContainerReader::find(ChunkName name, std::uint32_t index) const {
    const auto& by_name = source_->by_name;
    const auto& table = source_->table;
    const auto found = std::lower_bound(by_name.begin(), by_name.end(), std::pair(name, index),
                                        [&](std::uint32_t i, const std::pair<ChunkName, std::uint32_t>& wanted) {
                                            return std::pair(table[i].name, table[i].index) < wanted;
                                        });
    if (found == by_name.end() || table[*found].name != name || table[*found].index != index) return nullptr;
    return &table[*found];
}

Result<std::vector<std::byte>> ContainerReader::read(const ChunkEntry& entry) const {
    // The padding belongs to the chunk before it, so that reading every chunk checks every byte of the file.
    RS_ASSIGN_OR_RETURN(auto bytes, source_->bytes_at(entry.offset_bytes, aligned(entry.size_bytes)));
    const std::span<const std::byte> padding = std::span(bytes).subspan(static_cast<std::size_t>(entry.size_bytes));
    if (std::any_of(padding.begin(), padding.end(), [](std::byte b) { return b != std::byte{0}; })) {
        return source_->wrong(place(entry) + "the padding behind it is not zero" + kDamaged);
    }
    bytes.resize(static_cast<std::size_t>(entry.size_bytes));
    if (entry.checksum != XXH64(bytes.data(), bytes.size(), 0)) {
        return source_->wrong(place(entry) + "its checksum does not match" + kDamaged);
    }
    return bytes;
}

const std::string& ContainerReader::where() const {
    return source_->where;
}

std::uint64_t ContainerReader::size_bytes() const {
    return source_->size_bytes;
}

std::string to_string(ChunkName name) {
    return {name.begin(), name.end()};
}

}  // namespace rs
