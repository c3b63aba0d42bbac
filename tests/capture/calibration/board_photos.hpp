#pragma once
// Rendered photos of a drum on a printed board, with ground truth.

#include "capture/calibration/board/board_sheet.hpp"
#include "tests/capture/calibration/drawn_drum.hpp"

#include <cmath>
#include <optional>

namespace rs::test {

struct BoardPhotos {
    struct Photo {
        Image<Rgba8> image;  // opaque
        Image<Rgba8> mask;   // white inside the drum
    };

    BoardPhotos() {
        model.lens = {560, 448, 1080, 280, 224, 0, 0};
        model.pose = {0.01, radians(38), -0.012};
        for (int i = 0; i < 10; ++i) model.angles_rad.push_back(i * radians(36) + (i % 3) * radians(0.7));
        design.squares_x = design.squares_y = 7;
        design.square_mm = 24;
        const auto drawn = capture::board_image(design, kDpi);
        if (drawn) printed = *drawn;
        drum.height = 0.1;
        drum.radius = 0.06;
        drum.middle = -std::tan(radians(38)) + drum.height / 2;
    }

    [[nodiscard]] Photo taken(std::size_t view) const {
        Photo photo{drawn_drum(drum, model, view), Image<Rgba8>(model.lens.width, model.lens.height)};
        const double ground = drum.middle - drum.height / 2;
        const glm::dvec3 from = capture::turned({0, 0, 1}, -model.angles_rad[view]);
        const capture::TableRays rays(model.lens, model.pose, -model.angles_rad[view]);
        constexpr int kSide = 3;
        for (int y = 0; y < photo.image.height(); ++y) {
            for (int x = 0; x < photo.image.width(); ++x) {
                Rgba8& pixel = photo.image(x, y);
                photo.mask(x, y) = {pixel.a, pixel.a, pixel.a, 255};
                if (pixel.a == 255) continue;
                double light = 0;
                for (int s = 0; s < kSide * kSide; ++s) {
                    const glm::dvec2 p(x + (s % kSide + 0.5) / kSide, y + (s / kSide + 0.5) / kSide);
                    const auto ray = rays.through(p);
                    light += ray && ray->y < 0 ? light_at(from + ground / ray->y * *ray) : kBackdrop;
                }
                const double share = pixel.a / 255.0;
                const auto code = [&](std::uint8_t own) {
                    return srgb8_from_linear(
                        static_cast<float>(share * linear_from_srgb8(own) + (1 - share) * light / (kSide * kSide)));
                };
                pixel = {code(pixel.r), code(pixel.g), code(pixel.b), 255};
            }
        }
        return photo;
    }

    capture::TurntableModel model;
    capture::BoardDesign design;
    Drum drum;

private:
    static constexpr double kDpi = 100;
    static constexpr double kBackdrop = 0.3;
    static constexpr double kUnitsPerMm = 0.0026;

    // Maps a point of the disc to the board, which is rotated and off-centre.
    [[nodiscard]] double light_at(const glm::dvec3& p) const {
        const glm::dvec3 q = capture::turned(p - glm::dvec3(0.01, 0, -0.015), 0.3) / kUnitsPerMm;
        const double per_mm = kDpi / 25.4;
        const int x = static_cast<int>(std::floor(q.x * per_mm + 0.5 * printed.width()));
        const int y = static_cast<int>(std::floor(q.z * per_mm + 0.5 * printed.width()));
        if (x < 0 || y < 0 || x >= printed.width() || y >= printed.height()) return kBackdrop;
        return 0.04 + 0.6 * linear_from_srgb8(printed(x, y).g);
    }

    Image<Rgba8> printed;
};

}  // namespace rs::test
