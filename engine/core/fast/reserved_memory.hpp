#pragma once
// A range of addresses whose pages cost nothing until they are written, and can be given back one by one.

#include "rayspace/base/result.hpp"

#include <cstddef>
#include <string>

namespace rs::engine {

class ReservedMemory {
public:
    ReservedMemory() = default;
    // `bytes` zero bytes. Fails where the system does not give so many addresses; `name` begins the message.
    static Result<ReservedMemory> create(std::size_t bytes, const std::string& name);

    ReservedMemory(ReservedMemory&& other) noexcept;
    ReservedMemory& operator=(ReservedMemory&& other) noexcept;
    ~ReservedMemory();

    [[nodiscard]] std::byte* data() const { return data_; }

    // Makes bytes [begin, begin + bytes) zero again and their pages free. Both are multiples of kPage.
    void release(std::size_t begin, std::size_t bytes) const;

    // What sizes and places are rounded up to, to be released apart: a multiple of every usual page size.
    static constexpr std::size_t kPage = std::size_t{1} << 16;
    static constexpr std::size_t whole_pages(std::size_t bytes) { return (bytes + kPage - 1) / kPage * kPage; }

private:
    std::byte* data_ = nullptr;
    std::size_t bytes_ = 0;
};

}  // namespace rs::engine
