#include "capture/posed/colmap_reconstruction.hpp"

#include "capture/photos/masks/mask_folder.hpp"
#include "capture/posed/cameras/colmap_model.hpp"
#include "capture/posed/photo_match.hpp"
#include "rayspace/base/printable.hpp"
#include "rayspace/file/child_process.hpp"
#include "rayspace/image_io/image_io.hpp"
#include "rayspace/image_io/photo_size.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace rs::capture {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMatchedBlock = 10;     // photos; COLMAP prints a line for each pair of blocks
constexpr std::size_t kSequenceOverlap = 20;  // following photos that a photo is matched with
constexpr const char* kOption = "--calibration colmap: ";

// Stage of COLMAP with a progress bar: each output line that has `mark` is a step.
struct ColmapStage {
    std::string label;
    std::size_t steps = 0;
    std::vector<std::string> marks;
};

// Largest model of a run.
struct LargestModel {
    fs::path folder;                       // empty: COLMAP found none
    std::set<std::string> photos;          // that have a camera
    std::vector<std::string> model_sizes;  // numbers of photos of all models
};

Status write_masks(const ColmapRequest& request, const std::vector<std::string>& names, const fs::path& to,
                   Progress* progress) {
    std::map<std::pair<int, int>, PhotoFolder> groups;  // of one size, as MaskFolder reads them
    std::map<std::pair<int, int>, std::vector<std::string>> names_of;
    for (const std::string& name : names) {
        RS_ASSIGN_OR_RETURN(const ImageInfo info, read_image_info(request.photos / name, kMaxPhotoSide_px));
        PhotoFolder& group = groups[{info.width, info.height}];
        group.photos.push_back(request.photos / name);
        group.shown_width = info.width;
        group.shown_height = info.height;
        names_of[{info.width, info.height}].push_back(name);
    }
    for (auto& [size, group] : groups) {
        set_working_size(group, kMaxPhotoSide_px);
        RS_ASSIGN_OR_RETURN(const MaskFolder masks,
                            MaskFolder::open(request.masks, group, MaskKind::kBinary, progress));
        for (std::size_t i = 0; i < group.photos.size(); ++i) {
            RS_ASSIGN_OR_RETURN(const Image<std::uint8_t> mask, masks.read(i));
            Image<Rgba8> grey(mask.width(), mask.height());
            for (int y = 0; y < mask.height(); ++y) {
                for (int x = 0; x < mask.width(); ++x) grey(x, y) = {mask(x, y), mask(x, y), mask(x, y), 255};
            }
            const fs::path file = to / (names_of[size][i] + ".png");
            std::error_code failure;
            fs::create_directories(file.parent_path(), failure);
            RS_TRY(write_png(file, grey));
        }
    }
    return {};
}

class ColmapRun {
public:
    ColmapRun(const ColmapRequest& request, const std::vector<std::string>& names, fs::path folder, Progress* progress)
        : request_(request), names_(names), folder_(std::move(folder)), progress_(progress) {}

    // `masks`: COLMAP's folder of masks; empty: whole photos.
    Result<LargestModel> run(const fs::path& masks) {
        std::error_code failure;
        const fs::path sparse = folder_ / "sparse";
        if (!fs::create_directories(sparse, failure)) {
            return Error{folder_.string() + ": cannot be written (" + failure.message() + ")"};
        }
        RS_TRY(extract(masks));
        RS_TRY(match());
        // Fails if it finds no model, too.
        const std::vector<std::string> arguments{"mapper",       "--database_path",        database(),
                                                 "--image_path", request_.photos.string(), "--output_path",
                                                 sparse.string()};
        RS_ASSIGN_OR_RETURN(const int status,
                            colmap({"finding the cameras", names_.size(), {"Registering image #"}}, arguments));
        RS_ASSIGN_OR_RETURN(LargestModel largest, largest_model(sparse));
        if (status >= 128 && largest.folder.empty()) return failed("mapper", status);
        return largest;
    }

private:
    [[nodiscard]] std::string database() const { return (folder_ / "database.db").string(); }

    [[nodiscard]] Error failed(const std::string& command, int status) const {
        return Error{printable(request_.photos.string() + ": " + request_.program + " " + command + " ended with " +
                               std::to_string(status) + " (" + last_line_ +
                               "); check the photos, or compute the cameras elsewhere and give --known")};
    }

    // Runs a command of COLMAP; returns its exit status.
    Result<int> colmap(const ColmapStage& stage, std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), request_.program);
        if (progress_ != nullptr) progress_->start(stage.label, static_cast<std::int64_t>(stage.steps));
        std::size_t done = 0;
        const Result<int> status = run_program(arguments, [&](std::string_view line) {
            if (line.find_first_not_of(" \t\r") != std::string_view::npos) last_line_ = line;
            const auto has = [&](const std::string& mark) { return line.find(mark) != std::string_view::npos; };
            if (!std::ranges::any_of(stage.marks, has) || done == stage.steps) return;
            ++done;
            if (progress_ != nullptr) progress_->advance();
        });
        if (progress_ != nullptr) progress_->finish();
        if (!status) {
            return Error{printable(std::string(kOption) + request_.program + " cannot be run (" +
                                   status.error().message +
                                   "); install the Debian package colmap, or give the cameras by --known")};
        }
        return *status;
    }

    Status run_checked(const ColmapStage& stage, const std::vector<std::string>& arguments) {
        RS_ASSIGN_OR_RETURN(const int status, colmap(stage, arguments));
        if (status != 0) return failed(arguments.front(), status);
        return {};
    }

    // True if all photos seem to be of one lens at one focal length.
    [[nodiscard]] Result<bool> has_one_lens() const {
        std::set<std::vector<int>> lenses;
        for (const std::string& name : names_) {
            RS_ASSIGN_OR_RETURN(const ImageInfo info, read_image_info(request_.photos / name, kMaxPhotoSide_px));
            lenses.insert({info.width, info.height, info.focal_35mm});
        }
        return lenses.size() == 1;
    }

    Status extract(const fs::path& masks) {
        std::string list;
        for (const std::string& name : names_) list += name + "\n";
        const fs::path list_file = folder_ / "photos.txt";
        RS_TRY(write_file(list_file, list));
        RS_ASSIGN_OR_RETURN(const bool one_lens, has_one_lens());
        std::vector<std::string> arguments{"feature_extractor",
                                           "--database_path",
                                           database(),
                                           "--image_path",
                                           request_.photos.string(),
                                           "--image_list_path",
                                           list_file.string(),
                                           "--ImageReader.single_camera",
                                           one_lens ? "1" : "0",
                                           "--ImageReader.camera_model",
                                           "SIMPLE_RADIAL",
                                           "--SiftExtraction.use_gpu",
                                           "0"};
        if (!masks.empty()) arguments.insert(arguments.end(), {"--ImageReader.mask_path", masks.string()});
        return run_checked({"features of the photos", names_.size(), {"Processed file ["}}, arguments);
    }

    Status match() {
        std::vector<std::string> arguments{"exhaustive_matcher", "--database_path", database(),
                                           "--SiftMatching.use_gpu", "0"};
        const std::size_t count = names_.size();
        if (count > kMostExhaustive) {
            arguments.front() = "sequential_matcher";
            arguments.insert(arguments.end(), {"--SequentialMatching.overlap", std::to_string(kSequenceOverlap)});
            return run_checked({"matching the photos", count, {"image ["}}, arguments);
        }
        arguments.insert(arguments.end(), {"--ExhaustiveMatching.block_size", std::to_string(kMatchedBlock)});
        const std::size_t blocks = (count + kMatchedBlock - 1) / kMatchedBlock;
        return run_checked({"matching the photos", blocks * blocks, {"block ["}}, arguments);
    }

    static Result<LargestModel> largest_model(const fs::path& sparse) {
        LargestModel largest;
        std::vector<std::size_t> sizes;
        std::error_code failure;
        for (const fs::directory_entry& entry : fs::directory_iterator(sparse, failure)) {
            if (!entry.is_directory(failure)) continue;
            RS_ASSIGN_OR_RETURN(const PosedModel model, read_colmap_model(entry.path()));
            sizes.push_back(model.cameras.size());
            if (model.cameras.size() <= largest.photos.size()) continue;
            largest.folder = entry.path();
            largest.photos.clear();
            for (const PosedCamera& camera : model.cameras) largest.photos.insert(camera.photo);
        }
        std::ranges::sort(sizes, std::greater());
        for (const std::size_t size : sizes) largest.model_sizes.push_back(std::to_string(size));
        return largest;
    }

    const ColmapRequest& request_;
    const std::vector<std::string>& names_;
    fs::path folder_;
    Progress* progress_;
    std::string last_line_;  // of COLMAP's output
};

bool is_sufficient(const LargestModel& model, std::size_t count) {
    return 3 * model.photos.size() >= 2 * count;
}

// Error that names the photos without a camera.
Error too_few_cameras(const ColmapRequest& request, const std::vector<std::string>& names, const LargestModel& model) {
    std::vector<std::string> missing;
    for (const std::string& name : names) {
        if (!model.photos.contains(name)) missing.push_back(name);
    }
    const std::string where = request.photos.string() + ": COLMAP found the cameras of ";
    const std::string remedy =
        "; take more photos between the others, which overlap by two thirds, and lay something with texture below the "
        "object";
    if (model.photos.empty()) return Error{printable(where + "none of the photos" + remedy)};
    return Error{printable(where + std::to_string(model.photos.size()) + " of " + std::to_string(names.size()) +
                           " photos, not those of " + listed(missing, 12) + remedy + ", or leave these photos out")};
}

std::vector<std::string> notes_of(const ColmapRequest& request, const LargestModel& model, std::size_t count,
                                  bool is_masked) {
    const std::string where = request.photos.string() + ": ";
    std::vector<std::string> notes;
    if (count > kMostExhaustive) {
        notes.push_back(printable(where + "more than " + std::to_string(kMostExhaustive) +
                                  " photos; each is compared with the " + std::to_string(kSequenceOverlap) +
                                  " that follow by name"));
    }
    if (is_masked) {
        notes.push_back(printable(where + "the whole photos have no common cameras; those relative to the object are "
                                          "used"));
    }
    if (model.model_sizes.size() > 1) {
        notes.push_back(printable(where + "COLMAP found " + std::to_string(model.model_sizes.size()) +
                                  " models that share too few photos, of " + listed(model.model_sizes, 8) +
                                  " photos; the largest is used; photos in between may join them"));
    }
    return notes;
}

}  // namespace

Result<ColmapReconstruction> reconstruct_with_colmap(const ColmapRequest& request, Progress* progress) {
    RS_ASSIGN_OR_RETURN(const std::vector<std::string> names, list_photos(request.photos));
    std::error_code failure;
    const fs::path place = fs::temp_directory_path(failure) / ("rayspace-colmap-" + std::to_string(::getpid()));
    if (failure) return Error{"the folder of temporary files: " + failure.message() + "; set TMPDIR"};
    RS_ASSIGN_OR_RETURN(StagedFolder folder, StagedFolder::create(place, "files of COLMAP"));
    const fs::path temporary = folder.temporary_path();
    RS_ASSIGN_OR_RETURN(LargestModel model, ColmapRun(request, names, temporary / "whole", progress).run({}));
    bool is_masked = false;
    if (!is_sufficient(model, names.size()) && !request.masks.empty()) {
        const fs::path masks = temporary / "masks";
        RS_TRY(write_masks(request, names, masks, progress));
        RS_ASSIGN_OR_RETURN(LargestModel masked, ColmapRun(request, names, temporary / "masked", progress).run(masks));
        is_masked = masked.photos.size() > model.photos.size();
        if (is_masked) model = std::move(masked);
    }
    if (!is_sufficient(model, names.size())) return too_few_cameras(request, names, model);
    std::vector<std::string> notes = notes_of(request, model, names.size(), is_masked);
    return ColmapReconstruction{std::move(folder), model.folder, std::move(notes)};
}

}  // namespace rs::capture
