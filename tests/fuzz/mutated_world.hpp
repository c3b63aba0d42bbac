#pragma once
// Creates faulty VRML worlds from valid ones: changes bytes, and drops, doubles, exchanges and replaces words and
// brackets, so that many pass the syntax check.

#include <random>
#include <string>
#include <vector>

namespace rs::fuzz {

/// A mutation of one of the worlds, with pieces of the others. Depends only on the generator's state.
std::string mutated_world(const std::vector<std::string>& worlds, std::mt19937_64& random);

}  // namespace rs::fuzz
