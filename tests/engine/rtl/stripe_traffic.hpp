#pragma once
// Random columns and pixels of the stripes of a pipe of `parallel`, for blocks that store columns: the first column of
// a stripe follows when all pixels of the second to last stripe are done.

#include "engine/model/signals/parallel_messages.hpp"
#include "tests/engine/rtl/random_registers.hpp"

#include <array>
#include <deque>
#include <vector>

namespace rs::engine::rtl {

class StripeTraffic {
public:
    StripeTraffic(const model::RegisterFile& registers, Random& random) : registers_(registers), random_(random) {
        for (int id = 0; id < model::kPatchIds; ++id) free_ids_[column_of(id)].push_back(id);
    }

    [[nodiscard]] bool has_column() const {
        return next_column_ != 0 || next_of_columns_ < done_ + model::kStripeSlots;
    }
    /// View, stripe and place of the next column; the rest is left to the caller.
    model::ColumnSetup column() {
        const Stripe& stripe = at(next_of_columns_);
        model::ColumnSetup setup;
        setup.view = stripe.view;
        setup.stripe = number(next_of_columns_);
        setup.column = next_column_;
        if (++next_column_ == stripe.columns) {
            next_column_ = 0;
            ++next_of_columns_;
        }
        return setup;
    }

    /// The pixels of at most four stripes are under way, one of a number at a time.
    [[nodiscard]] bool has_pixel() {
        if (next_of_pixels_ >= done_ + model::kPatchSlots) return false;
        pixel_column_ = static_cast<std::size_t>(random_.in(0, at(next_of_pixels_).columns - 1));
        return !free_ids_[pixel_column_].empty();
    }
    model::ScannedPixel pixel() {
        Stripe& stripe = at(next_of_pixels_);
        model::ScannedPixel pixel;
        pixel.id = free_ids_[pixel_column_].front();
        free_ids_[pixel_column_].pop_front();
        pixel.view = stripe.view;
        pixel.stripe = number(next_of_pixels_);
        pixel.row = static_cast<int>(random_.in(0, 511));
        pixel.rise_q24 = static_cast<std::int32_t>(random_.of_any_length(28));
        if (--stripe.to_come == 0) ++next_of_pixels_;
        return pixel;
    }
    /// A pixel has left the block for good.
    void finish(const model::ScannedPixel& pixel) {
        free_ids_[column_of(pixel.id)].push_back(pixel.id);
        const auto first = static_cast<int>(done_ % model::kStripeNumbers);
        const int index = (pixel.stripe - first + model::kStripeNumbers) % model::kStripeNumbers;
        --stripes_[static_cast<std::size_t>(index)].unfinished;
        while (!stripes_.empty() && stripes_.front().unfinished == 0 && next_of_columns_ > done_) {
            stripes_.pop_front();
            ++done_;
        }
    }

private:
    struct Stripe {
        int view = 0;
        int columns = 0;
        std::int64_t to_come = 0;  // pixels
        std::int64_t unfinished = 0;
    };
    static std::size_t column_of(int id) { return static_cast<std::size_t>(id % model::kStripeColumns); }
    static int number(std::uint64_t stripe) { return static_cast<int>(stripe % model::kStripeNumbers); }

    Stripe& at(std::uint64_t stripe) {
        while (done_ + stripes_.size() <= stripe) {
            if (random_.chance(0.4)) view_ = random_view(registers_, random_);
            const auto columns = static_cast<int>(random_.chance(0.3) ? model::kStripeColumns : random_.in(1, 16));
            const std::int64_t pixels = random_.in(1, random_.chance(0.5) ? 400 : 30);
            stripes_.push_back({view_, columns, pixels, pixels});
        }
        return stripes_[stripe - done_];
    }

    const model::RegisterFile& registers_;
    Random& random_;
    int view_ = 0;
    std::deque<Stripe> stripes_;  // from the first one that is not done
    std::uint64_t done_ = 0;      // number of stripes
    std::uint64_t next_of_columns_ = 0;
    std::uint64_t next_of_pixels_ = 0;
    int next_column_ = 0;
    std::size_t pixel_column_ = 0;
    std::array<std::deque<int>, model::kStripeColumns> free_ids_;  // [column]
};

}  // namespace rs::engine::rtl
