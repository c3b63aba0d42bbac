#pragma once
// Draws rendering cycles: what the board holds and can draw on the board, at the same time the rest on the software
// core (data_module.hpp).

#include "engine/core/fast/renderer.hpp"
#include "engine/driver/board_thread.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace rs::engine {

// A view as an executor has drawn it.
struct DrawnView : ExecutedView {  // depth: empty where nobody needs it
    // It took the core; of a view that the board drew, its share of the cycle by its pixels.
    double seconds = 0;
    bool by_board = false;
};

struct PreparedView {
    std::uint32_t object = 0;
    std::shared_ptr<const Renderer> renderer;
    ViewRegisters registers;
    bool depth = false;        // is needed
    bool board_draws = false;  // if it holds the object
    [[nodiscard]] std::int64_t pixels() const { return std::int64_t{registers.width} * registers.height; }
};

class CycleExecutor {
public:
    explicit CycleExecutor(std::unique_ptr<Executor> board);

    // Null where the core draws everything. May be used from any thread.
    [[nodiscard]] BoardThread* board() const { return board_.get(); }

    // From one thread. One result for each view, in their order; fails as a whole where there is no memory.
    Result<std::vector<DrawnView>> draw(const std::vector<PreparedView>& views);

private:
    [[nodiscard]] std::vector<std::size_t> share_of_board(const std::vector<PreparedView>& views) const;
    void request_objects(const std::vector<PreparedView>& views);
    // False where the board has failed.
    bool take_from_board(const std::vector<PreparedView>& views, const std::vector<std::size_t>& share, double seconds,
                         std::vector<DrawnView>& drawn, Result<std::vector<ExecutedView>> images);

    std::unique_ptr<BoardThread> board_;
};

}  // namespace rs::engine
