#pragma once
// Playback of a sequence in a visit: current frame, and its controls in the panel.

#include "compositor/playback/sequence_player.hpp"
#include "compositor/sequence/sequence.hpp"

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace rs::compositor {

class Playback {
public:
    /// \param sequence must not be null.
    Playback(std::shared_ptr<const Sequence> sequence, std::optional<Weather> weather);

    /// Advances by `seconds` since the last frame if playing. True if another frame is to be displayed.
    bool advance(double seconds);
    /// Applies the current frame for the next draw().
    Status show(FrameCompositor& compositor, Showroom& showroom);

    [[nodiscard]] std::size_t frame() const { return frame_; }
    [[nodiscard]] double frames_per_second() const { return sequence_->frames_per_second; }
    [[nodiscard]] const std::optional<Weather>& weather() const { return weather_; }
    /// Replaces the weather; nullopt: none. The frame is to be displayed again.
    void set_weather(const std::optional<Weather>& weather);
    /// Scene of the sequence in the weather, with its moving parts at their positions in the models.
    [[nodiscard]] Scene scene_in_weather() const;

    /// Camera of the frame; nullopt if the visitor navigates freely.
    [[nodiscard]] std::optional<Camera> camera(int width, int height) const;
    /// Ends the use of the sequence's camera, until it is selected in the controls.
    void release_camera() { follows_ = false; }
    /// Scene of the frame with the lights of `lit`, another state of the sequence's scene; for the tracer.
    [[nodiscard]] Scene scene(const Scene& lit) const;

    void stop() { playing_ = false; }
    void toggle() { playing_ = !playing_; }
    void step(int frames);

    /// True while a video of all frames is recorded: from the first frame, one per advance(), up to the last.
    [[nodiscard]] bool saving() const { return saving_; }
    [[nodiscard]] bool saved_all() const { return saving_ && frame_ + 1 == sequence_->frames.size() && shown_; }
    void end_saving() { saving_ = playing_ = false; }

    /// Requests since the last call.
    bool take_jpeg() { return std::exchange(jpeg_requested_, false); }
    std::string take_folder() { return std::exchange(folder_, {}); }
    bool take_quit() { return std::exchange(quit_requested_, false); }
    bool take_weather_change() { return std::exchange(weather_changed_, false); }

    /// Panel controls; call it between ImGui::Begin and End.
    void draw_controls();

private:
    void draw_weather();

    std::shared_ptr<const Sequence> sequence_;
    std::optional<Weather> weather_;
    Weather selected_weather_;  // seed, wind and visibility of the weather that is selected next
    bool weather_changed_ = false;
    std::size_t frame_ = 0;
    bool shown_ = false;
    bool playing_ = true;
    bool follows_ = true;  // uses the sequence's camera
    bool saving_ = false;
    bool jpeg_requested_ = false;
    bool quit_requested_ = false;
    double passed_s_ = 0;
    std::string folder_;
    std::array<char, 512> typed_{};
};

}  // namespace rs::compositor
