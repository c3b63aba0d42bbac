#pragma once
// The panel of a light desk (light_desk.hpp): the list of lights, the numbers of the selected one in the units of its
// list, environment and exposure, profiles. Dear ImGui; between its NewFrame() and Render().

#include "compositor/window/light_desk.hpp"

namespace rs::compositor {

// A field that is dragged or typed into is one step of undo, a button pressed and held too.
class LightPanel {
public:
    void draw(LightDesk& desk, const DeskView& view);

private:
    bool changing_ = false;  // a gesture of the panel's
};

}  // namespace rs::compositor
