#pragma once
// Renders rendering cycles (render_session.hpp): views that the board can render on the board, concurrently all other
// views on the software core.

#include "engine/core/fast/renderer.hpp"
#include "engine/driver/board_thread.hpp"
#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rs::engine {

// A rendered view; depth is empty unless requested.
struct DrawnView : ExecutedView {
    // Rendering time on the core; on the board, the view's share of the cycle's time by its pixels.
    double seconds = 0;
    bool by_board = false;
};

struct PreparedView {
    std::uint32_t object = 0;
    std::shared_ptr<const Renderer> renderer;
    ViewRegisters registers;
    std::optional<ViewRegisters> second;  // of a view between two rings (mix_rings.hpp)
    int weight_q8 = 0;
    bool depth = false;             // depth is requested
    bool board_can_render = false;  // once the object is in its memory
    bool may_defer = false;         // ExecutedView::deferred is accepted
    [[nodiscard]] std::int64_t pixels() const { return std::int64_t{registers.width} * registers.height; }
};

class CycleExecutor {
public:
    explicit CycleExecutor(std::unique_ptr<Executor> board);

    /// Null without a board. Thread-safe.
    [[nodiscard]] BoardThread* board() const { return board_.get(); }

    /// Renders a cycle. Must be called from one thread at a time.
    /// \return one result per view, in the same order; an error if memory is exhausted
    Result<std::vector<DrawnView>> draw(const std::vector<PreparedView>& views);

private:
    Result<std::vector<DrawnView>> draw_unmixed(const std::vector<PreparedView>& views);
    [[nodiscard]] std::vector<std::size_t> select_board_views(const std::vector<PreparedView>& views) const;
    void request_objects(const std::vector<PreparedView>& views);
    // Moves the images of the board to `drawn`; returns false if the board failed.
    bool store_board_images(const std::vector<PreparedView>& views, const std::vector<std::size_t>& share,
                            double seconds, std::vector<DrawnView>& drawn, Result<std::vector<ExecutedView>> images);

    std::unique_ptr<BoardThread> board_;
};

}  // namespace rs::engine
