#pragma once
// A luminaire as its maker measured it: IES LM-63 (1986, 1991, 1995, 2002, 2019) and EULUMDAT files.
//
//     Result<Luminaire> lamp = read_luminaire("downlight.ies");
//     lamp->web.candela(direction)
//
// Frame: photometric_web.hpp. Lengths in metres.

#include "rayspace/light/photometric_web.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rs {

// The part that shines. `across` lies along X (planes C0 and C180), `along` along Z, `height` along Y.
enum class OpeningShape {
    kPoint,
    kRectangle,
    kBox,             // a rectangle with luminous sides
    kDisc,            // round or elliptic, seen from below
    kCylinder,        // upright; elliptic where across and along differ
    kCylinderAcross,  // lying
    kCylinderAlong,
    kEllipsoid,  // a sphere where all three are the same
};
const char* name_of(OpeningShape shape);

struct LuminousOpening {
    OpeningShape shape = OpeningShape::kPoint;
    double across_m = 0, along_m = 0, height_m = 0;  // all >= 0
};

// How much light is left when the luminaire is tilted from how it was measured. Angles ascend.
struct TiltTable {
    int lamp_to_luminaire = 1;  // 1 upright, 2 or 3 lying
    std::vector<double> angles_deg;
    std::vector<double> factors;
    // Linear between angles, the end's beyond; 1 where the table is empty.
    [[nodiscard]] double factor(double tilt_deg) const;
};

struct Luminaire {
    std::string format;                                         // "LM-63-2002", "EULUMDAT", ...
    std::vector<std::pair<std::string, std::string>> keywords;  // "LUMCAT", ...; UTF-8, [MORE] joined by a space
    Goniometer type = Goniometer::kTypeC;
    int lamps = 1;
    double lumens_per_lamp = -1;  // -1: measured absolutely
    double multiplier = 1;
    double ballast_factor = 1;
    double input_w = 0;
    LuminousOpening opening;
    TiltTable tilt;
    PhotometricWeb web;  // all factors but tilt's are in it

    // Of a keyword; empty where there is none.
    [[nodiscard]] const std::string& keyword(std::string_view name) const;
};

inline constexpr std::uint64_t kMostLuminaireBytes = 16U << 20U;

// By the name's ending: .ldt is EULUMDAT, all else LM-63. TILT=NAME is read from NAME beside the file. Errors name file
// and line. Thread-safe, as all here.
Result<Luminaire> read_luminaire(const std::filesystem::path& path);

// Of the file's text; `name` is for errors. A TILT that names another file is refused.
Result<Luminaire> parse_ies(std::string_view text, const std::string& name);
Result<Luminaire> parse_eulumdat(std::string_view text, const std::string& name);

// Between the outermost directions that have half of the plane's greatest intensity, in the plane through the aim at
// `horizontal_deg` (0: planes C0 and C180) and, for the field, a tenth. Radians.
struct BeamSpread {
    double beam_rad = 0;
    double field_rad = 0;
};
BeamSpread beam_spread(const PhotometricWeb& web, double horizontal_deg);

// Candela in that plane at `angle_rad` from the aim; negative angles are on the other side.
double candela_in_plane(const PhotometricWeb& web, double horizontal_deg, double angle_rad);

}  // namespace rs
