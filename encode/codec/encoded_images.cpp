#include "encode/codec/encoded_images.hpp"

#include "rayspace/base/parallel_loop.hpp"
#include "rayspace/codec/prediction_unit.hpp"
#include "rayspace/object/yuv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace rs::encode {

double measure_coded_psnr(const std::vector<SourceImage>& sources, int width, int height, int alpha_bits,
                          const std::function<codec::ConstPlaneViews(std::size_t view)>& reconstruction) {
    // Integer sums do not depend on the number of threads.
    std::vector<std::array<std::int64_t, 2>> sums(sources.size());  // squared error, samples
    for_each_index(sources.size(), [&](std::size_t v) {
        const SourceImage& source = sources[v];
        const codec::ConstPlaneViews planes = reconstruction(v);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (codec::alpha_of_level(source.alpha(x, y), alpha_bits) < 128) continue;
                const Rgba8 a =
                    rgba_from_yuva(source.planes[0](x, y), source.planes[1](x, y), source.planes[2](x, y), 255);
                const Rgba8 b = rgba_from_yuva(planes[0](x, y), planes[1](x, y), planes[2](x, y), 255);
                const auto square = [](int off) { return off * off; };
                sums[v][0] += square(a.r - b.r) + square(a.g - b.g) + square(a.b - b.b);
                sums[v][1] += 3;
            }
        }
    });
    double error = 0;
    double samples = 0;
    for (const auto& sum : sums) {
        error += static_cast<double>(sum[0]);
        samples += static_cast<double>(sum[1]);
    }
    return 10 * std::log10(255.0 * 255.0 * std::max(samples, 1.0) / std::max(error, 1e-3));
}

}  // namespace rs::encode
