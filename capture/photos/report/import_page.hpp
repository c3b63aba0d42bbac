#pragma once
/// \file
/// Self-contained HTML page about an import, mostly of figures: estimates and their uncertainty, tracked points, the
/// axis drawn on photos, alpha mattes over magenta.

#include "capture/photos/report/import_report.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <filesystem>
#include <string>

namespace rs::capture {

/// Longer side of an annotated photo.
inline constexpr int kAnnotatedSide_px = 560;

/// Reduced photo (its longer side at most kAnnotatedSide_px) with the turntable's axis and the tracked points drawn on
/// it. `view` is an index into the photos of the report.
Image<Rgba8> annotated_photo(ConstImageView<Rgba8> photo, const ImportReport& report, int view);

/// Makes the page, in HTML. Reads some of the report's photos again to annotate them. `photos` is the name of the turn
/// in the title. Errors: an unreadable photo.
Result<std::string> import_page(const std::filesystem::path& photos, const ImportReport& report);

}  // namespace rs::capture
