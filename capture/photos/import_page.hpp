#pragma once
// One self-contained page about an import, for people who would rather look than read: what was found and how sure it
// is, the points that were followed, the axis drawn on photographs, the mattes on magenta.

#include "capture/photos/import.hpp"
#include "rayspace/base/result.hpp"

#include <string>

namespace rs::capture {

// Reads some photographs again to draw on them; fails where one cannot be read.
Result<std::string> import_page(const ImportOptions& options, const ImportReport& report);

}  // namespace rs::capture
