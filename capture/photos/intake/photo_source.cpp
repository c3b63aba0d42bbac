#include "capture/photos/intake/photo_source.hpp"

#include "capture/photos/intake/bounded_work.hpp"
#include "capture/photos/intake/video/frame_selection.hpp"
#include "capture/photos/intake/video/video_frames.hpp"
#include "rayspace/file/file_output.hpp"

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

namespace rs::capture {
namespace {

FrameRequest frame_request(const std::optional<int>& frames, int by_default) {
    return frames ? FrameRequest{*frames, false} : FrameRequest{by_default, true};
}

Result<PhotoFolder> open_film(const PhotoRequest& request, Progress* progress) {
    RS_ASSIGN_OR_RETURN(StagedFolder staged, StagedFolder::create(request.output, "imported photos", request.force));
    const auto frames = std::make_shared<const StagedFolder>(std::move(staged));
    RS_ASSIGN_OR_RETURN(VideoFrames video,
                        write_video_frames(request.photos, frames->temporary_path(),
                                           frame_request(request.frames, kDefaultSelectedFrames), progress));
    Result<PhotoFolder> folder = open_photo_folder(frames->temporary_path(), request.max_side_px);
    if (!folder) return folder;
    folder->temporary = frames;
    folder->selection_notes = std::move(video.notes);
    return folder;
}

void keep_only(PhotoFolder& folder, const std::vector<std::size_t>& chosen) {
    PhotoFolder kept = folder;
    kept.photos.clear();
    kept.own_orientations.clear();
    for (const std::size_t i : chosen) {
        kept.photos.push_back(folder.photos[i]);
        if (!folder.own_orientations.empty()) kept.own_orientations.push_back(folder.own_orientations[i]);
    }
    folder = std::move(kept);
}

Status select_photos(PhotoFolder& folder, const std::string& name, const FrameRequest& request, Progress* progress) {
    std::vector<FrameCopy> copies(folder.photos.size());
    const auto copy = [&](std::size_t i) -> Status {
        RS_ASSIGN_OR_RETURN(const Image<Rgba8> photo, read_photo(folder, i));
        copies[i] = make_frame_copy(photo);
        return {};
    };
    if (Status status = for_each_photo(folder, kReadBytesPerPixel, "comparing the photos", progress, copy); !status) {
        return status;
    }
    const FrameSelection selection = select_frames(copies, request, progress);
    folder.selection_notes.push_back(selection_note(name, "photos", folder.photos.size(), selection));
    keep_only(folder, selection.frames);
    return {};
}

}  // namespace

bool is_video(const std::filesystem::path& photos) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(photos, ignored);
}

Result<PhotoFolder> open_photos(const PhotoRequest& request, Progress* progress) {
    if (request.has_per_photo_options && (is_video(request.photos) || request.frames)) {
        return Error{request.photos.string() +
                     ": masks, angles and steps cannot be combined with a selection of frames; extract the photos "
                     "from the video (ffmpeg -i FILM photos/%03d.png), or leave out --frames"};
    }
    if (is_video(request.photos)) return open_film(request, progress);
    Result<PhotoFolder> folder = open_photo_folder(request.photos, request.max_side_px);
    if (!folder) return folder;
    const std::size_t count = folder->photos.size();
    const bool is_large = count > kMaxPhotosWithoutSelection && !request.has_per_photo_options;
    const bool is_fewer_requested = request.frames && count > static_cast<std::size_t>(*request.frames);
    if (request.frames && !is_fewer_requested) {
        folder->selection_notes.push_back(request.photos.string() + ": holds " + std::to_string(count) +
                                          " photos, no more than --frames; all are used");
    }
    if (is_fewer_requested || (is_large && !request.frames)) {
        const FrameRequest frames = frame_request(request.frames, kMaxSelectedFrames);
        RS_TRY(select_photos(*folder, request.photos.string(), frames, progress));
    }
    return folder;
}

}  // namespace rs::capture
