#pragma once
// Diagnosis of OBJ files: Assimp's errors name no line, and it skips materials and statements without a word.

#include <set>
#include <string>
#include <string_view>

namespace rs {

/// First face, line or point statement with an index that does not exist, such as "line 12: names vertex 9 of 8".
/// Positive indices count from 1 over the whole file, negative ones back from the statement. Pure; thread-safe.
/// \return empty if all indices exist
std::string find_bad_obj_index(std::string_view text);

struct ObjNames {
    std::set<std::string> libraries;  // mtllib
    std::set<std::string> materials;  // usemtl, without "None" and "(null)", which exporters write for none
    bool has_free_forms = false;      // curv, curv2, surf
};
/// Pure; thread-safe.
ObjNames names_in_obj(std::string_view text);

}  // namespace rs
