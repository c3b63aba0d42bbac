#pragma once
// Writer of light lists for rs-view --lights, and of IES luminaires for them.

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <string>

namespace rs::synthetic {

class LightList {
public:
    LightList();
    ~LightList();
    void sun(glm::vec3 aim, double lux, glm::vec3 colour);
    void point(glm::vec3 place, double candela, glm::vec3 colour);
    /// Shines along `aim`; `size` is along X and Z if it aims down.
    void rectangle(glm::vec3 middle, glm::vec3 aim, glm::vec2 size, double lumens, glm::vec3 colour);
    void luminaire(const std::string& file, glm::vec3 place, glm::vec3 aim, glm::vec3 colour);
    /// {"replace": true, "lights": [...]}; numbers are rounded, so that the text does not depend on the machine.
    [[nodiscard]] std::string text() const;

private:
    std::unique_ptr<nlohmann::ordered_json> lights_;
};

/// IES file (LM-63-2002) of a beam with a Gaussian falloff over the angle, cut off at 90 degrees.
/// \param lumens luminous flux of the beam
/// \param half_deg angle at which intensity is half of the maximum, 0..60
std::string beam_ies(const std::string& name, double lumens, double half_deg);

}  // namespace rs::synthetic
