#pragma once
// Diagnosis of OBJ files that Assimp rejects: its errors name no line.

#include <string>
#include <string_view>

namespace rs {

/// First face, line or point statement with an index that does not exist, such as "line 12: names vertex 9 of 8".
/// Positive indices count from 1 over the whole file, negative ones back from the statement. Pure; thread-safe.
/// \return empty if all indices exist
std::string find_bad_obj_index(std::string_view text);

}  // namespace rs
