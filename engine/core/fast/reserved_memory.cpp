#include "engine/core/fast/reserved_memory.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace rs::engine {

Result<ReservedMemory> ReservedMemory::create(std::size_t bytes, const std::string& name) {
    ReservedMemory memory;
    memory.bytes_ = whole_pages(std::max<std::size_t>(bytes, 1));
    void* const data =
        mmap(nullptr, memory.bytes_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (data == MAP_FAILED) {
        return Error{name + ": cannot reserve " + std::to_string(memory.bytes_ >> 20) +
                     " MiB of addresses for its images; raise the limit (ulimit -v) or load a lower level"};
    }
    memory.data_ = static_cast<std::byte*>(data);
    return memory;
}

ReservedMemory::ReservedMemory(ReservedMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}

ReservedMemory& ReservedMemory::operator=(ReservedMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

ReservedMemory::~ReservedMemory() {
    if (data_ != nullptr) munmap(data_, bytes_);
}

void ReservedMemory::release(std::size_t begin, std::size_t bytes) const {
    RS_CHECK(begin % kPage == 0 && bytes % kPage == 0 && begin + bytes <= bytes_);
    if (madvise(data_ + begin, bytes, MADV_DONTNEED) != 0) std::memset(data_ + begin, 0, bytes);
}

}  // namespace rs::engine
