#pragma once
// Foreground probability of a photo by a neural network: any ONNX model of the U2-Net, IS-Net (DIS) and BiRefNet
// families in single precision that OpenCV's dnn module loads. Models and their sources: docs/segmentation.md.
//
//     photo --resize--> 1 x 3 x H x W, (code - mean) * scale --network--> 1 x 1 x h x w --resize--> probability
//
// The first resize does not keep the aspect ratio, as in the training of these networks.
//
// Model files are untrusted data parsed by OpenCV. Lengths of messages and tensors are checked before
// (onnx_summary.hpp) and exceptions are caught; OpenCV's importer may have other weaknesses. Use files from trusted
// sources.

#include "rayspace/base/result.hpp"
#include "rayspace/image/image.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace rs::capture {

/// Largest model file that is read. A protocol buffer cannot be larger.
inline constexpr std::uint64_t kMaxModel_bytes = (std::uint64_t{1} << 31) - 1;

class SegmentationNetwork {
public:
    /// Loads a model and its settings file (network_settings.hpp), and checks the shapes of input and output. No photo
    /// is processed yet.
    ///
    /// \param model         the .onnx file.
    /// \param max_instances how many calls of foreground_probability() may run at a time, at least 1. cv::dnn::Net is
    ///                      not thread-safe, so each needs a network of its own; the second and later ones are loaded
    ///                      when they are first needed. An IS-Net of 1024x1024 takes 0.75 GB for each.
    /// \return one line where the file is missing, larger than kMaxModel_bytes, not ONNX, half precision, quantized,
    ///         has its weights in another file, more than one input, an input other than 1 x 3 x H x W with sides of
    ///         kMinNetworkSide_px..kMaxNetworkSide_px, or an output other than one channel; where OpenCV cannot load
    ///         it; and for a faulty settings file.
    static Result<SegmentationNetwork> load(const std::filesystem::path& model, int max_instances = 1);

    SegmentationNetwork(SegmentationNetwork&&) noexcept;
    SegmentationNetwork& operator=(SegmentationNetwork&&) noexcept;
    ~SegmentationNetwork();

    /// The probability that a pixel is foreground, 0..1, in the photo's size. Alpha is ignored.
    ///
    /// Thread-safe: a call waits while max_instances others are running. Each runs with the threads that
    /// cv::setNumThreads() allows, on which the result does not depend. All cores are used in two ways:
    ///
    ///   - one instance, one photo after the other, cv::setNumThreads(cores): least memory. Nothing else may run beside
    ///     it, because Debian's OpenCV takes its threads from TBB, whose workers would wait here.
    ///   - cv::setNumThreads(1), one instance per core, photos in parallel: as fast, memory for each instance.
    ///
    /// \param photo not empty.
    /// \return an error where the network fails, and where its output is not finite or not what the settings state.
    [[nodiscard]] Result<Image<float>> foreground_probability(ConstImageView<Rgba8> photo) const;

    /// For logs: "isnet.onnx, 1024x1024 px, preprocessing of IS-Net (no settings file)".
    [[nodiscard]] const std::string& description() const;

private:
    struct Pool;
    explicit SegmentationNetwork(std::unique_ptr<Pool> pool);
    std::unique_ptr<Pool> pool_;
};

}  // namespace rs::capture
