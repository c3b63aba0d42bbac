#pragma once
// Relights ray-space objects: their images are scaled by the ratio of the irradiance at their place in the scene to
// that of their capture, per channel and in linear light.
//
//     gain(n) = scene irradiance(n) / capture irradiance(n), 0 .. 4, fitted by harmonics of order 2
//
// The irradiance of the capture is stored with the object (kCaptureIrradianceKey); if it is unknown, a white diffuse
// surface is assumed to have the value 1 in the images, on all sides. Normals are those of an ellipsoid around the
// object, which vary smoothly between pixels and frames. Shading, shadows and highlights in the images remain. Pure;
// thread-safe.

#include "compositor/viewer/residency/placed_object.hpp"
#include "rayspace/light/irradiance_harmonics.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace rs::compositor {

/// Frames whose objects are relit.
enum class Relighting {
    kOff,
    kTraced,  // frames of physically based traced renderers: all but toon
    kOn,
};

/// Irradiance at a position of the scene, in world axes, times the exposure.
struct LocalIrradiance {
    glm::dvec3 position{0};
    IrradianceHarmonics irradiance;
};
using LocalIrradiances = std::vector<LocalIrradiance>;

/// Middle of the object in the world: the position at which its irradiance is computed.
glm::dvec3 middle_of(const PlacedObject& placed);
/// The entry nearest to the object; null if there is none.
const IrradianceHarmonics* nearest_irradiance(const LocalIrradiances& all, const PlacedObject& placed);

/// Gain by the normal, in the axes of the object.
/// \param scene irradiance at the object in world axes
IrradianceHarmonics relighting_gain(const PlacedObject& placed, const IrradianceHarmonics& scene);

/// Upright ellipsoid about the object's axis whose normals approximate those of its surface; object radii.
struct NormalProxy {
    glm::dvec3 centre{0};
    glm::dvec3 half_axes{1};
    /// Normal where a ray enters the ellipsoid; of a ray that misses it, at the point of closest approach in the space
    /// in which it is a sphere.
    [[nodiscard]] glm::dvec3 normal(const glm::dvec3& origin, const glm::dvec3& direction) const;
};
NormalProxy normal_proxy(const ViewableObject& object);

/// Irradiance of rasterized lights (raster_lights()) that light everything, without shadows.
IrradianceHarmonics irradiance_of(const std::vector<Light>& lights, const glm::dvec3& position);

}  // namespace rs::compositor
