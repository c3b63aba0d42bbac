#pragma once
// Images of the conformance protocol in files: FOLDER/CASE/VIEW.rgba, FOLDER/CASE/VIEW.depth
// (engine/conformance/PROTOCOL.md).

#include "engine/conformance/run_vectors.hpp"

namespace rs::engine {

// Makes folders as needed.
Status write_view_files(const std::filesystem::path& folder, const std::string& of_case, std::size_t view,
                        const ExecutedView& executed);

// Fails where the colours are not there or a file does not have the size of width x height pixels.
Result<ExecutedView> read_view_files(const std::filesystem::path& folder, const std::string& of_case, std::size_t view,
                                     int width, int height);

}  // namespace rs::engine
