#include "rayspace/format/container_index.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/format/container_layout.hpp"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace rs {

using namespace container_layout;

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

Error ContainerIndex::wrong_file_size(std::uint64_t size_bytes) const {
    return wrong("is " + std::to_string(size_bytes) + " bytes long instead of " + std::to_string(size_bytes_) +
                 kDamaged);
}

Result<ContainerIndex> ContainerIndex::from_header(std::span<const std::byte> start,
                                                   std::optional<std::uint64_t> size_bytes, std::string where) {
    ContainerIndex index;
    index.where_ = std::move(where);
    if (size_bytes && *size_bytes > kMaxContainer_bytes) {
        return index.wrong("is larger than 64 GiB, the most that is read");
    }
    RS_TRY(check_magic(start, index.where_));
    if (start.size() < kHeader_bytes) return index.wrong("ends inside its header" + std::string(kDamaged));

    ByteReader header(start);
    header.take(kMagic.size());
    const auto major = header.get<std::uint16_t>();
    const auto minor = header.get<std::uint16_t>();  // newer minor versions only add chunks that may be skipped
    // Other major versions may have a different header, so nothing after these fields is read.
    if (major > kVersionMajor) {
        return index.wrong("is written in format version " + std::to_string(major) + ", newer than the " +
                           std::to_string(kVersionMajor) + " that is read here; update these tools");
    }
    if (major == 1) {
        return index.wrong("is written in format 1." + std::to_string(minor) +
                           ", which is read no more; encode its set anew with these tools (rs-encode build)");
    }
    index.chunk_count_ = header.get<std::uint32_t>();
    const auto table_offset = header.get<std::uint64_t>();
    index.size_bytes_ = header.get<std::uint64_t>();
    index.table_checksum_ = header.get<std::uint64_t>();
    const auto checksum = header.get<std::uint64_t>();
    if (checksum != XXH64(start.data(), kHeaderChecked_bytes, 0)) {
        return index.wrong("the header's checksum does not match" + std::string(kDamaged));
    }
    if (major == 0) return index.wrong("claims format version 0, which never was");
    if (size_bytes && index.size_bytes_ != *size_bytes) return index.wrong_file_size(*size_bytes);
    if (index.size_bytes_ > kMaxContainer_bytes) {
        return index.wrong("claims more than 64 GiB, the most that is read");
    }
    if (table_offset != kTableOffset_bytes) return index.wrong("its table is not where it must be");
    if (index.chunk_count_ < 1 || index.chunk_count_ > kMaxChunks) {
        return index.wrong("claims " + std::to_string(index.chunk_count_) + " chunks; 1.." +
                           std::to_string(kMaxChunks) + " are possible");
    }
    if (index.size_bytes_ < index.end_bytes()) return index.wrong("its table reaches beyond the end of the file");
    return index;
}

std::uint64_t ContainerIndex::end_bytes() const {
    return kTableOffset_bytes + chunk_count_ * kEntry_bytes;
}

Status ContainerIndex::read_table(std::span<const std::byte> bytes) {
    RS_CHECK(bytes.size() == chunk_count_ * kEntry_bytes);
    if (table_checksum_ != XXH64(bytes.data(), bytes.size(), 0)) {
        return wrong("the table's checksum does not match" + std::string(kDamaged));
    }
    ByteReader reader(bytes);
    table_.resize(chunk_count_);
    for (ChunkEntry& entry : table_) {
        std::memcpy(entry.name.data(), reader.take(entry.name.size()).data(), entry.name.size());
        entry.index = reader.get<std::uint32_t>();
        entry.offset_bytes = reader.get<std::uint64_t>();
        entry.size_bytes = reader.get<std::uint64_t>();
        entry.checksum = reader.get<std::uint64_t>();
    }
    RS_TRY(check_entries());
    return index_by_name();
}

Status ContainerIndex::check_entries() const {
    std::uint64_t expected_offset = end_bytes();
    for (std::size_t i = 0; i < table_.size(); ++i) {
        const ChunkEntry& entry = table_[i];
        // Messages contain only checked names.
        if (!is_valid(entry.name))
            return wrong("table entry " + std::to_string(i) + ": its name is not letters and digits");
        if (entry.offset_bytes != expected_offset) {
            return wrong(place(entry) + "does not begin where the one before it ends");
        }
        if (entry.size_bytes > kMaxChunk_bytes) return wrong(place(entry) + "is larger than 1 GiB");
        if (aligned(entry.size_bytes) > size_bytes_ - expected_offset) {
            return wrong(place(entry) + "reaches beyond the end of the file");
        }
        expected_offset += aligned(entry.size_bytes);
    }
    if (expected_offset != size_bytes_) return wrong("holds bytes behind its last chunk");
    return {};
}

Status ContainerIndex::index_by_name() {
    by_name_.resize(table_.size());
    for (std::uint32_t i = 0; i < by_name_.size(); ++i) by_name_[i] = i;
    const auto key = [this](std::uint32_t i) { return std::pair(table_[i].name, table_[i].index); };
    std::sort(by_name_.begin(), by_name_.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    const auto twin = std::adjacent_find(by_name_.begin(), by_name_.end(),
                                         [&](std::uint32_t a, std::uint32_t b) { return key(a) == key(b); });
    if (twin != by_name_.end()) return wrong(place(table_[*twin]) + "is there twice");
    return {};
}

const ChunkEntry* ContainerIndex::find(ChunkName name, std::uint32_t index) const {
    const auto found = std::lower_bound(by_name_.begin(), by_name_.end(), std::pair(name, index),
                                        [&](std::uint32_t i, const std::pair<ChunkName, std::uint32_t>& wanted) {
                                            return std::pair(table_[i].name, table_[i].index) < wanted;
                                        });
    if (found == by_name_.end() || table_[*found].name != name || table_[*found].index != index) return nullptr;
    return &table_[*found];
}

Result<std::vector<std::byte>> ContainerIndex::checked_payload(const ChunkEntry& entry,
                                                               std::vector<std::byte> bytes) const {
    RS_CHECK(bytes.size() == aligned(entry.size_bytes));
    const std::span<const std::byte> padding = std::span(bytes).subspan(static_cast<std::size_t>(entry.size_bytes));
    if (std::any_of(padding.begin(), padding.end(), [](std::byte b) { return b != std::byte{0}; })) {
        return wrong(place(entry) + "the padding behind it is not zero" + kDamaged);
    }
    bytes.resize(static_cast<std::size_t>(entry.size_bytes));
    if (entry.checksum != XXH64(bytes.data(), bytes.size(), 0)) {
        return wrong(place(entry) + "its checksum does not match" + kDamaged);
    }
    return bytes;
}

std::string to_string(ChunkName name) {
    return {name.begin(), name.end()};
}

}  // namespace rs
