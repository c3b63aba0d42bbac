#pragma once
// Rayspace's own image coding: the set is built into an object by the command `rs-encode`, and read back.

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

// Whether `encoder` has the options that the profiles in `names` need.
Status check_encoder(const std::filesystem::path& encoder, const std::set<std::string>& names);

// The profiles in `names` at all their qualities. Bytes are those of the whole file but the RS map (chunks RMAP and
// shap): the map is geometry, which the other codecs do not have. Nothing is kept: the encoder is what changes.
Result<std::vector<Measurement>> measure_ours(const ReferenceImages& images, const std::set<std::string>& names,
                                              const std::filesystem::path& encoder, const WorkFolder& work,
                                              Progress& progress);

}  // namespace rs::bench
