#include "capture/calibration/known/known_files.hpp"

#include <algorithm>
#include <cctype>
#include <map>

namespace rs::capture {

Result<KnownFile> read_known_file(const std::filesystem::path& path, PicturePixels pictures) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    std::error_code failure;
    if (ending == ".json" || std::filesystem::is_directory(path, failure)) return read_known_rig(path, pictures);
    if (ending == ".yml" || ending == ".yaml" || ending == ".xml") return read_opencv_intrinsics(path, pictures);
    if (ending == ".txt") return read_middlebury_parameters(path);
    return Error{
        path.string() +
        ": what is known is read from a transforms.json, from *_par.txt (Middlebury) or from *.yml, *.yaml and "
        "*.xml (OpenCV); give one of these"};
}

Result<KnownInputs> known_of_photographs(const KnownFile& file, const std::vector<std::string>& photographs) {
    KnownInputs known = file.known;
    if (!known.angles_rad || file.pictures.empty()) return known;
    std::map<std::string, double> angle_of;
    for (std::size_t i = 0; i < file.pictures.size() && i < known.angles_rad->size(); ++i) {
        angle_of[std::filesystem::path(file.pictures[i]).stem().string()] = (*known.angles_rad)[i];
    }
    std::vector<double> angles;
    for (const std::string& photograph : photographs) {
        const auto found = angle_of.find(std::filesystem::path(photograph).stem().string());
        if (found == angle_of.end()) {
            return Error{photograph + ": is not among the " + std::to_string(angle_of.size()) +
                         " pictures that the given rig knows; take it out of the folder, or give its rig"};
        }
        angles.push_back(found->second);
    }
    // Angles count from the first photograph; the pose is of the camera and the table and stays.
    for (double& angle : angles) angle -= angle_of.at(std::filesystem::path(photographs.front()).stem().string());
    known.angles_rad = std::move(angles);
    return known;
}

}  // namespace rs::capture
