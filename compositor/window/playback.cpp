#include "compositor/window/playback.hpp"

#include <imgui.h>

#include <utility>

namespace rs::compositor {

Playback::Playback(std::shared_ptr<const Sequence> sequence, std::optional<Weather> weather)
    : sequence_(std::move(sequence)), weather_(weather), selected_weather_(weather.value_or(Weather{})) {}

void Playback::set_weather(const std::optional<Weather>& weather) {
    if (weather == weather_) return;
    weather_ = weather;
    weather_changed_ = true;
    shown_ = false;
}

Scene Playback::scene_in_weather() const {
    return weather_ ? apply_weather(sequence_->scene, *weather_) : sequence_->scene;
}

void Playback::step(int frames) {
    const auto count = static_cast<std::ptrdiff_t>(sequence_->frames.size());
    const std::ptrdiff_t to = (static_cast<std::ptrdiff_t>(frame_) + frames % count + count) % count;
    shown_ = shown_ && static_cast<std::size_t>(to) == frame_;
    frame_ = static_cast<std::size_t>(to);
}

bool Playback::advance(double seconds) {
    if (saving_) {
        if (shown_) step(1);
    } else if (playing_) {
        passed_s_ += seconds;
        const int frames = static_cast<int>(passed_s_ * sequence_->frames_per_second);
        passed_s_ -= frames / sequence_->frames_per_second;
        step(frames);
    }
    return !shown_;
}

Status Playback::show(FrameCompositor& compositor, Showroom& showroom) {
    shown_ = true;
    return show_frame(*sequence_, frame_, weather_, compositor, showroom);
}

std::optional<Camera> Playback::camera(int width, int height) const {
    if (!follows_) return std::nullopt;
    return camera_of(*sequence_, frame_, width, height);
}

Scene Playback::scene(const Scene& lit) const {
    Scene scene = scene_in_weather();
    copy_lights(lit, scene);
    return scene_at(std::move(scene), *sequence_, frame_);
}

void Playback::draw_weather() {
    const std::string now = weather_ ? weather_words(*weather_) : "none";
    if (!ImGui::BeginCombo("weather", now.c_str())) return;
    if (ImGui::Selectable("none", !weather_)) set_weather(std::nullopt);
    for (bool Weather::*const kind : {&Weather::rain, &Weather::snow, &Weather::fog}) {
        Weather weather = selected_weather_;
        weather.rain = weather.snow = weather.fog = false;
        weather.*kind = true;
        if (ImGui::Selectable(weather_words(weather).c_str(), weather_ == weather)) set_weather(weather);
    }
    ImGui::EndCombo();
}

void Playback::draw_controls() {
    ImGui::Separator();
    int frame = static_cast<int>(frame_);
    const int last = static_cast<int>(sequence_->frames.size()) - 1;
    ImGui::Checkbox("play", &playing_);
    ImGui::SameLine();
    if (ImGui::Button("<")) step(-1), playing_ = false;
    ImGui::SameLine();
    if (ImGui::Button(">")) step(1), playing_ = false;
    ImGui::SameLine();
    if (last > 0 && ImGui::SliderInt("frame", &frame, 0, last)) {
        playing_ = false;
        step(frame - static_cast<int>(frame_));
    }
    ImGui::Checkbox("its camera", &follows_);
    ImGui::SameLine();
    if (ImGui::Button("save JPEG")) jpeg_requested_ = true;
    ImGui::SameLine();
    if (last > 0 && ImGui::Button(saving_ ? "end video" : "save video")) {
        saving_ = !saving_;
        playing_ = false;
        shown_ = false;
        if (saving_) frame_ = 0;
    }
    draw_weather();
    ImGui::InputText("##sequence", typed_.data(), typed_.size());
    ImGui::SameLine();
    if (ImGui::Button("open sequence")) folder_ = typed_.data();
    if (ImGui::Button("Quit")) quit_requested_ = true;
}

}  // namespace rs::compositor
