#include "engine/model/blocks/texels/sample_place.hpp"
#include "tests/engine/rtl/cosimulation.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <Vsample_place.h>
#include <Vsample_place_mutants.h>

#include <algorithm>

namespace rs::engine::rtl {
namespace {

// Cycles between a column and its first pixel in a pipe: the latencies of ray_rise and cell_march.
constexpr std::uint64_t kCyclesBehindColumn = 38;

// Image setup whose samples are mostly in the image: near its centre, of a camera at the height of the viewpoint.
model::ImageSetup likely_image(const model::ObjectRegisters& object, std::int32_t b_q20, Random& random) {
    model::ImageSetup image;
    image.l0_q20 = random.in(1 << 16, 1 << random.in(17, 24));
    image.l1_q24 = random.of_any_length(16);
    image.q0_q12 = random.of_any_length(22);
    image.q1_q12 = random.of_any_length(12);
    image.cx_q16 = static_cast<std::int32_t>(random.in(0, object.width << 16));
    image.cy_q16 = static_cast<std::int32_t>(random.in(0, object.height << 16));
    image.fl_y_q16 = static_cast<std::int32_t>(random.in(0, 1 << 27));
    image.height_q20 = static_cast<std::int32_t>(
        std::clamp<std::int64_t>(b_q20 + random.of_any_length(22), -(1 << 28), (1 << 28) - 1));
    return image;
}

// Extreme values of the ranges in RECONSTRUCTION.md.
model::ImageSetup extreme_image(Random& random) {
    model::ImageSetup image;
    image.l0_q20 = random.of_any_length(29);
    image.l1_q24 = random.of_any_length(20);
    image.q0_q12 = random.of_any_length(30);
    image.q1_q12 = random.in(-(1 << 20), 1 << 20);
    image.cx_q16 = static_cast<std::int32_t>(random.of_any_length(31));
    image.cy_q16 = static_cast<std::int32_t>(random.of_any_length(31));
    image.fl_y_q16 = static_cast<std::int32_t>(random.in(0, (1 << 30) - 1));
    image.height_q20 = static_cast<std::int32_t>(random.of_any_length(29));
    return image;
}

template <class Module>
class SamplePlaceBench final : public Bench<Module> {
public:
    SamplePlaceBench(Module& module, Random& random) : Bench<Module>(module, random) {
        this->input(
            columns_, RS_RTL_PORTS(module, place_columns), [this] { return column(); },
            [this] { return may_send_column(); });
        this->input(
            met_, RS_RTL_PORTS(module, met), [this] { return hit(); }, [this] { return arrived_columns() > 0; });
        this->output(placed_, RS_RTL_PORTS(module, placed), [this](const model::PlacedSample& sample) {
            if (!sample.head.last) return;
            --surfaces_in_[stripes_of_surfaces_.front()];
            stripes_of_surfaces_.pop_front();
        });
    }

private:
    struct Column {
        model::ColumnSetup setup;
        int behind_q3 = 0;        // depth near which lambda becomes positive
        std::uint64_t cycle = 0;  // of its arrival
    };

    // A stripe begins when no surface of the last but one is in the module.
    bool may_send_column() {
        if (column_ < stripe_columns_) return true;
        const auto next = static_cast<std::size_t>((stripe_ + 1) % model::kStripeSlots);
        return surfaces_in_[next] == 0 && this->random_.chance(0.01);
    }
    model::ColumnSetup column() {
        Random& random = this->random_;
        if (column_ == stripe_columns_) {
            stripe_ = (stripe_ + 1) % model::kStripeNumbers;
            column_ = 0;
            stripe_columns_ = static_cast<int>(random.in(1, model::kStripeColumns));
            view_ = random_view(registers_, random);
            const int replaced = stripe_ % model::kStripeSlots;
            std::erase_if(sent_, [&](const Column& c) { return c.setup.stripe % model::kStripeSlots == replaced; });
        }
        const model::ObjectRegisters& object = registers_.object_of(view_);
        const std::int32_t b_q20 = registers_.view(view_).b_q20;
        model::ColumnSetup setup;
        setup.view = view_;
        setup.kind = static_cast<model::RayKind>(random.in(0, 3));
        setup.stripe = stripe_;
        setup.column = column_++;
        setup.image = static_cast<int>(random.in(0, object.images - 1));
        setup.image_column = static_cast<int>(random.in(0, object.width - 1));
        const bool likely = random.chance(0.7);
        setup.row_0_q16 = likely ? random.in(0, object.height << 16) : random.of_any_length(46);
        setup.row_step_q16 = random.of_any_length(likely ? 17 : 36);
        for (model::ImageSetup& image : setup.images) {
            image = random.chance(0.8) ? likely_image(object, b_q20, random) : extreme_image(random);
            image.image = static_cast<int>(random.in(0, object.images - 1));
        }
        setup.weight = static_cast<int>(random.chance(0.3) ? 256 * random.in(0, 1) : random.in(0, 256));
        setup.lambda1_q21 = random.in(0, std::int64_t{1} << random.in(0, 19));
        setup.lambda0_q20 = random.of_any_length(likely ? 22 : 30);
        const auto behind_q3 = static_cast<int>(random.in(0, 2040));
        if (random.chance(0.5)) setup.lambda0_q20 = -((behind_q3 * setup.lambda1_q21) >> 4) + random.in(-1, 1);
        if (setup.kind != model::RayKind::none) sent_.push_back({setup, behind_q3, cycle_});
        return setup;
    }
    // Columns that pixels may use: the first ones that were sent.
    std::int64_t arrived_columns() const {
        return std::count_if(sent_.begin(), sent_.end(),
                             [&](const Column& c) { return c.cycle + kCyclesBehindColumn <= cycle_; });
    }
    model::SurfaceHit hit() {
        Random& random = this->random_;
        const auto number = [&](int most) { return static_cast<int>(random.in(0, most)); };
        const Column& sent = sent_[static_cast<std::size_t>(random.in(0, arrived_columns() - 1))];
        const model::ColumnSetup& column = sent.setup;
        const auto stripe = static_cast<std::size_t>(column.stripe % model::kStripeSlots);
        ++surfaces_in_[stripe];
        stripes_of_surfaces_.push_back(stripe);
        model::SurfaceHit hit;
        hit.pixel = {number(31) * model::kStripeColumns + column.column, column.view, column.stripe, number(511),
                     static_cast<std::int32_t>(random.of_any_length(random.chance(0.7) ? 22 : 28))};
        hit.depth_q3 = random.chance(0.5) ? number(2040) : std::clamp(sent.behind_q3 + number(4) - 2, 0, 2040);
        hit.final = random.chance(0.5);
        hit.next.begin = number(model::MarchState::kFarthest);
        hit.lean = number(16);
        return hit;
    }
    model::Block& block() override { return block_; }
    void look_up() override {
        const int view = valid_view(registers_, this->module_.view);
        const model::ObjectRegisters& object = registers_.object_of(view);
        this->module_.view_b_q20 = static_cast<IData>(registers_.view(view).b_q20) & 0x1FFFFFFFU;
        this->module_.object_width = static_cast<SData>(object.width);
        this->module_.object_height = static_cast<SData>(object.height);
    }
    std::string compare() override {
        ++cycle_;
        return {};
    }

    model::RegisterFile registers_ = random_registers(this->random_);
    std::uint64_t cycle_ = 0;
    int view_ = 0;
    int stripe_ = 0;
    int column_ = 0;
    int stripe_columns_ = 0;
    std::vector<Column> sent_;
    std::array<int, model::kStripeSlots> surfaces_in_{};  // the module, of each stripe
    std::deque<std::size_t> stripes_of_surfaces_;
    model::Fifo<model::ColumnSetup> columns_{"place_columns", 2, model::ColumnSetup::kPlaceBits};
    model::Fifo<model::SurfaceHit> met_{"met", 8, model::SurfaceHit::kBits};
    model::Fifo<model::PlacedSample> placed_{"placed", 4, model::PlacedSample::kBits};
    model::SamplePlace block_{registers_, {.columns = columns_, .in = met_, .out = placed_}};
};

RS_RTL_TESTS(RtlSamplePlace, SamplePlaceBench, sample_place)

}  // namespace
}  // namespace rs::engine::rtl
