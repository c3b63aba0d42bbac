#pragma once
// Panel of the light editor: list of lights, parameters of the selected one in its own units, environment, exposure and
// light lists. Dear ImGui; call it between NewFrame() and Render().

#include "compositor/window/light_editor.hpp"

namespace rs::compositor {

/// Dragging, typing into a field, or holding a button is one undo step.
class LightPanel {
public:
    void draw(LightEditor& desk, const EditorView& view);

private:
    bool changing_ = false;  // a gesture of the panel is in progress
};

}  // namespace rs::compositor
