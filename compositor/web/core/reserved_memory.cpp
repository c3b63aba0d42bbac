// ReservedMemory for WebAssembly, which has no mmap. Pages beyond the end of the heap are zero and take no memory until
// they are touched, so reservations are taken there. They are never returned: a page opens one object per instance of
// the module.

#include "engine/core/fast/reserved_memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace rs::engine {

Result<ReservedMemory> ReservedMemory::create(std::size_t bytes, const std::string& name) {
    ReservedMemory memory;
    memory.bytes_ = whole_pages(std::max<std::size_t>(bytes, 1));
    // The heap's end is aligned to kPage first.
    const std::size_t unaligned = reinterpret_cast<std::uintptr_t>(sbrk(0)) % kPage;
    const std::size_t gap = unaligned == 0 ? 0 : kPage - unaligned;
    void* const data = sbrk(static_cast<std::intptr_t>(gap + memory.bytes_));
    if (data == reinterpret_cast<void*>(-1)) {
        return Error{name + ": needs " + std::to_string(memory.bytes_ >> 20) +
                     " MiB for its images, more than the browser gives a page; encode it with fewer or smaller images"};
    }
    memory.data_ = static_cast<std::byte*>(data) + gap;
    return memory;
}

ReservedMemory::ReservedMemory(ReservedMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

ReservedMemory& ReservedMemory::operator=(ReservedMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

ReservedMemory::~ReservedMemory() = default;

void ReservedMemory::release(std::size_t begin, std::size_t bytes) const {
    RS_CHECK(begin % kPage == 0 && bytes % kPage == 0 && begin + bytes <= bytes_);
    std::memset(data_ + begin, 0, bytes);
}

}  // namespace rs::engine
