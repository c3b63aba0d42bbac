#include "compositor/lighting/light_edits.hpp"

#include "rayspace/base/printable.hpp"
#include "rayspace/light/light_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rs::compositor {
namespace {

constexpr std::size_t kMaxSteps = 256;
constexpr std::size_t kMaxHistoryLights = 1U << 18U;  // lights in all undo steps: about 100 MiB

}  // namespace

LightingState state_of(const LightList& list, double exposure_ev) {
    return {list.entries, list.environment_entry, list.headlight, exposure_ev};
}

LightList list_of(const LightingState& state) {
    LightList list;
    list.replace = true;
    list.headlight = state.headlight;
    list.entries = state.entries;
    for (const LightEntry& entry : state.entries) list.lights.push_back(light_of(entry));
    list.environment_entry = state.environment;
    list.environment = environment_of(state.environment);
    return list;
}

void LightEdits::push_undo(Step step) {
    after_.clear();
    before_.push_back(std::move(step));
    const std::size_t each = now_.state.entries.size() + 1;
    while (before_.size() > std::clamp<std::size_t>(kMaxHistoryLights / each, 1, kMaxSteps)) before_.pop_front();
}

void LightEdits::select(std::optional<std::size_t> light) {
    now_.selected = light && *light < now_.state.entries.size() ? light : std::nullopt;
}

void LightEdits::set(LightingState state) {
    if (state == now_.state) return;
    if (!gesture_) push_undo(now_);
    now_.state = std::move(state);
    select(now_.selected);
    ++revision_;
}

void LightEdits::set_light(std::size_t index, LightEntry entry) {
    if (index >= now_.state.entries.size() || entry == now_.state.entries[index]) return;
    if (!gesture_) push_undo(now_);
    now_.state.entries[index] = std::move(entry);
    ++revision_;
}

void LightEdits::add(LightEntry entry) {
    LightingState changed = now_.state;
    changed.entries.push_back(std::move(entry));
    set(std::move(changed));
    select(now_.state.entries.size() - 1);
}

void LightEdits::duplicate(const glm::dvec3& offset) {
    if (!now_.selected) return;
    LightEntry copy = now_.state.entries[*now_.selected];
    if (model_of(copy).words.has_place) copy.location += offset;
    if (!copy.name.empty()) copy.name = free_light_name(now_.state, copy.name);
    add(std::move(copy));
}

void LightEdits::remove_selected() {
    if (!now_.selected) return;
    LightingState changed = now_.state;
    changed.entries.erase(changed.entries.begin() + static_cast<std::ptrdiff_t>(*now_.selected));
    if (!gesture_) push_undo(now_);
    now_ = {std::move(changed), std::nullopt};
    ++revision_;
}

void LightEdits::begin_gesture() {
    if (!gesture_) gesture_ = now_;
}

void LightEdits::end_gesture() {
    if (!gesture_) return;
    Step began = std::move(*gesture_);
    gesture_.reset();
    if (!(began.state == now_.state)) push_undo(std::move(began));
}

void LightEdits::cancel_gesture() {
    if (!gesture_) return;
    if (!(gesture_->state == now_.state)) ++revision_;
    now_ = std::move(*gesture_);
    gesture_.reset();
}

bool LightEdits::apply_step(std::deque<Step>& from, std::deque<Step>& to) {
    if (gesture_ || from.empty()) return false;
    to.push_back(std::move(now_));
    now_ = std::move(from.back());
    from.pop_back();
    ++revision_;
    return true;
}

bool LightEdits::undo() {
    return apply_step(before_, after_);
}

bool LightEdits::redo() {
    return apply_step(after_, before_);
}

LightEntry new_light(LightKind kind, const glm::dvec3& location) {
    LightEntry entry = model_of(kind).example();
    entry.kind = kind;
    if (model_of(kind).words.has_place) entry.location = location;
    return entry;
}

std::string free_light_name(const LightingState& state, const std::string& base) {
    const std::size_t digits = base.find_last_not_of("0123456789");
    const bool numbered = digits != std::string::npos && digits + 1 < base.size() && base[digits] == ' ';
    const std::string stem = numbered ? base.substr(0, digits) : base;
    for (std::size_t number = 2;; ++number) {
        std::string name = stem + " " + std::to_string(number);
        if (std::ranges::none_of(state.entries, [&](const LightEntry& entry) { return entry.name == name; }))
            return name;
    }
}

std::string light_label(const LightEntry& entry, std::size_t index) {
    const std::string own = printable(entry.name);
    std::string label = own.empty() ? model_of(entry).words.kind + (" " + std::to_string(index + 1)) : own;
    if (!entry.file.empty()) label += " (" + printable(entry.file.filename().string()) + ")";
    return label;
}

double rounded_to_digits(double value, int digits) {
    if (value == 0 || !std::isfinite(value)) return value;
    const int order = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1 - digits;
    // Only non-negative powers of ten are exact.
    const double power = std::pow(10.0, std::abs(order));
    return order < 0 ? std::round(value * power) / power : std::round(value / power) * power;
}

double scaled(double value, double factor, double first, double lowest, double highest) {
    constexpr int kDigits = 4;
    const double changed = value > 0 ? value * factor : factor > 1 ? first : value;
    return std::clamp(rounded_to_digits(changed, kDigits), lowest, highest);
}

double shifted(double value, int order, int count, double lowest, double highest) {
    constexpr int kDigitsBelow = 6;  // decimals kept below the step's digit
    const double power = std::pow(10.0, std::abs(order));
    const double step = order < 0 ? count / power : count * power;
    const double fine = std::pow(10.0, kDigitsBelow + std::max(-order, 0));
    return std::clamp(std::round((value + step) * fine) / fine, lowest, highest);
}

}  // namespace rs::compositor
