#include "rayspace/base/byte_stream.hpp"
#include "rayspace/format/container.hpp"
#include "rayspace/format/container_layout.hpp"

#include <xxhash.h>

#include <algorithm>
#include <utility>

namespace rs {

using namespace container_layout;

Result<ContainerWriter> ContainerWriter::create(const std::filesystem::path& path, std::uint32_t chunk_count) {
    RS_CHECK(chunk_count >= 1 && chunk_count <= kMaxChunks);
    RS_ASSIGN_OR_RETURN(auto file, StagedFile::create(path));
    const std::vector<std::byte> reserved(kHeader_bytes + chunk_count * kEntry_bytes);
    RS_TRY(file.write(reserved));
    return ContainerWriter(std::move(file), chunk_count);
}

ContainerWriter::ContainerWriter(StagedFile file, std::uint32_t chunk_count)
    : file_(std::move(file)), chunk_count_(chunk_count) {
    table_.reserve(chunk_count);
}

Status ContainerWriter::add(ChunkName name, std::uint32_t index, std::span<const std::byte> payload) {
    RS_CHECK(is_valid(name));
    RS_CHECK(table_.size() < chunk_count_);
    RS_CHECK(std::none_of(table_.begin(), table_.end(),
                          [&](const ChunkEntry& e) { return e.name == name && e.index == index; }));
    const std::uint64_t padded_bytes = aligned(payload.size());
    if (payload.size() > kMaxChunk_bytes || padded_bytes > kMaxContainer_bytes - file_.size_bytes()) {
        return Error{file_.target().string() + ": chunk " + to_string(name) + " " + std::to_string(index) +
                     " would make it larger than the format allows; use fewer or smaller images"};
    }
    table_.push_back({name, index, file_.size_bytes(), payload.size(), XXH64(payload.data(), payload.size(), 0)});
    RS_TRY(file_.write(payload));
    static constexpr std::array<std::byte, kAlignment_bytes> kZeros{};
    return file_.write(std::span(kZeros).first(static_cast<std::size_t>(padded_bytes - payload.size())));
}

Status ContainerWriter::commit() {
    RS_CHECK(table_.size() == chunk_count_);
    ByteWriter table;
    for (const ChunkEntry& entry : table_) {
        table.put(std::as_bytes(std::span(entry.name)));
        table.put(entry.index);
        table.put(entry.offset_bytes);
        table.put(entry.size_bytes);
        table.put(entry.checksum);
    }
    ByteWriter header;
    header.put(std::span<const std::uint8_t>(kMagic));
    header.put(kVersionMajor);
    header.put(kVersionMinor);
    header.put(chunk_count_);
    header.put(kTableOffset_bytes);
    header.put(file_.size_bytes());
    header.put(std::uint64_t{XXH64(table.bytes().data(), table.size(), 0)});
    RS_CHECK(header.size() == kHeaderChecked_bytes);
    header.put(std::uint64_t{XXH64(header.bytes().data(), header.size(), 0)});

    RS_TRY(file_.write_at(0, header.bytes()));
    RS_TRY(file_.write_at(kTableOffset_bytes, table.bytes()));
    return file_.commit();
}

}  // namespace rs
