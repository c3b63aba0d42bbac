#pragma once
// The photometric web of a luminaire: its luminous intensity in each direction, far away from it.
//
// Luminaire frame   The light is aimed along -Y (the nadir). Type C: vertical angles count from the nadir, horizontal
//                   ones about it from +X (plane C0) towards -Z (plane C90): counter-clockwise, seen from above.
//                   Types A and B: vertical 0, horizontal 0 is the aim; horizontal angles go towards +X, vertical ones
//                   towards -Z. Type A's poles are at vertical +-90, type B's at horizontal +-90.
// Between angles    Bilinear in (vertical, horizontal); 0 where the web holds no angles. Webs whose planes are all
// alike
//                   are looked up by their vertical angle alone.
// Units             Candela, lumens, degrees in files and in PhotometricTable, radians elsewhere.
//
// Source: ANSI/IESNA LM-63-2002; IES LM-75 for the three types of goniometer. A radiant quantity is the photometric one
// over kLumensPerWatt, as Radiance and its kin have it.

#include "rayspace/base/result.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs {

inline constexpr double kLumensPerWatt = 179.0;

enum class Goniometer { kTypeA, kTypeB, kTypeC };

// What a file states. Angles ascend strictly. By the ends of the horizontal angles, planes that are left out are like
// those that are there:
//   type C      0: all; 0..90: mirrored in both planes; 0..180: in the plane 0-180; 90..270: in the plane 90-270;
//               0..360, or 0 to less than 360: none is left out
//   types A, B  0..90: mirrored; vertical angles likewise
struct PhotometricTable {
    Goniometer type = Goniometer::kTypeC;
    std::vector<double> vertical_deg;
    std::vector<double> horizontal_deg;
    std::vector<double> candela;  // of vertical angle v in horizontal plane h: [h * vertical_deg.size() + v]
};

class PhotometricWeb {
public:
    static constexpr std::size_t kMostAngles = 4096;       // of either kind
    static constexpr std::size_t kMostValues = 1U << 20U;  // of a table

    // Refuses tables whose angles are out of order or range, values that are negative or not finite, and webs without
    // light. The message states what, without a file's name.
    static Result<PhotometricWeb> create(const PhotometricTable& table);

    // `direction` is away from the luminaire, in its frame, of any length but 0. Thread-safe, as all that follows.
    [[nodiscard]] double candela(const glm::dvec3& direction) const;
    [[nodiscard]] double peak_candela() const { return peak_; }

    // The integral of candela() over all directions, exactly.
    [[nodiscard]] double lumens() const { return total_; }
    // What laboratories report: each zone between two vertical angles with the mean of its corners.
    [[nodiscard]] double zonal_lumens() const;

    // A direction drawn with probability density candela(direction) / lumens() per steradian. u in [0, 1)^2.
    [[nodiscard]] glm::dvec3 sample(const glm::dvec2& u) const;
    [[nodiscard]] double pdf(const glm::dvec3& direction) const { return candela(direction) / total_; }

private:
    // Polar coordinates about `axis_`: azimuth 0 is at zero_, 90 degrees at quarter_. All three types are this, with
    // other axes.
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
    bool round_ = false;        // the whole circle, the same in every plane
    std::vector<double> flux_;  // of the cells, summed up: [azimuth cell][polar cell]
    double total_ = 0;
    double peak_ = 0;
};

}  // namespace rs
