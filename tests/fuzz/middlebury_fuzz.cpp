#include "capture/calibration/known/known_files.hpp"
#include "rayspace/api/types/check.hpp"
#include "rayspace/base/conventions.hpp"
#include "tests/fuzz/entries.hpp"

#include <cmath>
#include <string>

namespace rs::fuzz {

int fuzz_middlebury(const std::uint8_t* data, std::size_t size) {
    const auto file =
        capture::middlebury_parameters_from(std::string(reinterpret_cast<const char*>(data), size), "input");
    if (!file) {
        RS_CHECK(file.error().message.find('\n') == std::string::npos);
        return 0;
    }
    // Accepted files are complete and finite.
    const capture::KnownInputs& known = file->known;
    RS_CHECK(known.f_px && known.principal_point && known.distortion && known.pose && known.angles_rad);
    RS_CHECK(*known.f_px > 0 && std::isfinite(*known.f_px));
    RS_CHECK(std::isfinite(known.principal_point->x) && std::isfinite(known.principal_point->y));
    RS_CHECK(std::isfinite(known.pose->pan_rad) && std::isfinite(known.pose->tilt_rad) &&
             std::isfinite(known.pose->roll_rad));
    RS_CHECK(known.angles_rad->size() == file->images.size() && known.angles_rad->size() <= kMaxViews);
    for (const double angle : *known.angles_rad) RS_CHECK(std::isfinite(angle));
    RS_CHECK(known.angles_rad->front() == 0);
    return 0;
}

}  // namespace rs::fuzz
