#pragma once
// A list of lights as rs-view's --lights takes it, and luminaires of our own for it.

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
    // Shines along `aim`; `size` along X and Z where it aims down.
    void rectangle(glm::vec3 middle, glm::vec3 aim, glm::vec2 size, double lumens, glm::vec3 colour);
    void luminaire(const std::string& file, glm::vec3 place, glm::vec3 aim, glm::vec3 colour);
    // {"replace": true, "lights": [...]}; numbers rounded, so that it is the same text everywhere.
    [[nodiscard]] std::string text() const;

private:
    std::unique_ptr<nlohmann::ordered_json> lights_;
};

// LM-63-2002: so many lumens in a beam that falls to half at `half_deg` from its middle (0..60, a Gaussian of the
// angle) and ends at 90 degrees.
std::string beam_ies(const std::string& name, double lumens, double half_deg);

}  // namespace rs::synthetic
