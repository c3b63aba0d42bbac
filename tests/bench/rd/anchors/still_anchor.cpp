#include "tests/bench/rd/anchors/still_anchor.hpp"

#include "rayspace/base/parallel.hpp"

#include <opencv2/imgcodecs.hpp>

namespace rs::bench {
namespace {

cv::Mat3b bgr_of(const Image<Rgba8>& image) {
    cv::Mat3b bgr(image.height(), image.width());
    for (int y = 0; y < bgr.rows; ++y) {
        for (int x = 0; x < bgr.cols; ++x) bgr(y, x) = {image(x, y).b, image(x, y).g, image(x, y).r};
    }
    return bgr;
}

Image<Rgba8> rgba_of(const cv::Mat3b& bgr) {
    Image<Rgba8> image(bgr.cols, bgr.rows);
    for (int y = 0; y < bgr.rows; ++y) {
        for (int x = 0; x < bgr.cols; ++x) image(x, y) = {bgr(y, x)[2], bgr(y, x)[1], bgr(y, x)[0], 255};
    }
    return image;
}

}  // namespace

Result<CodingResult> code_stills(const ReferenceImages& images, const std::vector<Image<Rgba8>>& shown,
                                 StillCodec codec, int quality) {
    const bool jpeg = codec == StillCodec::kJpeg;
    const std::vector<int> parameters =
        jpeg ? std::vector<int>{cv::IMWRITE_JPEG_QUALITY, quality, cv::IMWRITE_JPEG_OPTIMIZE, 1}
             : std::vector<int>{cv::IMWRITE_WEBP_QUALITY, quality};
    std::vector<CodingResult> parts(shown.size());
    const auto code = [&](int view) -> Status {
        const auto n = static_cast<std::size_t>(view);
        const Error failure{images.name + ": view " + std::to_string(view) + ": OpenCV cannot code " +
                            (jpeg ? "JPEG" : "WebP") + "; is it built with that codec?"};
        try {
            std::vector<std::uint8_t> file;
            if (!cv::imencode(jpeg ? ".jpg" : ".webp", bgr_of(shown[n]), file, parameters)) return failure;
            const cv::Mat decoded = cv::imdecode(file, cv::IMREAD_COLOR);
            if (decoded.rows != images.height || decoded.cols != images.width) return failure;
            parts[n].bytes = file.size();
            parts[n].error = object_error(images, n, rgba_of(decoded));
        } catch (const cv::Exception& exception) {
            return Error{failure.message + " " + exception.what()};
        }
        return {};
    };
    RS_TRY(for_each_in_parallel(static_cast<int>(shown.size()), "", nullptr, code));
    CodingResult all;
    for (const CodingResult& part : parts) {
        all.bytes += part.bytes;
        all.error += part.error;
    }
    return all;
}

}  // namespace rs::bench
