#include "engine/driver/cycle_executor.hpp"

#include "engine/core/definition/mix_rings.hpp"
#include "engine/core/fast/core_executor.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <utility>

namespace rs::engine {
namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

DrawnView render_on_core(const PreparedView& view) {
    const auto begin = std::chrono::steady_clock::now();
    CoreExecutor core;
    const int slot = core.add(view.renderer);
    Result<std::vector<ExecutedView>> drawn =
        core.render({{.slot = slot, .registers = view.registers, .depth = view.depth}});
    return {std::move(drawn.value().front()), seconds_since(begin)};
}

}  // namespace

CycleExecutor::CycleExecutor(std::unique_ptr<Executor> board) {
    if (board) board_ = std::make_unique<BoardThread>(std::move(board));
}

// Indices of the views that the board renders. Requires a reserved board.
std::vector<std::size_t> CycleExecutor::select_board_views(const std::vector<PreparedView>& views) const {
    std::vector<std::size_t> share;
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (!views[v].board_can_render || !board_->holds(views[v].object)) continue;
        if (share.size() == static_cast<std::size_t>(board_->device().traits().views_per_cycle)) break;
        share.push_back(v);
    }
    return share;
}

// Objects that are not on the board are loaded after the current cycle.
void CycleExecutor::request_objects(const std::vector<PreparedView>& views) {
    std::vector<std::uint32_t> requested;
    for (const PreparedView& view : views) {
        if (view.board_can_render) requested.push_back(view.object);
    }
    board_->request(requested);
}

bool CycleExecutor::store_board_images(const std::vector<PreparedView>& views, const std::vector<std::size_t>& share,
                                       double seconds, std::vector<DrawnView>& drawn,
                                       Result<std::vector<ExecutedView>> images) {
    if (!images) return false;
    std::int64_t all = 0;
    for (const std::size_t v : share) all += views[v].pixels();
    for (std::size_t n = 0; n < share.size(); ++n) {
        DrawnView& view = drawn[share[n]];
        const double part =
            static_cast<double>(views[share[n]].pixels()) / static_cast<double>(std::max(all, std::int64_t{1}));
        static_cast<ExecutedView&>(view) = std::move((*images)[n]);
        view.seconds = seconds * part;
        view.by_board = true;
    }
    return true;
}

Result<std::vector<DrawnView>> CycleExecutor::draw_unmixed(const std::vector<PreparedView>& views) {
    const bool reserved = board_ && board_->reserve();
    const std::vector<std::size_t> share = reserved ? select_board_views(views) : std::vector<std::size_t>();
    std::vector<bool> on_board(views.size());
    std::vector<BoardThread::ObjectView> for_board;
    for (const std::size_t v : share) {
        on_board[v] = true;
        for_board.push_back({views[v].object, views[v].registers, views[v].may_defer});
    }
    const auto begin = std::chrono::steady_clock::now();
    if (reserved) board_->draw(std::move(for_board));
    if (board_) request_objects(views);
    std::vector<DrawnView> drawn(views.size());
    std::optional<Error> failure;
    const auto draw_on_core = [&](std::size_t v) {
        try {
            if (!failure) drawn[v] = render_on_core(views[v]);
        } catch (const std::exception& escaped) {  // such as std::bad_alloc for fifteen very large views
            failure = Error{std::string("cannot render the cycle: ") + escaped.what()};
        }
    };
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (!on_board[v]) draw_on_core(v);
    }
    if (!share.empty()) {
        Result<std::vector<ExecutedView>> images = board_->wait();
        const double seconds = seconds_since(begin);
        if (!store_board_images(views, share, seconds, drawn, std::move(images))) {
            for (const std::size_t v : share) draw_on_core(v);  // the board failed
        }
    }
    if (failure) return *failure;
    return drawn;
}

Result<std::vector<DrawnView>> CycleExecutor::draw(const std::vector<PreparedView>& views) {
    if (std::ranges::none_of(views, [](const PreparedView& view) { return view.second.has_value(); })) {
        return draw_unmixed(views);
    }
    std::vector<PreparedView> all = views;
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (!views[v].second) continue;
        all[v].may_defer = false;
        all.push_back(all[v]);
        all.back().registers = *views[v].second;
    }
    RS_ASSIGN_OR_RETURN(std::vector<DrawnView> drawn, draw_unmixed(all));
    std::size_t next = views.size();
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (!views[v].second) continue;
        const DrawnView& second = drawn[next++];
        mix_rings(drawn[v].image, drawn[v].depth_q20, second.image, second.depth_q20, views[v].weight_q8);
        drawn[v].seconds += second.seconds;
        drawn[v].by_board = drawn[v].by_board && second.by_board;
    }
    drawn.resize(views.size());
    return drawn;
}

}  // namespace rs::engine
