#pragma once
// Objects built from a part of a capture set, scored on the rest: `rs-encode evaluate` and the page of a build.
//
// A view that was encoded is never scored. What is scored against is the upright image, before its colours are
// stored as Y, U and V.

#include "encode/build.hpp"
#include "encode/hold_out.hpp"
#include "encode/set/capture_set.hpp"
#include "rayspace/base/progress.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <functional>
#include <string>
#include <vector>

namespace rs::encode {

enum class Method {
    kPhoto,  // the nearest kept image, shown as it is: what spin viewers do
    kPlane,  // an object of MapKind::kPlane, rendered
    kShape,  // an object of MapKind::kShape, rendered
};

std::string to_string(Method method);

// "photo,plane,shape" or some of them, in the order given; a name that is unknown, missing or given twice is an error.
Result<std::vector<Method>> parse_methods(const std::string& text);

struct EvaluationOptions {
    std::vector<Method> methods{Method::kPhoto, Method::kPlane, Method::kShape};
    int planes = 12;  // of the objects that are built; cells as usual_plane_map() gives
};

struct AnsweredView {
    Method method = Method::kPhoto;
    std::size_t number = 0;  // in HoldOut::held
    int view = 0;            // HoldOut::held[number]
    const Image<Rgba8>& truth;
    const Image<Rgba8>& answer;  // of the same size
    double psnr_db = 0;
};
// Called from several threads at once.
using LookAtAnswer = std::function<Status(const AnsweredView&)>;

// One entry for each method, with the views of hold_out.held in their order. `hold_out` is of the set's rig; `look` may
// be empty. Fails as build_object, read_upright_image and `look` do.
Result<std::vector<MethodScores>> evaluate(const CaptureSet& set, const HoldOut& hold_out,
                                           const EvaluationOptions& options, const LookAtAnswer& look = {},
                                           Progress* progress = nullptr);

}  // namespace rs::encode
