#pragma once
// Image files of the conformance protocol: FOLDER/CASE/VIEW.rgba, FOLDER/CASE/VIEW.depth
// (engine/conformance/PROTOCOL.md).

#include "engine/conformance/run_vectors.hpp"

namespace rs::engine {

/// Writes a view; creates folders as needed.
Status write_view_files(const std::filesystem::path& folder, const std::string& test_case, std::size_t view,
                        const ExecutedView& executed);

/// Reads a view. \return error if the colour file is missing or a file is not of width x height pixels
Result<ExecutedView> read_view_files(const std::filesystem::path& folder, const std::string& test_case,
                                     std::size_t view, int width, int height);

}  // namespace rs::engine
