#include "rayspace/format/container.hpp"
#include "tests/fuzz/chunk_soup.hpp"
#include "tests/fuzz/entries.hpp"

#include <utility>

namespace rs::fuzz {
namespace {

void open_and_read(std::vector<std::byte> bytes) {
    const std::size_t size = bytes.size();
    const auto reader = ContainerReader::over(std::move(bytes), "input");
    if (!reader) {
        RS_CHECK(reader.error().message.find('\n') == std::string::npos);
        return;
    }
    RS_CHECK(reader->size_bytes() == size);
    for (const ChunkEntry& entry : reader->table()) {
        RS_CHECK(reader->find(entry.name, entry.index) == &entry);
        const auto payload = reader->read(entry);
        if (payload) RS_CHECK(payload->size() == entry.size_bytes);
    }
}

}  // namespace

int fuzz_container(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    std::vector<std::byte> container(bytes.begin(), bytes.end());
    open_and_read(container);
    seal(container);
    open_and_read(std::move(container));
    return 0;
}

}  // namespace rs::fuzz
