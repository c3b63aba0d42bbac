#pragma once
// Luminaires from photometric files: IES LM-63 (1986, 1991, 1995, 2002, 2019) and EULUMDAT.
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

// Shape of the luminous opening. `across` is along X (planes C0 and C180), `along` along Z, `height` along Y.
enum class OpeningShape {
    kPoint,
    kRectangle,
    kBox,             // a rectangle with luminous sides
    kDisc,            // horizontal circle or ellipse
    kCylinder,        // vertical; elliptic if across and along differ
    kCylinderAcross,  // horizontal
    kCylinderAlong,   // horizontal
    kEllipsoid,
};
const char* name_of(OpeningShape shape);

struct LuminousOpening {
    OpeningShape shape = OpeningShape::kPoint;
    double across_m = 0, along_m = 0, height_m = 0;  // all >= 0
};

// Factor on the intensity by tilt from the measurement position. Angles ascend.
struct TiltTable {
    int lamp_to_luminaire = 1;  // lamp geometry: 1 vertical, 2 or 3 horizontal
    std::vector<double> angles_deg;
    std::vector<double> factors;
    // Linear interpolation, constant beyond the ends; 1 for an empty table.
    [[nodiscard]] double factor(double tilt_deg) const;
};

struct Luminaire {
    std::string format;                                         // "LM-63-2002", "EULUMDAT", ...
    std::vector<std::pair<std::string, std::string>> keywords;  // "LUMCAT", ...; UTF-8, [MORE] joined by a space
    Goniometer type = Goniometer::kTypeC;
    int lamps = 1;
    double lumens_per_lamp = -1;  // -1: absolute photometry
    double multiplier = 1;
    double ballast_factor = 1;
    double input_w = 0;
    LuminousOpening opening;
    TiltTable tilt;
    PhotometricWeb web;  // includes all factors except tilt

    // Value of a keyword; empty if missing.
    [[nodiscard]] const std::string& keyword(std::string_view name) const;
};

inline constexpr std::uint64_t kMaxLuminaireFile_bytes = 16U << 20U;

// All functions below are thread-safe.

/// Reads a photometric file: EULUMDAT for the extension .ldt, otherwise LM-63. TILT=NAME is read from the same folder.
/// \return an error with file and line
Result<Luminaire> read_luminaire(const std::filesystem::path& path);

/// Parses the text of a file; `name` is used in errors. A TILT that names another file is an error.
Result<Luminaire> parse_ies(std::string_view text, const std::string& name);
Result<Luminaire> parse_eulumdat(std::string_view text, const std::string& name);

// Angles between the outermost directions with half (beam) and a tenth (field) of a plane's maximum intensity.
struct BeamSpread {
    double beam_rad = 0;
    double field_rad = 0;
};
/// Part of the sphere whose maximum and directions count: up to 180 or 90 degrees from the aim, or beyond 90 degrees.
enum class BeamPart { kWhole, kTowardsAim, kOpposite };
/// Beam spread in the plane through the aim at `horizontal_deg` (0: planes C0 and C180), measured from the aim; for
/// kOpposite from the opposite direction.
BeamSpread beam_spread(const PhotometricWeb& web, double horizontal_deg, BeamPart part = BeamPart::kWhole);

/// True for direct-indirect luminaires: each side of the horizontal plane gets at least a tenth of the flux (CIE's
/// limit between direct and semi-direct luminaires). Their beams are stated for each side.
bool is_direct_indirect(const PhotometricWeb& web);

/// Intensity in candela in the same plane at `angle_rad` from the aim; negative angles are on the opposite side.
double candela_in_plane(const PhotometricWeb& web, double horizontal_deg, double angle_rad);

}  // namespace rs
