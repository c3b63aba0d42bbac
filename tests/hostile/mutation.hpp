#pragma once
// Files with faults, made from whole ones. What a mutation does depends on the generator's state alone.

#include "tests/fuzz/chunk_soup.hpp"

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace rs::test {

using Random = std::mt19937_64;

// Below `count`, which is above 0.
std::size_t below(Random& random, std::size_t count);

// Bits turned, numbers of any width replaced by those at the ends of their ranges, bytes cut off, moved and repeated.
void mutate_bytes(std::vector<std::byte>& bytes, Random& random);

// The same inside of chunks, and inside of what they hold compressed; chunks that are lost, doubled, exchanged and
// renamed. Checksums and frames are made anew by whoever puts them together again (fuzz::container_of).
void mutate_chunks(std::vector<fuzz::SoupChunk>& chunks, Random& random);

// Numbers, words, brackets, quotes and lines of a text changed, lost, doubled and exchanged.
std::string mutated_text(const std::string& text, Random& random);

}  // namespace rs::test
