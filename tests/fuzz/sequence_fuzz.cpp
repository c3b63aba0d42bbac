#include "compositor/sequence/extended_obj.hpp"
#include "compositor/sequence/frames_file.hpp"
#include "rayspace/api/types/check.hpp"
#include "tests/fuzz/entries.hpp"

#include <cmath>
#include <string>
#include <string_view>

namespace rs::fuzz {

// Accepted sequences can be placed in a scene; rejected ones give a one-line error with its place.
int fuzz_sequence(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto read = compositor::parse_extended_obj(text, "fuzz.obj");
    if (read) {
        for (const compositor::InstanceLine& line : read->instances) {
            const glm::dmat4 matrix = compositor::instance_matrix(line.pose, {1, 2, 3});
            for (int column = 0; column < 4; ++column) {
                for (int row = 0; row < 4; ++row) RS_CHECK(std::isfinite(matrix[column][row]));
            }
            RS_CHECK(std::abs(glm::determinant(glm::dmat3(matrix))) > 0);
            RS_CHECK(line.line >= 1 && !line.id.empty() && !line.material.empty());
        }
        for (const compositor::ObjObject& object : read->objects) RS_CHECK(!object.nodes.empty());
        RS_CHECK(!read->camera || read->camera->pose.eye != read->camera->pose.at);
    } else {
        const std::string& message = read.error().message;
        RS_CHECK(message.rfind("fuzz.obj:", 0) == 0 && message.find('\n') == std::string::npos);
    }
    const auto files = compositor::frames_from_json(std::string(text), "fuzz/frames.json");
    if (files) RS_CHECK(!files->frames.empty());
    return 0;
}

}  // namespace rs::fuzz
