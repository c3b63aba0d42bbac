#pragma once
// VRML worlds with faults, made from whole ones: bytes are changed, and words and brackets dropped, doubled, exchanged
// and replaced, so that many get past the syntax.

#include <random>
#include <string>
#include <vector>

namespace rs::fuzz {

// A mutation of one of the worlds, with pieces of the others. Depends on the generator's state alone.
std::string mutated_world(const std::vector<std::string>& worlds, std::mt19937_64& random);

}  // namespace rs::fuzz
