#pragma once
// One self-contained page about an import, for people who would rather look than read: what was found and how sure it
// is, the points that were followed, the axis drawn on photographs, the mattes on magenta.

#include "capture/photos/import.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <string>

namespace rs::capture {

// A photograph with the turntable's axis and the followed points drawn on it.

inline constexpr int kAnnotatedSide_px = 560;

// Made small (its longer side at most kAnnotatedSide_px), then drawn on. `view` counts the photographs of the report.
Image<Rgba8> annotated_photo(ConstImageView<Rgba8> photo, const ImportReport& report, int view);

// Reads some photographs again to draw on them; fails where one cannot be read.
Result<std::string> import_page(const ImportOptions& options, const ImportReport& report);

}  // namespace rs::capture
