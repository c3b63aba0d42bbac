#include "capture/calibration/known/known_files.hpp"
#include "rayspace/file/file_output.hpp"

#include <opencv2/core.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

namespace rs::capture {
namespace {

constexpr std::uint64_t kMaxFile_bytes = std::uint64_t{1} << 20;
constexpr int kMaxNesting = 32;
constexpr int kMaxIndent = 200;
constexpr int kMaxDashes = 64;
constexpr std::array<const char*, 5> kMatrixNames = {"camera_matrix", "cameraMatrix", "Camera_Matrix", "CameraMatrix",
                                                     "K"};
constexpr std::array<const char*, 5> kCoefficientNames = {"distortion_coefficients", "Distortion_Coefficients",
                                                          "distCoeffs", "dist_coeffs", "D"};

// cv::FileStorage recurses for each level in its three languages: brackets, indentation and dashes of YAML, tags of
// XML. Files nested more deeply than any file of intrinsics are refused before parsing.
bool nests_too_deeply(const std::string& text) {
    int brackets = 0;
    int tags = 0;
    int indent = 0;
    int dashes = 0;
    bool at_start = true;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        const char following = i + 1 < text.size() ? text[i + 1] : '\0';
        if (c == '[' || c == '{') ++brackets;
        if (c == ']' || c == '}') brackets = std::max(0, brackets - 1);
        if (c == '<' && following != '/' && following != '?' && following != '!') ++tags;
        if (c == '<' && following == '/') tags = std::max(0, tags - 1);
        if (c == '\n') {
            indent = dashes = 0;
            at_start = true;
        } else if (at_start && (c == ' ' || c == '\t' || c == '-')) {
            ++indent;
        } else {
            at_start = false;
        }
        if (c == '-' && (following == ' ' || following == '\t' || following == '\n')) ++dashes;
        if (brackets > kMaxNesting || tags > kMaxNesting || indent > kMaxIndent || dashes > kMaxDashes) return true;
    }
    return false;
}

template <std::size_t N>
cv::FileNode first_of(const cv::FileStorage& file, const std::array<const char*, N>& names) {
    for (const char* name : names) {
        const cv::FileNode node = file[name];
        if (!node.empty()) return node;
    }
    return {};
}

// Matrix elements row by row. Parsed as a map instead of a cv::Mat, whose reader allocates whatever size the file
// states; this also accepts plain YAML of other tools (rows, cols, data).
struct Matrix {
    int rows = 0;
    int columns = 0;
    std::vector<double> elements;
};
Result<Matrix> matrix_from(const cv::FileNode& node, const std::string& place) {
    const Error malformed{place + " must be a matrix with rows, cols and data"};
    if (!node.isMap()) return malformed;
    const cv::FileNode rows = node["rows"];
    const cv::FileNode columns = node["cols"];
    const cv::FileNode data = node["data"];
    if (!rows.isInt() || !columns.isInt() || !data.isSeq()) return malformed;
    Matrix matrix{static_cast<int>(rows), static_cast<int>(columns), {}};
    constexpr int kMaxSide = 16;
    if (matrix.rows < 1 || matrix.columns < 1 || matrix.rows > kMaxSide || matrix.columns > kMaxSide) return malformed;
    if (data.size() != static_cast<std::size_t>(matrix.rows * matrix.columns)) return malformed;
    for (const cv::FileNode& element : data) {
        if (!element.isReal() && !element.isInt()) return malformed;
        const auto number = static_cast<double>(element);
        if (!std::isfinite(number)) return Error{place + " has an element that is not finite"};
        matrix.elements.push_back(number);
    }
    return matrix;
}

Status check_size(const cv::FileStorage& file, const std::string& where, ImagePixels images) {
    const cv::FileNode width = file["image_width"];
    const cv::FileNode height = file["image_height"];
    if (!width.isInt() || !height.isInt() || images.width <= 0) return {};
    if (static_cast<int>(width) == images.width && static_cast<int>(height) == images.height) return {};
    return Error{where + ": is for images of " + std::to_string(static_cast<int>(width)) + " x " +
                 std::to_string(static_cast<int>(height)) + " pixels, these have " + std::to_string(images.width) +
                 " x " + std::to_string(images.height) + "; calibrate with images of the same size"};
}

Result<glm::dvec2> distortion_from(const cv::FileNode& node, const std::string& where) {
    if (node.empty()) return glm::dvec2(0);
    RS_ASSIGN_OR_RETURN(const auto matrix, matrix_from(node, where + ": " + node.name()));
    static constexpr std::array<const char*, 14> kNames = {"k1", "k2", "p1", "p2", "k3", "k4",    "k5",
                                                           "k6", "s1", "s2", "s3", "s4", "tau_x", "tau_y"};
    const std::vector<double>& k = matrix.elements;
    if ((matrix.rows != 1 && matrix.columns != 1) || k.size() > kNames.size()) {
        return Error{where + ": " + node.name() + " must be a row or column of at most 14 coefficients"};
    }
    for (std::size_t i = 2; i < k.size(); ++i) {
        if (k[i] != 0) {
            return Error{where + ": distortion " + kNames[i] + " = " + std::to_string(k[i]) +
                         " is not supported, only k1 and k2; calibrate with CALIB_ZERO_TANGENT_DIST and CALIB_FIX_K3, "
                         "or undistort the images"};
        }
    }
    return glm::dvec2(k.empty() ? 0 : k[0], k.size() > 1 ? k[1] : 0);
}

Result<KnownFile> known_from(const cv::FileStorage& file, const std::string& where, ImagePixels images) {
    const cv::FileNode node = first_of(file, kMatrixNames);
    if (node.empty()) {
        return Error{where + ": has no camera_matrix (or cameraMatrix); check that it holds OpenCV's intrinsics"};
    }
    const std::string place = where + ": " + node.name();
    RS_ASSIGN_OR_RETURN(const auto matrix, matrix_from(node, place));
    const std::vector<double>& k = matrix.elements;
    if (matrix.rows != 3 || matrix.columns != 3) return Error{place + " must be 3 x 3"};
    if (k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1) return Error{place + " is not fx 0 cx, 0 fy cy, 0 0 1"};
    RS_ASSIGN_OR_RETURN(const auto f_px, common_focal_length(k[0], k[4], place));
    if (std::abs(k[1]) > 1e-3 * f_px) return Error{place + " has skew, which is not supported"};
    if (!(std::abs(k[2]) < 1e6 && std::abs(k[5]) < 1e6)) return Error{place + ": its principal point is out of range"};
    RS_TRY(check_size(file, where, images));
    RS_ASSIGN_OR_RETURN(const auto distortion, distortion_from(first_of(file, kCoefficientNames), where));

    KnownFile result;
    result.known.f_px = f_px;
    result.known.principal_point = glm::dvec2(k[2] + 0.5, k[5] + 0.5);
    result.known.distortion = distortion;
    return result;
}

// Replaces the line breaks in OpenCV's messages.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

}  // namespace

Result<KnownFile> opencv_intrinsics_from(const std::string& text, const std::string& where, ImagePixels images) {
    if (text.size() > kMaxFile_bytes) return Error{where + ": is larger than 1 MB, too large for intrinsics"};
    if (text.find('\0') != std::string::npos) return Error{where + ": is not a text file"};
    if (nests_too_deeply(text)) return Error{where + ": is nested too deeply for intrinsics; check the file"};
    try {
        const cv::FileStorage file(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
        if (!file.isOpened()) return Error{where + ": is not in OpenCV's YAML, XML or JSON"};
        return known_from(file, where, images);
    } catch (const cv::Exception& problem) {
        return Error{where + ": is not in OpenCV's YAML, XML or JSON (" + one_line(problem.err) +
                     "); cameras of other programs are read from a transforms.json or a COLMAP model"};
    } catch (const std::exception& problem) {
        return Error{where + ": cannot be read: " + one_line(problem.what())};
    }
}

Result<KnownFile> read_opencv_intrinsics(const std::filesystem::path& path, ImagePixels images) {
    RS_ASSIGN_OR_RETURN(const auto bytes, read_file(path, kMaxFile_bytes));
    return opencv_intrinsics_from({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path.string(), images);
}

}  // namespace rs::capture
