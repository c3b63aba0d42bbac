#include "compositor/viewer/residency/object_source.hpp"

#include "rayspace/format/object_file.hpp"

#include <tbb/task_arena.h>

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <utility>

namespace rs::compositor {
namespace {

constexpr int kLowPriority = 5;  // "nice" value

// Progress at the steps of loading, about proportional to their time.
constexpr float kBegun = 0.05F;
constexpr float kRead = 0.7F;

class FileObjectSource final : public ObjectSource {
public:
    FileObjectSource(std::shared_ptr<const engine::RenderSession> engine, bool background)
        : engine_(std::move(engine)), background_(background), arena_(background ? 1 : tbb::task_arena::automatic) {}

    Result<std::int64_t> most_bytes(const std::filesystem::path& file) override {
        RS_ASSIGN_OR_RETURN(const auto container, ContainerReader::open(file));
        RS_ASSIGN_OR_RETURN(const ReadMemory reading, estimate_read_memory(container));
        const std::int64_t texels = engine::TexelStore::bytes_of_images(reading.width, reading.height, reading.images);
        // A board gets a copy of its own, made from a possibly modified object.
        const int copies = engine_->has_board() ? 3 : 1;
        return std::max(reading.most_bytes, copies * reading.object_bytes + texels);
    }

    Result<ViewableObject> read(const std::filesystem::path& file, std::int64_t most_bytes,
                                const ProgressCallback& on_progress) override {
        if (background_ && !slowed_) {  // always called on the same thread
            slowed_ = true;
            static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kLowPriority));
        }
        try {
            return arena_.execute(
                [&]() -> Result<ViewableObject> { return read_in_arena(file, most_bytes, on_progress); });
        } catch (const std::bad_alloc&) {
            return Error{file.string() + ": not enough memory; lower the budget (--memory)"};
        }
    }

private:
    Result<ViewableObject> read_in_arena(const std::filesystem::path& file, std::int64_t most_bytes,
                                         const ProgressCallback& on_progress) const {
        on_progress(kBegun);
        RS_ASSIGN_OR_RETURN(const auto container, ContainerReader::open(file));
        // The file may have changed since peak_bytes() was computed.
        RS_ASSIGN_OR_RETURN(RaySpaceObject object,
                            read_object(container, {.memory_cap_bytes = static_cast<std::uint64_t>(most_bytes)}));
        on_progress(kRead);
        Result<std::shared_ptr<const RaySpaceObject>> for_board = engine_->convert_for_board(object);
        object.coded.reset();  // already unpacked
        RS_ASSIGN_OR_RETURN(ViewableObject viewable, make_viewable(std::move(object)));
        if (for_board)
            viewable.for_board = *std::move(for_board);
        else
            viewable.not_on_board = for_board.error().message;
        on_progress(1);
        return viewable;
    }

    std::shared_ptr<const engine::RenderSession> engine_;
    bool background_;
    bool slowed_ = false;
    tbb::task_arena arena_;
};

}  // namespace

std::unique_ptr<ObjectSource> make_file_source(std::shared_ptr<const engine::RenderSession> engine, bool background) {
    return std::make_unique<FileObjectSource>(std::move(engine), background);
}

}  // namespace rs::compositor
