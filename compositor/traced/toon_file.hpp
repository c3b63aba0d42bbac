#pragma once
// File of a style of toon shading (README.md): the keys of a recipe's "toon" without "edge_radius" and "shadow_rays",
// which are chosen by TracedOptions.

#include "capture/tracer/scene/toon_style.hpp"
#include "rayspace/base/result.hpp"

#include <filesystem>
#include <string_view>

namespace rs::compositor {

/// Parses the text of a file. Keys that it lacks keep their defaults. Errors name the key.
/// \param path for error messages
Result<capture::ToonStyle> toon_style_from_json(std::string_view text, const std::filesystem::path& path);
/// Reads a file of up to 1 MiB.
Result<capture::ToonStyle> read_toon_style(const std::filesystem::path& path);

}  // namespace rs::compositor
