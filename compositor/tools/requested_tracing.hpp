#pragma once
// How rs-view is to trace.

#include "compositor/tools/view_options.hpp"
#include "compositor/traced/traced_renderer.hpp"
#include "rayspace/base/result.hpp"

#include <optional>

namespace rs::compositor {

// Nothing: raster.
std::optional<TracedMethod> requested_method(const ViewArguments& arguments);

// For raster, too: what a window traces when that is switched on. Refuses a lens that is none, or that is focused on
// nothing.
Result<TracedOptions> requested_tracing(const ViewArguments& arguments);

}  // namespace rs::compositor
