#pragma once
// Window events, independent of the window library, so that event handling can be tested without a window.

#include <glm/glm.hpp>

#include <string>
#include <variant>
#include <vector>

namespace rs::compositor {

enum class Key {
    kForward,            // W, up arrow
    kBack,               // S, down
    kLeft,               // A
    kRight,              // D
    kTurnLeft,           // left arrow
    kTurnRight,          // right arrow
    kUp,                 // E, space
    kDown,               // Q, C
    kFast,               // shift
    kWalk,               // 1
    kFly,                // 2
    kExamine,            // 3
    kNextViewpoint,      // page down
    kPreviousViewpoint,  // page up
    kHome,               // home
    kHelp,               // F1, H
    kPanel,              // tab
    kWireFrame,          // F
    kShadows,            // O
    kTrace,              // T
    kLights,             // L
    kUndo,               // control Z
    kRedo,               // control Y, control shift Z
    kDuplicate,          // control D
    kDelete,             // delete
    kScreenshot,         // P
    kRecord,             // R
    kPlay,               // K
    kFrameBack,          // comma
    kFrameOn,            // full stop
    kQuit,               // escape
};

enum class Button { kLeft, kRight };

struct KeyEvent {
    Key key = Key::kForward;
    bool down = false;
};
struct ButtonEvent {
    Button button = Button::kLeft;
    bool down = false;
    glm::dvec2 at_px{0};  // of the framebuffer, from the upper left
};
struct MoveEvent {
    glm::dvec2 to_px{0};
};
struct WheelEvent {
    double notches = 0;  // forward
};
/// Files or folders were dropped onto the window.
struct DropEvent {
    std::vector<std::string> paths;
    glm::dvec2 at_px{0};
};
/// The window lost the focus; releases of held keys will not be reported.
struct LostFocusEvent {};

using Event = std::variant<KeyEvent, ButtonEvent, MoveEvent, WheelEvent, DropEvent, LostFocusEvent>;

}  // namespace rs::compositor
