#pragma once
// From events to what the visitor requests: movement for as long as keys are held and buttons dragged, commands once.

#include "compositor/viewer/views/navigation.hpp"
#include "compositor/window/events.hpp"

#include <optional>
#include <set>
#include <vector>

namespace rs::compositor {

class VisitorInput {
public:
    void take(const Event& event);

    // Input since the last call, which is `seconds` ago.
    NavigationInput movement(double seconds);
    // Keys that are no movement, in the order in which they went down.
    std::vector<Key> commands();
    // Position of a click of the left button (pressed and released without a drag); at most one per call.
    std::optional<glm::dvec2> click();

private:
    [[nodiscard]] bool held(Key key) const { return held_.contains(key); }
    [[nodiscard]] double balance(Key plus, Key minus) const;

    std::set<Key> held_;
    std::optional<Button> dragging_;
    glm::dvec2 pressed_at_{0};
    glm::dvec2 last_{0};
    bool dragged_ = false;  // farther than a hand shakes
    glm::dvec2 look_{0};
    glm::dvec2 pan_{0};
    double wheel_ = 0;
    std::vector<Key> commands_;
    std::optional<glm::dvec2> click_;
};

}  // namespace rs::compositor
