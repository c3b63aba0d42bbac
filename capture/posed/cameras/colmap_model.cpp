#include "capture/posed/cameras/colmap_model.hpp"

#include "rayspace/base/byte_stream.hpp"
#include "rayspace/base/conventions.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/file_output.hpp"
#include "rayspace/file/input_file.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <system_error>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxModelFile_bytes = std::uint64_t{1} << 30;
constexpr std::size_t kMaxPhotoName_bytes = 4096;
constexpr double kMaxTranslation = 1e12;
constexpr std::size_t kMaxParameters = 12;

// Camera model: its parameters are the focal lengths, cx, cy, and the first coefficients of LensDistortion.
struct ColmapLens {
    int id;
    std::string_view name;
    std::size_t parameters;
    std::size_t focal_lengths;
    LensDistortion::Model model;
};

using enum LensDistortion::Model;
constexpr std::array<ColmapLens, 9> kColmapLenses = {{{0, "SIMPLE_PINHOLE", 3, 1, kRadialTangential},
                                                      {1, "PINHOLE", 4, 2, kRadialTangential},
                                                      {2, "SIMPLE_RADIAL", 4, 1, kRadialTangential},
                                                      {3, "RADIAL", 5, 1, kRadialTangential},
                                                      {4, "OPENCV", 8, 2, kRadialTangential},
                                                      {5, "OPENCV_FISHEYE", 8, 2, kFisheye},
                                                      {6, "FULL_OPENCV", 12, 2, kRadialTangential},
                                                      {8, "SIMPLE_RADIAL_FISHEYE", 4, 1, kFisheye},
                                                      {9, "RADIAL_FISHEYE", 5, 1, kFisheye}}};

// Models of COLMAP that are refused, for messages about binary files.
const std::map<int, std::string> kRefusedLenses{
    {7, "FOV"}, {10, "THIN_PRISM_FISHEYE"}, {11, "RAD_TAN_THIN_PRISM_FISHEYE"}};

Error refused_lens(const std::string& place, const std::string& model) {
    return Error{place + ": camera model " + printable(model) +
                 " is not supported; undistort the photos by colmap image_undistorter, or calibrate with OPENCV"};
}

// Lens of a camera, without photo and pose.
Result<PosedCamera> lens_from(const ColmapLens& lens, std::uint64_t width, std::uint64_t height,
                              std::span<const double> parameters, const std::string& place) {
    PosedCamera camera;
    const auto side = [](std::uint64_t px) {
        return static_cast<int>(std::min<std::uint64_t>(px, kMaxPhotoSide_px + 1));
    };
    camera.camera.width = side(width);
    camera.camera.height = side(height);
    camera.camera.fl_x = parameters[0];
    camera.camera.fl_y = parameters[lens.focal_lengths - 1];
    camera.camera.cx = parameters[lens.focal_lengths];
    camera.camera.cy = parameters[lens.focal_lengths + 1];
    camera.distortion.model = lens.model;
    std::ranges::copy(parameters.subspan(lens.focal_lengths + 2), camera.distortion.coefficients.begin());
    RS_TRY(check_lens(camera, place));
    return camera;
}

// Collects the cameras and images of a model and checks them.
class ModelBuilder {
public:
    explicit ModelBuilder(const std::string& folder) : model_{folder, {}, false} {}

    Status add_lens(std::uint32_t id, const PosedCamera& lens, const std::string& place) {
        if (lenses_.size() >= kMaxViews) {
            return Error{place + ": more than " + std::to_string(kMaxViews) + " cameras; reduce the model"};
        }
        if (!lenses_.try_emplace(id, lens).second) {
            return Error{place + ": camera " + std::to_string(id) + " is there twice; export the model again"};
        }
        return {};
    }

    // `pose`: qw qx qy qz tx ty tz of the transform from the world to the camera.
    Status add_image(std::uint32_t camera, std::string name, const std::array<double, 7>& pose,
                     const std::string& place) {
        if (model_.cameras.size() >= kMaxViews) {
            return Error{place + ": more than " + std::to_string(kMaxViews) + " images; split the model"};
        }
        if (name.empty() || name.size() > kMaxPhotoName_bytes) {
            return Error{place + ": the image's name is empty or too long; export the model again"};
        }
        const auto lens = lenses_.find(camera);
        if (lens == lenses_.end()) {
            return Error{place + ": camera " + std::to_string(camera) +
                         " does not exist; cameras and images must be of the same model"};
        }
        const glm::dquat q(pose[0], pose[1], pose[2], pose[3]);
        const double norm = glm::length(q);
        if (!(norm > 0.5 && norm < 2)) {
            return Error{place + ": its quaternion is not of length 1; export the model again"};
        }
        const glm::dvec3 t(pose[4], pose[5], pose[6]);
        if (!(glm::length(t) <= kMaxTranslation)) {
            return Error{place + ": its translation is out of range; export the model again"};
        }
        PosedCamera& added = model_.cameras.emplace_back(lens->second);
        added.photo = std::move(name);
        // Columns of the transpose are the rows.
        added.camera.world_from_camera = world_from_opencv_camera(glm::transpose(glm::mat3_cast(q / norm)), t);
        return {};
    }

    Result<PosedModel> finish() && {
        if (model_.cameras.empty()) {
            return Error{model_.where + ": the model has no images; run the reconstruction again"};
        }
        return std::move(model_);
    }

private:
    PosedModel model_;
    std::map<std::uint32_t, PosedCamera> lenses_;
};

// Lines of a text file with their numbers; comments and, outside of images.txt, empty lines are skipped.
class ModelLines {
public:
    ModelLines(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {}

    // The next line without its line break; nullopt at the end.
    std::optional<std::string_view> next() {
        if (rest_.empty()) return std::nullopt;
        const std::size_t end = rest_.find('\n');
        std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        if (line.ends_with('\r')) line.remove_suffix(1);
        ++number_;
        return line;
    }
    // The next line that is neither empty nor a comment.
    std::optional<std::string_view> next_record() {
        while (const auto line = next()) {
            const std::size_t first = line->find_first_not_of(" \t");
            if (first != std::string_view::npos && (*line)[first] != '#') return line->substr(first);
        }
        return std::nullopt;
    }
    [[nodiscard]] std::string place() const { return file_ + ":" + std::to_string(number_); }

private:
    std::string_view rest_;
    std::string file_;
    int number_ = 0;
};

std::string_view take_word(std::string_view& line) {
    const std::size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    line.remove_prefix(first);
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    line.remove_prefix(word.size());
    return word;
}

template <class T>
bool take_number(std::string_view& line, T& number) {
    const std::string_view word = take_word(line);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && end == word.data() + word.size() && !word.empty();
}

Status read_text_camera(std::string_view line, const std::string& place, ModelBuilder& model) {
    std::uint32_t id = 0;
    if (!take_number(line, id)) return Error{place + ": CAMERA_ID MODEL WIDTH HEIGHT PARAMS[] is expected"};
    const std::string name(take_word(line));
    const auto lens = std::ranges::find(kColmapLenses, name, &ColmapLens::name);
    if (lens == kColmapLenses.end()) return refused_lens(place, name.substr(0, 40));
    std::uint64_t width = 0, height = 0;
    std::array<double, kMaxParameters> parameters{};
    bool is_complete = take_number(line, width) && take_number(line, height);
    for (std::size_t i = 0; i < lens->parameters; ++i) is_complete = is_complete && take_number(line, parameters[i]);
    if (!is_complete || !take_word(line).empty()) {
        return Error{place + ": a camera of model " + name + " has width, height and " +
                     std::to_string(lens->parameters) + " parameters; export the model again"};
    }
    RS_ASSIGN_OR_RETURN(const PosedCamera camera,
                        lens_from(*lens, width, height, std::span(parameters).first(lens->parameters), place));
    return model.add_lens(id, camera, place);
}

Status read_text_image(std::string_view line, const std::string& place, ModelBuilder& model) {
    std::uint32_t id = 0, camera = 0;
    std::array<double, 7> pose{};
    bool is_complete = take_number(line, id);
    for (double& number : pose) is_complete = is_complete && take_number(line, number);
    is_complete = is_complete && take_number(line, camera);
    if (!is_complete) {
        return Error{place + ": IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME is expected; export the model again"};
    }
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    return model.add_image(camera, std::string(line), pose, place);
}

// Checks the second line of an image: X Y POINT3D_ID of each point, or nothing. Without these lines every other image
// would be skipped.
Status check_points(std::string_view line, const std::string& place) {
    std::size_t numbers = 0;
    double number = 0;
    bool are_numbers = true;
    while (are_numbers && line.find_first_not_of(" \t") != std::string_view::npos) {
        are_numbers = take_number(line, number);
        ++numbers;
    }
    if (are_numbers && numbers % 3 == 0) return {};
    return Error{place +
                 ": X Y POINT3D_ID of the image's points are expected; each image has a second line, which may "
                 "be empty"};
}

Result<PosedCamera> read_binary_lens(ByteReader& reader, const std::string& place) {
    const auto id = reader.get<std::int32_t>();
    const auto width = reader.get<std::uint64_t>();
    const auto height = reader.get<std::uint64_t>();
    const auto lens = std::ranges::find(kColmapLenses, id, &ColmapLens::id);
    if (lens == kColmapLenses.end()) {
        const auto known = kRefusedLenses.find(id);
        return refused_lens(place, known == kRefusedLenses.end() ? std::to_string(id) : known->second);
    }
    std::array<double, kMaxParameters> parameters{};
    for (std::size_t i = 0; i < lens->parameters; ++i) parameters[i] = reader.get_double();
    if (!reader.ok()) return Error{place + ": the file is cut short; copy it again"};
    return lens_from(*lens, width, height, std::span(parameters).first(lens->parameters), place);
}

Status read_binary_image(ByteReader& reader, const std::string& place, ModelBuilder& model) {
    constexpr std::size_t kPoint_bytes = 24;
    (void)reader.get<std::uint32_t>();  // IMAGE_ID
    std::array<double, 7> pose{};
    for (double& number : pose) number = reader.get_double();
    const auto camera = reader.get<std::uint32_t>();
    std::string name;
    while (reader.ok() && name.size() <= kMaxPhotoName_bytes) {
        const char c = static_cast<char>(reader.get<std::uint8_t>());
        if (c == '\0') break;
        name += c;
    }
    const auto points = reader.get<std::uint64_t>();
    if (!reader.ok() || points > reader.left() / kPoint_bytes) {
        return Error{place + ": the file is cut short; copy it again"};
    }
    (void)reader.take(static_cast<std::size_t>(points) * kPoint_bytes);
    return model.add_image(camera, std::move(name), pose, place);
}

bool is_model_file(const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored);
}

bool has_model(const fs::path& folder) {
    return (is_model_file(folder / "cameras.bin") && is_model_file(folder / "images.bin")) ||
           (is_model_file(folder / "cameras.txt") && is_model_file(folder / "images.txt"));
}

std::string digits(double value) {
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);  // shortest exact form
    return {text.data(), end};
}

}  // namespace

std::vector<std::string> colmap_camera_models() {
    std::vector<std::string> names;
    for (const ColmapLens& lens : kColmapLenses) names.emplace_back(lens.name);
    return names;
}

std::vector<std::string> refused_colmap_camera_models() {
    std::vector<std::string> names;
    for (const auto& [id, name] : kRefusedLenses) names.push_back(name);
    return names;
}

std::optional<fs::path> find_colmap_model(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) {
        const std::string name = path.filename().string();
        const bool is_of_model = name.starts_with("cameras.") || name.starts_with("images.");
        return is_of_model && has_model(path.parent_path()) ? std::optional(path.parent_path()) : std::nullopt;
    }
    for (const char* const inner : {"", "sparse/0", "sparse", "0"}) {
        if (has_model(path / inner)) return path / inner;
    }
    return std::nullopt;
}

namespace {

Result<PosedModel> read_model_files(const fs::path& folder) {
    if (is_model_file(folder / "cameras.bin") && is_model_file(folder / "images.bin")) {
        RS_ASSIGN_OR_RETURN(const auto cameras, read_file(folder / "cameras.bin", kMaxModelFile_bytes));
        RS_ASSIGN_OR_RETURN(const auto images, read_file(folder / "images.bin", kMaxModelFile_bytes));
        return colmap_model_from_binary(cameras, images, folder.string());
    }
    RS_ASSIGN_OR_RETURN(const auto cameras, read_file(folder / "cameras.txt", kMaxModelFile_bytes));
    RS_ASSIGN_OR_RETURN(const auto images, read_file(folder / "images.txt", kMaxModelFile_bytes));
    const auto text = [](const std::vector<std::byte>& bytes) {
        return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    return colmap_model_from_text(text(cameras), text(images), folder.string());
}

}  // namespace

Result<PosedModel> read_colmap_model(const fs::path& folder) {
    RS_ASSIGN_OR_RETURN(PosedModel model, read_model_files(folder));
    const fs::path next = folder.parent_path() / "1";
    if (folder.filename() == "0" && has_model(next)) {
        model.notes.push_back(folder.string() + " is read, of several models that could not be joined; give " +
                              next.string() + " for the next one");
    }
    return model;
}

Result<PosedModel> colmap_model_from_text(std::string_view cameras, std::string_view images,
                                          const std::string& folder) {
    ModelBuilder model(folder);
    cameras = without_byte_order_mark(cameras);
    images = without_byte_order_mark(images);
    ModelLines lenses(cameras, (fs::path(folder) / "cameras.txt").string());
    while (const auto line = lenses.next_record()) RS_TRY(read_text_camera(*line, lenses.place(), model));
    ModelLines records(images, (fs::path(folder) / "images.txt").string());
    while (const auto line = records.next_record()) {
        RS_TRY(read_text_image(*line, records.place(), model));
        if (const auto points = records.next()) RS_TRY(check_points(*points, records.place()));
    }
    return std::move(model).finish();
}

Result<PosedModel> colmap_model_from_binary(std::span<const std::byte> cameras, std::span<const std::byte> images,
                                            const std::string& folder) {
    ModelBuilder model(folder);
    ByteReader lenses(cameras);
    const auto lens_count = lenses.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < lens_count; ++i) {
        const std::string place = (fs::path(folder) / "cameras.bin").string() + ": camera " + std::to_string(i + 1);
        const auto id = lenses.get<std::uint32_t>();
        if (!lenses.ok()) return Error{place + ": the file is cut short; copy it again"};
        RS_ASSIGN_OR_RETURN(const PosedCamera lens, read_binary_lens(lenses, place));
        RS_TRY(model.add_lens(id, lens, place));
    }
    ByteReader records(images);
    const auto count = records.get<std::uint64_t>();
    for (std::uint64_t i = 0; i < count; ++i) {
        RS_TRY(read_binary_image(
            records, (fs::path(folder) / "images.bin").string() + ": image " + std::to_string(i + 1), model));
    }
    return std::move(model).finish();
}

ColmapText colmap_text_of(std::span<const PosedCamera> cameras) {
    ColmapText text{"# CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]\n",
                    "# IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME\n# POINTS2D[] as X Y POINT3D_ID\n",
                    "# POINT3D_ID X Y Z R G B ERROR TRACK[] as IMAGE_ID POINT2D_IDX\n"};
    std::map<std::string, std::size_t> id_of;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Camera& camera = cameras[i].camera;
        const std::string lens = "PINHOLE " + std::to_string(camera.width) + ' ' + std::to_string(camera.height) + ' ' +
                                 digits(camera.fl_x) + ' ' + digits(camera.fl_y) + ' ' + digits(camera.cx) + ' ' +
                                 digits(camera.cy);
        const auto [known, is_new] = id_of.try_emplace(lens, id_of.size() + 1);
        if (is_new) text.cameras += std::to_string(known->second) + ' ' + lens + '\n';
        const glm::dmat3 rows(camera.right(), -camera.up(), camera.forward());  // R, row by row
        const glm::dquat q = glm::quat_cast(glm::transpose(rows));
        const glm::dvec3 t = -glm::transpose(rows) * camera.centre();
        text.images += std::to_string(i + 1);
        for (const double number : {q.w, q.x, q.y, q.z, t.x, t.y, t.z}) text.images += ' ' + digits(number);
        text.images += ' ' + std::to_string(known->second) + ' ' + cameras[i].photo + "\n\n";
    }
    return text;
}

}  // namespace rs::capture
