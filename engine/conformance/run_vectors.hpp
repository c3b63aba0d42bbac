#pragma once
// The conformance set: every implementation that turns an object and view registers into an image is compared with
// what the definition gave.

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

// Renders the views of one object. Fails, with the reason, where the implementation does not do such objects.
using ExecuteView = std::function<Result<ExecutedView>(std::size_t view)>;
struct Implementation {
    std::string name;
    // `object` is read with its images as the file holds them (coded ones are not unpacked).
    std::function<Result<ExecuteView>(const ConformanceCase& of_case, RaySpaceObject object)> open;
};

// Declines objects and views that the executor does not draw as they are.
Implementation implementation_of(std::shared_ptr<Executor> executor);
// Images that another implementation wrote: FOLDER/CASE/VIEW.rgba and, where there is one, VIEW.depth
// (engine/conformance/PROTOCOL.md).
Implementation implementation_in_files(const std::filesystem::path& folder);

struct CaseResult {
    int same = 0;
    int different = 0;     // in colour or depth
    std::string declined;  // not "": why the implementation did not take the case
    std::string first;     // the first view that differs, and how
    bool failed = false;   // something went wrong; `declined` holds what
};

struct ConformanceMatrix {
    std::vector<std::string> names;
    std::vector<std::vector<CaseResult>> results;  // [case][implementation]
    [[nodiscard]] bool passed() const;             // nothing different, nothing failed, and nobody declined all
};

// `write_folder`, if not empty: also writes what the first implementation renders, in the protocol's form.
Result<ConformanceMatrix> run_vectors(const VectorSet& set, const std::vector<Implementation>& implementations,
                                      const std::filesystem::path& write_folder = {}, Progress* progress = nullptr);

}  // namespace rs::engine
