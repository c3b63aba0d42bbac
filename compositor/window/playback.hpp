#pragma once
// A sequence that a visit plays: which frame is shown, and what the panel shows of it and does to it.

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
    // `sequence` is not null.
    Playback(std::shared_ptr<const Sequence> sequence, std::optional<Weather> weather);

    // `seconds` after the frame before: plays on where it plays. True where another frame is to be shown.
    bool advance(double seconds);
    // The frame is shown in the next draw().
    Status show(FrameCompositor& compositor, Showroom& showroom);

    [[nodiscard]] std::size_t frame() const { return frame_; }
    [[nodiscard]] double frames_per_second() const { return sequence_->frames_per_second; }
    // The frame's camera; nothing where the visitor walks for himself.
    [[nodiscard]] std::optional<Camera> camera(int width, int height) const;
    // The scene of the frame, for the tracer.
    [[nodiscard]] Scene scene() const;

    void stop() { playing_ = false; }
    void toggle() { playing_ = !playing_; }
    void step(int frames);

    // A video of all frames is requested: it begins at the first, goes on by one with each advance(), and ends here.
    [[nodiscard]] bool saving() const { return saving_; }
    [[nodiscard]] bool saved_all() const { return saving_ && frame_ + 1 == sequence_->frames.size() && shown_; }
    void end_saving() { saving_ = playing_ = false; }

    // What was requested since the last call.
    bool take_jpeg() { return std::exchange(jpeg_requested_, false); }
    std::string take_folder() { return std::exchange(folder_, {}); }

    // The lines of the panel; between ImGui::Begin and End.
    void draw_controls();

private:
    std::shared_ptr<const Sequence> sequence_;
    std::optional<Weather> weather_;
    std::size_t frame_ = 0;
    bool shown_ = false;
    bool playing_ = true;
    bool follows_ = true;  // the sequence's camera
    bool saving_ = false;
    bool jpeg_requested_ = false;
    double passed_s_ = 0;
    std::string folder_;
    std::array<char, 512> typed_{};
};

}  // namespace rs::compositor
