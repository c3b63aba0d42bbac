#pragma once
// Photometric web of a luminaire: far-field luminous intensity by direction.
//
// Luminaire frame   The aim is -Y (nadir). Type C: vertical angles from the nadir, horizontal angles about it from +X
//                   (plane C0) towards -Z (plane C90), counter-clockwise as seen from above. Types A and B: the aim has
//                   vertical and horizontal angle 0; horizontal angles go towards +X, vertical ones towards -Z. Type
//                   A's poles are at vertical +-90, type B's at horizontal +-90.
// Interpolation     Bilinear in (vertical, horizontal); 0 outside the range of angles. Rotationally symmetric webs
//                   depend on the vertical angle only.
// Units             Candela, lumens, degrees in files and in PhotometricTable, radians elsewhere.
//
// Source: ANSI/IESNA LM-63-2002; IES LM-75 for the three types of goniometer. Radiant quantities are photometric ones
// over kLumensPerWatt, as in Radiance.

#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs {

inline constexpr double kLumensPerWatt = 179.0;

enum class Goniometer { kTypeA, kTypeB, kTypeC };

// Contents of a file. Angles are strictly ascending. The range of horizontal angles determines the symmetry:
//   type C      0: rotational; 0..90: about both planes; 0..180: about the plane 0-180; 90..270: about the plane
//   90-270;
//               0..360, or 0 to less than 360: none
//   types A, B  0..90: mirrored; vertical angles likewise
struct PhotometricTable {
    Goniometer type = Goniometer::kTypeC;
    std::vector<double> vertical_deg;
    std::vector<double> horizontal_deg;
    std::vector<double> candela;  // [h * vertical_deg.size() + v] for vertical angle v, horizontal plane h
};

class PhotometricWeb {
public:
    static constexpr std::size_t kMaxAngles = 4096;       // vertical, horizontal
    static constexpr std::size_t kMaxValues = 1U << 20U;  // per table

    /// \return an error, without a file name, if angles are out of order or range, if a value is negative or not
    /// finite, or if the web is dark
    static Result<PhotometricWeb> create(const PhotometricTable& table);

    // All functions below are thread-safe. Directions point away from the luminaire, in its frame, with any length > 0.
    [[nodiscard]] double candela(const glm::dvec3& direction) const;
    [[nodiscard]] double peak_candela() const { return peak_; }

    // Exact integral of candela() over all directions.
    [[nodiscard]] double lumens() const { return total_; }
    // Luminous flux by the zonal method of laboratories: each zone between two vertical angles with the mean of its
    // corners.
    [[nodiscard]] double zonal_lumens() const;

    // Samples a direction with density candela(direction) / lumens() per steradian. u in [0, 1)^2.
    [[nodiscard]] glm::dvec3 sample(const glm::dvec2& u) const;
    [[nodiscard]] double pdf(const glm::dvec3& direction) const { return candela(direction) / total_; }

private:
    // Polar coordinates about `axis_`: azimuth 0 at zero_, 90 degrees at quarter_. The goniometer types differ in these
    // axes.
    [[nodiscard]] glm::dvec3 direction_of(double polar, double azimuth) const;
    [[nodiscard]] double at(std::size_t azimuth, std::size_t polar) const {
        return candela_[azimuth * polar_.size() + polar];
    }
    void mirror(bool whole_circle, const PhotometricTable& table);
    [[nodiscard]] bool is_round() const;
    void accumulate();

    glm::dvec3 axis_{0, -1, 0}, zero_{1, 0, 0}, quarter_{0, 0, -1};
    std::vector<double> polar_;    // radians, ascending, within 0..pi
    std::vector<double> azimuth_;  // radians, ascending; 0..2 pi for type C
    std::vector<double> candela_;
    bool round_ = false;        // rotationally symmetric
    std::vector<double> flux_;  // cumulative flux: [azimuth cell][polar cell]
    double total_ = 0;
    double peak_ = 0;
};

}  // namespace rs
