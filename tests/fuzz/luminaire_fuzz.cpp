#include "rayspace/api/types/check.hpp"
#include "rayspace/light/luminaire.hpp"
#include "tests/fuzz/entries.hpp"

#include <cmath>
#include <string_view>

namespace rs::fuzz {
namespace {

// Accepted luminaires must have plausible intensities and be drawable.
void check_luminaire(const Result<Luminaire>& read) {
    if (!read) {
        RS_CHECK(read.error().message.find('\n') == std::string::npos);
        return;
    }
    const PhotometricWeb& web = read->web;
    RS_CHECK(web.lumens() > 0 && std::isfinite(web.lumens()) && std::isfinite(web.zonal_lumens()));
    for (const double u : {0.0, 0.37, 0.9999999}) {
        const glm::dvec3 drawn = web.sample({u, 1 - u});
        RS_CHECK(std::abs(glm::length(drawn) - 1) < 1e-9);
        const double candela = web.candela(drawn);
        RS_CHECK(candela >= 0 && candela <= web.peak_candela() * (1 + 1e-9));
    }
}

}  // namespace

int fuzz_luminaire(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    check_luminaire(parse_ies(text, "fuzz"));
    check_luminaire(parse_eulumdat(text, "fuzz"));
    return 0;
}

}  // namespace rs::fuzz
