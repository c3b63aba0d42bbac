#pragma once
// Progress of long work. Libraries take a `Progress*` (null: silent) and call advance(). Tools pass a ProgressBar,
// which draws "label [=====>   ]  45 %  12 s left" on stderr: redrawn in place on a terminal, one line per tenth
// otherwise, nothing for work that ends within half a second.

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace rs {

class Progress {
public:
    virtual ~Progress() = default;
    /// Starts a stage of `total` steps; ends the previous stage, if any.
    virtual void start(const std::string& label, std::int64_t total) = 0;
    /// Thread-safe.
    virtual void advance(std::int64_t steps = 1) = 0;
    virtual void finish() = 0;
};

class ProgressBar final : public Progress {
public:
    /// Nothing is drawn for stages that end within `silence`.
    explicit ProgressBar(bool quiet = false, std::chrono::milliseconds silence = std::chrono::milliseconds(500));
    ~ProgressBar() override;

    void start(const std::string& label, std::int64_t total) override;
    void advance(std::int64_t steps = 1) override;
    void finish() override;

private:
    using Clock = std::chrono::steady_clock;
    void draw(Clock::time_point now, bool last);

    std::mutex mutex_;
    std::string label_;
    std::int64_t total_ = 0;
    std::int64_t done_ = 0;
    int last_tenth_ = -1;
    std::chrono::milliseconds silence_;
    bool quiet_ = false;
    bool terminal_ = false;
    bool drawn_ = false;
    bool running_ = false;
    Clock::time_point begun_{};
    Clock::time_point last_draw_{};
};

}  // namespace rs
