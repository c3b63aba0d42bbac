#include "capture/photos/masks/segmentation_network.hpp"

#include "capture/opencv/opencv_image.hpp"
#include "capture/photos/masks/network_settings.hpp"
#include "capture/photos/masks/onnx_summary.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <vector>

namespace rs::capture {
namespace {

// A network and what it needs to be run.
struct DetectedInstance {
    cv::dnn::Net net;
    int width = 0;
    int height = 0;
    std::string output_name;
};

// OpenCV's words on one line, not too many of them.
std::string reason(const std::exception& escaped) {
    constexpr std::size_t kMost = 240;
    const auto* const of_opencv = dynamic_cast<const cv::Exception*>(&escaped);
    std::string words = of_opencv != nullptr ? of_opencv->err : escaped.what();
    std::replace(words.begin(), words.end(), '\n', ' ');
    if (words.size() > kMost) words = words.substr(0, kMost) + " ...";
    return words;
}

// Calls `work` and turns what it throws into an error "FILE: WHAT (reason); REMEDY".
template <class Work>
auto caught(const std::string& file, const std::string& what, const std::string& remedy, const Work& work)
    -> decltype(work()) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& escaped) {
        return Error{printable(file + ": " + what + " (" + reason(escaped) + "); " + remedy)};
    }
}

// Keeps OpenCV from logging to stderr what is returned as an error. The level is global to the process; loading is
// rare.
class SilentOpenCv {
public:
    SilentOpenCv() : lock_(mutex()), level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
    SilentOpenCv(const SilentOpenCv&) = delete;
    SilentOpenCv& operator=(const SilentOpenCv&) = delete;
    ~SilentOpenCv() { cv::utils::logging::setLogLevel(level_); }

private:
    static std::mutex& mutex() {
        static std::mutex one;
        return one;
    }
    std::lock_guard<std::mutex> lock_;
    cv::utils::logging::LogLevel level_;
};

std::string shape_text(const std::vector<std::int64_t>& shape) {
    std::string text;
    for (const std::int64_t side : shape) text += (text.empty() ? "" : "x") + (side < 0 ? "?" : std::to_string(side));
    return text.empty() ? "no shape" : text;
}

Status check_kind(const OnnxSummary& model, const std::string& file) {
    const auto refused = [&](const std::string& what) { return Error{printable(file + ": " + what)}; };
    const auto of_type = [&](std::int64_t type) {
        return std::ranges::any_of(model.inputs, [&](const OnnxValue& v) { return v.element_type == type; });
    };
    if (model.has_external_data) {
        return refused("its weights are in another file; save them in one with onnx.save(onnx.load(FILE), FILE)");
    }
    if (!model.quantized_operator.empty()) {
        return refused("is quantized (operator " + model.quantized_operator +
                       "); take the fp32 export of the model (docs/segmentation.md)");
    }
    if (model.has_half_weights || of_type(kOnnxFloat16) || of_type(kOnnxBfloat16)) {
        return refused(
            "is in half precision (fp16), which OpenCV does not load; convert it to fp32 "
            "(docs/segmentation.md has the script)");
    }
    if (model.inputs.size() != 1) {
        return refused("has " + std::to_string(model.inputs.size()) +
                       " inputs; a segmentation network takes one photo (1x3xHxW)");
    }
    if (model.outputs.empty()) return refused("has no output; export the model again");
    const OnnxValue& input = model.inputs.front();
    const bool is_rgb_batch = input.shape.size() == 4 && (input.shape[0] == 1 || input.shape[0] == -1) &&
                              (input.shape[1] == 3 || input.shape[1] == -1);
    if (!is_rgb_batch || (input.element_type != kOnnxFloat && input.element_type != 0)) {
        return refused("its input " + input.name + " is " + shape_text(input.shape) +
                       (input.element_type == kOnnxFloat ? "" : " of another type than fp32") +
                       "; it must be 1x3xHxW in fp32");
    }
    return {};
}

// The input's size in px, of the model or else of the settings.
Result<cv::Size> input_size(const OnnxValue& input, const NetworkSettings& settings, const std::string& file) {
    const auto side = [](std::int64_t fixed, int given) { return fixed > 0 ? fixed : std::int64_t{given}; };
    const std::int64_t height = side(input.shape[2], settings.height), width = side(input.shape[3], settings.width);
    if (settings.width > 0 && (width != settings.width || height != settings.height)) {
        return Error{file + ": takes photos of " + std::to_string(width) + "x" + std::to_string(height) +
                     ", its settings file states " + std::to_string(settings.width) + "x" +
                     std::to_string(settings.height) + "; remove width and height there"};
    }
    if (width <= 0 || height <= 0) {
        return Error{file + ": does not fix the size of its input; write width and height (px) into " + file + ".json"};
    }
    const auto fits = [](std::int64_t px) { return px >= kMinNetworkSide_px && px <= kMaxNetworkSide_px; };
    if (!fits(width) || !fits(height)) {
        return Error{file + ": takes photos of " + std::to_string(width) + "x" + std::to_string(height) +
                     "; sides must be " + std::to_string(kMinNetworkSide_px) + ".." +
                     std::to_string(kMaxNetworkSide_px) + " px"};
    }
    return cv::Size(static_cast<int>(width), static_cast<int>(height));
}

Result<std::string> output_name(const OnnxSummary& model, const NetworkSettings& settings, const std::string& file) {
    if (settings.output_name.empty()) return model.outputs.front().name;
    std::vector<std::string> names;
    for (const OnnxValue& output : model.outputs) names.push_back(output.name);
    if (std::ranges::find(names, settings.output_name) != names.end()) return settings.output_name;
    constexpr std::size_t kMostListed = 8;
    return Error{printable(file + ": has no output " + settings.output_name +
                           ", which its settings file names; it has " + listed(names, kMostListed))};
}

// Height and width of an output of one channel: h x w, behind any number of dimensions of size 1. Nothing otherwise.
std::optional<cv::Size> map_size(const std::vector<int>& shape) {
    if (shape.size() < 2 || shape.size() > 4) return std::nullopt;
    for (std::size_t i = 0; i + 2 < shape.size(); ++i) {
        if (shape[i] != 1) return std::nullopt;
    }
    const int height = shape[shape.size() - 2], width = shape.back();
    if (height < 1 || width < 1 || height > kMaxNetworkSide_px || width > kMaxNetworkSide_px) return std::nullopt;
    return cv::Size(width, height);
}

Error wrong_output(const std::string& file, const std::string& name, const std::vector<int>& shape) {
    return Error{printable(file + ": its output " + name + " is " + shape_text({shape.begin(), shape.end()}) +
                           "; it must be 1x1xHxW, the probability of one class")};
}

Result<DetectedInstance> make_instance(const std::filesystem::path& path, const NetworkSettings& settings) {
    const std::string file = path.string();
    RS_ASSIGN_OR_RETURN(std::vector<std::byte> bytes, read_file(path, kMaxModel_bytes));
    RS_ASSIGN_OR_RETURN(const OnnxSummary model, read_onnx_summary(bytes, file));
    RS_TRY(check_kind(model, file));
    RS_ASSIGN_OR_RETURN(const cv::Size size, input_size(model.inputs.front(), settings, file));
    RS_ASSIGN_OR_RETURN(std::string output, output_name(model, settings, file));

    const SilentOpenCv silent;
    return caught(
        file, "OpenCV cannot load the model", "export it with opset 11 to 13, in fp32",
        [&]() -> Result<DetectedInstance> {
            DetectedInstance instance{{}, size.width, size.height, std::move(output)};
            instance.net = cv::dnn::readNetFromONNX(reinterpret_cast<const char*>(bytes.data()), bytes.size());
            instance.net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
            instance.net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
            std::vector<std::vector<int>> in, out;
            instance.net.getLayerShapes({1, 3, size.height, size.width}, instance.net.getLayerId(instance.output_name),
                                        in, out);
            if (out.size() != 1 || !map_size(out.front())) {
                return wrong_output(file, instance.output_name, out.empty() ? std::vector<int>{} : out.front());
            }
            return instance;
        });
}

// 1 x 3 x H x W, fp32.
cv::Mat network_input(ConstImageView<Rgba8> photo, const cv::Size& size, const NetworkSettings& settings) {
    cv::Mat resized;
    const bool is_smaller = size.width < photo.width() && size.height < photo.height();
    cv::resize(mat_view(photo), resized, size, 0, 0, is_smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
    const int shape[] = {1, 3, size.height, size.width};
    cv::Mat input(4, shape, CV_32F);
    for (int channel = 0; channel < 3; ++channel) {
        const int plane = settings.is_bgr ? 2 - channel : channel;
        const float mean = settings.mean[channel], scale = settings.scale[channel];
        for (int y = 0; y < size.height; ++y) {
            const auto* from = resized.ptr<cv::Vec4b>(y);
            float* to = input.ptr<float>(0, plane) + static_cast<std::ptrdiff_t>(y) * size.width;
            for (int x = 0; x < size.width; ++x) to[x] = (static_cast<float>(from[x][channel]) - mean) * scale;
        }
    }
    return input;
}

// Turns the network's numbers into probabilities, in place.
Status make_probability(cv::Mat1f& map, NetworkOutput meaning, const std::string& file) {
    // Rounding of a sigmoid in single precision, and what resizing inside of the network may overshoot.
    constexpr float kSlack = 0.02F;
    float lowest = map(0, 0), highest = map(0, 0);
    bool is_finite = true;
    for (const float value : map) {
        is_finite = is_finite && std::isfinite(value);
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
    }
    if (!is_finite) {
        return Error{file +
                     ": its output is not a number in places; check mean and scale in its settings file, and "
                     "that the model was converted to fp32"};
    }
    if (meaning == NetworkOutput::kProbability && (lowest < -kSlack || highest > 1 + kSlack)) {
        constexpr int kDigits = 2;
        return Error{file + ": its output goes from " + format_fixed(lowest, kDigits) + " to " +
                     format_fixed(highest, kDigits) +
                     ", which is no probability; write \"output\": \"logits\" or \"minmax\" into its settings file"};
    }
    const float range = highest > lowest ? highest - lowest : 1;
    for (float& value : map) {
        if (meaning == NetworkOutput::kLogits) value = 1 / (1 + std::exp(-value));
        if (meaning == NetworkOutput::kMinMax) value = (value - lowest) / range;
        value = std::clamp(value, 0.0F, 1.0F);
    }
    return {};
}

Result<Image<float>> run(DetectedInstance& instance, const NetworkSettings& settings, ConstImageView<Rgba8> photo,
                         const std::string& file) {
    instance.net.setInput(network_input(photo, {instance.width, instance.height}, settings));
    const cv::Mat output = instance.net.forward(instance.output_name);
    const std::vector<int> shape(output.size.p, output.size.p + output.dims);
    const std::optional<cv::Size> size = map_size(shape);
    if (!size || output.type() != CV_32F || !output.isContinuous()) {
        return wrong_output(file, instance.output_name, shape);
    }
    // The output is memory of the network.
    cv::Mat1f map = cv::Mat1f(size->height, size->width, const_cast<float*>(output.ptr<float>())).clone();
    RS_TRY(make_probability(map, settings.output, file));
    Image<float> probability(photo.width(), photo.height());
    cv::Mat1f resized(photo.height(), photo.width(), probability.data());
    const bool is_smaller = photo.width() < size->width && photo.height() < size->height;
    cv::resize(map, resized, resized.size(), 0, 0, is_smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
    return probability;
}

}  // namespace

// Instances that are not in use, and how many there are.
struct SegmentationNetwork::Pool {
    std::filesystem::path model;
    NetworkSettings settings;
    std::string description;
    int max_instances = 1;

    std::mutex mutex;
    std::condition_variable returned;
    int made = 0;
    std::vector<DetectedInstance> free;

    // An instance for the caller alone, until give_back().
    Result<DetectedInstance> take() {
        std::unique_lock lock(mutex);
        returned.wait(lock, [&] { return !free.empty() || made < max_instances; });
        if (!free.empty()) {
            DetectedInstance taken = std::move(free.back());
            free.pop_back();
            return taken;
        }
        ++made;
        lock.unlock();
        Result<DetectedInstance> fresh = make_instance(model, settings);
        if (!fresh) forget();
        return fresh;
    }
    void give_back(DetectedInstance instance) {
        {
            const std::lock_guard lock(mutex);
            free.push_back(std::move(instance));
        }
        returned.notify_one();
    }
    void forget() {
        {
            const std::lock_guard lock(mutex);
            --made;
        }
        returned.notify_one();
    }
};

SegmentationNetwork::SegmentationNetwork(std::unique_ptr<Pool> pool) : pool_(std::move(pool)) {}
SegmentationNetwork::SegmentationNetwork(SegmentationNetwork&&) noexcept = default;
SegmentationNetwork& SegmentationNetwork::operator=(SegmentationNetwork&&) noexcept = default;
SegmentationNetwork::~SegmentationNetwork() = default;

Result<SegmentationNetwork> SegmentationNetwork::load(const std::filesystem::path& model, int max_instances) {
    RS_CHECK(max_instances >= 1);
    RS_ASSIGN_OR_RETURN(const NetworkSettings settings, read_network_settings(model));
    RS_ASSIGN_OR_RETURN(DetectedInstance first, make_instance(model, settings));
    auto pool = std::make_unique<Pool>();
    pool->model = model;
    pool->settings = settings;
    const std::filesystem::path settings_file = network_settings_file(model);
    pool->description = printable(model.filename().string() + ", " + std::to_string(first.width) + "x" +
                                  std::to_string(first.height) + " px, " +
                                  (settings_file.empty() ? "preprocessing of IS-Net (no settings file)"
                                                         : "settings of " + settings_file.filename().string()));
    pool->max_instances = max_instances;
    pool->made = 1;
    pool->free.push_back(std::move(first));
    return SegmentationNetwork(std::move(pool));
}

Result<Image<float>> SegmentationNetwork::foreground_probability(ConstImageView<Rgba8> photo) const {
    RS_CHECK(!photo.empty());
    RS_ASSIGN_OR_RETURN(DetectedInstance instance, pool_->take());
    const std::string file = pool_->model.string();
    Result<Image<float>> probability = [&] {
        try {
            return caught(file, "OpenCV cannot run the model", "use another model, or --segmenter background",
                          [&] { return run(instance, pool_->settings, photo, file); });
        } catch (...) {  // memory: the instance may be in any state
            pool_->forget();
            throw;
        }
    }();
    pool_->give_back(std::move(instance));
    return probability;
}

const std::string& SegmentationNetwork::description() const {
    return pool_->description;
}

}  // namespace rs::capture
