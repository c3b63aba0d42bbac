#pragma once
// Reserved range of virtual addresses. Pages are allocated when they are first written, and can be freed one by one.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <string>

namespace rs::engine {

class ReservedMemory {
public:
    ReservedMemory() = default;
    /// Reserves `bytes` zero bytes. \return error, prefixed by `name`, if the system has not enough addresses
    static Result<ReservedMemory> create(std::size_t bytes, const std::string& name);

    ReservedMemory(ReservedMemory&& other) noexcept;
    ReservedMemory& operator=(ReservedMemory&& other) noexcept;
    ~ReservedMemory();

    [[nodiscard]] std::byte* data() const { return data_; }

    /// Zeroes bytes [begin, begin + bytes) and frees their pages. Both are multiples of kPage.
    void release(std::size_t begin, std::size_t bytes) const;

    // Granularity of release(): a multiple of every usual page size.
    static constexpr std::size_t kPage = std::size_t{1} << 16;
    static constexpr std::size_t whole_pages(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

private:
    std::byte* data_ = nullptr;
    std::size_t bytes_ = 0;
};

}  // namespace rs::engine
