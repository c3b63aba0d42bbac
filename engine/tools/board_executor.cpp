#include "engine/tools/board_executor.hpp"

#include "engine/model/board.hpp"
#include "engine/model/layout/object_image.hpp"

#include <memory>
#include <utility>

namespace rs::engine {
namespace {

// A board with raw pictures rounds alpha to 2 bits; it can be compared with the definition only where that changes
// nothing.
bool has_board_alpha(const RaySpaceObject& object) {
    return model::with_board_alpha(object).pictures == object.pictures;
}

}  // namespace

Result<Executor> board_executor(const std::string& config) {
    const Result<model::BoardConfig> read = model::read_board_config(config);
    if (!read) return read.error();
    return Executor{
        "board:" + read->name,
        [config = *read](const ConformanceCase& of_case, const RaySpaceObject& object) -> Result<ExecuteView> {
            if (Status status = model::drawable(object, config.limits); !status) return status.error();
            if (!config.limits.coded_pictures && !has_board_alpha(object))
                return Error{"its alpha has values that the board's 2 bits do not hold"};
            const auto board = std::make_shared<model::Board>(config);
            const Result<int> slot = board->place(object);
            if (!slot) return slot.error();
            return ExecuteView([board, slot = *slot, &of_case](std::size_t v) -> Result<ExecutedView> {
                const Result<model::BoardView> view = board->view(slot, of_case.views[v].registers);
                if (!view) return view.error();
                Result<model::BoardRun> run = board->render({{*view}});
                if (!run) return run.error();
                return ExecutedView{std::move(run->cycles.front().pictures.front()), {}};
            });
        }};
}

}  // namespace rs::engine
