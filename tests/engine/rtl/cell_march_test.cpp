#include "engine/model/blocks/parallel/cell_march.hpp"
#include "tests/engine/rtl/stripe_traffic.hpp"

#include <Vcell_march.h>
#include <Vcell_march_mutants.h>

namespace rs::engine::rtl {
namespace {

template <class Module>
class CellMarchBench final : public Bench<Module> {
public:
    static constexpr std::int64_t kLongestEpisode = 2 * kUsualEpisode;

    CellMarchBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(
            columns_, RS_RTL_PORTS(module, march_columns), [this] { return column(); },
            [this] { return traffic_.has_column(); });
        this->input(
            words_, RS_RTL_PORTS(module, band_words), [this] { return word(); }, [this] { return words_to_come_ > 0; });
        this->input(
            rays_, RS_RTL_PORTS(module, risen), [this] { return ray(); },
            [this] { return written_ >= kDepthsOfViews && traffic_.has_pixel(); });
        this->input(
            again_, RS_RTL_PORTS(module, again), [this] { return returned(); }, [this] { return !returned_.empty(); });
        this->output(met_, RS_RTL_PORTS(module, met), [this](const model::SurfaceHit& hit) { on_hit(hit); });
        this->output(empty_, RS_RTL_PORTS(module, empty), [this](const model::FinishedPixel& pixel) {
            traffic_.finish(pixels_[static_cast<std::size_t>(pixel.id)]);
        });
    }

private:
    static constexpr int kObjectsOfViews = 2;  // all effective depths are written before the first ray
    static constexpr int kDepthsOfViews = kObjectsOfViews * EffectiveDepth::kDepths;

    model::RegisterFile random_shapes(Random& random) {
        model::RegisterFile file = random_registers(random);
        const auto number = [&](int low, int high) { return static_cast<int>(random.in(low, high)); };
        for (model::ViewBank& bank : file.banks) {
            for (model::BoardView& view : bank.views) {
                view.object = first_object_ + number(0, kObjectsOfViews - 1);
            }
        }
        for (model::ObjectRegisters& object : file.objects) {
            model::ShapeRegisters& shape = object.shape;
            shape.exists = true;
            shape.bands = number(1, random.chance(0.9) ? 20 : kMaxBands);
            shape.jump = number(1, random.chance(0.7) ? 20 : 255);
            shape.thickness = number(0, random.chance(0.7) ? 20 : 255);
            shape.foot_d_q3 = number(0, 2040);
            const int lowest = number(-EffectiveDepth::kMax_q3, 0);
            const int highest = number(0, EffectiveDepth::kMax_q3);
            for (auto& depth : shape.effective_depth_q3) depth = static_cast<std::int16_t>(number(lowest, highest));
            if (random.chance(0.7)) std::sort(shape.effective_depth_q3.begin(), shape.effective_depth_q3.end());
        }
        return file;
    }
    model::ColumnSetup column() {
        Random& random = this->random_;
        model::ColumnSetup setup = traffic_.column();
        setup.kind = random.chance(0.9) ? model::RayKind::shape : static_cast<model::RayKind>(random.in(0, 2));
        setup.weight = static_cast<int>(random.chance(0.3) ? 256 * random.in(0, 1) : random.in(0, 256));
        setup.line_part = static_cast<int>(random.in(0, 7));
        setup.p_part = static_cast<int>(random.in(0, 7));
        if (setup.kind != model::RayKind::shape) return setup;
        setup.same_cells = setup.view == view_of_cells_ && random.chance(0.6);
        view_of_cells_ = setup.view;
        if (!setup.same_cells) words_to_come_ += 4 * model::column_words(registers_.object_of(setup.view).shape.bands);
        return setup;
    }
    // Cells of a surface with gaps and steps.
    model::MemoryWord word() {
        Random& random = this->random_;
        --words_to_come_;
        std::uint64_t word = 0;
        for (unsigned n = 0; n < model::kCellsPerWord; ++n) {
            if (random.chance(0.1)) depth_ = static_cast<int>(random.in(0, 255));
            depth_ = std::clamp(depth_ + static_cast<int>(random.in(-5, 5)), 0, 255);
            const auto shown = static_cast<std::uint8_t>(random.in(1, 3));
            const std::uint16_t cell =
                random.chance(0.15) ? std::uint16_t{0} : model::packed_cell({static_cast<std::uint8_t>(depth_), shown});
            word |= std::uint64_t{cell} << (16 * n);
        }
        return {word};
    }
    model::PixelBandRay ray() {
        Random& random = this->random_;
        model::PixelBandRay ray;
        ray.pixel = traffic_.pixel();
        const int bands = registers_.object_of(ray.pixel.view).shape.bands;
        ray.foot_q12 = static_cast<std::int32_t>(random.chance(0.1) ? random.of_any_length(30)
                                                                    : random.in(-(1 << 13), (bands + 2) << 12));
        ray.per_d_q20 = static_cast<std::int32_t>(random.chance(0.05)   ? 1 << 22
                                                  : random.chance(0.05) ? random.in(-2049, -2047)
                                                                        : random.of_any_length(23));
        pixels_[static_cast<std::size_t>(ray.pixel.id)] = ray.pixel;
        return ray;
    }
    model::ReturnedPixel returned() {
        const model::ReturnedPixel pixel = returned_.front();
        returned_.pop_front();
        return pixel;
    }
    void on_hit(const model::SurfaceHit& hit) {
        if (!hit.final && this->random_.chance(0.7)) {
            returned_.push_back({hit.pixel.id, hit.next});
        } else {
            traffic_.finish(hit.pixel);
        }
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        Module& module = this->module_;
        const model::ShapeRegisters& loading = registers_.object_of(valid_view(registers_, module.loading_view)).shape;
        module.loading_shape_bands = static_cast<SData>(loading.bands);
        module.loading_shape_jump = static_cast<CData>(loading.jump);
        const model::ShapeRegisters& shape = registers_.object_of(valid_view(registers_, module.view)).shape;
        module.object_shape_bands = static_cast<SData>(shape.bands);
        module.object_shape_jump = static_cast<CData>(shape.jump);
        module.object_shape_thickness = static_cast<CData>(shape.thickness);
        module.object_shape_foot_d_q3 = static_cast<SData>(shape.foot_d_q3);
        module.view_object = static_cast<CData>(registers_.view(valid_view(registers_, module.view)).object);
        if (offered_ < 0 && this->random_.chance(written_ < kDepthsOfViews ? 0.95 : 0.3)) offered_ = next_depth();
        module.effective_depths_valid = offered_ >= 0;
        module.effective_depths_data =
            static_cast<IData>(offered_ >= 0 ? offered_ : static_cast<std::int64_t>(this->random_.word() >> 38U));
    }
    std::string compare() override {
        if (this->module_.effective_depths_valid != 0 && this->module_.effective_depths_ready != 0) {
            ++written_;
            offered_ = -1;
        }
        return {};
    }
    // Object, depth and effective depth: those of the objects of views, then of another one.
    std::int64_t next_depth() {
        const auto packed = [](std::int64_t object, std::int64_t depth, std::int64_t effective_q3) {
            return object << 21 | depth << 13 | (effective_q3 & 0x1FFF);
        };
        if (written_ >= kDepthsOfViews) {
            const std::int64_t other = (first_object_ + this->random_.in(kObjectsOfViews, 19)) % 20;
            return packed(other, this->random_.in(0, 255), this->random_.in(-4096, 4095));
        }
        const int object = first_object_ + written_ / EffectiveDepth::kDepths;
        const auto depth = static_cast<std::size_t>(written_ % EffectiveDepth::kDepths);
        const auto& shape = registers_.objects[static_cast<std::size_t>(object)].shape;
        return packed(object, static_cast<std::int64_t>(depth), shape.effective_depth_q3[depth]);
    }

    int first_object_ = static_cast<int>(this->random_.in(0, 18));  // the first one that views show
    int written_ = 0;                                               // effective depths
    std::int64_t offered_ = -1;                                     // the next one; -1: none
    model::RegisterFile registers_ = random_shapes(this->random_);
    StripeTraffic traffic_{registers_, this->random_};
    int view_of_cells_ = -1;  // view of the last column with cells
    int words_to_come_ = 0;
    int depth_ = 0;  // of the last cell
    std::array<model::ScannedPixel, model::kPatchIds> pixels_;
    std::deque<model::ReturnedPixel> returned_;
    model::Fifo<model::ColumnSetup> columns_{"march_columns", 2, model::ColumnSetup::kMarchBits};
    model::Fifo<model::MemoryWord> words_{"band_words", 8, model::MemoryWord::kBits};
    model::Fifo<model::PixelBandRay> rays_{"risen", 4, model::PixelBandRay::kBits};
    model::Fifo<model::ReturnedPixel> again_{"again", 16, model::ReturnedPixel::kBits};
    model::Fifo<model::SurfaceHit> met_{"met", 8, model::SurfaceHit::kBits};
    model::Fifo<model::FinishedPixel> empty_{"empty", 4, model::FinishedPixel::kBitsOfEmpty};
    model::CellMarch block_{
        registers_, {.columns = columns_, .words = words_, .in = rays_, .again = again_, .met = met_, .empty = empty_}};
};

RS_RTL_TESTS(RtlCellMarch, CellMarchBench, cell_march)

}  // namespace
}  // namespace rs::engine::rtl
