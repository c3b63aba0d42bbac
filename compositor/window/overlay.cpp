#include "compositor/window/overlay.hpp"

#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"

#include <imgui.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace rs::compositor {
namespace {

constexpr float kMargin_px = 10;
constexpr float kFontSize_px = 13;  // ImGui's default, at a scale of 1

// Length at the interface's scale.
float overlay_px(float at_scale_1) {
    return at_scale_1 * ImGui::GetFontSize() / kFontSize_px;
}

struct HelpLine {
    const char* keys;
    const char* what;
};
constexpr std::array kHelp = {
    HelpLine{"W S / up down", "forward, back"},
    HelpLine{"A D", "to the left, to the right"},
    HelpLine{"left right", "turn"},
    HelpLine{"E Q", "up, down"},
    HelpLine{"shift", "faster"},
    HelpLine{"drag", "look around; examine: turn"},
    HelpLine{"right drag", "shift sideways"},
    HelpLine{"wheel", "forward; examine: nearer"},
    HelpLine{"1 2 3", "walk, fly, examine"},
    HelpLine{"page up, page down", "viewpoints"},
    HelpLine{"home", "initial viewpoint"},
    HelpLine{"click", "examine an object; on another place: end it"},
    HelpLine{"F", "wire frame"},
    HelpLine{"O", "shadows, on and off"},
    HelpLine{"T", "trace the light in a frozen view, and back"},
    HelpLine{"L", "edit the lights: click one, drag its arrows, its middle or its aim"},
    HelpLine{"control Z, Y", "undo, redo a change of light"},
    HelpLine{"control D, delete", "duplicate, delete the light"},
    HelpLine{"P  R", "screenshot, record"},
    HelpLine{"K  , .", "sequences: play, a frame back, on"},
    HelpLine{"drop a file", "add an object; open a scene, a sequence or a list of lights"},
    HelpLine{"tab", "statistics and settings"},
    HelpLine{"H", "this help"},
    HelpLine{"escape", "end examining; leave"},
};

constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                    ImGuiWindowFlags_NoNav;

constexpr ImGuiWindowFlags kMovable = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

void draw_viewpoint_menu(PanelState& state) {
    if (!ImGui::BeginMenu("viewpoints", !state.viewpoints.empty())) return;
    for (std::size_t i = 0; i < state.viewpoints.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::MenuItem(state.viewpoints[i].c_str(), nullptr, i == state.viewpoint)) state.next_viewpoint = i;
        ImGui::PopID();
    }
    ImGui::EndMenu();
}

constexpr std::array kModes = {NavigationMode::kWalk, NavigationMode::kFly, NavigationMode::kExamine};

void draw_movement_menu(PanelState& state) {
    if (!ImGui::BeginMenu("movement")) return;
    for (const NavigationMode mode : kModes) {
        if (ImGui::MenuItem(name_of(mode), nullptr, state.mode == mode)) state.mode = mode;
    }
    ImGui::EndMenu();
}

void draw_renderer_menu(PanelState& state) {
    if (!ImGui::BeginMenu("renderer")) return;
    if (ImGui::MenuItem("raster", nullptr, !state.traced)) state.traced = false;
    for (const NamedMethod& named : kTracedMethods) {
        if (!ImGui::MenuItem(named.name, nullptr, state.traced && state.method == named.method)) continue;
        state.traced = true;
        state.method = named.method;
    }
    ImGui::EndMenu();
}

void draw_toolbar(PanelState& state) {
    if (!ImGui::BeginMainMenuBar()) return;
    if (ImGui::MenuItem("open")) state.choose_file = true;
    draw_viewpoint_menu(state);
    draw_movement_menu(state);
    draw_renderer_menu(state);
    ImGui::MenuItem("record", nullptr, &state.recording);
    ImGui::MenuItem("panel", nullptr, &state.show_panel);
    ImGui::MenuItem("help", nullptr, &state.show_help);
    ImGui::Separator();
    ImGui::TextUnformatted(state.scene.c_str());
    ImGui::EndMainMenuBar();
}

void draw_figures(const PanelState& state) {
    ImGui::Text("%.1f ms a frame, %.0f frames/s", state.frame_ms, state.frame_ms > 0 ? 1000 / state.frame_ms : 0.0);
    ImGui::Text("geometry %.1f  engine %.1f  upload %.1f  composite %.1f ms", state.geometry_ms, state.engine_ms,
                state.upload_ms, state.composite_ms);
    ImGui::Text("views by core %d, by board %d; objects %.0f of %.0f MiB", state.views_by_core, state.views_by_board,
                state.memory_mib, state.budget_mib);
    ImGui::TextDisabled("%s; %s", state.executor.c_str(), state.device.c_str());
}

void draw_objects(PanelState& state) {
    if (state.objects.empty() ||
        !ImGui::BeginTable("objects", 3, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg)) {
        return;
    }
    ImGui::TableSetupColumn("object");
    ImGui::TableSetupColumn("picture");
    ImGui::TableSetupColumn("ms");
    ImGui::TableHeadersRow();
    for (std::size_t i = 0; i < state.objects.size(); ++i) {
        const ObjectLine& object = state.objects[i];
        ImGui::PushID(static_cast<int>(i));
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        if (ImGui::Selectable(object.name.c_str(), state.picked == static_cast<int>(i),
                              ImGuiSelectableFlags_SpanAllColumns)) {
            state.picked = state.picked == static_cast<int>(i) ? -1 : static_cast<int>(i);
        }
        ImGui::TableNextColumn();
        if (object.in_view) {
            ImGui::Text("%dx%d", object.width, object.height);
        } else {
            ImGui::TextDisabled("%s", object.absence.empty() ? "out of view" : object.absence.c_str());
        }
        ImGui::TableNextColumn();
        if (object.in_view) ImGui::Text("%.2f", object.milliseconds);
        ImGui::PopID();
    }
    ImGui::EndTable();
}

void draw_switches(PanelState& state) {
    for (const NavigationMode mode : kModes) {
        if (mode != NavigationMode::kWalk) ImGui::SameLine();
        if (ImGui::RadioButton(name_of(mode), state.mode == mode)) state.mode = mode;
    }
    auto speed = static_cast<float>(state.speed);
    if (ImGui::SliderFloat("speed", &speed, 0.01F, 100, "%.2f /s", ImGuiSliderFlags_Logarithmic)) state.speed = speed;
    ImGui::Checkbox("wire frame", &state.wire_frame);
    ImGui::SameLine();
    ImGui::Checkbox("shadows", &state.shadows);
    ImGui::SameLine();
    ImGui::Checkbox("traced light", &state.traced);
    if (state.traced) {
        for (const NamedMethod& named : kTracedMethods) {
            if (ImGui::RadioButton(named.name, state.method == named.method)) state.method = named.method;
            ImGui::SameLine();
        }
        ImGui::Checkbox("walk on", &state.walk_on);
        ImGui::SameLine();
        ImGui::Text("%d samples a pixel", state.passes);
    }
    ImGui::SameLine();
    ImGui::Checkbox("record", &state.recording);
    ImGui::SameLine();
    if (ImGui::Button("screenshot")) state.take_screenshot = true;
    ImGui::SameLine();
    ImGui::Checkbox("help", &state.show_help);
}

void edit_text(const char* label, std::string& text) {
    std::array<char, 512> typed{};
    std::snprintf(typed.data(), typed.size(), "%s", text.c_str());
    if (ImGui::InputText(label, typed.data(), typed.size())) text = typed.data();
}

void draw_saved_names(PanelState& state) {
    const ImGuiTreeNodeFlags flags =
        state.playback != nullptr ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None;
    if (!ImGui::TreeNodeEx("saved images and videos", flags)) return;
    edit_text("folder", state.saved.folder);
    ImGui::SameLine();
    if (ImGui::Button("...")) state.choose_folder = true;
    edit_text("image", state.saved.image);
    edit_text("video", state.saved.video);
    ImGui::TreePop();
}

void draw_panel(PanelState& state) {
    const float margin = overlay_px(kMargin_px);
    const float top = ImGui::GetFrameHeight() + margin;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({margin, top}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSizeConstraints({0, 0}, {display.x, std::max(display.y - top - margin, margin)});
    ImGui::SetNextWindowBgAlpha(0.75F);
    if (ImGui::Begin("statistics and settings", &state.show_panel, kMovable)) {
        draw_figures(state);
        draw_switches(state);
        if (state.playback != nullptr) state.playback->draw_controls();
        draw_saved_names(state);
        draw_objects(state);
        if (state.picked >= 0 && state.picked < static_cast<int>(state.objects.size())) {
            auto turn = static_cast<float>(degrees(state.turn_rad));
            if (ImGui::SliderFloat("turn", &turn, -180, 180, "%.0f degrees")) state.turn_rad = radians(turn);
        }
    }
    ImGui::End();
}

void draw_confirmation(PanelState& state) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({display.x / 2, display.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    if (ImGui::Begin("confirmation", nullptr, kPlain)) {
        ImGui::TextUnformatted(printable(state.unconfirmed).c_str());
        ImGui::TextUnformatted("Edited lights are not saved. Opening the file discards them.");
        if (ImGui::Button("open")) state.confirmed = true;
        ImGui::SameLine();
        if (ImGui::Button("cancel")) state.unconfirmed.clear();
    }
    ImGui::End();
}

void draw_help() {
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::SetNextWindowBgAlpha(0.9F);
    if (ImGui::Begin("help", nullptr, kPlain | ImGuiWindowFlags_NoInputs) &&
        ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const HelpLine& line : kHelp) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.keys);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.what);
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

void draw_news(const std::string& news) {
    const ImGuiIO& io = ImGui::GetIO();
    const float margin = overlay_px(kMargin_px);
    ImGui::SetNextWindowPos({margin, io.DisplaySize.y - margin}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowBgAlpha(0.75F);
    if (ImGui::Begin("news", nullptr, kPlain | ImGuiWindowFlags_NoInputs)) ImGui::TextUnformatted(news.c_str());
    ImGui::End();
}

void draw_frozen_notice(const std::string& notice) {
    const float top = ImGui::GetFrameHeight() + overlay_px(kMargin_px);
    ImGui::SetNextWindowPos({ImGui::GetIO().DisplaySize.x / 2, top}, ImGuiCond_Always, {0.5F, 0});
    ImGui::SetNextWindowBgAlpha(0.75F);
    if (ImGui::Begin("frozen", nullptr, kPlain | ImGuiWindowFlags_NoInputs)) ImGui::TextUnformatted(notice.c_str());
    ImGui::End();
}

}  // namespace

std::string frozen_notice(const PanelState& state) {
    if (!state.traced || state.walk_on) return "";
    return "view frozen while its light is traced: T releases it; with 'walk on' in the panel (tab) it moves";
}

Overlay::Overlay(Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // no settings file
    ImGui::StyleColorsDark();
    const auto scale = static_cast<float>(window.interface_scale());
    ImFontConfig font;
    font.SizePixels = std::floor(kFontSize_px * scale);
    font.OversampleH = font.OversampleV = 1;  // the default font is a bitmap
    font.PixelSnapH = true;
    ImGui::GetIO().Fonts->AddFontDefault(&font);
    ImGui::GetStyle().ScaleAllSizes(scale);
    ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
}

Overlay::~Overlay() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

bool Overlay::captures_mouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Overlay::captures_keys() const {
    return ImGui::GetIO().WantTextInput;
}

void Overlay::draw(PanelState& state, const std::function<void()>& more) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    draw_toolbar(state);
    if (state.show_panel) draw_panel(state);
    if (more) more();
    if (const std::string notice = frozen_notice(state); !notice.empty()) draw_frozen_notice(notice);
    if (!state.unconfirmed.empty()) draw_confirmation(state);
    if (state.show_help) draw_help();
    if (!state.news.empty()) draw_news(state.news);
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace rs::compositor
