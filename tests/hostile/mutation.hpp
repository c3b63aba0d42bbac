#pragma once
// Creates faulty files from valid ones. Mutations depend only on the generator's state.

#include "tests/fuzz/chunk_soup.hpp"

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace rs::test {

using Random = std::mt19937_64;

/// A random index below `count`, which is above 0.
std::size_t below(Random& random, std::size_t count);

/// Flips bits, replaces numbers of any width by extreme values, removes, moves and repeats bytes.
void mutate_bytes(std::vector<std::byte>& bytes, Random& random);

/// Mutates the contents of chunks and of their compressed frames; removes, doubles, exchanges and renames chunks.
/// fuzz::container_of recomputes checksums and frames.
void mutate_chunks(std::vector<fuzz::SoupChunk>& chunks, Random& random);

/// Changes, removes, doubles and exchanges numbers, words, brackets, quotes and lines of a text.
std::string mutate_text(const std::string& text, Random& random);

}  // namespace rs::test
