#include "rayspace/base/progress.hpp"

#include "rayspace/base/printable.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rs {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr double kRedraw_s = 0.1;
constexpr int kBarCharacters = 30;

std::string duration_text(double seconds) {
    const auto whole = static_cast<std::int64_t>(std::llround(std::max(0.0, seconds)));
    if (whole < 100) return std::to_string(whole) + " s";
    if (whole < 100 * 60) return std::to_string((whole + 30) / 60) + " min";
    return std::to_string((whole + 1800) / 3600) + " h";
}

}  // namespace

ProgressBar::ProgressBar(bool quiet, std::chrono::milliseconds silence)
    : silence_(silence), quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
    finish();
}

void ProgressBar::start(const std::string& label, std::int64_t total) {
    finish();
    const std::lock_guard lock(mutex_);
    label_ = printable(label);
    total_ = total;
    done_ = 0;
    last_tenth_ = 0;
    drawn_ = false;
    running_ = true;
    begun_ = Clock::now();
    last_draw_ = begun_;
}

void ProgressBar::advance(std::int64_t steps) {
    const std::lock_guard lock(mutex_);
    if (!running_) return;
    done_ += steps;
    if (quiet_ || total_ <= 0) return;
    const Clock::time_point now = Clock::now();
    if (now - begun_ < silence_) return;
    const int tenth = static_cast<int>(std::min<std::int64_t>(10, 10 * done_ / total_));
    if (terminal_ ? Seconds(now - last_draw_).count() >= kRedraw_s : tenth > last_tenth_) {
        last_tenth_ = tenth;
        draw(now, false);
    }
}

void ProgressBar::finish() {
    const std::lock_guard lock(mutex_);
    if (!running_) return;
    running_ = false;
    // A visible bar is completed, so that none remains at 97 %.
    if (drawn_ && (terminal_ || last_tenth_ < 10)) draw(Clock::now(), true);
}

void ProgressBar::draw(Clock::time_point now, bool last) {
    const double fraction = std::clamp(static_cast<double>(done_) / static_cast<double>(total_), 0.0, 1.0);
    const double elapsed_s = Seconds(now - begun_).count();
    const int percent = static_cast<int>(fraction * 100);
    const std::string time = last || fraction >= 1 || fraction <= 0
                                 ? duration_text(elapsed_s)
                                 : duration_text(elapsed_s * (1 - fraction) / fraction) + " left";
    if (terminal_) {
        const int filled = static_cast<int>(fraction * kBarCharacters);
        std::string bar(static_cast<std::size_t>(filled), '=');
        if (filled < kBarCharacters) bar += '>';
        bar.resize(kBarCharacters, ' ');
        // "\033[K" clears the rest of a longer previous line.
        std::fprintf(stderr, "\r%s [%s] %3d %%  %s\033[K%s", label_.c_str(), bar.c_str(), percent, time.c_str(),
                     last ? "\n" : "");
    } else {
        std::fprintf(stderr, "%s: %d %%  %s\n", label_.c_str(), percent, time.c_str());
    }
    std::fflush(stderr);
    drawn_ = true;
    last_draw_ = now;
}

}  // namespace rs
