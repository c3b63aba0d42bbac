#pragma once
// Stroke font: capital letters as pen paths.

#include <glm/glm.hpp>

#include <vector>

namespace rs::synthetic {

struct Letter {
    std::vector<std::vector<glm::vec2>> strokes;  // polylines, curves finely divided; y from 0 (base line) to 1
    float width = 0.0F;                           // x from 0 to this
};

// `letter`: 'A' to 'Z'.
Letter pen_letter(char letter);

}  // namespace rs::synthetic
