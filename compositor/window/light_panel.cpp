#include "compositor/window/light_panel.hpp"

#include "compositor/lighting/light_edits.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/light/light_model.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace rs::compositor {
namespace {

// Lengths in px at an interface scale of 1.
constexpr float kPanelMargin_px = 10;
constexpr float kWidth_px = 400;
constexpr float kField_px = 88;
constexpr float kButton_px = 44;
constexpr float kListRows = 7;
constexpr float kUnscaledFont_px = 13;
// Key of the panel's ImGui storage: the wheel changes the number under the pointer.
constexpr ImGuiID kWheelKey = 1;
const ImVec4 kWarning{1, 0.6F, 0.3F, 1};

struct Range {
    double lowest;
    double highest;
};
constexpr Range kPlaces{-kMaxLightDistance, kMaxLightDistance};
constexpr Range kPowers{0, kMaxLightStrength};
constexpr Range kLengths{kShortest, kMaxLightDistance};

float panel_px(float at_scale_1) {
    return at_scale_1 * ImGui::GetFontSize() / kUnscaledFont_px;
}

bool step_button(const char* text) {
    const bool pressed = ImGui::Button(text, {panel_px(kButton_px), 0});
    ImGui::SameLine(0, 2);
    return pressed;
}

// Notches of the wheel over the field that was drawn last.
int wheel_notches() {
    if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return 0;
    ImGui::GetStateStorage()->SetBool(kWheelKey, true);
    return static_cast<int>(std::lround(std::clamp(ImGui::GetIO().MouseWheel, -10.0F, 10.0F)));
}

// \param notches of the wheel, which the caller applies
bool drag(double& value, double speed, const Range& range, const char* format, int& notches) {
    ImGui::SetNextItemWidth(panel_px(kField_px));
    double changed = value;
    const bool moved = ImGui::DragScalar("##value", ImGuiDataType_Double, &changed, static_cast<float>(speed),
                                         &range.lowest, &range.highest, format);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("drag, or turn the wheel; double-click to type");
    notches = wheel_notches();
    ImGui::SameLine(0, 2);
    if (!moved || !std::isfinite(changed)) return false;
    changed = std::clamp(changed, range.lowest, range.highest);
    if (changed == value) return false;
    value = changed;
    return true;
}

// Buttons multiply by 10 and 1.1, the wheel by 1.1.
bool factor_field(const char* label, double& value, double first, const Range& range) {
    ImGui::PushID(label);
    double changed = value;
    const auto factor = [&](const char* text, double by) {
        if (step_button(text)) changed = scaled(value, by, first, range.lowest, range.highest);
    };
    factor("/10", 0.1);
    factor("/1.1", 1 / 1.1);
    const double speed = std::max(value, 0.1 * first) * 0.01;
    int notches = 0;
    if (double dragged = value; drag(dragged, speed, range, "%.4g", notches)) changed = dragged;
    if (notches != 0) changed = scaled(value, std::pow(1.1, notches), first, range.lowest, range.highest);
    factor("x1.1", 1.1);
    factor("x10", 10);
    ImGui::TextUnformatted(label);
    ImGui::PopID();
    return std::exchange(value, changed) != changed;
}

// Buttons add 10^order and ten times that, the wheel 10^order.
bool step_field(const char* label, double& value, int order, const Range& range) {
    ImGui::PushID(label);
    double changed = value;
    const auto step = [&](int step_order, int count) {
        char text[32];
        std::snprintf(text, sizeof text, "%+g", count * std::pow(10.0, step_order));
        if (step_button(text)) changed = shifted(value, step_order, count, range.lowest, range.highest);
    };
    step(order + 1, -1);
    step(order, -1);
    int notches = 0;
    if (double dragged = value; drag(dragged, std::pow(10.0, order) * 0.5, range, "%.5g", notches)) changed = dragged;
    if (notches != 0) changed = shifted(value, order, notches, range.lowest, range.highest);
    step(order, 1);
    step(order + 1, 1);
    ImGui::TextUnformatted(label);
    ImGui::PopID();
    return std::exchange(value, changed) != changed;
}

void triple_field(const char* what, const std::array<const char*, 3>& labels, glm::dvec3& value, int order,
                  const Range& range) {
    ImGui::PushID(what);
    for (int i = 0; i < 3; ++i) step_field(labels[static_cast<std::size_t>(i)], value[i], order, range);
    ImGui::PopID();
}

void draw_list(LightEditor& desk) {
    LightEdits& edits = desk.edits();
    if (ImGui::BeginListBox("##lights", {-1, kListRows * ImGui::GetTextLineHeightWithSpacing()})) {
        for (std::size_t i = 0; i < edits.state().entries.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            const bool selected = edits.selected() == i;
            if (ImGui::Selectable(light_label(edits.state().entries[i], i).c_str(), selected)) {
                edits.select(selected ? std::nullopt : std::optional(i));
            }
            ImGui::PopID();
        }
        ImGui::EndListBox();
    }
}

void draw_list_buttons(LightEditor& desk, const EditorView& view) {
    ImGui::SetNextItemWidth(panel_px(kField_px));
    if (ImGui::BeginCombo("##add", "add ...")) {
        for (std::size_t i = 0; i < kLightKinds; ++i) {
            const auto kind = static_cast<LightKind>(i);
            if (ImGui::Selectable(model_of(kind).words.kind)) desk.add(kind, view);
        }
        ImGui::EndCombo();
    }
    for (const auto& [text, key] : {std::pair("duplicate", Key::kDuplicate), std::pair("delete", Key::kDelete),
                                    std::pair("undo", Key::kUndo), std::pair("redo", Key::kRedo)}) {
        ImGui::SameLine();
        if (ImGui::Button(text)) desk.on_key(key);
    }
}

void edit_power(LightEntry& entry) {
    const LightWords& words = model_of(entry).words;
    if (!entry.radiance) {
        factor_field(words.power, entry.power, words.power_is_factor ? 1 : 10, kPowers);
        return;
    }
    const double most = std::max({entry.radiance->x, entry.radiance->y, entry.radiance->z});
    double changed = most;
    const std::string label =
        words.radiance + (words.radiance_unit != nullptr ? std::string(", ") + words.radiance_unit : "");
    if (factor_field(label.c_str(), changed, 1, kPowers)) {
        *entry.radiance = most > 0 ? *entry.radiance * (changed / most) : glm::dvec3(changed);
    }
}

void edit_colour(LightEntry& entry) {
    glm::vec3 colour(entry.colour);
    ImGui::SetNextItemWidth(panel_px(3 * kField_px));
    if (ImGui::ColorEdit3("colour", &colour.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR)) {
        entry.colour = glm::clamp(glm::dvec3(colour), 0.0, kMaxLightStrength);
    }
}

void edit_aim(LightEntry& entry) {
    glm::dvec3 aim = entry.aim;
    triple_field("aim", {"aim x", "aim y", "aim z"}, aim, -2, {-1e3, 1e3});
    if (glm::length(aim) > 1e-3) entry.aim = aim;
}

void edit_shape(LightEntry& entry) {
    const LightWords& words = model_of(entry).words;
    for (std::size_t i = 0; i < words.sizes.size(); ++i) {
        factor_field(words.sizes[i], entry.size[static_cast<int>(i)], 0.1, kLengths);
    }
    if (words.sizes.size() == 1) entry.size.y = entry.size.x;
    for (const LightNumber& number : words.numbers) {
        if (!step_field(number.label, entry.*number.value, 0, {number.lowest, number.highest})) continue;
        // The edited value is kept; dependent limits are adjusted.
        for (const LightNumber& other : words.numbers) {
            if (other.at_most == number.value) entry.*other.value = std::min(entry.*other.value, entry.*number.value);
        }
        if (number.at_most != nullptr) entry.*number.at_most = std::max(entry.*number.at_most, entry.*number.value);
    }
}

// Edits all parameters except the file, which the editor reads.
void edit_light(LightEntry& entry) {
    char name[128];
    std::snprintf(name, sizeof name, "%s", entry.name.c_str());
    ImGui::SetNextItemWidth(panel_px(3 * kField_px));
    if (ImGui::InputText("name", name, sizeof name)) entry.name = name;
    edit_power(entry);
    edit_colour(entry);
    const LightWords& words = model_of(entry).words;
    if (words.has_place) triple_field("place", {"x", "y", "z"}, entry.location, -2, kPlaces);
    if (words.has_aim) edit_aim(entry);
    if (words.turns) step_field("turn, degrees", entry.turn_deg, 0, {-36000, 36000});
    edit_shape(entry);
}

void draw_files(LightEditor& desk, const LightEntry& entry) {
    ImGui::SetNextItemWidth(panel_px(3 * kField_px));
    if (ImGui::BeginCombo("file", printable(entry.file.filename().string()).c_str())) {
        for (const std::filesystem::path& file : desk.files()) {
            if (!ImGui::Selectable(printable(file.filename().string()).c_str(), file == entry.file)) continue;
            if (const Status used = desk.use_file(file); !used) desk.report(used.error().message);
        }
        ImGui::EndCombo();
    }
    char folder[1024];
    std::snprintf(folder, sizeof folder, "%s", desk.folder().c_str());
    ImGui::SetNextItemWidth(panel_px(3 * kField_px));
    if (ImGui::InputText("folder", folder, sizeof folder, ImGuiInputTextFlags_EnterReturnsTrue)) {
        desk.scan_folder(folder);
    }
}

void edit_surroundings(LightingState& state) {
    step_field("exposure, stops", state.exposure_ev, -1, {-40, 40});
    if (state.headlight) ImGui::Checkbox("headlight", &state.headlight);
    if (!state.environment) return;
    factor_field("environment", state.environment->scale, 1, kPowers);
    step_field("environment rotation, degrees", state.environment->turn_deg, 0, {-36000, 36000});
    ImGui::Checkbox("environment visible", &state.environment->seen);
}

void draw_profile(LightEditor& desk) {
    char profile[1024];
    std::snprintf(profile, sizeof profile, "%s", desk.profile.c_str());
    ImGui::SetNextItemWidth(panel_px(2 * kField_px));
    if (ImGui::InputText("##profile", profile, sizeof profile)) desk.profile = profile;
    ImGui::SameLine();
    if (ImGui::Button("...")) desk.request_profile();
    ImGui::SameLine();
    if (ImGui::Button("load")) {
        if (const Status loaded = desk.load(); !loaded) desk.report(loaded.error().message);
    }
    ImGui::SameLine();
    if (ImGui::Button("save")) {
        const Status saved = desk.save();
        desk.report(saved ? desk.profile + ": saved" : saved.error().message);
    }
}

}  // namespace

void LightPanel::draw(LightEditor& desk, const EditorView& view) {
    const ImGuiIO& io = ImGui::GetIO();
    LightEdits& edits = desk.edits();
    const float margin = panel_px(kPanelMargin_px);
    const float width = panel_px(kWidth_px);
    const float top = ImGui::GetFrameHeight() + margin;  // below the toolbar
    ImGui::SetNextWindowPos({io.DisplaySize.x - margin, top}, ImGuiCond_FirstUseEver, {1, 0});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, std::max(io.DisplaySize.y - top - margin, margin)});
    ImGui::SetNextWindowBgAlpha(0.85F);
    ImGuiWindowFlags flags = ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize |
                             ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                             ImGuiWindowFlags_NoNav;
    if (wheel_is_taken_) flags |= ImGuiWindowFlags_NoScrollWithMouse;
    bool stays_open = true;
    wheel_is_taken_ = false;
    if (ImGui::Begin("lights", &stays_open, flags)) {
        ImGui::GetStateStorage()->SetBool(kWheelKey, false);
        ImGui::PushButtonRepeat(true);
        LightingState surroundings = edits.state();
        edit_surroundings(surroundings);
        const bool touched = ImGui::IsAnyItemActive();
        if (!(surroundings == edits.state())) {
            if (touched) edits.begin_gesture();
            changing_ = changing_ || touched;
            edits.set(std::move(surroundings));
        }
        ImGui::PopButtonRepeat();
        ImGui::Separator();
        draw_list(desk);
        draw_list_buttons(desk, view);
        if (!edits.selected()) {
            ImGui::TextDisabled(
                "click a light; drag its arrows, its middle\nover surfaces, or its white dot to aim it");
        }
        if (const auto selected = edits.selected()) {
            ImGui::Separator();
            ImGui::PushID(static_cast<int>(*selected));
            ImGui::PushButtonRepeat(true);
            LightEntry entry = edits.state().entries[*selected];
            edit_light(entry);
            if (!(entry == edits.state().entries[*selected])) {
                if (ImGui::IsAnyItemActive()) {
                    edits.begin_gesture();
                    changing_ = true;
                }
                edits.set_light(*selected, std::move(entry));
            }
            ImGui::PopButtonRepeat();
            if (model_of(edits.state().entries[*selected]).words.has_file) {
                draw_files(desk, edits.state().entries[*selected]);
            }
            ImGui::PopID();
            if (!desk.warning().empty()) {
                ImGui::PushTextWrapPos(0);
                ImGui::TextColored(kWarning, "%s", printable(desk.warning()).c_str());
                ImGui::PopTextWrapPos();
            }
        }
        ImGui::Separator();
        draw_profile(desk);
        wheel_is_taken_ = ImGui::GetStateStorage()->GetBool(kWheelKey);
    }
    ImGui::End();
    if (changing_ && !ImGui::IsAnyItemActive()) {
        edits.end_gesture();
        changing_ = false;
    }
    if (!stays_open) desk.open(false);
}

}  // namespace rs::compositor
