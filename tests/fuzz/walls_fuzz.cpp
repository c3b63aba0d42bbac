#include "compositor/displays/walls_file.hpp"
#include "rayspace/api/types/check.hpp"
#include "tests/fuzz/entries.hpp"

#include <cmath>

namespace rs::fuzz {
namespace {

void check_message(const std::string& message) {
    RS_CHECK(message.find('\n') == std::string::npos);
    RS_CHECK(message.rfind("input.json: ", 0) == 0);
}

}  // namespace

int fuzz_walls(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    if (const auto display = compositor::walls_from_json(text, "input.json")) {
        for (const compositor::Wall& wall : display->walls) {
            RS_CHECK(compositor::check_wall(wall).ok());
            const auto camera = compositor::wall_camera(wall, display->head.eye(display->eye_distance_m),
                                                        display->place.value_or(compositor::RoomPose{}));
            RS_CHECK(!camera || (camera->fl_x > 0 && std::isfinite(camera->cx) && rotation_error(*camera) < 1e-9));
        }
    } else {
        check_message(display.error().message);
    }
    if (const auto heads = compositor::heads_from_json(text, "input.json")) {
        for (const compositor::Head& head : *heads) RS_CHECK(std::abs(glm::length(head.right()) - 1) < 1e-9);
    } else {
        check_message(heads.error().message);
    }
    return 0;
}

}  // namespace rs::fuzz
