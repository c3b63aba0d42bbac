#pragma once
// One self-contained page about an import, for people who would rather look than read: what was found and how sure it
// is, the points that were followed, the axis drawn on photographs, the mattes on magenta.

#include "capture/photos/report/import_report.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <filesystem>
#include <string>

namespace rs::capture {

inline constexpr int kAnnotatedSide_px = 560;

// A photograph made small (its longer side at most kAnnotatedSide_px), with the turntable's axis and the followed
// points drawn on it. `view` counts the photographs of the report.
Image<Rgba8> annotated_photo(ConstImageView<Rgba8> photo, const ImportReport& report, int view);

// Reads some of the report's photographs again to draw on them; fails where one cannot be read. `photos` names them all
// in the title.
Result<std::string> import_page(const std::filesystem::path& photos, const ImportReport& report);

}  // namespace rs::capture
