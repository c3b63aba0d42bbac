#pragma once
// Runs the conformance set: compares the images of implementations, or their files, with the hashes of the scalar
// definition.

#include "engine/conformance/vectors.hpp"
#include "rayspace/api/types/executor.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rs::engine {

// Renders a view of one case. Returns an error with the reason if the implementation does not support it.
using ExecuteView = std::function<Result<ExecutedView>(std::size_t view)>;
struct Implementation {
    std::string name;
    // `object` has its images as stored in the file (coded images are not unpacked).
    std::function<Result<ExecuteView>(const ConformanceCase& test_case, RaySpaceObject object)> open;
};

/// Writes a view to FOLDER/CASE/VIEW.rgba and VIEW.depth (engine/conformance/PROTOCOL.md); creates folders as needed.
Status write_view_files(const std::filesystem::path& folder, const std::string& test_case, std::size_t view,
                        const ExecutedView& executed);

/// Reads a view. \return error if the colour file is missing or a file is not of width x height pixels
Result<ExecutedView> read_view_files(const std::filesystem::path& folder, const std::string& test_case,
                                     std::size_t view, int width, int height);

/// Runs an executor. Declines objects and views that it does not render unchanged.
Implementation implementation_of(std::shared_ptr<Executor> executor);
/// Reads images that another implementation wrote: FOLDER/CASE/VIEW.rgba and optionally VIEW.depth
/// (engine/conformance/PROTOCOL.md).
Implementation implementation_in_files(const std::filesystem::path& folder);

struct CaseResult {
    int same = 0;
    int different = 0;     // in colour or depth
    std::string declined;  // reason why the implementation declined the case; "" if it did not
    std::string first;     // first view that differs, and its difference
    bool failed = false;   // an error occurred; `declined` is its message
};

struct ConformanceMatrix {
    std::vector<std::string> names;
    std::vector<std::vector<CaseResult>> results;  // [case][implementation]
    [[nodiscard]] bool passed() const;             // no difference, no failure, and an equal view of each
};

/// Runs all cases. If `write_folder` is not empty, also writes the views of the first implementation to it
/// (engine/conformance/PROTOCOL.md).
Result<ConformanceMatrix> run_vectors(const VectorSet& set, const std::vector<Implementation>& implementations,
                                      const std::filesystem::path& write_folder = {}, Progress* progress = nullptr);

}  // namespace rs::engine
