#pragma once
// Builds objects from part of a capture set and scores them on the rest, for `rs-encode evaluate` and the build report.
//
// Encoded views are never scored. Ground truth is the upright image before conversion to YUV.

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
    kPhoto,  // the nearest kept image, unchanged, as in spin viewers
    kPlane,  // a rendering of an object of MapKind::kPlane
    kShape,  // a rendering of an object of MapKind::kShape
};

std::string to_string(Method method);

/// Parses "photo,plane,shape" or a subset, in the given order. Unknown, missing and repeated names are errors.
Result<std::vector<Method>> parse_methods(const std::string& text);

struct EvaluationOptions {
    std::vector<Method> methods{Method::kPhoto, Method::kPlane, Method::kShape};
    int planes = 12;  // reference planes of the objects; cells as in default_plane_map()
};

struct EvaluatedView {
    Method method = Method::kPhoto;
    std::size_t number = 0;  // in HoldOut::held
    int view = 0;            // HoldOut::held[number]
    const Image<Rgba8>& truth;
    const Image<Rgba8>& rendering;  // same size
    double psnr_db = 0;
};
/// Called from several threads at once.
using EvaluationSink = std::function<Status(const EvaluatedView&)>;

/// Evaluates each method on the views hold_out.held, in their order. Fails as build_object, read_upright_image and
/// `sink` do.
/// \param hold_out  split of the set's rig.
/// \param sink      receives each rendering, from several threads; may be empty.
Result<std::vector<MethodScores>> evaluate(const CaptureSet& set, const HoldOut& hold_out,
                                           const EvaluationOptions& options, const EvaluationSink& sink = {},
                                           Progress* progress = nullptr);

}  // namespace rs::encode
