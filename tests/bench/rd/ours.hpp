#pragma once
// Rayspace's own image coding: builds an object from the set with the command `rs-encode` and decodes it.

#include "rayspace/base/progress.hpp"
#include "tests/bench/rd/coded.hpp"
#include "tests/bench/rd/curve.hpp"
#include "tests/bench/rd/work_folder.hpp"

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace rs::bench {

// Curve names: raw (images stored as they are, one point), and the coding profiles dense and board.
const std::vector<std::string>& profile_names();

/// Fails if `encoder` lacks an option that the profiles in `names` need.
Status check_encoder(const std::filesystem::path& encoder, const std::set<std::string>& names);

/// Measures the profiles in `names` at all their qualities. Bytes are those of the file without the RS map (chunks RMAP
/// and shap), which is geometry that the other codecs do not store. Results are not cached, since the encoder is what
/// changes between runs.
Result<std::vector<Measurement>> measure_ours(const ReferenceImages& images, const std::set<std::string>& names,
                                              const std::filesystem::path& encoder, const WorkFolder& work,
                                              Progress& progress);

}  // namespace rs::bench
