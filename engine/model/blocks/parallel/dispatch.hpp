#pragma once
// View dispatcher: starts a view (columns, pixels, codebooks) in all pipes with a share of it, and reports the view as
// written when all of them have written their shares. Every pipe passes through the views of a rendering cycle at its
// own pace.

#include "engine/model/clock/block.hpp"
#include "engine/model/signals/messages.hpp"
#include "engine/model/signals/registers.hpp"
#include "engine/model/signals/stripes.hpp"

#include <deque>
#include <vector>

namespace rs::engine::model {

struct DispatchPort {
    Fifo<ViewJob>* columns = nullptr;
    Fifo<ViewJob>* pixels = nullptr;
    Fifo<ViewJob>* books = nullptr;
    Fifo<Done>* written = nullptr;
};

class ViewDispatcher final : public Block {
public:
    struct Ports {
        Fifo<ViewJob>& in;
        std::vector<DispatchPort> pipes;
        Fifo<Done>& view_written;
    };
    ViewDispatcher(const RegisterFile& registers, const Ports& ports);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return "views " + std::to_string(views_.size()); }

private:
    bool begin_view();
    bool end_view();

    const RegisterFile& registers_;
    Fifo<ViewJob>& in_;
    std::vector<DispatchPort> pipes_;
    Fifo<Done>& view_written_;
    // Per pipe: number of views written in total at which its share is complete; 0: no share.
    std::deque<std::vector<std::uint64_t>> views_;
    std::vector<std::uint64_t> begun_;  // per pipe
    std::vector<std::uint64_t> written_;
};

// Load broadcast: sends the words of the private bus to all memory channels, which hold the same objects. An object is
// loaded when it is in all of them.

struct LoadPort {
    Fifo<MemoryWrite>* words = nullptr;
    Fifo<Done>* loaded = nullptr;
};

class LoadBroadcast final : public Block {
public:
    struct Ports {
        Fifo<MemoryWrite>& in;
        std::vector<LoadPort> channels;
        Fifo<Done>& loaded;
    };
    explicit LoadBroadcast(const Ports& ports);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<MemoryWrite>& in_;
    std::vector<LoadPort> channels_;
    Fifo<Done>& loaded_;
};

}  // namespace rs::engine::model
