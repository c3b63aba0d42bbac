#include "compositor/displays/head_datagram.hpp"
#include "rayspace/api/types/check.hpp"
#include "tests/fuzz/entries.hpp"

#include <algorithm>
#include <cmath>

namespace rs::fuzz {

int fuzz_head(const std::uint8_t* data, std::size_t size) {
    const auto head = compositor::head_from_datagram(std::as_bytes(std::span(data, size)));
    if (!head) {
        RS_CHECK(head.error().message.find('\n') == std::string::npos);
        return 0;
    }
    RS_CHECK(size == compositor::kHeadDatagram_bytes);
    for (int axis = 0; axis < 3; ++axis) {
        RS_CHECK(std::abs(head->position[axis]) <= compositor::kMaxHeadDistance_m * (1 + 1e-12));
    }
    const compositor::Head zero{.position = {1, 2, 3}, .heading_rad = 1};
    const compositor::Head in_room = compositor::head_in_room(*head, zero);
    RS_CHECK(std::abs(glm::length(in_room.right()) - 1) < 1e-9);
    RS_CHECK(std::abs(glm::distance(in_room.position, zero.position) - glm::length(head->position)) < 1e-9);
    return 0;
}

}  // namespace rs::fuzz
