#pragma once
// What is edited of a scene's light, and the way back: lights, environment, headlight and exposure, which of the lights
// is selected, and every state before and after. No window, no OpenGL; one thread.
//
//     LightEdits edits(state);
//     edits.begin_gesture();            // a drag: all changes until its end are one step of undo()
//     edits.set_light(3, moved);
//     edits.end_gesture();

#include "compositor/scene/light/scene_lights.hpp"
#include "rayspace/light/light_entry.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

namespace rs::compositor {

struct LightingState {
    std::vector<LightEntry> entries;
    std::optional<EnvironmentEntry> environment;
    bool headlight = false;
    double exposure_ev = 0;

    bool operator==(const LightingState&) const = default;
};

// The list in force, and back: lists hold no exposure.
LightingState state_of(const LightList& list, double exposure_ev);
LightList list_of(const LightingState& state);

class LightEdits {
public:
    explicit LightEdits(LightingState state) : now_{std::move(state), std::nullopt} {}

    [[nodiscard]] const LightingState& state() const { return now_.state; }
    // Grows with each change of state().
    [[nodiscard]] std::uint64_t revision() const { return revision_; }

    [[nodiscard]] std::optional<std::size_t> selected() const { return now_.selected; }
    // Nothing is selected where there is no such light. No step of its own.
    void select(std::optional<std::size_t> light);

    // Each is a step, outside of gestures, where it changes anything.
    void set(LightingState state);
    void set_light(std::size_t index, LightEntry entry);
    // At the end of the list, and selected.
    void add(LightEntry entry);
    // The selected light; its copy is selected and is `beside` away.
    void duplicate(const glm::dvec3& beside);
    void remove_selected();

    void begin_gesture();
    void end_gesture();
    // Back to how it was when the gesture began, which ends.
    void cancel_gesture();
    [[nodiscard]] bool in_gesture() const { return gesture_.has_value(); }

    // False, with nothing changed, where there is no step to take, or within a gesture.
    bool undo();
    bool redo();
    [[nodiscard]] bool can_undo() const { return !before_.empty(); }
    [[nodiscard]] bool can_redo() const { return !after_.empty(); }

private:
    struct Step {
        LightingState state;
        std::optional<std::size_t> selected;
    };
    void remember(Step step);
    bool travel(std::deque<Step>& from, std::deque<Step>& to);

    Step now_;
    std::deque<Step> before_;
    std::deque<Step> after_;
    std::optional<Step> gesture_;  // as it began
    std::uint64_t revision_ = 0;
};

// A light of the kind that is easily found at a place; what needs a file has none yet.
LightEntry new_light(LightKind kind, const glm::dvec3& location);

// "kitchen" -> "kitchen 2" -> "kitchen 3": the first that no light has.
std::string free_light_name(const LightingState& state, const std::string& like);

}  // namespace rs::compositor
