#pragma once
// A photograph with the turntable's axis and the followed points drawn on it.

#include "capture/photos/import.hpp"
#include "rayspace/image/image.hpp"

namespace rs::capture {

inline constexpr int kAnnotatedSide_px = 560;

// Made small (its longer side at most kAnnotatedSide_px), then drawn on. `view` counts the photographs of the report.
Image<Rgba8> annotated_photo(ConstImageView<Rgba8> photo, const ImportReport& report, int view);

}  // namespace rs::capture
