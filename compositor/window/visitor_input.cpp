#include "compositor/window/visitor_input.hpp"

#include <utility>

namespace rs::compositor {
namespace {

constexpr double kShaking_px = 4;

bool is_movement(Key key) {
    return key <= Key::kFast;
}

template <class... Handlers>
struct Overloaded : Handlers... {
    using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

void VisitorInput::take(const Event& event) {
    std::visit(Overloaded{[&](const KeyEvent& key) {
                              if (!is_movement(key.key)) {
                                  if (key.down) commands_.push_back(key.key);
                              } else if (key.down) {
                                  held_.insert(key.key);
                              } else {
                                  held_.erase(key.key);
                              }
                          },
                          [&](const ButtonEvent& button) {
                              if (button.down && !dragging_) {
                                  dragging_ = button.button;
                                  pressed_at_ = last_ = button.at_px;
                                  dragged_ = false;
                              } else if (!button.down && dragging_ == button.button) {
                                  if (!dragged_ && button.button == Button::kLeft) click_ = button.at_px;
                                  dragging_.reset();
                              }
                          },
                          [&](const MoveEvent& move) {
                              if (dragging_) {
                                  dragged_ = dragged_ || glm::length(move.to_px - pressed_at_) > kShaking_px;
                                  if (dragged_) (*dragging_ == Button::kLeft ? look_ : pan_) += move.to_px - last_;
                              }
                              if (!dragging_ || dragged_) last_ = move.to_px;
                          },
                          [&](const WheelEvent& wheel) { wheel_ += wheel.notches; }, [](const DropEvent&) {},
                          [&](const LostFocusEvent&) {
                              held_.clear();
                              dragging_.reset();
                          }},
               event);
}

double VisitorInput::balance(Key plus, Key minus) const {
    return (held(plus) ? 1.0 : 0.0) - (held(minus) ? 1.0 : 0.0);
}

NavigationInput VisitorInput::movement(double seconds) {
    NavigationInput input;
    input.seconds = seconds;
    input.forward = balance(Key::kForward, Key::kBack);
    input.right = balance(Key::kRight, Key::kLeft);
    input.up = balance(Key::kUp, Key::kDown);
    input.turn_left = balance(Key::kTurnLeft, Key::kTurnRight);
    input.fast = held(Key::kFast);
    input.look_px = std::exchange(look_, glm::dvec2(0));
    input.pan_px = std::exchange(pan_, glm::dvec2(0));
    input.wheel = std::exchange(wheel_, 0.0);
    return input;
}

std::vector<Key> VisitorInput::commands() {
    return std::exchange(commands_, {});
}

std::optional<glm::dvec2> VisitorInput::click() {
    return std::exchange(click_, std::nullopt);
}

}  // namespace rs::compositor
