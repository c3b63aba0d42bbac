#pragma once
// Panel of the light editor: list of lights, parameters of the selected one in its own units, environment, exposure and
// light lists. Dear ImGui; call it between NewFrame() and Render().

#include "compositor/window/light_editor.hpp"

namespace rs::compositor {

/// Window at the right edge that can be moved. Numbers change by dragging, by the wheel, by buttons and by typing.
/// Dragging, typing into a field, or holding a button is one undo step, and so is a notch of the wheel.
class LightPanel {
public:
    void draw(LightEditor& desk, const EditorView& view);

private:
    bool changing_ = false;        // a gesture of the panel is in progress
    bool wheel_is_taken_ = false;  // the pointer is over a number, so that the wheel does not scroll the panel
};

}  // namespace rs::compositor
