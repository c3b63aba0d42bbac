#pragma once
// View dispatcher: has all pipes with a share of a view begin it (its columns, its pixels, its books), and
// reports that a view is written when all of them have written theirs. Pipes go through the views of a rendering cycle
// each at its own pace.

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
    ViewDispatcher(const RegisterFile& registers, Fifo<ViewJob>& in, std::vector<DispatchPort> pipes,
                   Fifo<Done>& view_written);
    Activity tick(std::uint64_t now) override;
    [[nodiscard]] std::string state_text() const override { return "views " + std::to_string(views_.size()); }

private:
    bool begin_view();
    bool end_view();

    const RegisterFile& registers_;
    Fifo<ViewJob>& in_;
    std::vector<DispatchPort> pipes_;
    Fifo<Done>& view_written_;
    // Per pipe: its share is written when it has written so many views in all; 0: it has none.
    std::deque<std::vector<std::uint64_t>> views_;
    std::vector<std::uint64_t> begun_;  // per pipe
    std::vector<std::uint64_t> written_;
};

// Load broadcast: the words of the private bus go to all memory channels, which hold the same objects. An object is
// loaded when it is in all of them.

struct LoadPort {
    Fifo<MemoryWrite>* words = nullptr;
    Fifo<Done>* loaded = nullptr;
};

class LoadBroadcast final : public Block {
public:
    LoadBroadcast(Fifo<MemoryWrite>& in, std::vector<LoadPort> channels, Fifo<Done>& loaded);
    Activity tick(std::uint64_t now) override;

private:
    Fifo<MemoryWrite>& in_;
    std::vector<LoadPort> channels_;
    Fifo<Done>& loaded_;
};

}  // namespace rs::engine::model
