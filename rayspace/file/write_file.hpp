#pragma once
// A whole file at once, never seen half-written (StagedFile of file_output.hpp).

#include "rayspace/file/file_output.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace rs {

// Fails as StagedFile does; what stood under the name then still stands.
Status write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
Status write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace rs
