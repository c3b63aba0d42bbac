#pragma once
// Editing of a scene's lighting with undo: lights, environment, headlight and exposure, the selected light, and the
// undo history. Independent of window and OpenGL; not thread-safe.
//
//     LightEdits edits(state);
//     edits.begin_gesture();            // e.g. a drag: all changes until its end are one undo step
//     edits.set_light(3, moved);
//     edits.end_gesture();

#include "compositor/scene/light/scene_lights.hpp"
#include "rayspace/light/light_entry.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace rs::compositor {

struct LightingState {
    std::vector<LightEntry> entries;
    std::optional<EnvironmentEntry> environment;
    bool headlight = false;
    double exposure_ev = 0;

    bool operator==(const LightingState&) const = default;
};

// Conversion from and to the active light list; lists have no exposure.
LightingState state_of(const LightList& list, double exposure_ev);
LightList list_of(const LightingState& state);

class LightEdits {
public:
    explicit LightEdits(LightingState state) : now_{std::move(state), std::nullopt} {}

    [[nodiscard]] const LightingState& state() const { return now_.state; }
    // Increases with each change of state().
    [[nodiscard]] std::uint64_t revision() const { return revision_; }

    [[nodiscard]] std::optional<std::size_t> selected() const { return now_.selected; }
    // Clears the selection if there is no such light. Not an undo step.
    void select(std::optional<std::size_t> light);

    // Each effective change outside of gestures is an undo step.
    void set(LightingState state);
    void set_light(std::size_t index, LightEntry entry);
    // Appends a light and selects it.
    void add(LightEntry entry);
    // Copies the selected light, moves the copy by `offset` and selects it.
    void duplicate(const glm::dvec3& offset);
    void remove_selected();

    void begin_gesture();
    void end_gesture();
    // Ends the gesture and restores the state at its beginning.
    void cancel_gesture();
    [[nodiscard]] bool in_gesture() const { return gesture_.has_value(); }

    // Return false, with nothing changed, if there is no step or within a gesture.
    bool undo();
    bool redo();
    [[nodiscard]] bool can_undo() const { return !before_.empty(); }
    [[nodiscard]] bool can_redo() const { return !after_.empty(); }

private:
    struct Step {
        LightingState state;
        std::optional<std::size_t> selected;
    };
    void push_undo(Step step);
    bool apply_step(std::deque<Step>& from, std::deque<Step>& to);

    Step now_;
    std::deque<Step> before_;
    std::deque<Step> after_;
    std::optional<Step> gesture_;  // state at its beginning
    std::uint64_t revision_ = 0;
};

// A new light of a kind with default values at a location. Kinds that need a file have none yet.
LightEntry new_light(LightKind kind, const glm::dvec3& location);

// First unused name: "kitchen" -> "kitchen 2" -> "kitchen 3".
std::string free_light_name(const LightingState& state, const std::string& base);

// Name of a light in user interfaces: its own, else its kind and its number in the list, from 1; and its photometric
// file. Without control characters.
std::string light_label(const LightEntry& entry, std::size_t index);

// Steps of numbers in user interfaces: brightness by factors, which suits candles and the sun alike; lengths and
// angles by steps of a power of ten. Results have few digits. Pure; thread-safe.

// `value` times `factor`, rounded to four digits, clamped to lowest..highest; a value of 0 becomes `first`.
double scaled(double value, double factor, double first, double lowest, double highest);

// `value` plus `count` steps of 10^order, without rounding errors, clamped to lowest..highest.
double shifted(double value, int order, int count, double lowest, double highest);

// Rounds to significant digits.
double rounded_to_digits(double value, int digits);

}  // namespace rs::compositor
