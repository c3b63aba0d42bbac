#include "compositor/window/overlay.hpp"

#include "rayspace/base/conventions.hpp"

#include <imgui.h>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>

#include <array>

namespace rs::compositor {
namespace {

constexpr float kMargin_px = 10;

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
    HelpLine{"click", "pick an object"},
    HelpLine{"F", "wire frame"},
    HelpLine{"O", "shadows, on and off"},
    HelpLine{"T", "trace the light, and back"},
    HelpLine{"L", "edit the lights: click one, drag its arrows, its middle or its aim"},
    HelpLine{"control Z, Y", "undo, redo a change of light"},
    HelpLine{"control D, delete", "duplicate, delete the light"},
    HelpLine{"P  R", "screenshot, record"},
    HelpLine{"K  , .", "sequences: play, a frame back, on"},
    HelpLine{"tab", "this panel"},
    HelpLine{"H", "this help"},
    HelpLine{"escape", "leave"},
};

constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                    ImGuiWindowFlags_NoNav;

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
    for (const NavigationMode mode : {NavigationMode::kWalk, NavigationMode::kFly, NavigationMode::kExamine}) {
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

void draw_panel(PanelState& state) {
    ImGui::SetNextWindowPos({kMargin_px, kMargin_px});
    ImGui::SetNextWindowBgAlpha(0.75F);
    if (ImGui::Begin("panel", nullptr, kPlain)) {
        draw_figures(state);
        draw_switches(state);
        if (state.playback != nullptr) state.playback->draw_controls();
        draw_objects(state);
        if (state.picked >= 0 && state.picked < static_cast<int>(state.objects.size())) {
            auto turn = static_cast<float>(degrees(state.turn_rad));
            if (ImGui::SliderFloat("turn", &turn, -180, 180, "%.0f degrees")) state.turn_rad = radians(turn);
        }
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
    ImGui::SetNextWindowPos({kMargin_px, io.DisplaySize.y - kMargin_px}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowBgAlpha(0.75F);
    if (ImGui::Begin("news", nullptr, kPlain | ImGuiWindowFlags_NoInputs)) ImGui::TextUnformatted(news.c_str());
    ImGui::End();
}

}  // namespace

Overlay::Overlay(Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // no settings file
    ImGui::StyleColorsDark();
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
    if (state.show_panel) draw_panel(state);
    if (more) more();
    if (state.show_help) draw_help();
    if (!state.news.empty()) draw_news(state.news);
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace rs::compositor
