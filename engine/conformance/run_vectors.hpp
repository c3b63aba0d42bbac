#pragma once
// Executors on the conformance set: whoever turns an object and view registers into a picture.

#include "engine/conformance/vectors.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"
#include "rayspace/object/ray_space_object.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rs::engine {

struct ExecutedView {
    Image<Rgba8> picture;
    Image<std::int32_t> depth_q20;  // empty: this executor gives none
};

// Renders the views of one object. Fails, saying why, where the executor does not do such objects.
using ExecuteView = std::function<Result<ExecutedView>(std::size_t view)>;
struct Executor {
    std::string name;
    // `object` is read with its pictures as the file holds them (coded ones are not unpacked).
    std::function<Result<ExecuteView>(const ConformanceCase& of_case, RaySpaceObject object)> open;
};

Executor scalar_executor();  // reconstruct_scalar
Executor core_executor();    // Renderer
// Pictures that another implementation wrote: FOLDER/CASE/VIEW.rgba and, where there is one, VIEW.depth
// (engine/conformance/PROTOCOL.md).
Executor files_executor(const std::filesystem::path& folder);

struct CaseResult {
    int same = 0;
    int different = 0;     // in colour or depth
    std::string declined;  // not "": why the executor did not take the case
    std::string first;     // the first view that differs, and how
    bool failed = false;   // `declined` says that something went wrong
};

struct ConformanceMatrix {
    std::vector<std::string> executors;
    std::vector<std::vector<CaseResult>> results;  // [case][executor]
    [[nodiscard]] bool passed() const;             // nothing different, nothing failed, and nobody declined all
};

// `write_folder`, if not empty: also writes what the first executor renders, in the protocol's form.
Result<ConformanceMatrix> run_vectors(const VectorSet& set, const std::vector<Executor>& executors,
                                      const std::filesystem::path& write_folder = {}, Progress* progress = nullptr);

}  // namespace rs::engine
