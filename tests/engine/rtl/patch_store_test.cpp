#include "engine/model/blocks/parallel/patch_store.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vpatch_store.h>
#include <Vpatch_store_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class PatchStoreBench final : public Bench<Module> {
public:
    PatchStoreBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(
            patches_, RS_RTL_PORTS(module, patches), [this] { return patch(); }, [this] { return free_patches_ > 0; });
        // A pixel arrives long after its patch.
        const auto has_pixel = [this] {
            return !ids_.empty() && made_patches_ == patches_.total_pushed() - static_cast<unsigned>(patches_.count());
        };
        this->input(
            pixels_, RS_RTL_PORTS(module, resolved),
            [this] {
                return model::FinishedPixel{next_id(), static_cast<std::uint32_t>(this->random_.word())};
            },
            has_pixel);
        this->input(
            empty_, RS_RTL_PORTS(module, empty),
            [this] {
                return model::FinishedPixel{next_id(), 0};
            },
            has_pixel);
        this->output(image_writes_, RS_RTL_PORTS(module, image_writes));
        this->output(patch_free_, RS_RTL_PORTS(module, patch_free), [this](const model::Done&) { ++free_patches_; });
        this->output(stripe_free_, RS_RTL_PORTS(module, stripe_free));
        this->output(view_done_scan_, RS_RTL_PORTS(module, view_done_scan));
        this->output(view_done_books_, RS_RTL_PORTS(module, view_done_books));
    }

private:
    model::PatchJob patch() {
        Random& random = this->random_;
        const auto number = [&](int low, int high) { return static_cast<int>(random.in(low, high)); };
        model::PatchJob patch;
        patch.view = random_view(registers_, random);
        patch.slot = slot_;
        patch.first_column = model::kStripeColumns * number(0, 31);
        patch.first_row = model::kPatchRows * number(0, 63);
        patch.columns = random.chance(0.3) ? 16 : number(1, 16);
        patch.rows = random.chance(0.3) ? 8 : number(1, 8);
        patch.ends_stripe = random.chance(0.5);
        patch.ends_view = patch.ends_stripe && random.chance(0.5);
        for (int row = 0; row < patch.rows; ++row) {
            for (int column = 0; column < patch.columns; ++column) {
                ids_.push_back(slot_ * model::kPatchPixels + row * model::kStripeColumns + column);
            }
        }
        slot_ = (slot_ + 1) % model::kPatchSlots;
        --free_patches_;
        ++made_patches_;
        return patch;
    }
    int next_id() {
        std::swap(ids_.back(),
                  ids_[static_cast<std::size_t>(this->random_.in(0, static_cast<std::int64_t>(ids_.size()) - 1))]);
        const int id = ids_.back();
        ids_.pop_back();
        return id;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const int view = valid_view(registers_, this->module_.view);
        this->module_.view_height = static_cast<SData>(registers_.view(view).height);
        this->module_.view_image = registers_.image(registers_.active, view);
    }

    model::RegisterFile registers_ = random_registers(this->random_);
    int slot_ = 0;
    int free_patches_ = model::kPatchSlots;
    std::uint64_t made_patches_ = 0;
    std::vector<int> ids_;  // of the pixels that are still to arrive
    model::Fifo<model::PatchJob> patches_{"patches", 2, model::PatchJob::kBits};
    model::Fifo<model::FinishedPixel> pixels_{"resolved", 4, model::FinishedPixel::kBits};
    model::Fifo<model::FinishedPixel> empty_{"empty", 4, model::FinishedPixel::kBitsOfEmpty};
    model::Fifo<model::MemoryWrite> image_writes_{"image_writes", 4, model::MemoryWrite::kBits};
    model::Fifo<model::Done> patch_free_{"patch_free", 4, 1};
    model::Fifo<model::Done> stripe_free_{"stripe_free", 2, 1};
    model::Fifo<model::Done> view_done_scan_{"view_done_scan", 2, 1};
    model::Fifo<model::Done> view_done_books_{"view_done_books", 2, 1};
    model::PatchStore block_{registers_,
                             {.patches = patches_,
                              .pixels = pixels_,
                              .empty = empty_,
                              .image_writes = image_writes_,
                              .patch_free = patch_free_,
                              .stripe_free = stripe_free_,
                              .view_done_scan = view_done_scan_,
                              .view_done_books = view_done_books_}};
};

RS_RTL_TESTS(RtlPatchStore, PatchStoreBench, patch_store)

}  // namespace
}  // namespace rs::engine::rtl
