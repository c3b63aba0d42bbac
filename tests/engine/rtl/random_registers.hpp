#pragma once
// Random contents of the register file, within the widths of the registers and the limits of the board prototype-2000.

#include "engine/model/signals/registers.hpp"
#include "engine/model/signals/stripes.hpp"
#include "tests/engine/rtl/cosimulation.hpp"

namespace rs::engine::rtl {

inline model::ObjectRegisters random_object(Random& random) {
    const auto number = [&](std::int64_t low, std::int64_t high) { return static_cast<int>(random.in(low, high)); };
    const auto address = [&] { return static_cast<model::WordAddress>(number(0, (1 << 27) - 1)); };
    model::ObjectRegisters object;
    object.valid = true;
    object.width = number(1, 512);
    object.height = number(1, 512);
    object.images = number(1, 120);
    object.planes = number(1, model::kMaxPlanes);
    object.x_cells = number(1, 1024);
    object.u_cells = number(1, 1024);
    object.x_half_q20 = number(1 << 14, 1 << number(14, 21));
    object.u_half_q28 = number(1 << 22, 1 << number(22, 29));
    object.x_cells_per_unit_q12 = static_cast<std::int32_t>((std::int64_t{object.x_cells} << 31) / object.x_half_q20 +
                                                            random.in(0, 1) * random.in(0, 4096));
    object.u_cells_per_unit_q12 = static_cast<std::int32_t>((std::int64_t{object.u_cells} << 39) / object.u_half_q28 +
                                                            random.in(0, 1) * random.in(0, 4096));
    object.luma_pitch = (object.height + 7) / 8;
    object.chroma_pitch = (half_size(object.height) + 3) / 4;
    object.alpha_pitch = (object.height + 31) / 32;
    object.luma = address();
    object.chroma = address();
    object.alpha = address();
    object.map = address();
    object.lines = address();
    return object;
}

/// A view whose registers pass register_error(): N and T are in range at both ends of every plane.
inline model::BoardView random_board_view(const model::RegisterFile& file, Random& random) {
    model::BoardView view;
    view.object = static_cast<int>(random.in(0, static_cast<std::int64_t>(file.objects.size()) - 1));
    const std::int64_t longest = random.chance(0.9) ? 24 : 512;
    view.width = static_cast<int>(random.in(1, longest));
    view.height = static_cast<int>(random.in(1, longest));
    view.b_q20 = static_cast<std::int32_t>(random.of_any_length(29));
    view.s0_q32 = random.of_any_length(36);
    view.sy_q32 = random.of_any_length(34);
    const auto ends = [&](std::int64_t& origin, std::int64_t& step) {
        origin = random.of_any_length(36);
        step = (random.of_any_length(36) - origin) / std::max(1, view.width - 1);
    };
    for (model::PlaneView& plane : view.planes) {
        plane.a_q20 = static_cast<std::int32_t>(random.of_any_length(29));
        plane.c_q20 = static_cast<std::int32_t>(random.of_any_length(29));
        ends(plane.n0_q32, plane.nx_q32);
        ends(plane.t0_q32, plane.tx_q32);
        if (random.chance(0.2)) {  // near the limit of 2^24 in q28, below which there is no ray
            plane.n0_q32 = -(std::int64_t{1} << 28) + random.in(-40, 40);
            plane.nx_q32 = random.in(-20, 20);
        }
    }
    return view;
}

/// 20 objects, and 1 to 15 views in both banks.
inline model::RegisterFile random_registers(Random& random) {
    constexpr int kObjects = 20;
    constexpr int kMostViews = 15;
    model::RegisterFile file;
    for (int n = 0; n < kObjects; ++n) file.objects.push_back(random_object(random));
    file.loaded.resize(kObjects);
    for (model::ViewBank& bank : file.banks) {
        const std::int64_t views = random.in(1, kMostViews);
        for (std::int64_t n = 0; n < views; ++n) bank.views.push_back(random_board_view(file, random));
    }
    file.active = static_cast<int>(random.in(0, 1));
    file.views_per_cycle = kMostViews;
    file.images = model::WordAddress{15} << 23;
    file.words_per_view = 512 * 256;
    file.words_per_buffer = static_cast<model::WordAddress>(kMostViews * file.words_per_view);
    for (std::size_t b = 0; b < 2; ++b) {
        for (const model::BoardView& view : file.banks[b].views) {
            file.buffer_words[b].push_back(view.words());
            file.buffer_pitches[b].push_back(view.words_per_column());
        }
    }
    return file;
}

/// Views of which every one has columns of the pipe `share`; most of its last stripe is narrow.
inline model::RegisterFile random_stripe_views(const model::StripeShare& share, Random& random) {
    model::RegisterFile file = random_registers(random);
    auto& views = file.banks[static_cast<std::size_t>(file.active)].views;
    for (std::size_t n = 0; n < views.size(); ++n) {
        const int first = share.first_column(static_cast<int>(n));
        const std::int64_t most = random.chance(0.7) ? std::min(512, first + 20) : 512;
        views[n].width = static_cast<int>(random.in(first + 1, most));
        if (first + 256 <= 512 && random.chance(0.2)) views[n].width = first + 256;  // up to its next stripe
        views[n].height = static_cast<int>(random.chance(0.8) ? random.in(1, 40) : random.in(1, 512));
    }
    return file;
}

inline int random_view(const model::RegisterFile& file, Random& random) {
    const auto& views = file.banks[static_cast<std::size_t>(file.active)].views;
    return static_cast<int>(random.in(0, static_cast<std::int64_t>(views.size()) - 1));
}

/// Number of a view that the module reads; view 0 where its number is a random value (the register holds no message).
inline int valid_view(const model::RegisterFile& file, int number) {
    const auto& views = file.banks[static_cast<std::size_t>(file.active)].views;
    return number < static_cast<int>(views.size()) ? number : 0;
}

}  // namespace rs::engine::rtl
