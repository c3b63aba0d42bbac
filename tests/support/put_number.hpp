#pragma once
// Overwrites little-endian numbers in bytes, to test readers.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rs::test {

inline void put_number(std::vector<std::byte>& bytes, std::size_t offset, std::uint64_t number, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) bytes.at(offset + i) = static_cast<std::byte>(number >> (8 * i));
}

}  // namespace rs::test
