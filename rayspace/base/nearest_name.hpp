#pragma once
// Suggestions for misspelt options and keys.

#include <span>
#include <string>
#include <string_view>

namespace rs {

/// Known name with the smallest number of inserted, removed, replaced and swapped letters (restricted edit distance;
/// L. Boytsov 2011, section 2). Thread-safe.
/// \return empty if more than a third of the letters differ
std::string nearest_name(std::string_view written, std::span<const std::string> known);

/// "; did you mean 'NAME'?" of nearest_name(); empty if there is none.
std::string suggestion(std::string_view written, std::span<const std::string> known);

}  // namespace rs
